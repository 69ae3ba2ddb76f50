//! What pushes back: inertia, stiffness, loads.
//!
//! An element sees positions, twists and accelerations in SI and answers with forces and their
//! derivatives. It knows no time step, no scheme and no scaling.

pub mod beam;
pub mod blocks;
pub mod bushing;
pub mod contribution;
pub mod coordinate_dynamics;
pub(crate) mod coordinate_spring;
pub mod creep_force;
pub mod force;
pub(crate) mod force_law;
mod frame_pair;
pub mod friction;
pub mod gyrostat;
pub mod inertia;
mod inertia_blocks;
pub mod initial_model;
pub(crate) mod joint_load;
pub mod kind;
mod kinds;
pub mod latch;
pub mod moment;
pub(crate) mod point_spring;
pub mod quadrature;
pub mod rolling;
pub mod rolling_contact;
pub mod rope;
pub mod shape;
pub mod stop;
pub mod superelement;
pub mod switch_states;

pub use contribution::Contribution;
pub use initial_model::InitialModel;
pub use kind::{Attached, Attachment, ElementKind};
pub use kinds::{LOADS, SPRINGS};

use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, NodeId};
use blocks::Blocks;
use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

/// Local unknowns that elements usually have at most: four nodes and two coordinates. Superelements may have more.
pub const USUAL_UNKNOWNS: usize = 26;

/// Energies of an element or a system [J].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy.
    pub strain: f64,
    /// Energy of gravity and of dead loads that do not change in time.
    pub potential: f64,
}

impl Energy {
    /// Sum of all parts.
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain + self.potential
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
    /// How many of the last local unknowns are multipliers. Derivatives by them are with the stiffness.
    multipliers: usize,
}

impl Tangents {
    /// Room for `size` local unknowns, all zero.
    pub fn new(size: usize) -> Self {
        let zeros = vec![0.0; size * size];
        Self { size, stiffness: zeros.clone(), damping: zeros.clone(), mass: zeros, multipliers: 0 }
    }

    /// Multiplies everything by a number.
    pub fn multiply(&mut self, factor: f64) {
        for matrix in [&mut self.stiffness, &mut self.damping, &mut self.mass] {
            for value in matrix {
                *value *= factor;
            }
        }
    }

    /// Makes room for more unknowns after those there are, all zero.
    pub fn widen(&mut self, size: usize) {
        let own = std::mem::replace(&mut self.size, size);
        for matrix in [&mut self.stiffness, &mut self.damping, &mut self.mass] {
            matrix.resize(size * size, 0.0);
            // From the end on, so that nothing is overwritten before it is moved.
            for entry in (0..own * own).rev() {
                let value = std::mem::take(&mut matrix[entry]);
                matrix[entry / own * size + entry % own] = value;
            }
        }
    }

    /// Adds the derivatives of all forces by a multiplier, the last local unknown.
    pub(crate) fn add_by_multiplier(&mut self, forces: &[f64]) {
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

/// Whether two parts of neighbouring models hold the same numbers. What is shown for debugging shows them all, and each
/// to the last bit.
pub fn is_same<T: std::fmt::Debug + ?Sized>(one: &T, other: &T) -> bool {
    format!("{one:?}") == format!("{other:?}")
}

/// How much of the range is used in which a linear law is believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRange {
    /// Over what is believed: beyond 1 it is in doubt.
    pub part: f64,
    /// The node that deforms most, or turns.
    pub node: NodeId,
}

/// What takes a linear law out of its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearLimit {
    /// Deformations.
    Deformation,
    /// The rate of rotation.
    Spin,
    /// The share of the stiffness that axial forces and rotation give or take.
    Load,
    /// What moments couple of bending and twist.
    Moment,
    /// Forces of modes that are omitted, under sudden loads.
    LeftOut,
}

impl LinearLimit {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Deformation, Self::Spin, Self::Load, Self::Moment, Self::LeftOut];
}

/// Adds `block` to the local matrix at local rows from `row` and columns from `column`.
pub(crate) fn add_block<const R: usize, const C: usize>(
    matrix: &mut [f64],
    size: usize,
    (row, column): (usize, usize),
    block: &nalgebra::SMatrix<f64, R, C>,
) {
    for i in 0..R {
        for j in 0..C {
            matrix[(row + i) * size + column + j] += block[(i, j)];
        }
    }
}

