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
#[path = "../tests/unit/raster.rs"]
mod tests;
