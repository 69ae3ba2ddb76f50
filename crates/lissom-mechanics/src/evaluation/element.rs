//! Interface of an element: it computes forces and their derivatives from positions, twists and accelerations in SI.

use serde::{Deserialize, Serialize};

use super::blocks::Blocks;
use super::capabilities::Capabilities;
use super::switch_states::SwitchStates;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, NodeId};

/// Energies of an element or a system [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy.
    pub strain: f64,
    /// Energy of gravity and of dead loads that are constant in time.
    pub potential: f64,
}

impl Energy {
    /// Sum of all terms.
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain + self.potential
    }
}

impl std::iter::Sum for Energy {
    fn sum<I: Iterator<Item = Self>>(energies: I) -> Self {
        let mut sum = Self::default();
        energies.for_each(|energy| sum += energy);
        sum
    }
}

impl std::ops::AddAssign for Energy {
    fn add_assign(&mut self, other: Self) {
        self.kinetic += other.kinetic;
        self.strain += other.strain;
        self.potential += other.potential;
    }
}

/// Derivatives of an element's forces, as dense local matrices: row `i`, column `j` is at
/// `i * size + j`. Unknowns are six body-frame degrees of freedom per node, then the coordinates.
#[derive(Clone, Debug)]
pub struct Tangents {
    size: usize,
    /// With respect to body-frame displacements and rotations.
    pub stiffness: Vec<f64>,
    /// With respect to twists.
    pub damping: Vec<f64>,
    /// With respect to accelerations.
    pub mass: Vec<f64>,
    /// Number of multipliers at the end of the local unknowns. Derivatives with respect to them are part of the
    /// stiffness.
    multipliers: usize,
}

impl Tangents {
    /// Storage for `size` local unknowns, all zero.
    pub fn new(size: usize) -> Self {
        let zeros = vec![0.0; size * size];
        Self { size, stiffness: zeros.clone(), damping: zeros.clone(), mass: zeros, multipliers: 0 }
    }

    /// Multiplies all derivatives by a number.
    pub fn multiply(&mut self, factor: f64) {
        for matrix in [&mut self.stiffness, &mut self.damping, &mut self.mass] {
            for value in matrix {
                *value *= factor;
            }
        }
    }

    /// Adds unknowns after the existing ones, all zero.
    pub fn widen(&mut self, size: usize) {
        let own = std::mem::replace(&mut self.size, size);
        for matrix in [&mut self.stiffness, &mut self.damping, &mut self.mass] {
            matrix.resize(size * size, 0.0);
            // From the end, so that nothing is overwritten before it is moved.
            for entry in (0..own * own).rev() {
                let value = std::mem::take(&mut matrix[entry]);
                matrix[entry / own * size + entry % own] = value;
            }
        }
    }

    /// Adds the derivatives of all forces with respect to a multiplier, the last local unknown.
    pub fn add_by_multiplier(&mut self, forces: &[f64]) {
        self.multipliers = 1;
        for (i, force) in forces.iter().enumerate() {
            self.stiffness[(i + 1) * self.size - 1] += force;
        }
    }

    /// The first local unknown that is a multiplier.
    pub fn first_multiplier(&self) -> usize {
        self.size - self.multipliers
    }

    /// Number of local unknowns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Sets everything to zero, for an element of `size` unknowns.
    pub fn clear(&mut self, size: usize) {
        self.size = size;
        self.multipliers = 0;
        for matrix in [&mut self.stiffness, &mut self.damping, &mut self.mass] {
            matrix.clear();
            matrix.resize(size * size, 0.0);
        }
    }
}

/// Whether two parts of neighbouring models have the same values: their debug output contains all values, to the last
/// bit.
pub fn is_same<T: std::fmt::Debug + ?Sized>(one: &T, other: &T) -> bool {
    format!("{one:?}") == format!("{other:?}")
}

/// Unknowns on which an element acts, and multipliers on which its forces depend, in the order of its local unknowns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unknowns<'e> {
    /// Nodes, six body-frame degrees of freedom each.
    pub nodes: &'e [NodeId],
    /// Algebraic coordinates.
    pub coordinates: &'e [CoordinateId],
    /// Multipliers, among all.
    pub multipliers: &'e [usize],
}

impl<'e> Unknowns<'e> {
    /// Nodes alone.
    pub fn of_nodes(nodes: &'e [NodeId]) -> Self {
        Self { nodes, ..Self::default() }
    }

    /// Coordinates alone.
    pub fn of_coordinates(coordinates: &'e [CoordinateId]) -> Self {
        Self { coordinates, ..Self::default() }
    }

    /// Number of forces: multipliers have none.
    pub fn force_count(&self) -> usize {
        6 * self.nodes.len() + self.coordinates.len()
    }

    /// Twists of the nodes, then rates of the coordinates.
    pub fn rates(self, at: &Kinematics) -> impl Iterator<Item = f64> {
        let twists = self.nodes.iter().flat_map(|&node| at.nodes[node].twist.iter().copied());
        twists.chain(self.coordinates.iter().map(|&own| at.coordinates[own].rate))
    }
}

/// An element. SI in, SI out.
pub trait Element: std::fmt::Debug + Send + Sync + 'static {
    /// Unknowns on which it acts.
    fn unknowns(&self) -> Unknowns<'_>;

    /// Adds the forces [N, N m] on the left-hand side of the equations of motion, six per node in the node's body
    /// frame, then one per coordinate. Called in every iteration.
    fn forces(&self, at: &Kinematics, out: &mut [f64]);

    /// Adds the forces at both stages of a step, for schemes that integrate strains. Their work over it is the
    /// change of the elements' energy, as far as the method's stages integrate squares exactly. Default, for
    /// forces without energy or with strains that the stages integrate exactly: `forces` at each stage.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        for (at, out) in step.stages.iter().zip(out) {
            self.forces(at, out);
        }
    }

    /// Adds the derivatives of `forces`. `out` is zero on entry. Called rarely.
    fn linearize(&self, at: &Kinematics, out: &mut Tangents);

    /// Kinetic, elastic and potential energy. Default: none.
    fn energy(&self, _at: &Kinematics) -> Energy {
        Energy::default()
    }

    /// Capabilities of the element, the same for all elements of its kind. Default: none.
    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities::default()
    }

    /// Location of the frozen sides of its switches, for elements with [`ForceLaws`](super::capabilities::ForceLaws): its forces are
    /// to be continued from there. Default: none.
    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        None
    }

    /// All elements of a batch laid out for evaluation several at a time, if that is efficient. Their forces are
    /// those of [`Self::forces`] to round-off. Default: none, they are evaluated one by one.
    fn blocks(_elements: &[Self]) -> Option<Box<dyn Blocks>>
    where
        Self: Sized,
    {
        None
    }

    /// If forces are proportional to a model parameter, such as a stiffness or a mass: an element whose forces are their
    /// derivative with respect to it, from this element in neighbouring models with the weights of a difference. Default:
    /// none, and differences of forces replace it.
    fn derivative(_neighbours: &[(&Self, f64)]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }
}

#[cfg(test)]
#[path = "../../tests/unit/evaluation/element.rs"]
mod tests;