/// An element. SI in, SI out.
pub trait Element: std::fmt::Debug + Send + Sync + 'static {
    /// Nodes it acts on, in local order.
    fn nodes(&self) -> &[NodeId];

    /// Algebraic coordinates it acts on, after the nodes in local order.
    fn coordinates(&self) -> &[CoordinateId] {
        &[]
    }

    /// Multipliers on which its forces depend, among all; they follow its coordinates in local order. Default: none.
    fn multipliers(&self) -> &[usize] {
        &[]
    }

    /// Adds the forces [N, N m] that are on the left-hand side of the equations of motion,
    /// six per node in the node's body frame, then one per coordinate. Hot: called in every iteration.
    fn forces(&self, at: &Kinematics, out: &mut [f64]);

    /// All elements of a batch laid out for evaluation several at a time, where that is worth while. Their forces
    /// are those of [`Self::forces`] to round-off. Default: there is no such thing, they are evaluated one by one.
    fn blocks(_elements: &[Self]) -> Option<Box<dyn Blocks>>
    where
        Self: Sized,
    {
        None
    }

    /// Adds the forces at both stages of a step, for schemes that integrate strains. Their work over it is the
    /// change of the elements' energy, as far as the method's stages integrate squares exactly. Default, for
    /// forces without energy or with strains that the stages integrate exactly: `forces` at each stage.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        for (at, out) in step.stages.iter().zip(out) {
            self.forces(at, out);
        }
    }

    /// Where forces are proportional to what a number of the model changes, as to a stiffness or a mass: an element whose
    /// forces are their derivative by the number, from this element in neighbouring models with the weights of a
    /// difference. Default: there is none, and differences of forces represent it.
    fn derivative(_neighbours: &[(&Self, f64)]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Adds the derivatives of `forces`. `out` is zero on entry. Rare.
    fn linearize(&self, at: &Kinematics, out: &mut Tangents);

    /// The same, with the stresses of another configuration in the geometric stiffness: far from equilibrium
    /// those of an iterate are no guide, see `Point::stressed`.
    fn linearize_stressed(&self, at: &Kinematics, _stressed: &Kinematics, out: &mut Tangents) {
        self.linearize(at, out);
    }

    /// Puts its mass matrix into `out`, row after row of its local unknowns, for elements with mass but [`inertia`], whose mass
    /// the system knows. Default: nothing.
    fn mass(&self, _at: &Kinematics, _out: &mut Vec<f64>) {}

    /// Whether its kinetic energy is positive in every motion, where that depends on the configuration. Default: it is.
    fn has_positive_mass(&self, _at: &Kinematics) -> bool {
        true
    }

    /// Kinetic, elastic and potential energy.
    fn energy(&self, at: &Kinematics) -> Energy;

    /// Whether its forces put energy in or take it out, so that their work is counted. Default: they do not, what they
    /// store is reported by [`energy`](Self::energy), and what they take away is lost.
    fn is_load(&self) -> bool {
        false
    }

    /// Angular momentum that it adds to that of the masses, global axes [N m s]. Default: none.
    fn angular_momentum(&self, _at: &Kinematics) -> Vector3 {
        Vector3::zeros()
    }

    /// Elongation, its rate and the force against it [SI], for springs and what is like them. Default: none.
    fn spring_motion(&self, _at: &Kinematics) -> Option<[f64; 3]> {
        None
    }

    /// Times at which its forces are known not to be smooth [s]. Default: none.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// How many kinks and jumps of its forces [`switches`](Self::switches) reports. Default: none.
    fn switch_count(&self) -> usize {
        0
    }

    /// Where the sides of its switches will be held: from these on its forces are to be continued. Default: nothing.
    fn freeze_switches(&mut self, _switch_states: switch_states::SwitchStates) {}

    /// Appends numbers that change their sign where its forces have a kink or a jump, as at the contact of a stop.
    fn switches(&self, _at: &Kinematics, _out: &mut Vec<f64>) {}

    /// How fast it deforms [1/s]: the largest speed of its nodes relative to each other, over their distance, and one of
    /// the two nodes, for elements that can be bent. Default: none.
    fn deformation_rate(&self, _at: &Kinematics) -> Option<(f64, NodeId)> {
        None
    }

    /// How far it goes towards a limit up to which its linear law is believed, for elements that are linear in a frame of their own.
    /// Default: none.
    fn linear_range(&self, _limit: LinearLimit, _at: &Kinematics) -> Option<LinearRange> {
        None
    }

    /// The two of its nodes that are turned most against each other, and the cosine of half the angle between them,
    /// for elements that cannot distinguish a turn from one the other way. Default: none.
    fn max_relative_rotation(&self, _at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces, their derivatives and energy, and nothing else.
    #[derive(Debug)]
    struct Bare;

    impl Element for Bare {
        fn nodes(&self) -> &[NodeId] {
            &[]
        }
        fn forces(&self, _: &Kinematics, _: &mut [f64]) {}
        fn linearize(&self, _: &Kinematics, _: &mut Tangents) {}
        fn energy(&self, _: &Kinematics) -> Energy {
            Energy::default()
        }
    }

    #[test]
    fn energies_add_up_part_by_part() {
        let mut sum = Energy { kinetic: 1.0, strain: 2.0, potential: -4.0 };
        sum += Energy { kinetic: 8.0, strain: 16.0, potential: -32.0 };
        assert_eq!(sum, Energy { kinetic: 9.0, strain: 18.0, potential: -36.0 });
        assert_eq!(sum.total(), -9.0);
    }

    #[test]
    fn an_element_has_only_what_it_says() {
        let at = &Kinematics {
            time: 0.0,
            elapsed: 0.0,
            nodes: Vec::new(),
            coordinates: Vec::new(),
            held: Vec::new(),
            multipliers: Vec::new(),
        };
        assert!(Bare.coordinates().is_empty() && Bare.multipliers().is_empty() && !Bare.is_load());
        assert!(Bare.breakpoints().is_empty() && Bare.switch_count() == 0);
        assert!(<Bare as Element>::blocks(&[Bare]).is_none() && Bare::derivative(&[(&Bare, 1.0)]).is_none());
        assert_eq!(Bare.deformation_rate(at), None);
        assert_eq!(Bare.spring_motion(at), None);
        assert_eq!(Bare.max_relative_rotation(at), None);
        for limit in LinearLimit::ALL {
            assert_eq!(Bare.linear_range(limit, at), None);
        }
        let mut out = Vec::new();
        Bare.switches(at, &mut out);
        Bare.mass(at, &mut out);
        assert!(out.is_empty());
    }
}
