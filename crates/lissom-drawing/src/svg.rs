//! Drawings as SVG.

use std::fmt::Write;

use crate::drawing::{Align, DASH, Drawing, DrawingError, EDGE, Shade, Shape};

impl Drawing {
    /// The drawing as an SVG text.
    ///
    /// # Errors
    /// If a position is not a finite number.
    pub fn svg(&self) -> Result<String, DrawingError> {
        self.check()?;
        Ok(text(self))
    }
}

/// The text of an SVG file.
fn text(drawing: &Drawing) -> String {
    let [width, height] = drawing.size.map(rounded);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for shape in &drawing.shapes {
        // Writing to a string cannot fail.
        let _ = match shape {
            Shape::Polygon { points, shade } => {
                let (path, colour) = (path(points), hexadecimal(*shade));
                writeln!(
                    svg,
                    "<path d=\"{path}Z\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"{EDGE}\" stroke-linejoin=\"round\"/>"
                )
            }
            Shape::Disc { center, radius, shade } => {
                let ([x, y], colour) = (center.map(rounded), hexadecimal(*shade));
                writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{colour}\"/>")
            }
            Shape::Line { points, shade, width, is_dashed } => {
                let (path, colour) = (path(points), hexadecimal(*shade));
                let dash = if *is_dashed {
                    format!(" stroke-dasharray=\"{} {}\"", DASH[0], DASH[1])
                } else {
                    String::new()
                };
                writeln!(
                    svg,
                    "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{dash}/>"
                )
            }
            Shape::Words { at, text, height, align, shade, is_upright } => {
                let ([x, y], colour) = (at.map(rounded), hexadecimal(*shade));
                let anchor = match align {
                    Align::Start => "start",
                    Align::Middle => "middle",
                    Align::End => "end",
                };
                let turn =
                    if *is_upright { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
                let words = escaped(text);
                writeln!(
                    svg,
                    "<text x=\"{x}\" y=\"{y}\" font-size=\"{height}\" text-anchor=\"{anchor}\" fill=\"{colour}\"{turn}>{words}</text>"
                )
            }
        };
    }
    svg.push_str("</svg>\n");
    svg
}

fn path(points: &[[f64; 2]]) -> String {
    let mut path = String::with_capacity(12 * points.len());
    for (index, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{} {}", if index == 0 { "M" } else { "L" }, rounded(*x), rounded(*y));
    }
    path
}

fn hexadecimal([red, green, blue]: Shade) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Rounded to a tenth of a pixel.
fn rounded(number: f64) -> f64 {
    (10.0 * number).round() / 10.0 + 0.0
}
