//! Capabilities of elements besides forces and energy. A query is a method of one of these interfaces, and a loop over the elements
//! that have it where the result is needed.

use lissom_motion::Vector3;

use super::element::{Element, Tangents};
use super::limits::Validity;
use super::report::Report;
use super::work::{power, work};
use crate::kinematics::{
    CarriedFrame, CoordinateId, DiscreteValueId, Kinematics, NodeId, Stressed, Subject, Switch,
};
use crate::law::VisitLaw;
use crate::signals::SignalError;
use crate::signals::measurement::Gradient;

/// Capabilities of an element, the same for all elements of a kind: a loop over a batch ends at the first element
/// without the one it needs.
#[derive(Clone, Copy, Default)]
pub struct Capabilities<'e> {
    /// Forces that supply or dissipate energy.
    pub load: Option<&'e dyn Load>,
    /// An elongation with its force.
    pub spring: Option<&'e dyn Spring>,
    /// Limits within which its laws and data are valid.
    pub validity: Option<&'e dyn Validity>,
    /// Numbers of its own.
    pub report: Option<&'e dyn Report>,
    /// Frames of base and tip between which it exerts a force and a moment.
    pub frames: Option<[CarriedFrame; 2]>,
    /// Laws of its forces, with their kinks and jumps.
    pub laws: Option<&'e dyn ForceLaws>,
    /// Strain energy whose derivatives differ from the forces.
    pub strain: Option<&'e dyn StrainSlopes>,
    /// Deformations of an element with geometric stiffness.
    pub deformation: Option<&'e dyn Deformable>,
    /// Friction by a bristle, whose deflection may change faster than steps resolve.
    pub bristle: Option<&'e dyn Bristle>,
    /// Inertia besides that of bodies, which is stored in the system.
    pub inertia: Option<&'e dyn OwnInertia>,
    /// Symmetry about an axis of a node.
    pub symmetry: Option<&'e dyn Symmetric>,
    /// Whether it is the inertia of a body, whose forces depend on positions only through the axes in which they are
    /// expressed. Motion that deforms any other element may be faster than steps resolve.
    pub is_body_inertia: bool,
}

/// Forces that supply or dissipate energy.
pub trait Load: Element {
    /// Whether they do, so that their work is computed. Default: they do. Stored energy is otherwise reported by
    /// [`Element::energy`], and dissipated energy is lost.
    fn is_active(&self) -> bool {
        true
    }

    /// Power that it supplies [W]. Default: that of all its forces.
    fn power(&self, at: &Kinematics) -> f64 {
        power(self, at)
    }

    /// Work that it supplies between two configurations [J]. Default: that of all its forces, which change linearly along the path.
    fn work(&self, from: &Kinematics, to: &Kinematics) -> f64 {
        work(self, (from, to), [1.0; 2])
    }

    /// Known breakpoints of its forces [s]. Default: none.
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Whether they depend on the motion beyond the rotation of their node, so that the tangent is not symmetric. Default: they do
    /// not.
    fn depends_on_motion(&self) -> bool {
        false
    }

    /// Checks that the functions from which its forces follow have values. Default: they have.
    ///
    /// # Errors
    /// If one is not finite.
    fn check(&self, _at: &Kinematics) -> Result<(), SignalError> {
        Ok(())
    }

    /// First-order states that its equations determine at rest. Default: none.
    fn states_at_rest(&self) -> &[CoordinateId] {
        &[]
    }

    /// Adds the derivatives of its forces with respect to a held value. Default: they do not depend on any.
    fn add_by_held(&self, _held: DiscreteValueId, _at: &Kinematics, _out: &mut [f64]) {}
}

/// Springs and similar elements.
pub trait Spring: Element {
    /// Elongation, its rate and the opposing force [SI].
    fn spring_motion(&self, at: &Kinematics) -> [f64; 3];

    /// Derivatives of these three numbers with respect to its local unknowns; none if these are more than a gradient has places.
    fn spring_gradients(&self, at: &Kinematics) -> Option<[Gradient; 3]>;

