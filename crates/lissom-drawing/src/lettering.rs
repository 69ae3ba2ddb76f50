//! Text as outlines, and its width. The letters are those of DejaVu Sans: Latin, Greek, Cyrillic capitals and the symbols
//! of formulas and units. Missing characters are drawn as boxes.

use std::sync::LazyLock;

use tiny_skia::{Path, PathBuilder, Point};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// A part of DejaVu Sans (free to use and redistribute, see `DejaVuSans-LICENSE`).
static FONT: &[u8] = include_bytes!("DejaVuSans-subset.ttf");

static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FONT, 0).ok());

/// Width of text of a height.
pub(crate) fn width(text: &str, height: f64) -> f64 {
    let Some(face) = &*FACE else { return 0.6 * height * text.chars().count() as f64 };
    let units: f64 = text.chars().map(|letter| advance(face, glyph(face, letter))).sum();
    units * height / f64::from(face.units_per_em())
}

fn glyph(face: &Face<'_>, letter: char) -> GlyphId {
    face.glyph_index(letter).unwrap_or(GlyphId(0))
}

fn advance(face: &Face<'_>, glyph: GlyphId) -> f64 {
    f64::from(face.glyph_hor_advance(glyph).unwrap_or_default())
}

/// Outlines of text that begins at the origin, to the right and downwards; none if all of it is blank.
pub(crate) fn outlines(text: &str, height: f64) -> Option<Path> {
    let face = FACE.as_ref()?;
    let scale = height / f64::from(face.units_per_em());
    let mut outlines = Outlines { path: PathBuilder::new(), pen: 0.0, scale: scale as f32 };
    for letter in text.chars() {
        let glyph = glyph(face, letter);
        // A space has no outline.
        let _ = face.outline_glyph(glyph, &mut outlines);
        outlines.pen += advance(face, glyph) as f32 * outlines.scale;
    }
    outlines.path.finish()
}

struct Outlines {
    path: PathBuilder,
    pen: f32,
    scale: f32,
}

impl Outlines {
    fn place(&self, x: f32, y: f32) -> Point {
        Point::from_xy(self.pen + self.scale * x, -self.scale * y)
    }
}

impl OutlineBuilder for Outlines {
    fn move_to(&mut self, x: f32, y: f32) {
        let Point { x, y } = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let Point { x, y } = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (bend, end) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(bend.x, bend.y, end.x, end.y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (first, second, end) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(first.x, first.y, second.x, second.y, end.x, end.y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
#[path = "../tests/unit/lettering.rs"]
mod tests;
