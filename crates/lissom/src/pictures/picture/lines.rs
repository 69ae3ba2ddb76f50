//! Edges of open surfaces as lines: borders and folds, and faint ones between elements that are not too small.

use super::view::Projection;
use crate::pictures::geometry::{Edge, Geometry, Mesh, Normals};

/// Shortest mean edge of elements that are drawn, relative to the model: those of finer ones would cover the surface.
const SHORTEST: f64 = 0.01;
/// Brightness relative to that of the surface, and width [pixels], of borders and folds.
const BORDER: (f64, f64) = (0.45, 1.3);
/// Brightness relative to that of the surface, and width [pixels], of edges between elements.
const INNER: (f64, f64) = (0.82, 0.6);

/// A line on a surface.
pub(super) struct Line {
    /// Two points of the line.
    pub(super) ends: [u32; 2],
    /// A face beside it, whose colour it has.
    pub(super) face: usize,
    /// Brightness of the line.
    pub(super) bright: f64,
    /// Width of the line [pixels].
    pub(super) width: f64,
}

/// The lines on a surface; none on a closed one.
pub(super) fn lines(mesh: &Mesh, (geometry, projection): (&Geometry, &Projection)) -> Vec<Line> {
    if !mesh.is_open {
        return Vec::new();
    }
    let edges = Normals::of(mesh).edges(mesh);
    let length = |edge: &Edge| {
        let [from, to] = edge.ends.map(|point| mesh.points[point as usize]);
        (to - from).norm()
    };
    let mean = edges.iter().map(length).sum::<f64>() / edges.len() as f64;
    let line = |edge: Edge| {
        let (share, width) = if edge.is_border { BORDER } else { INNER };
        let bright = share * projection.brightness_of_side(&edge.normal, &edge.normal, &geometry.up);
        Line { ends: edge.ends, face: edge.face, bright, width }
    };
    let is_drawn = |edge: &Edge| edge.is_border || mean > SHORTEST * geometry.size;
    edges.into_iter().filter(is_drawn).map(line).collect()
}
