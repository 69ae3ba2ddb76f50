//! Surfaces as pixels by a depth buffer: the fast way to draw many pictures.

use crate::drawing::Shade;
use crate::image::Image;

/// Samples of a pixel along each axis.
const SAMPLES: usize = 2;

/// Width by which faces are enlarged so that neighbours have no gap [samples].
const EDGE: f64 = 1e-6;

/// A corner of a face: pixels to the right and downward, position towards the viewer, and brightness.
pub type Corner = [f64; 4];

/// Samples of an image with the position of the nearest surface towards the viewer, and its colour.
pub struct DepthBuffer {
    size: [u32; 2],
    width: usize,
    samples: Vec<(f32, Shade)>,
}

impl DepthBuffer {
    /// An empty one, for an image of this width and height.
    pub fn new(size: [u32; 2]) -> Self {
        let [width, height] = size.map(|side| SAMPLES * side as usize);
        Self { size, width, samples: vec![(f32::NEG_INFINITY, [255; 3]); width * height] }
    }

    /// Draws a convex face where it is nearest.
    pub fn draw(&mut self, face: &[Corner], shade: Shade) {
        for k in 2..face.len() {
            let scaled =
                |[x, y, near, bright]: Corner| [SAMPLES as f64 * x, SAMPLES as f64 * y, near, bright];
            self.triangle([face[0], face[k - 1], face[k]].map(scaled), shade);
        }
    }

    fn triangle(&mut self, [a, b, c]: [Corner; 3], shade: Shade) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let range = |k: usize, count: usize| {
            let low = a[k].min(b[k]).min(c[k]).ceil().max(0.0) as usize;
            let high = a[k].max(b[k]).max(c[k]).floor();
            low..if high < 0.0 { 0 } else { count.min(high as usize + 1) }
        };
        let (columns, rows) = (range(0, self.width), range(1, self.samples.len() / self.width));
        // The shares of the corners a and c are linear; so is what they weigh.
        let slope = [b[1] - c[1], a[1] - b[1]].map(|change| change / area);
        let weigh = |k: usize, [of_a, of_c]: [f64; 2]| b[k] + of_a * (a[k] - b[k]) + of_c * (c[k] - b[k]);
        for row in rows {
            let y = row as f64;
            let start = [(c[0] - b[0]) * (y - b[1]) / area, (b[0] - a[0]) * (y - a[1]) / area];
            let start = [start[0] - slope[0] * b[0], start[1] - slope[1] * a[0]];
            // All three shares are positive between two columns of a row.
            let (mut low, mut high) = (columns.start as f64, columns.end as f64 - 1.0);
            let third = (1.0 - start[0] - start[1], -slope[0] - slope[1]);
            for (share, slope) in [(start[0], slope[0]), (start[1], slope[1]), third] {
                let zero = -share / slope;
                if slope > 0.0 {
                    low = low.max(zero - EDGE);
                } else if slope < 0.0 {
                    high = high.min(zero + EDGE);
                } else if share < 0.0 {
                    high = -1.0;
                }
            }
            if high < low {
                continue;
            }
            let line = &mut self.samples[row * self.width..][..self.width];
            for (column, sample) in
                (low.ceil() as usize..).zip(&mut line[low.ceil() as usize..=high as usize])
            {
                let x = column as f64;
                let shares = [0, 1].map(|k| start[k] + slope[k] * x);
                let near = weigh(2, shares) as f32;
                if near > sample.0 {
                    let bright = weigh(3, shares);
                    *sample = (near, shade.map(|part| (f64::from(part) * bright + 0.5) as u8));
                }
            }
        }
    }

    /// The means of the samples of every pixel, on white.
    pub fn image(&self) -> Image {
        let mut image = Image::white(self.size);
        let width = self.size[0] as usize;
        for (index, pixel) in image.pixels.iter_mut().enumerate() {
            let first = SAMPLES * (index / width) * self.width + SAMPLES * (index % width);
            let mut sum = [0; 3];
            for row in 0..SAMPLES {
                for (_, shade) in &self.samples[first + row * self.width..][..SAMPLES] {
                    (0..3).for_each(|k| sum[k] += usize::from(shade[k]));
                }
            }
            *pixel = sum.map(|part| (part / (SAMPLES * SAMPLES)) as u8);
        }
        image
    }
}

#[cfg(test)]
#[path = "../tests/unit/depth_buffer.rs"]
mod tests;
