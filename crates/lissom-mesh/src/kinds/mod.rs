//! Kinds of solid elements: a file with a row for each. What reads meshes, joins, loads, draws and solves takes all that it needs from the row.

mod functions;
mod hexahedron;
mod points;
mod tetrahedron;
mod wedge;

pub mod face;

use lissom_motion::Vector3;

pub use self::functions::{Fill, Functions, Inverted, Natural, Rule};
use crate::mesh::MeshShape;

/// A kind of solid elements of second order, and that of first order with the same corners. Nodes are in the order of Abaqus: corners, then
/// the middles of the edges.
#[derive(Debug)]
pub struct SolidKind {
    /// What it is called.
    pub word: &'static str,
    /// Shapes of first and of second order.
    pub shapes: [MeshShape; 2],
    /// Types of both in Abaqus and CalculiX.
    pub abaqus: [&'static [&'static str]; 2],
    /// Types of both in Gmsh.
    pub gmsh: [u64; 2],
    /// Corners at the ends of each edge, in the order of the middle nodes of Gmsh.
    pub gmsh_edges: &'static [[usize; 2]],
    /// Natural coordinates of the corners.
    pub corners: &'static [Natural],
    /// Corners at the ends of each edge.
    pub edges: &'static [[usize; 2]],
    /// Nodes of each face: corners counterclockwise seen from outside, then the middles of the sides from each corner to the next.
    pub faces: &'static [&'static [usize]],
    /// Functions of the nodes.
    pub functions: Fill,
    /// Points of quadrature of elastic forces.
    pub points: Rule,
    /// Points of quadrature of mass.
    pub fine: Rule,
    /// Points where stresses are most accurate, and their number, at most eight.
    pub stress_points: (fn(usize) -> Natural, usize),
    /// Share of the stress at one of these points in that at a place.
    pub stress_share: fn(usize, Natural) -> f64,
}

/// All kinds.
pub static SOLID_KINDS: [&SolidKind; 3] = [&tetrahedron::KIND, &hexahedron::KIND, &wedge::KIND];

impl MeshShape {
    /// The kind of a solid element, and whether it is of second order; none for lines and surfaces.
    pub fn solid_kind(self) -> Option<(&'static SolidKind, bool)> {
        SOLID_KINDS.iter().find_map(|kind| {
            let order = kind.shapes.iter().position(|shape| *shape == self)?;
            Some((*kind, order == 1))
        })
    }
}

impl SolidKind {
    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.corners.len() + self.edges.len()
    }

    /// Natural coordinates of a node.
    pub fn node(&self, node: usize) -> Natural {
        let Some(edge) = node.checked_sub(self.corners.len()) else { return self.corners[node] };
        let [from, to] = self.edges[edge].map(|corner| self.corners[corner]);
        std::array::from_fn(|k| 0.5 * (from[k] + to[k]))
    }

    /// Shares of the nodes in a force per volume: the integrals of their functions [m³]. Those of corners may be negative.
    ///
    /// # Errors
    /// If the element with its nodes at these positions is inverted at a point of quadrature.
    pub fn shares(&self, positions: &[Vector3]) -> Result<Vec<f64>, Inverted> {
        let (mut values, mut slopes) = (vec![0.0; positions.len()], vec![Vector3::zeros(); positions.len()]);
        let mut shares = vec![0.0; positions.len()];
        for ((at, count), is_fine) in [(self.points, false), (self.fine, true)] {
            for (place, weight) in (0..count).map(at) {
                (self.functions)(place, &mut values, &mut slopes);
                let volume = functions::volume((&values, &slopes), positions)?;
                if is_fine {
                    shares.iter_mut().zip(&values).for_each(|(sum, value)| *sum += weight * volume * value);
                }
            }
        }
        Ok(shares)
    }
}
