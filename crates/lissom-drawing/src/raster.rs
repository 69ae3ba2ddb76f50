//! Drawings as pixels, antialiased.

use std::io::Write;

use png::EncodingError;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform,
};

use crate::drawing::{Align, DASH, Drawing, DrawingError, EDGE, PngError, Shade, Shape};
use crate::image::Image;
use crate::lettering;

/// Maximum number of pixels of a picture.
const MAX_PIXELS: f64 = 1e8;

/// Number of rows that are drawn at once. They stay in the cache, whereas for a whole picture the system would provide
/// new memory, which takes longer than drawing.
const BAND: u32 = 64;

impl Drawing {
    /// The drawing as outlines, `scale` pixels for each of its own.
    pub(crate) fn raster(&self, scale: f64) -> Result<Raster, DrawingError> {
        self.check()?;
        Ok(Raster::new(self, scale)?)
    }

    /// Red, green and blue of all pixels of an image of its size with the drawing above it.
    pub(crate) fn over(&self, image: &Image) -> Result<Vec<u8>, DrawingError> {
        let raster = self.raster(1.0)?;
        if [raster.width, raster.height] != image.size {
            return Err(PngError::Sizes.into());
        }
        let mut pixels = Vec::new();
        raster.write(Some(image), &mut pixels)?;
        Ok(pixels)
    }
}

/// A drawing as outlines in pixels.
pub(crate) struct Raster {
    pub(crate) width: u32,
    pub(crate) height: u32,
    outlines: Vec<Outline>,
}

struct Outline {
    path: Path,
    paint: Paint<'static>,
}

impl Raster {
    /// The drawing, `scale` pixels for each of its own.
    pub(crate) fn new(drawing: &Drawing, scale: f64) -> Result<Self, PngError> {
        let [width, height] = drawing.size.map(|side| (side * scale).ceil().max(0.0));
        if width * height > MAX_PIXELS {
            return Err(PngError::TooLarge { width: width as u64, height: height as u64 });
        }
        if width * height == 0.0 {
            return Err(PngError::Nothing);
        }
        let mut raster = Self { width: width as u32, height: height as u32, outlines: Vec::new() };
        for shape in &drawing.shapes {
            raster.add(shape, scale as f32);
        }
        Ok(raster)
    }

