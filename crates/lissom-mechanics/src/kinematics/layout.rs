//! Numbering of the unknowns and equations, with their names.

use std::ops::Range;

use super::ids::indexed_by;
use super::subject::Subject;
use super::{CoordinateId, NodeId, Rotor};
use crate::kinematics::Quantity;

indexed_by!(NodeId: [u32; 6];);

/// Maximum number of nodes of a beam element or a rope.
pub const MAX_NODES: usize = 4;

/// Usual maximum number of local unknowns of an element, and of those that a measurement depends on: its nodes and two coordinates.
/// Superelements may have more.
pub const USUAL_UNKNOWNS: usize = 6 * MAX_NODES + 2;

/// Marks a locked degree of freedom: it has no row.
pub const LOCKED: u32 = u32::MAX;

/// The free degrees of freedom of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedoms {
    /// None: the ground, or a frame fixed to it.
    Fixed,
    /// Three translations and three rotations.
    Full,
    /// Three translations: a point mass.
    Translations,
    /// Two translations, along the two given axes (0, 1 or 2): a planar point mass.
    Planar(usize, usize),
}

impl Freedoms {
    /// Whether degree of freedom `k` (0..3 translations, 3..6 rotations) is free.
    pub fn is_free(self, k: usize) -> bool {
        match self {
            Self::Fixed => false,
            Self::Full => true,
            Self::Translations => k < 3,
            Self::Planar(a, b) => k == a || k == b,
        }
    }

    /// Whether the node is a point mass: it has no rotation, and carries no point away from its own.
    pub fn is_point(self) -> bool {
        matches!(self, Self::Translations | Self::Planar(..))
    }
}

/// Numbering of all unknowns: node degrees of freedom, algebraic coordinates, then multipliers.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Row of each degree of freedom of each node, or [`LOCKED`].
    pub node_rows: Vec<[u32; 6]>,
    /// Row of each algebraic coordinate.
    pub coordinate_rows: Vec<u32>,
    /// Number of node degrees of freedom and coordinates.
    pub coordinate_count: usize,
    /// Number of multipliers.
    pub multiplier_count: usize,
    /// Name of each node.
    pub node_names: Vec<String>,
    /// Name of each coordinate.
    pub coordinate_names: Vec<String>,
    /// Name and equation of every multiplier.
    pub multiplier_names: Vec<(String, &'static str)>,
    /// Quantity of every coordinate row, then of every constraint.
    pub quantities: Vec<Quantity>,
    /// Coordinate and magnitude of every first-order state.
    pub states: Vec<(CoordinateId, f64)>,
    /// Multipliers of constraints of velocities, in ascending order.
    pub of_velocities: Vec<usize>,
    /// Nodes that are symmetric about an axis, with all that is attached to them.
    pub rotors: Vec<Rotor>,
}

impl Layout {
    /// Number of unknowns: coordinates and multipliers.
    pub fn size(&self) -> usize {
        self.coordinate_count + self.multiplier_count
    }

    /// Number of rows of node degrees of freedom and algebraic coordinates.
    pub fn coordinate_count(&self) -> usize {
        self.coordinate_count
    }

