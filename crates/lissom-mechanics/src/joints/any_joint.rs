//! One interface to joints of all kinds.

use lissom_motion::{Motion, Vector6};
use nalgebra::SVector;

use super::attached::AttachedJoint;
use super::blocks::Batches;
use super::{
    Branch, ConstraintHessian, Coordinate, Equations, Gradient, Joint, JointCoordinates, MAX_COORDINATES,
    Relative,
};
use crate::kinematics::Quantity;
use crate::wheels::CreepLaw;
use crate::wheels::wheel_on_plane::Contact;
use crate::wheels::wheel_on_rail::RailContact;

/// A joint of any kind.
pub trait AnyJoint: Send + Sync + std::fmt::Debug {
    /// See [`Joint::equations`].
    fn equations(&self) -> &'static [&'static str];
    /// The quantity of an equation: see [`Joint::EQUATIONS`].
    fn equation_quantity(&self, equation: usize) -> Quantity;
    /// See [`Joint::COORDINATES`].
    fn coordinates(&self) -> &'static [Coordinate];
    /// See [`Joint::initial`].
    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion);
    /// See [`Joint::branch`].
    fn branch(&self) -> Option<Branch> {
        None
    }
    /// See [`Joint::contact`].
    fn contact(&self) -> Option<Contact>;
    /// The contact of a wheel with a rail, for joints of that kind. Default: none.
    fn rail_contact(&self) -> Option<&RailContact> {
        None
    }
    /// The creep law in that contact, if there is one.
    fn creep(&self) -> Option<&CreepLaw> {
        None
    }
    /// See [`Joint::violation`].
    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations;
    /// See [`Joint::violation_change`].
    fn violation_change(&self, relative: &Relative, own: &JointCoordinates) -> Equations;
    /// See [`Joint::wrench`].
    fn wrench(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MAX_COORDINATES>);
    /// See [`Joint::gradient`].
    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient);
    /// See [`Joint::constraint_hessian`].
    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    );
    /// Adds the joint of this index to the batch of its kind.
    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches);
}

impl<J: Joint> AnyJoint for J {
    fn equations(&self) -> &'static [&'static str] {
        Joint::equations(self)
    }

    fn equation_quantity(&self, equation: usize) -> Quantity {
        if equation < J::EQUATIONS.lengths { Quantity::Length } else { Quantity::Angle }
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        J::COORDINATES
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        Joint::initial(self)
    }

    fn branch(&self) -> Option<Branch> {
        Joint::branch(self)
    }

    fn contact(&self) -> Option<Contact> {
        Joint::contact(self)
    }

    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        Joint::violation(self, relative, own)
    }

    fn violation_change(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        J::violation_change(&relative.into(), &own.into(), &self.constants())
    }

    fn wrench(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
    ) -> (Vector6, SVector<f64, MAX_COORDINATES>) {
        let (wrench, forces) = J::wrench(&relative.into(), &own.into(), &self.constants(), mu);
        (wrench.into(), forces.into())
    }

    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient) {
        Joint::gradient(self, relative, own, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        Joint::constraint_hessian(self, relative, own, mu, out);
    }

    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches) {
        batches.enter(*self, index, attached);
    }
}
