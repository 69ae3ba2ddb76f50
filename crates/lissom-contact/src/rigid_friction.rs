//! Friction of a rigid contact that slides, and the quantities whose zeros change its mode.
//!
//! Legend: see [`joints::rigid_contact`](crate::rigid).
//!
//! ```text
//! f = -μ N s/|s| on the tip
//! ```

use std::sync::Arc;

use lissom_motion::Vector3;

use crate::rigid::{Mode, RigidContact};
use lissom_mechanics::elements::{Capabilities, Element, Load, Tangents, Unknowns};
use lissom_mechanics::kinematics::{Kinematics, NodeId};
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};

/// Two nodes and the normal multiplier.
const SIZE: usize = 13;

/// Friction of a rigid contact while it slides or is saturated.
#[derive(Clone, Debug)]
pub struct RigidFriction {
    contact: Arc<RigidContact>,
    multipliers: [usize; 1],
}

impl RigidFriction {
    /// Friction of a contact.
    pub fn new(contact: Arc<RigidContact>) -> Self {
        Self { multipliers: [contact.first_multiplier], contact }
    }

    fn acts(&self, at: &Kinematics) -> bool {
        matches!(self.contact.mode(at), Mode::Sliding | Mode::Saturated)
    }

    /// -μ N.
    fn factor(&self, at: &Kinematics) -> f64 {
        at.multipliers
            .get(self.multipliers[0])
            .map_or(0.0, |multiplier| self.contact.law.friction * multiplier)
    }
}

impl Element for RigidFriction {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: self.contact.nodes(), multipliers: &self.multipliers, ..Unknowns::default() }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        if self.acts(at) {
            let touching = self.contact.touching(at);
            let direction = self.contact.slip_direction(at, &touching).value;
            self.contact.add_force(&touching, &(self.factor(at) * direction), out);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        if !self.acts(at) {
            return;
        }
        let touching = self.contact.touching(at);
        let direction = self.contact.slip_direction(at, &touching);
        let factor = self.factor(at);
        let (force, by) = (factor * direction.value, direction.by.map(|by| factor * by));
        self.contact.add_derivatives(&touching, (&force, &by), (SIZE, &mut out.stiffness, &mut out.damping));
        let mut column = [0.0; SIZE - 1];
        self.contact.add_force(&touching, &(self.contact.law.friction * direction.value), &mut column);
        out.add_by_multiplier(&column);
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for RigidFriction {}

/// What ends a mode of a rigid contact where it falls through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guard {
    /// The gap, while it is open.
    Touch,
    /// The normal force, while it is not open.
    Release,
    /// What is left of the largest friction while it sticks; the velocity along the direction of sliding while it slides; while
    /// it is saturated, what is left to a velocity that is not zero.
    Slip,
}

/// A [`Guard`] as a measurement; zero while it does not apply.
pub struct ContactGuard {
    contact: Arc<RigidContact>,
    guard: Guard,
}

impl ContactGuard {
    /// Guard of a contact.
    pub fn new(contact: Arc<RigidContact>, guard: Guard) -> Self {
        Self { contact, guard }
    }

    fn value(&self, at: &Kinematics) -> f64 {
        let contact = &*self.contact;
        let mode = contact.mode(at);
        match (self.guard, mode) {
            (Guard::Touch, Mode::Open | Mode::Kept) => contact.touching(at).gap.value - contact.offset(at),
            (Guard::Release, mode) if mode.is_closed() => {
                contact.forces(at, &at.multipliers).0 + contact.no_force(at)
            }
            (Guard::Slip, Mode::Sticking) => {
                let (normal, friction) = contact.forces(at, &at.multipliers);
                contact.law.friction * normal - friction.norm() + contact.no_force(at)
            }
            (Guard::Slip, Mode::Sliding) if contact.has_friction() => {
                let touching = contact.touching(at);
                let n = touching.gap.normal;
                let reference = contact.direction(at);
                let tangent: Vector3 = reference - n * n.dot(&reference);
                touching.sliding().dot(&tangent)
            }
            (Guard::Slip, Mode::Saturated) => contact.still() - contact.touching(at).sliding().norm(),
            _ => 0.0,
        }
    }
}

impl Measurement for ContactGuard {
    fn nodes(&self) -> &[NodeId] {
        self.contact.nodes()
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        [self.value(at), 0.0, 0.0, 0.0, 0.0, 0.0]
    }

    /// Events alone depend on it, and need no derivatives.
    fn gradient(&self, _component: usize, _at: &Kinematics) -> Gradient {
        Gradient::zero()
    }
}
