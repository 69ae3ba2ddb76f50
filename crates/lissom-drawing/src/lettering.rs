//! Text as outlines, and its width. The letters are those of DejaVu Sans: Latin, Greek, Cyrillic capitals and the symbols
//! of formulas and units. Missing characters are drawn as boxes.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// A part of DejaVu Sans (free to use and redistribute, see `DejaVuSans-LICENSE`).
static FONT: &[u8] = include_bytes!("DejaVuSans-subset.ttf");

static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FONT, 0).ok());

/// Number of segments of a curve of an outline.
const PIECES: u32 = 5;

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

/// Closed outlines of text that begins at the origin, to the right and downwards.
pub(crate) fn outlines(text: &str, height: f64) -> Vec<Vec<[f64; 2]>> {
    let Some(face) = &*FACE else { return Vec::new() };
    let scale = height / f64::from(face.units_per_em());
    let mut builder = Outlines { found: Vec::new(), pen: 0.0, scale };
    for letter in text.chars() {
        let glyph = glyph(face, letter);
        // A space has no outline.
        let _ = face.outline_glyph(glyph, &mut builder);
        builder.pen += advance(face, glyph) * scale;
    }
    builder.found
}

struct Outlines {
    found: Vec<Vec<[f64; 2]>>,
    pen: f64,
    scale: f64,
}

impl Outlines {
    fn place(&self, x: f32, y: f32) -> [f64; 2] {
        [self.pen + self.scale * f64::from(x), -self.scale * f64::from(y)]
    }

    fn last(&self) -> [f64; 2] {
        self.found.last().and_then(|outline| outline.last()).copied().unwrap_or_default()
    }

    fn bend(&mut self, at: impl Fn(f64) -> [f64; 2]) {
        if let Some(outline) = self.found.last_mut() {
            outline.extend((1..=PIECES).map(|piece| at(f64::from(piece) / f64::from(PIECES))));
        }
    }
}

impl OutlineBuilder for Outlines {
    fn move_to(&mut self, x: f32, y: f32) {
        let place = self.place(x, y);
        self.found.push(vec![place]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let place = self.place(x, y);
        if let Some(outline) = self.found.last_mut() {
            outline.push(place);
        }
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.last(), self.place(x1, y1), self.place(x, y));
        self.bend(|t| {
            std::array::from_fn(|i| (1.0 - t) * ((1.0 - t) * a[i] + 2.0 * t * b[i]) + t * t * c[i])
        });
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.last(), self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.bend(|t| {
            let s = 1.0 - t;
            std::array::from_fn(|i| s * s * (s * a[i] + 3.0 * t * b[i]) + t * t * (3.0 * s * c[i] + t * d[i]))
        });
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_have_outlines_and_widths() {
        assert!(FACE.is_some());
        assert!((width("m", 100.0) - 97.4).abs() < 1.0, "{}", width("m", 100.0));
        assert!((width("ii", 10.0) - 2.0 * width("i", 10.0)).abs() < 1e-9);
        assert_eq!(outlines("o", 10.0).len(), 2, "outside and inside");
        assert!(outlines(" ", 10.0).is_empty());
        let bounds = outlines("H", 100.0).concat();
        let height = bounds.iter().fold(0.0_f64, |most, place| most.max(-place[1]));
        assert!((height - 72.9).abs() < 1.0, "{height}");
        for letter in "µΩαωäß²·−–°".chars() {
            assert!(FACE.as_ref().unwrap().glyph_index(letter).is_some(), "{letter}");
        }
    }
}