    /// The quantity of the unknown of every coordinate row, then of the equation of every multiplier.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// Violations of the constraints as fractions of a length `length` [m], or in radians.
    pub fn relative_violations<'v>(
        &'v self,
        violations: &'v [f64],
        length: f64,
    ) -> impl Iterator<Item = f64> + 'v {
        let length = if length > 0.0 { length } else { 1.0 };
        let quantities = &self.quantities()[self.coordinate_count()..];
        violations.iter().zip(quantities).map(move |(violation, quantity)| match quantity {
            Quantity::Length => violation.abs() / length,
            Quantity::Angle | Quantity::State => violation.abs(),
        })
    }

    /// Rows of the multipliers.
    pub fn multiplier_rows(&self) -> Range<usize> {
        self.coordinate_count..self.size()
    }

    /// Number of nodes, the ground included.
    pub fn node_count(&self) -> usize {
        self.node_rows.len()
    }

    /// All nodes, the ground first.
    pub fn nodes(&self) -> impl DoubleEndedIterator<Item = NodeId> + ExactSizeIterator + Clone + use<> {
        NodeId::first(self.node_rows.len())
    }

    /// All algebraic coordinates.
    pub fn coordinates(
        &self,
    ) -> impl DoubleEndedIterator<Item = CoordinateId> + ExactSizeIterator + Clone + use<> {
        CoordinateId::first(self.coordinate_rows.len())
    }

    /// Name of a node: of a body or point mass, or the position on a beam, such as `beam.start` or `beam@0.5`.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn node_name(&self, node: NodeId) -> &str {
        &self.node_names[node.index()]
    }

    /// Rows of a node's six degrees of freedom, [`LOCKED`] for locked ones.
    pub fn rows_of_node(&self, node: NodeId) -> &[u32; 6] {
        &self.node_rows[node]
    }

    /// Row of an algebraic coordinate.
    pub fn row_of_coordinate(&self, coordinate: CoordinateId) -> usize {
        self.coordinate_rows[coordinate.index()] as usize
    }

    /// Name of an algebraic coordinate, such as `joint.angle`.
    pub fn coordinate_name(&self, coordinate: CoordinateId) -> &str {
        &self.coordinate_names[coordinate.index()]
    }

    /// Quantity of an algebraic coordinate.
    pub fn coordinate_quantity(&self, coordinate: CoordinateId) -> Quantity {
        self.quantities[self.row_of_coordinate(coordinate)]
    }

    /// Number of first-order states, which are among the algebraic coordinates.
    pub fn state_count(&self) -> usize {
        self.states.len()
    }

    /// Row, coordinate and usual magnitude of every first-order state.
    pub fn states(&self) -> impl Iterator<Item = (usize, CoordinateId, f64)> + '_ {
        self.states
            .iter()
            .map(|&(coordinate, magnitude)| (self.row_of_coordinate(coordinate), coordinate, magnitude))
    }

    /// Whether a multiplier belongs to a constraint of velocities.
    pub fn is_of_velocities(&self, multiplier: usize) -> bool {
        self.of_velocities.binary_search(&multiplier).is_ok()
    }

    /// Rows of the multipliers of constraints of velocities.
    pub fn velocity_rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.of_velocities.iter().map(|multiplier| self.coordinate_count + multiplier)
    }

    /// Joint and equation of a multiplier.
    ///
    /// # Panics
    /// If there is no such multiplier.
    pub fn constraint_name(&self, multiplier: usize) -> (&str, &'static str) {
        let (joint, equation) = &self.multiplier_names[multiplier];
        (joint, equation)
    }

    /// Name of a node, as in the model.
    pub fn name_of_node(&self, node: NodeId) -> &str {
        &self.node_names[node.index()]
    }

    /// Name of the unknown in `row`, as in the model.
    pub fn name_of(&self, row: usize) -> String {
        self.subject_of(row).to_string()
    }

    /// The unknown in `row`, for messages.
    pub fn subject_of(&self, row: usize) -> Subject {
        const FREEDOMS: [&str; 6] =
            ["translation 1", "translation 2", "translation 3", "rotation 1", "rotation 2", "rotation 3"];
        if row >= self.coordinate_count {
            return self.multiplier_names.get(row - self.coordinate_count).map_or_else(
                || Subject::nameless(format!("unknown {row}")),
                |(joint, equation)| {
                    Subject::new("joint", joint).called(format!("multiplier of joint `{joint}` ({equation})"))
                },
            );
        }
        for (node, rows) in self.node_rows.iter().enumerate() {
            if let Some(k) = rows.iter().position(|&r| r as usize == row && r != LOCKED) {
                return Subject::new("node", &self.node_names[node]).component(FREEDOMS[k]);
            }
        }
        for (coordinate, &r) in CoordinateId::enumerate(&self.coordinate_rows) {
            if r as usize == row {
                let what = match self.quantities[row] {
                    Quantity::State => "state",
                    Quantity::Length | Quantity::Angle => "coordinate",
                };
                return Subject::new(what, self.coordinate_name(coordinate));
            }
        }
        Subject::nameless(format!("unknown {row}"))
    }
}
