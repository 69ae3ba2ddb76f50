//! Drawings as pixels, antialiased: the weight of a shape's colour in a pixel is the area that it covers.

use crate::dashes::dashes;
use crate::drawing::{Align, Shade, Shape};
use crate::lettering;
use crate::png::PngError;

/// Maximum number of pixels of a picture.
const MAX_PIXELS: f64 = 1e8;

/// Rows of pixels, red, green and blue.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<u8>,
    /// Pixels for each of the drawing.
    scale: f64,
    /// Coverage of each pixel by the present shape, zero before and after.
    cover: Vec<f32>,
}

/// Pixels from a position up to another, the latter excluded.
#[derive(Clone, Copy)]
struct Bounds {
    from: [usize; 2],
    to: [usize; 2],
}

impl Image {
    /// A white picture.
    pub(crate) fn new(size: [f64; 2], scale: f64) -> Result<Self, PngError> {
        let [width, height] = size.map(|side| (side * scale).ceil());
        if width * height > MAX_PIXELS {
            return Err(PngError::TooLarge { width: width as u64, height: height as u64 });
        }
        let [width, height] = [width, height].map(|side| side.max(0.0) as usize);
        if width == 0 || height == 0 {
            return Err(PngError::Nothing);
        }
        Ok(Image {
            width,
            height,
            pixels: vec![255; 3 * width * height],
            scale,
            cover: vec![0.0; width * height],
        })
    }

