//! One interface to joints of all kinds.

use lissom_motion::{Motion, Screw, Slopes, Vector6};
use nalgebra::{RowSVector, SVector};

use super::attached::AttachedJoint;
use super::blocks::Batches;
use super::variations::variations;
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
    /// Violation c of the equations, evaluated from absolute positions.
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
    /// ∂c/∂(η, φ); `out` is zero on entry.
    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient);
    /// Derivative of the constraint forces at constant multipliers μ; `out` is zero on entry.
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
        let (values, start) = Joint::initial(self);
        let relative = Relative {
            rotation_change: relative.rotation - start.rotation.matrix(),
            position_change: relative.position - start.position,
            ..*relative
        };
        let change = std::array::from_fn(|k| own.value[k] - values[k]);
        AnyJoint::violation_change(self, &relative, &JointCoordinates { change, ..*own })
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
        let (relative, own, constants) = (relative.into(), own.into(), self.constants());
        for equation in 0..Joint::equations(self).len() {
            let mut mu = Equations::default();
            mu[equation] = 1.0;
            let (wrench, forces) = J::wrench(&relative, &own, &constants, &mu);
            out.relative.set_row(equation, &Vector6::from(wrench).transpose());
            out.own.set_row(equation, &SVector::from(forces).transpose());
        }
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        // As for matrices of inertias and constraints alone.
        if mu.iter().all(|mu| *mu == 0.0) {
            return;
        }
        let (relative, own) = variations(&relative.into(), &own.into());
        let (constants, mu) = (self.constants().map(Slopes::constant), mu.map(Slopes::constant));
        let (Screw { translation: n, rotation: m }, [a, b]) = J::wrench(&relative, &own, &constants, &mu);
        for (row, entry) in [n.x, n.y, n.z, m.x, m.y, m.z, a, b].into_iter().enumerate() {
            out.set_row(row, &RowSVector::from(entry.by));
        }
    }

    fn enter(&self, index: usize, attached: &AttachedJoint, batches: &mut Batches) {
        batches.enter(*self, index, attached);
    }
}
