//! Drawings made of filled polygons, lines and words, as SVG and as PNG. Knows no mechanics.

use std::fmt::Write;

use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::{FigureError, render};

/// Red, green and blue as screens take them, 0 to 255.
pub type Shade = [u8; 3];

/// Where words stand beside their place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// They begin there.
    Start,
    /// Their middle is there.
    Middle,
    /// They end there.
    End,
}

/// A drawing, in pixels from the upper left corner. What comes later lies above.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Name, fit for a file.
    pub name: String,
    /// Width and height.
    pub size: [f64; 2],
    shapes: Vec<Shape>,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Polygon { points: Vec<[f64; 2]>, shade: Shade },
    Line { points: Vec<[f64; 2]>, shade: Shade, width: f64 },
    Words { at: [f64; 2], text: String, height: u32, align: Align, shade: Shade },
}

impl Drawing {
    /// An empty drawing.
    pub fn new(name: &str, size: [f64; 2]) -> Self {
        Self { name: name.to_owned(), size, shapes: Vec::new() }
    }

    /// Adds a filled polygon.
    pub fn polygon(&mut self, points: Vec<[f64; 2]>, shade: Shade) {
        self.shapes.push(Shape::Polygon { points, shade });
    }

    /// Adds a line through points.
    pub fn line(&mut self, points: Vec<[f64; 2]>, shade: Shade, width: f64) {
        self.shapes.push(Shape::Line { points, shade, width });
    }

    /// Adds words of a height.
    pub fn words(&mut self, at: [f64; 2], text: &str, height: u32, align: Align, shade: Shade) {
        self.shapes.push(Shape::Words { at, text: text.to_owned(), height, align, shade });
    }

    /// How many polygons there are.
    pub fn polygon_count(&self) -> usize {
        self.shapes.iter().filter(|shape| matches!(shape, Shape::Polygon { .. })).count()
    }

    /// The drawing as an SVG text.
    ///
    /// # Errors
    /// If a place is not a finite number.
    pub fn svg(&self) -> Result<String, FigureError> {
        Ok(render::svg(&self.scene()?))
    }

    /// The drawing as the bytes of a PNG file, two pixels for each of the drawing.
    ///
    /// # Errors
    /// If a place is not a finite number, or the drawing library fails.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        render::png(self.scene()?).map_err(|reason| self.failure(&reason))
    }

    fn failure(&self, reason: &str) -> FigureError {
        FigureError { figure: self.name.clone(), reason: reason.to_owned() }
    }

    fn scene(&self) -> Result<Scene, FigureError> {
        let mut scene = Scene::with_capacity(self.size[0], self.size[1], self.shapes.len());
        for shape in &self.shapes {
            let places = match shape {
                Shape::Polygon { points, .. } | Shape::Line { points, .. } => points.as_slice(),
                Shape::Words { at, .. } => std::slice::from_ref(at),
            };
            if !places.iter().flatten().all(|number| number.is_finite()) {
                return Err(self.failure("a place in it is not a finite number"));
            }
            scene.add(primitive(shape));
        }
        Ok(scene)
    }
}

fn primitive(shape: &Shape) -> Primitive {
    let colour = |[r, g, b]: Shade| Color::Rgb(r, g, b);
    match shape {
        Shape::Polygon { points, shade } => {
            let mut d = String::with_capacity(12 * points.len());
            for (index, [x, y]) in points.iter().enumerate() {
                // Writing to a string cannot fail.
                let _ = write!(d, "{}{} {}", if index == 0 { "M" } else { "L" }, rounded(*x), rounded(*y));
            }
            d.push('Z');
            // The edge hides the seam to the neighbour.
            Primitive::Path(Box::new(PathData {
                d,
                fill: Some(colour(*shade)),
                stroke: colour(*shade),
                stroke_width: 0.8,
                opacity: None,
                stroke_dasharray: None,
            }))
        }
        Shape::Line { points, shade, width } => Primitive::PolyLine {
            points: points.iter().map(|[x, y]| (*x, *y)).collect(),
            stroke: colour(*shade),
            stroke_width: *width,
            stroke_dasharray: None,
        },
        Shape::Words { at, text, height, align, shade } => Primitive::Text {
            x: at[0],
            y: at[1],
            content: text.clone(),
            size: *height,
            anchor: match align {
                Align::Start => TextAnchor::Start,
                Align::Middle => TextAnchor::Middle,
                Align::End => TextAnchor::End,
            },
            rotate: None,
            bold: false,
            color: Some(colour(*shade)),
        },
    }
}

/// To a tenth of a pixel.
fn rounded(number: f64) -> f64 {
    (10.0 * number).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawings_hold_what_was_drawn_and_refuse_what_has_no_place() {
        let mut drawing = Drawing::new("snapshot", [200.0, 100.0]);
        drawing.polygon(vec![[10.0, 10.04], [90.0, 10.0], [50.0, 80.0]], [255, 128, 0]);
        drawing.line(vec![[0.0, 0.0], [200.0, 100.0]], [0, 0, 0], 1.0);
        drawing.words([100.0, 50.0], "t = 1 s < 2 s", 12, Align::Middle, [0, 0, 0]);
        let svg = drawing.svg().unwrap();
        assert!(svg.contains("M10 10L90 10L50 80Z") && svg.contains("#ff8000"), "{svg}");
        assert!(svg.contains("t = 1 s &lt; 2 s"), "{svg}");
        assert!(drawing.png().unwrap().starts_with(b"\x89PNG"));
        drawing.polygon(vec![[f64::NAN, 0.0]; 3], [0; 3]);
        assert!(drawing.svg().is_err() && drawing.png().is_err());
    }
}
