//! Elements of a drawing.

/// Width of the edge that is drawn around polygons.
pub(crate) const EDGE: f64 = 0.8;

/// Lengths of a dash and of the gap after it.
pub(crate) const DASH: [f64; 2] = [8.0, 4.0];

/// Red, green and blue in screen values, 0 to 255.
pub type Shade = [u8; 3];

/// Blue, vermilion, green, purple, orange, sky blue, black (after Okabe and Ito 2008), which colour-blind readers can
/// also distinguish, and on paper.
const COLOURS: [Shade; COLOUR_COUNT] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [0, 0, 0]];

/// Number of colours before they repeat.
pub(crate) const COLOUR_COUNT: usize = 7;

/// Colour of the curve of this index, from zero. Colours repeat after seven.
pub fn palette(index: usize) -> Shade {
    COLOURS[index % COLOURS.len()]
}

/// Why a picture cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PngError {
    /// It has no pixels, or there is no picture.
    #[error("a picture without pixels")]
    Nothing,
    /// It has too many.
    #[error("a picture of {width} x {height} pixels is too large")]
    TooLarge {
        /// Width in pixels.
        width: u64,
        /// Height in pixels.
        height: u64,
    },
    /// Frames of an animation differ in size.
    #[error("the pictures of a moving one have different sizes")]
    Sizes,
    /// The encoder rejects the picture.
    #[error("a picture cannot be encoded: {0}")]
    Encoder(String),
}

/// Why a drawing cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrawingError {
    /// The drawing is empty.
    #[error("{0}")]
    Empty(&'static str),
    /// A polygon, line or text has no finite position.
    #[error("a position in it is not a finite number")]
    NotFinite,
    /// It exceeds the limits of a picture.
    #[error(transparent)]
    Png(#[from] PngError),
}

/// Alignment of text relative to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// A drawing, in pixels from the upper left corner. Later elements are drawn above earlier ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Name, suitable for a file.
    pub name: String,
    /// Width and height.
    pub size: [f64; 2],
    pub(crate) shapes: Vec<Shape>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Polygon { points: Vec<[f64; 2]>, shade: Shade },
    Disc { center: [f64; 2], radius: f64, shade: Shade },
    Line { points: Vec<[f64; 2]>, shade: Shade, width: f64, is_dashed: bool },
    Words { at: [f64; 2], text: String, height: u32, align: Align, shade: Shade, is_upright: bool },
}

impl Drawing {
    /// An empty drawing.
    pub fn new(name: &str, size: [f64; 2]) -> Self {
        Self { name: name.to_owned(), size, shapes: Vec::new() }
    }

    /// Adds a filled polygon. Its edge is also drawn, 0.8 pixels wide, so that there is no gap to a neighbour.
    pub fn polygon(&mut self, points: Vec<[f64; 2]>, shade: Shade) {
        self.shapes.push(Shape::Polygon { points, shade });
    }

    /// Adds a filled circle.
    pub fn disc(&mut self, center: [f64; 2], radius: f64, shade: Shade) {
        self.shapes.push(Shape::Disc { center, radius, shade });
    }

    /// Adds a line through points.
    pub fn line(&mut self, points: Vec<[f64; 2]>, shade: Shade, width: f64) {
        self.shapes.push(Shape::Line { points, shade, width, is_dashed: false });
    }

    /// Adds a dashed line through points; dashes continue from one segment to the next.
    pub fn dashed_line(&mut self, points: Vec<[f64; 2]>, shade: Shade, width: f64) {
        self.shapes.push(Shape::Line { points, shade, width, is_dashed: true });
    }

    /// Adds text of a height; `at` is on its baseline.
    pub fn words(&mut self, at: [f64; 2], text: &str, height: u32, align: Align, shade: Shade) {
        let text = text.to_owned();
        self.shapes.push(Shape::Words { at, text, height, align, shade, is_upright: false });
    }

    /// Adds text that runs upwards.
    pub fn upright_words(&mut self, at: [f64; 2], text: &str, height: u32, align: Align, shade: Shade) {
        let text = text.to_owned();
        self.shapes.push(Shape::Words { at, text, height, align, shade, is_upright: true });
    }

    /// Whether all positions are finite.
    pub(crate) fn check(&self) -> Result<(), DrawingError> {
        let is_placed = self.shapes.iter().all(|shape| {
            let places = match shape {
                Shape::Polygon { points, .. } | Shape::Line { points, .. } => points.as_slice(),
                Shape::Words { at, .. } => std::slice::from_ref(at),
                Shape::Disc { center, .. } => std::slice::from_ref(center),
            };
            places.iter().flatten().all(|number| number.is_finite())
        });
        if is_placed && self.size.iter().all(|side| side.is_finite()) {
            Ok(())
        } else {
            Err(DrawingError::NotFinite)
        }
    }
}

#[cfg(test)]
#[path = "../tests/unit/drawing.rs"]
mod tests;