    fn add(&mut self, shape: &Shape, scale: f32) {
        let scaling = Transform::from_scale(scale, scale);
        match shape {
            Shape::Polygon { points, shade } => {
                let outline = path(points, true).and_then(|path| path.transform(scaling));
                self.stroke(outline.as_ref(), *shade, EDGE as f32 * scale, None);
                self.fill(outline, *shade);
            }
            Shape::Disc { center: [x, y], radius, shade } => {
                let circle = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32);
                self.fill(circle.and_then(|path| path.transform(scaling)), *shade);
            }
            Shape::Line { points, shade, width, is_dashed: false } if is_rectilinear(points) => {
                for pair in points.windows(2) {
                    self.bar(pair, *shade, 0.5 * width, f64::from(scale));
                }
            }
            Shape::Line { points, shade, width, is_dashed } => {
                let line = path(points, false).and_then(|path| path.transform(scaling));
                let dash = is_dashed.then(|| DASH.map(|length| length as f32 * scale).to_vec());
                self.stroke(line.as_ref(), *shade, *width as f32 * scale, dash);
            }
            Shape::Words { at: [x, y], text, height, align, shade, is_upright } => {
                let share = match align {
                    Align::Start => 0.0,
                    Align::Middle => 0.5,
                    Align::End => 1.0,
                };
                let start = -share * lettering::width(text, f64::from(*height));
                let place = scaling
                    .pre_translate(*x as f32, *y as f32)
                    .pre_rotate(if *is_upright { -90.0 } else { 0.0 })
                    .pre_translate(start as f32, 0.0);
                let letters = lettering::outlines(text, f64::from(*height));
                self.fill(letters.and_then(|path| path.transform(place)), *shade);
            }
        }
    }

    fn fill(&mut self, path: Option<Path>, shade: Shade) {
        self.outlines.extend(path.map(|path| Outline { path, paint: paint(shade) }));
    }

    fn stroke(&mut self, path: Option<&Path>, shade: Shade, width: f32, dash: Option<Vec<f32>>) {
        let (line_cap, line_join) = (LineCap::Round, LineJoin::Round);
        let line = Stroke { width, line_cap, line_join, ..Stroke::default() };
        let dashed = dash.and_then(|lengths| path?.dash(&StrokeDash::new(lengths, 0.0)?, 1.0));
        self.fill(dashed.as_ref().or(path).and_then(|path| path.stroke(&line, 1.0)), shade);
    }

    /// Adds a line along an axis, of whole pixels: sharp, and drawn in a fraction of the time.
    fn bar(&mut self, ends: &[[f64; 2]], shade: Shade, half: f64, scale: f64) {
        let sides = [self.width, self.height].map(f64::from);
        let [[left, right], [top, bottom]] = [0, 1].map(|axis| {
            let [from, to] = [ends[0][axis], ends[1][axis]];
            let low = (scale * (from.min(to) - half)).round();
            let length = (scale * ((from - to).abs() + 2.0 * half)).round().max(1.0);
            [low, low + length].map(|number| number.clamp(0.0, sides[axis]) as f32)
        });
        let paint = Paint { anti_alias: false, ..paint(shade) };
        let bar = Rect::from_ltrb(left, top, right, bottom).map(PathBuilder::from_rect);
        self.outlines.extend(bar.map(|path| Outline { path, paint }));
    }

    /// Writes red, green and blue of all pixels, row by row from above, on an image or on white.
    pub(crate) fn write(&self, below: Option<&Image>, target: &mut impl Write) -> Result<(), PngError> {
        let mut band = Pixmap::new(self.width, BAND.min(self.height)).ok_or(PngError::Nothing)?;
        let mut colours = vec![[0; 3]; self.width as usize];
        for top in (0..self.height).step_by(BAND as usize) {
            let rows = BAND.min(self.height - top);
            let [from, to] = [top, top + rows].map(|row| row as f32);
            band.data_mut().fill(255);
            if let Some(image) = below {
                let own = &image.pixels[top as usize * colours.len()..];
                for (pixel, own) in band.data_mut().as_chunks_mut::<4>().0.iter_mut().zip(own) {
                    pixel[..3].copy_from_slice(own);
                }
            }
            for Outline { path, paint } in &self.outlines {
                if path.bounds().top() < to && path.bounds().bottom() > from {
                    let place = Transform::from_translate(0.0, -from);
                    band.fill_path(path, paint, FillRule::Winding, place, None);
                }
            }
            let pixels = band.data().as_chunks::<4>().0;
            for row in pixels.chunks_exact(colours.len()).take(rows as usize) {
                for (colour, [red, green, blue, _]) in colours.iter_mut().zip(row) {
                    *colour = [*red, *green, *blue];
                }
                target.write_all(colours.as_flattened()).map_err(EncodingError::from)?;
            }
        }
        Ok(())
    }
}

fn paint([red, green, blue]: Shade) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}

fn is_rectilinear(points: &[[f64; 2]]) -> bool {
    points.windows(2).all(|pair| pair[0][0] == pair[1][0] || pair[0][1] == pair[1][1])
}

