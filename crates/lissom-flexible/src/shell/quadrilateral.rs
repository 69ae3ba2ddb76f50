//! Nodes, edges and points of quadrature of a quadrilateral.

pub use lissom_mesh::kinds::face::{CORNERS, bilinear};

/// Nodes of an element.
pub const NODES: usize = 4;
/// Natural strains of an element.
pub(super) const STRAINS: usize = 18;
/// Points of quadrature.
pub(super) const POINTS: usize = 4;
/// 1/√3.
pub(super) const GAUSS: f64 = 0.577_350_269_189_625_8;
/// r and s at the points of quadrature.
pub(super) const GAUSS_POINTS: [(f64, f64); POINTS] =
    [(-GAUSS, -GAUSS), (GAUSS, -GAUSS), (-GAUSS, GAUSS), (GAUSS, GAUSS)];
/// First and second node of the edges along r at s = -1 and 1, and along s at r = -1 and 1.
pub const EDGES: [(usize, usize); 4] = [(0, 1), (3, 2), (0, 3), (1, 2)];
