//! Motion of a frame over any [`Number`], so that a formula of an output yields its value and its exact derivatives.
//!
//! Legend: q unit quaternion, scalar first, R its rotation, x position, v and w twist in the frame's axes, v' and w' its rate,
//! δθ and δu body variation.
//!
//! ```text
//! R a = a + q₀ t + q × t,  t = 2 q × a        δx = R δu        δq = q (0, δθ)/2
//! ```

use lissom_motion::Motion;

use crate::dual::{Dual, Number, Three, cross, sum};
use crate::kinematics::{NodeMotion, split};

/// Directions in which the motion of a node can be changed: six each of its position, twist and rate of the twist.
pub(super) const DIRECTIONS: usize = 18;

/// A unit quaternion, scalar first.
pub(super) type Quaternion<T> = [T; 4];

/// Position, twist and rate of the twist of a frame; the last two in its own axes.
#[derive(Clone, Copy, Debug)]
pub struct MovingFrame<T> {
    pub(super) rotation: Quaternion<T>,
    pub(super) position: Three<T>,
    pub(super) velocity: Three<T>,
    pub(super) spin: Three<T>,
    pub(super) acceleration: Three<T>,
    pub(super) spin_rate: Three<T>,
}

/// A vector of constants.
pub(super) fn constant<T: Number>(vector: impl Into<[f64; 3]>) -> Three<T> {
    vector.into().map(T::constant)
}

/// a - b.
pub(super) fn difference<T: Number>(a: Three<T>, b: Three<T>) -> Three<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// R a.
pub(super) fn rotated<T: Number>(rotation: Quaternion<T>, vector: Three<T>) -> Three<T> {
    let [scalar, axis @ ..] = rotation;
    let twice = cross(axis, vector).map(|part| part.scaled(2.0));
    sum(sum(vector, twice.map(|part| part * scalar)), cross(axis, twice))
}

/// Rᵀ a.
pub(super) fn rotated_back<T: Number>(rotation: Quaternion<T>, vector: Three<T>) -> Three<T> {
    rotated(conjugate(rotation), vector)
}

/// Quaternion of Rᵀ.
pub(super) fn conjugate<T: Number>([scalar, x, y, z]: Quaternion<T>) -> Quaternion<T> {
    [scalar, -x, -y, -z]
}

/// Quaternion of R₁ R₂.
pub(super) fn product<T: Number>(one: Quaternion<T>, other: Quaternion<T>) -> Quaternion<T> {
    let ([a, u @ ..], [b, v @ ..]) = (one, other);
    let [x, y, z] = sum(sum(v.map(|part| part * a), u.map(|part| part * b)), cross(u, v));
    [a * b - (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]), x, y, z]
}

impl<T: Number> MovingFrame<T> {
    /// A node whose motion does not vary.
    pub fn of_node(node: &NodeMotion) -> Self {
        let (velocity, spin) = split(&node.twist);
        let (acceleration, spin_rate) = split(&node.acceleration);
        Self {
            rotation: node.frame.rotation.quaternion().map(T::constant),
            position: constant(node.frame.position),
            velocity: constant(velocity),
            spin: constant(spin),
            acceleration: constant(acceleration),
            spin_rate: constant(spin_rate),
        }
    }

    /// The global frame.
    pub fn global() -> Self {
        Self::of_node(&NodeMotion::at_rest(Motion::identity()))
    }

    /// The frame that this one carries at `offset`, a motion in its axes.
    #[must_use]
    pub fn carried(&self, offset: &Motion) -> Self {
        let arm: Three<T> = constant(offset.position);
        let rotation = offset.rotation.quaternion().map(T::constant);
        let turned = |vector| rotated_back(rotation, vector);
        Self {
            rotation: product(self.rotation, rotation),
            position: sum(self.position, rotated(self.rotation, arm)),
            velocity: turned(sum(self.velocity, cross(self.spin, arm))),
            spin: turned(self.spin),
            acceleration: turned(sum(self.acceleration, cross(self.spin_rate, arm))),
            spin_rate: turned(self.spin_rate),
        }
    }
}

impl MovingFrame<Dual<DIRECTIONS>> {
    /// A node whose motion varies: its position along directions 0 to 5, its twist along 6 to 11, the twist's rate along 12
    /// to 17.
    pub(super) fn variable(node: &NodeMotion) -> Self {
        let mut own = Self::of_node(node);
        for k in 0..3 {
            let mut along = [0.0; 3];
            along[k] = 1.0;
            let position: Three<f64> = rotated(node.frame.rotation.quaternion(), along);
            let [x, y, z] = along.map(|part| 0.5 * part);
            let rotation = product(node.frame.rotation.quaternion(), [0.0, x, y, z]);
            (0..3).for_each(|i| own.position[i].by[k] = position[i]);
            (0..4).for_each(|i| own.rotation[i].by[3 + k] = rotation[i]);
            own.velocity[k].by[6 + k] = 1.0;
            own.spin[k].by[9 + k] = 1.0;
            own.acceleration[k].by[12 + k] = 1.0;
            own.spin_rate[k].by[15 + k] = 1.0;
        }
        own
    }
}