    pub(crate) fn draw(&mut self, shape: &Shape) {
        let scale = self.scale;
        let scaled = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|place| place.map(|number| scale * number)).collect()
        };
        match shape {
            Shape::Polygon { points, shade } => {
                let mut outline = scaled(points);
                self.fill(std::slice::from_ref(&outline), *shade);
                outline.extend(outline.first().copied());
                self.stroke(&outline, 0.8 * scale, *shade);
            }
            Shape::Disc { center, radius, shade } => {
                let corner = |k: u32| {
                    let (sine, cosine) = (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos();
                    [center[0] + radius * cosine, center[1] + radius * sine].map(|number| scale * number)
                };
                self.fill(&[(0..24).map(corner).collect()], *shade);
            }
            Shape::Line { points, shade, width, is_dashed } => {
                let pieces = if *is_dashed { dashes(points) } else { vec![points.clone()] };
                for piece in pieces {
                    self.stroke(&scaled(&piece), width * scale, *shade);
                }
            }
            Shape::Words { at, text, height, align, shade, is_upright } => {
                let height = scale * f64::from(*height);
                let shift = lettering::width(text, height)
                    * match align {
                        Align::Start => 0.0,
                        Align::Middle => 0.5,
                        Align::End => 1.0,
                    };
                let place = |[x, y]: [f64; 2]| {
                    let [x, y] = if *is_upright { [y, shift - x] } else { [x - shift, y] };
                    [scale * at[0] + x, scale * at[1] + y]
                };
                let outlines: Vec<Vec<[f64; 2]>> = lettering::outlines(text, height)
                    .into_iter()
                    .map(|outline| outline.into_iter().map(place).collect())
                    .collect();
                self.fill(&outlines, *shade);
            }
        }
    }

    /// Pixels that positions within `reach` may touch, if there are any in the picture.
    fn bounds<'a>(&self, places: impl Iterator<Item = &'a [f64; 2]>, reach: f64) -> Option<Bounds> {
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in places {
            for axis in 0..2 {
                least[axis] = least[axis].min(place[axis] - reach);
                most[axis] = most[axis].max(place[axis] + reach);
            }
        }
        let sides = [self.width, self.height];
        // Numbers beyond the picture are clamped to it.
        let from = std::array::from_fn(|axis| (least[axis].floor().max(0.0) as usize).min(sides[axis]));
        let to = std::array::from_fn(|axis| (most[axis].ceil().max(0.0) as usize).min(sides[axis]));
        (from[0] < to[0] && from[1] < to[1]).then_some(Bounds { from, to })
    }

    /// Fills closed outlines; holes have the opposite orientation.
    ///
    /// Every edge adds its change of coverage to the pixels that it crosses, so that sums along rows are the covered
    /// area.
    fn fill(&mut self, outlines: &[Vec<[f64; 2]>], shade: Shade) {
        let Some(bounds) = self.bounds(outlines.iter().flatten(), 1.0) else { return };
        for outline in outlines {
            for (index, &to) in outline.iter().enumerate() {
                let from = outline[(index + outline.len() - 1) % outline.len()];
                self.edge(from, to, bounds);
            }
        }
        for row in bounds.from[1]..bounds.to[1] {
            let mut sum = 0.0;
            for column in bounds.from[0]..bounds.to[0] {
                let index = row * self.width + column;
                sum += std::mem::take(&mut self.cover[index]);
                self.blend(index, sum.abs().min(1.0), shade);
            }
        }
    }

    fn edge(&mut self, from: [f64; 2], to: [f64; 2], bounds: Bounds) {
        let (sign, top, bottom) = if from[1] < to[1] { (1.0, from, to) } else { (-1.0, to, from) };
        if bottom[1] <= top[1] {
            return;
        }
        let slope = (bottom[0] - top[0]) / (bottom[1] - top[1]);
        let [left, right] = [bounds.from[0] as f64, bounds.to[0] as f64];
        let first = (top[1].floor().max(bounds.from[1] as f64)) as usize;
        let last = (bottom[1].ceil().clamp(0.0, bounds.to[1] as f64)) as usize;
        for row in first..last {
            let (y0, y1) = (top[1].max(row as f64), bottom[1].min(row as f64 + 1.0));
            if y1 <= y0 {
                continue;
            }
            let x = [y0, y1].map(|y| (top[0] + slope * (y - top[1])).clamp(left, right));
            let (x0, x1) = (x[0].min(x[1]), x[0].max(x[1]));
            let area = sign * (y1 - y0);
            let (start, end) = (x0.floor() as usize, x1.ceil().max(x0.floor() + 1.0) as usize);
            // Fraction of the edge's height that is left of the right end of each pixel.
            let mut before = 0.0;
            for column in start..=end {
                if column >= bounds.to[0] {
                    break;
                }
                let covered = covered_share(x0, x1, column as f64);
                self.cover[row * self.width + column] += (area * (covered - before)) as f32;
                before = covered;
            }
        }
    }

    /// Draws a line of a width, with round ends and corners.
    fn stroke(&mut self, points: &[[f64; 2]], width: f64, shade: Shade) {
        let reach = 0.5 * width + 1.0;
        let Some(bounds) = self.bounds(points.iter(), reach) else { return };
        for pair in points.windows(2) {
            self.segment(pair[0], pair[1], width);
        }
        for row in bounds.from[1]..bounds.to[1] {
            for column in bounds.from[0]..bounds.to[0] {
                let index = row * self.width + column;
                let cover = std::mem::take(&mut self.cover[index]);
                if cover > 0.0 {
                    self.blend(index, cover, shade);
                }
            }
        }
    }

    /// Records the coverage of pixels by a straight segment, unless another segment covers more.
    fn segment(&mut self, from: [f64; 2], to: [f64; 2], width: f64) {
        let reach = 0.5 * width + 1.0;
        let Some(bounds) = self.bounds([from, to].iter(), reach) else { return };
        // Lines thinner than a pixel are paler.
        let most = width.min(1.0);
        let along = [to[0] - from[0], to[1] - from[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        for row in bounds.from[1]..bounds.to[1] {
            let y = row as f64 + 0.5;
            // The part within reach of this row.
            let x = [y - reach, y + reach].map(|y| {
                let share = if along[1] == 0.0 { 0.0 } else { ((y - from[1]) / along[1]).clamp(0.0, 1.0) };
                from[0] + share * along[0]
            });
            let (left, right) = if along[1] == 0.0 {
                (from[0].min(to[0]) - reach, from[0].max(to[0]) + reach)
            } else {
                (x[0].min(x[1]) - reach, x[0].max(x[1]) + reach)
            };
            let first = (left.floor().max(0.0) as usize).max(bounds.from[0]);
            let last = (right.ceil().max(0.0) as usize).min(bounds.to[0]);
            for column in first..last {
                let offset = [column as f64 + 0.5 - from[0], y - from[1]];
                let share = (offset[0] * along[0] + offset[1] * along[1]) / square;
                let share = if square > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
                let distance = (offset[0] - share * along[0]).hypot(offset[1] - share * along[1]);
                let cover = (0.5 * width.max(1.0) + 0.5 - distance).clamp(0.0, 1.0) * most;
                let known = &mut self.cover[row * self.width + column];
                *known = known.max(cover as f32);
            }
        }
    }

    fn blend(&mut self, index: usize, cover: f32, shade: Shade) {
        if cover <= 0.0 {
            return;
        }
        for (pixel, shade) in self.pixels[3 * index..3 * index + 3].iter_mut().zip(shade) {
            let mixed = f32::from(*pixel) + cover * (f32::from(shade) - f32::from(*pixel));
            *pixel = mixed.round() as u8;
        }
    }
}

/// Fraction of a pixel's width, from `column` on, that is right of an edge from `x0` to `x1`, averaged over its height; the part
/// further left counts as whole.
fn covered_share(x0: f64, x1: f64, column: f64) -> f64 {
    let right = column + 1.0;
    if x1 - x0 < 1e-9 {
        return (right - x0).clamp(0.0, 1.0);
    }
    // Integral over the edge of the part to its right within the pixel.
    let part = |from: f64, to: f64| 0.5 * (to - from).max(0.0) * ((right - from) + (right - to).max(0.0));
    let before = (x1.min(column) - x0).max(0.0);
    let inside = part(x0.max(column), x1.min(right));
    (before + if x1.min(right) > x0.max(column) { inside } else { 0.0 }) / (x1 - x0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn darkness(image: &Image) -> f64 {
        image.pixels.iter().map(|pixel| 1.0 - f64::from(*pixel) / 255.0).sum::<f64>() / 3.0
    }

    #[test]
    fn polygons_cover_their_area() {
        for points in [
            vec![[3.3, 2.7], [15.9, 4.1], [8.2, 17.6]],
            vec![[2.25, 2.5], [9.75, 2.5], [9.75, 12.75], [2.25, 12.75]],
            vec![[2.0, 2.0], [2.0, 18.0], [18.0, 18.0], [18.0, 17.0], [3.0, 17.0], [3.0, 2.0]],
        ] {
            let mut image = Image::new([20.0, 20.0], 1.0).unwrap();
            image.fill(std::slice::from_ref(&points), [0; 3]);
            let next = |index: usize| points[(index + 1) % points.len()];
            let twice: f64 =
                points.iter().enumerate().map(|(i, a)| a[0] * next(i)[1] - a[1] * next(i)[0]).sum();
            assert!((darkness(&image) - 0.5 * twice.abs()).abs() < 0.1, "{} {twice}", darkness(&image));
        }
    }

    #[test]
    fn lines_cover_length_times_width() {
        for (to, width) in
            [([40.0, 10.0], 3.0), ([10.0, 40.0], 1.5), ([45.0, 38.0], 2.0), ([45.0, 38.0], 0.5)]
        {
            let mut image = Image::new([50.0, 50.0], 1.0).unwrap();
            image.stroke(&[[10.0, 10.0], to], width, [0; 3]);
            let length = f64::hypot(to[0] - 10.0, to[1] - 10.0);
            let found = darkness(&image) / (length * width + 0.25 * std::f64::consts::PI * width * width);
            assert!((found - 1.0).abs() < 0.06, "{to:?} {width}: {found}");
        }
    }

    #[test]
    fn what_lies_outside_is_cut_off() {
        let mut image = Image::new([10.0, 10.0], 1.0).unwrap();
        image.fill(&[vec![[-50.0, -50.0], [60.0, -50.0], [60.0, 60.0], [-50.0, 60.0]]], [0; 3]);
        assert!((darkness(&image) - 100.0).abs() < 1e-9, "{}", darkness(&image));
        let mut image = Image::new([10.0, 10.0], 1.0).unwrap();
        image.fill(&[vec![[-50.0, -50.0], [5.0, -50.0], [5.0, 60.0], [-50.0, 60.0]]], [0; 3]);
        assert!((darkness(&image) - 50.0).abs() < 1e-9, "{}", darkness(&image));
        image.stroke(&[[20.0, 20.0], [30.0, 30.0]], 2.0, [0; 3]);
        image.stroke(&[[-1e9, 5.0], [1e9, 5.0]], 2.0, [255; 3]);
        assert!((darkness(&image) - 40.0).abs() < 0.1, "{}", darkness(&image));
    }

    #[test]
    fn words_are_as_dark_upright_as_level() {
        let words = |is_upright| {
            let mut image = Image::new([120.0, 120.0], 1.0).unwrap();
            let at = if is_upright { [60.3, 110.0] } else { [10.0, 60.3] };
            let text = "displacement [m]".to_owned();
            let (height, align, shade) = (12, Align::Start, [0; 3]);
            image.draw(&Shape::Words { at, text, height, align, shade, is_upright });
            darkness(&image)
        };
        let [level, upright] = [words(false), words(true)];
        assert!(level > 100.0 && (upright / level - 1.0).abs() < 0.02, "{level} {upright}");
    }
}
