//! Interface of an element: it computes forces and their derivatives from positions, twists and accelerations in SI.

use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use super::blocks::Blocks;
use super::switch_states::SwitchStates;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, Switch};
use crate::law::VisitLaw;
use crate::signals::measurement::Gradient;

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

/// Whether two parts of neighbouring models have the same values: their debug output contains all values, to the last
/// bit.
pub fn is_same<T: std::fmt::Debug + ?Sized>(one: &T, other: &T) -> bool {
    format!("{one:?}") == format!("{other:?}")
}

/// Used fraction of the range in which a linear law is valid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRange {
    /// Fraction of the valid range: above 1 the law is inaccurate.
    pub part: f64,
    /// The node with the largest deformation or rotation.
    pub node: NodeId,
}

/// Limits of a linear law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearLimit {
    /// Deformations.
    Deformation,
    /// The rate of rotation.
    Spin,
    /// The relative change of stiffness by axial forces and rotation.
    Load,
    /// Coupling of bending and torsion by moments.
    Moment,
    /// Forces of modes that are omitted, under sudden loads.
    LeftOut,
}

impl LinearLimit {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Deformation, Self::Spin, Self::Load, Self::Moment, Self::LeftOut];
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

    /// Adds the forces [N, N m] on the left-hand side of the equations of motion, six per node in the node's body
    /// frame, then one per coordinate. Called in every iteration.
    fn forces(&self, at: &Kinematics, out: &mut [f64]);

    /// All elements of a batch laid out for evaluation several at a time, if that is efficient. Their forces are
    /// those of [`Self::forces`] to round-off. Default: none, they are evaluated one by one.
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

    /// If forces are proportional to a model parameter, such as a stiffness or a mass: an element whose forces are their
    /// derivative with respect to it, from this element in neighbouring models with the weights of a difference. Default:
    /// none, and differences of forces replace it.
    fn derivative(_neighbours: &[(&Self, f64)]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Adds the derivatives of `forces`. `out` is zero on entry. Called rarely.
    fn linearize(&self, at: &Kinematics, out: &mut Tangents);

    /// The same, with the stresses of another configuration in the geometric stiffness: far from equilibrium those of
    /// an iterate are meaningless, see `Point::stressed`.
    fn linearize_stressed(&self, at: &Kinematics, _stressed: &Kinematics, out: &mut Tangents) {
        self.linearize(at, out);
    }

    /// Writes its mass matrix to `out`, row by row of its local unknowns, for elements with mass except bodies, whose mass
    /// is stored in the system. Default: nothing.
    fn mass(&self, _at: &Kinematics, _out: &mut Vec<f64>) {}

    /// Whether its kinetic energy is positive in every motion, if that depends on the configuration. Default: it is.
    fn has_positive_mass(&self, _at: &Kinematics) -> bool {
        true
    }

    /// Kinetic, elastic and potential energy.
    fn energy(&self, at: &Kinematics) -> Energy;

    /// Adds the derivatives of its strain energy with respect to its local unknowns, from the configuration at rest and in free
    /// `fall`, where neither inertia nor weight acts. Default, for elements whose other forces vanish there: their forces, unless
    /// they are a load.
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]) {
        if !self.is_load() {
            self.forces(fall, out);
        }
    }

    /// Whether motion that deforms it may be faster than steps resolve. Default: it may. False for inertia, whose forces depend on
    /// positions only through the axes in which they are expressed.
    fn may_be_stiff(&self) -> bool {
        true
    }

    /// Whether its forces supply or dissipate energy, so that their work is computed. Default: they do not. Stored
    /// energy is then reported by [`energy`](Self::energy), and dissipated energy is lost.
    fn is_load(&self) -> bool {
        false
    }

    /// Angular momentum in addition to that of the masses, inertial axes [N m s]. Default: none.
    fn angular_momentum(&self, _at: &Kinematics) -> Vector3 {
        Vector3::zeros()
    }

    /// Elongation, its rate and the opposing force [SI], for springs and similar elements. Default: none.
    fn spring_motion(&self, _at: &Kinematics) -> Option<[f64; 3]> {
        None
    }

    /// Derivatives of the three numbers of [`spring_motion`](Self::spring_motion) with respect to its local unknowns. Default:
    /// zero.
    fn spring_gradients(&self, _at: &Kinematics) -> [Gradient; 3] {
        [Gradient::zero(); 3]
    }

    /// Known breakpoints of its forces [s]. Default: none.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Number of kinks and jumps of its forces that [`switches`](Self::switches) reports. Default: none.
    fn switch_count(&self) -> usize {
        0
    }

    /// Sets the location of the frozen sides of its switches, from which its forces are to be continued. Default:
    /// nothing.
    fn freeze_switches(&mut self, _switch_states: SwitchStates) {}

    /// Appends numbers that change their sign where its forces have a kink or a jump, as at the contact of a stop.
    fn switches(&self, _at: &Kinematics, _out: &mut Vec<Switch>) {}

    /// Passes its scalar laws with their arguments to `visit`, always in the same order, except for linear ones. Default: it
    /// has none.
    fn laws(&self, _at: &Kinematics, _visit: &mut VisitLaw<'_>) {}

    /// Its deformation rate [1/s]: the largest relative speed of its nodes over their distance, and one of the two
    /// nodes, for deformable elements. Default: none.
    fn deformation_rate(&self, _at: &Kinematics) -> Option<(f64, NodeId)> {
        None
    }

    /// Used fraction of the range in which its linear law is valid, for elements that are linear in a frame of their own.
    /// Default: none.
    fn linear_range(&self, _limit: LinearLimit, _at: &Kinematics) -> Option<LinearRange> {
        None
    }

    /// Its two nodes with the largest relative rotation, and the cosine of half its angle, for elements that cannot
    /// distinguish a rotation from the opposite one. Default: none.
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
        assert_eq!(Bare.spring_gradients(at), [Gradient::zero(); 3]);
        assert_eq!(Bare.max_relative_rotation(at), None);
        for limit in LinearLimit::ALL {
            assert_eq!(Bare.linear_range(limit, at), None);
        }
        let (mut switches, mut out) = (Vec::new(), Vec::new());
        Bare.switches(at, &mut switches);
        Bare.mass(at, &mut out);
        assert!(switches.is_empty() && out.is_empty());
    }
}