fn path(points: &[[f64; 2]], is_closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::with_capacity(points.len() + 1, points.len());
    for (index, [x, y]) in points.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    if is_closed {
        builder.close();
    }
    builder.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn empty(width: f64, height: f64) -> Raster {
        Raster::new(&Drawing::new("empty", [width, height]), 1.0).unwrap()
    }

    fn pixels(raster: &Raster) -> Vec<u8> {
        let mut pixels = Vec::new();
        raster.write(None, &mut pixels).unwrap();
        pixels
    }

    /// Sum over the pixels, one for a black one.
    fn darkness(raster: &Raster) -> f64 {
        pixels(raster).iter().map(|pixel| 1.0 - f64::from(*pixel) / 255.0).sum::<f64>() / 3.0
    }

    #[test]
    fn polygons_cover_their_area() {
        for points in [
            vec![[3.3, 2.7], [15.9, 4.1], [8.2, 17.6]],
            vec![[2.25, 2.5], [9.75, 2.5], [9.75, 12.75], [2.25, 12.75]],
            vec![[2.0, 2.0], [2.0, 18.0], [18.0, 18.0], [18.0, 17.0], [3.0, 17.0], [3.0, 2.0]],
        ] {
            let mut raster = empty(20.0, 20.0);
            raster.fill(path(&points, true), [0; 3]);
            let next = |index: usize| points[(index + 1) % points.len()];
            let twice: f64 =
                points.iter().enumerate().map(|(i, a)| a[0] * next(i)[1] - a[1] * next(i)[0]).sum();
            let found = darkness(&raster) / (0.5 * twice.abs());
            assert!((found - 1.0).abs() < 0.01, "{found} {twice}");
        }
    }

    #[test]
    fn lines_cover_length_times_width() {
        // The last ones cross several bands.
        for (to, width) in [
            ([40.0, 10.0], 3.0),
            ([10.0, 40.0], 1.5),
            ([45.0, 38.0], 2.0),
            ([45.0, 38.0], 0.5),
            ([45.0, 190.0], 2.0),
            ([45.0, 190.0], 9.0),
        ] {
            let mut raster = empty(60.0, 200.0);
            raster.stroke(path(&[[10.0, 10.0], to], false).as_ref(), [0; 3], width, None);
            let length = f64::hypot(to[0] - 10.0, to[1] - 10.0);
            let width = f64::from(width);
            let found = darkness(&raster) / (length * width + 0.25 * std::f64::consts::PI * width * width);
            assert!((found - 1.0).abs() < 0.06, "{to:?} {width}: {found}");
        }
    }

    #[test]
    fn lines_along_an_axis_are_whole_pixels() {
        let mut drawing = Drawing::new("corner", [20.0, 20.0]);
        drawing.line(vec![[3.3, 2.0], [3.3, 16.2], [18.0, 16.2]], [0; 3], 1.0);
        let raster = Raster::new(&drawing, 2.0).unwrap();
        let found = pixels(&raster);
        assert!(found.iter().all(|pixel| [0, 255].contains(pixel)));
        assert_eq!(darkness(&raster), 2.0 * 30.0 + 2.0 * 29.0);
    }

    #[test]
    fn dashes_go_on_along_a_curve_of_many_points() {
        let mut drawing = Drawing::new("dashes", [60.0, 6.0]);
        let points = (0..=1000).map(|k| [0.0599 * f64::from(k), 3.0]).collect();
        drawing.dashed_line(points, [0; 3], 2.0);
        let found = pixels(&Raster::new(&drawing, 1.0).unwrap());
        // Dashes begin at 0, 12, 24, 36 and 48, and each is 8 long.
        for dash in 0..5 {
            let row = |column: usize| found[3 * (3 * 60 + 12 * dash + column)];
            assert_eq!([row(2), row(6), row(10)], [0, 0, 255], "{dash}");
        }
    }

    #[test]
    fn what_lies_outside_is_cut_off() {
        let square = |right: f64| path(&[[-50.0, -50.0], [right, -50.0], [right, 60.0], [-50.0, 60.0]], true);
        let mut raster = empty(10.0, 10.0);
        raster.fill(square(60.0), [0; 3]);
        assert!((darkness(&raster) - 100.0).abs() < 1e-9, "{}", darkness(&raster));
        let mut raster = empty(10.0, 10.0);
        raster.fill(square(5.0), [0; 3]);
        assert!((darkness(&raster) - 50.0).abs() < 1e-9, "{}", darkness(&raster));
        let mut line = |points: [[f64; 2]; 2], shade| {
            let points = points.to_vec();
            raster.add(&Shape::Line { points, shade, width: 2.0, is_dashed: false }, 1.0);
        };
        line([[20.0, 20.0], [30.0, 30.0]], [0; 3]);
        line([[-1e9, 5.0], [1e9, 5.0]], [255; 3]);
        assert!((darkness(&raster) - 40.0).abs() < 0.1, "{}", darkness(&raster));
    }

    #[test]
    fn words_are_as_dark_upright_as_level() {
        let words = |is_upright| {
            let mut raster = empty(120.0, 120.0);
            let at = if is_upright { [60.3, 110.0] } else { [10.0, 60.3] };
            let text = "displacement [m]".to_owned();
            let (height, align, shade) = (12, Align::Start, [0; 3]);
            raster.add(&Shape::Words { at, text, height, align, shade, is_upright }, 1.0);
            darkness(&raster)
        };
        let [level, upright] = [words(false), words(true)];
        assert!(level > 100.0 && (upright / level - 1.0).abs() < 0.02, "{level} {upright}");
    }
}