    /// Whether its force may dissipate energy at some elongation.
    fn dissipates(&self) -> bool;
}

/// Friction by a bristle, a first-order state that reaches its steady deflection along a path of a few deflections at slip.
pub trait Bristle: Element {
    /// The state, and its steady deflection if a first step of `size` [s] is far longer than the bristle takes from zero to it.
    fn steady_at_start(&self, at: &Kinematics, size: f64) -> Option<(CoordinateId, f64)>;

    /// Work on the rest of the model in a step whose stages do not resolve the deflection [J]; none if they do.
    fn unresolved_work(&self, from: &Kinematics, to: &Kinematics) -> Option<f64>;
}

/// Elements whose forces follow from functions of a few numbers, with kinks or jumps at which steps end. They have
/// [`switch_states`](Element::switch_states).
pub trait ForceLaws: Element {
    /// Number of kinks and jumps that [`switches`](Self::switches) reports.
    fn switch_count(&self) -> usize;

    /// Appends numbers that change their sign where its forces have a kink or a jump, as at the contact of a stop.
    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>);

    /// Subjects of its kinks and jumps in messages, in the order of [`switches`](Self::switches). Default: they have none of their own.
    fn switch_subjects(&self) -> Option<Vec<Subject>> {
        None
    }

    /// Number of the group of elements with the same laws at different points: values that are small beside those of others of the
    /// group, such as the velocity at the hub of a rotor, are round-off. Default: none.
    fn group(&self) -> Option<usize> {
        None
    }

    /// Whether it exerts no force on its nodes about this configuration, and has the equation z' = 0 for each of its coordinates, if
    /// that is known without an evaluation: of many possible contacts most cost nothing. Default: it is not known.
    fn is_idle(&self, _at: &Kinematics) -> bool {
        false
    }

    /// Passes its scalar laws with their arguments to `visit`, always in the same order, except for linear ones. Default: it
    /// has none.
    fn laws(&self, _at: &Kinematics, _visit: &mut VisitLaw<'_>) {}
}

/// Elements whose forces at rest are not the derivatives of their strain energy.
pub trait StrainSlopes: Element {
    /// Adds the derivatives of its strain energy with respect to its local unknowns, from the configuration at rest and in free
    /// `fall`, where neither inertia nor weight acts.
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]);
}

/// Elements that deform, with geometric stiffness.
pub trait Deformable: Element {
    /// As [`Element::linearize`], with the stresses of another configuration in the geometric stiffness: see
    /// [`Stressed`].
    fn linearize_stressed(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents);

    /// Whether it predicts the stresses of the geometric stiffness from [`Stressed::previous`]. Default: it does not.
    fn predicts_stresses(&self) -> bool {
        false
    }

    /// Deformation rate of the element [1/s]: the largest relative speed of its nodes over their distance, and one of the two
    /// nodes.
    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)>;

    /// Two nodes with the largest relative rotation, and the cosine of half its angle: it cannot distinguish a rotation from the
    /// opposite one.
    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])>;
}

/// Elements that may be symmetric about an axis of a node on which they act.
pub trait Symmetric: Element {
    /// Whether a rotation of the node about this unit vector in its axes, through its place, changes the axes of the forces on it alone, and
    /// no force on others.
    fn is_symmetric_about(&self, node: NodeId, axis: &Vector3) -> bool;
}

/// Elements with inertia besides that of bodies.
pub trait OwnInertia: Element {
    /// Writes its mass matrix to `out`, row by row of its local unknowns. Default: nothing.
    fn mass(&self, _at: &Kinematics, _out: &mut Vec<f64>) {}

    /// Whether its kinetic energy is positive in every motion. Default: it is.
    fn has_positive_mass(&self, _at: &Kinematics) -> bool {
        true
    }

    /// Angular momentum in addition to that of the masses, inertial axes [N m s]. Default: none.
    fn angular_momentum(&self, _at: &Kinematics) -> Vector3 {
        Vector3::zeros()
    }
}
