//! Drawings of filled polygons, lines and text, and charts consisting of these, as SVG and as PNG. Independent of
//! mechanics and files.
//!
//! ```
//! use lissom_drawing::{Axis, Chart, Curve, Panel, palette};
//!
//! let points = (0..100).map(|k| (0.1 * f64::from(k), (0.1 * f64::from(k)).sin())).collect();
//! let curve = Curve { name: "x".to_owned(), points, ..Curve::new(palette(0)) };
//! let panel = Panel { x: Axis::new("time [s]"), y: Axis::new("displacement [m]"), curves: vec![curve] };
//! let drawing = Chart { title: "A wave".to_owned(), ..Chart::new("wave", vec![panel]) }.draw();
//! assert!(drawing.svg().unwrap().contains("displacement [m]"));
//! assert!(drawing.png().unwrap().starts_with(b"\x89PNG"));
//! ```

mod animation;
mod axis;
mod chart;
mod depth_buffer;
mod drawing;
mod image;
mod lettering;
mod png;
mod raster;
mod svg;

pub use animation::{Format, animation};
pub use axis::{Axis, Scale};
pub use chart::{Chart, Curve, Mark, Panel, title_lines};
pub use depth_buffer::{Corner, DepthBuffer};
pub use drawing::{Align, Drawing, DrawingError, PngError, Shade, palette};
pub use image::Image;
