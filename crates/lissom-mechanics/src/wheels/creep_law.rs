//! Forces of rolling contact between wheel and rail: Kalker's linear theory with saturation by friction.
//!
//! Legend: N normal force, A and B half the sums of curvatures along and across the rail, E elliptic integral and g ratio of the
//! half axes of Hertz's ellipse, C = (a b)^½, G shear modulus, σ Poisson's number, s sliding velocity, c velocity of the wheel's centre,
//! both relative to the rail, t₁ direction of rolling, n normal, t₂ = n × t₁, ω angular velocity of the wheel.
//!
//! ```text
//! C³ = 3 N (1 - σ) E/(2π (A + B) G g^½),      v_r = |s/2 - c|,      ν = (t₁·s, t₂·s)/v_r,   φ = n·ω/v_r
//! T₁ = -μN tanh(G C² C₁₁ ν₁/(μN)),   T₂ = -μN tanh((G C² C₂₂ ν₂ + G C³ C₂₃ φ)/(μN)),   |T| ≤ μN
//! ```
//!
//! [Kalker 1967; saturation after Simeon, Führer and Rentrop 1991]. N is the multiplier of the joint that keeps wheel and rail
//! in contact. t₁ is in the common tangent plane, perpendicular to the wheel's axis. With small angles, as in the problem of
//! 1991, it is the rail's direction rotated about the vertical by θ/cos δ instead. For s, ω and the arm to the contact are
//! rotated likewise, and φ v_r = cos δ θ' - sin δ ω_a, θ yaw angle, δ contact angle.

use super::wheel_on_rail::{ContactPosition, Pose, RailContact};
use crate::dual::{Number, Three, cross, dot, sum, times};

/// Rolling velocity that is added to the actual one, as the hypotenuse, so that a wheel at rest has finite creepages [m/s].
const AT_REST: f64 = 1e-3;

/// Parameters of the creep forces.
#[derive(Clone, Debug, PartialEq)]
pub struct CreepLaw {
    /// G [N/m²].
    pub shear_modulus: f64,
    /// σ.
    pub poisson: f64,
    /// μ.
    pub friction: f64,
    /// C₁₁, C₂₂, C₂₃.
    pub kalker: [f64; 3],
    /// E and g.
    pub ellipse: [f64; 2],
    /// Velocity of the base along the rail, along the third axis of the base's joint frame [m/s].
    pub velocity: f64,
    /// Angular velocity of the wheel relative to the tip, about its outward axis [rad/s].
    pub spin: f64,
    /// Whether directions are those for small angles.
    pub small_angles: bool,
}

/// Quantities of a contact.
#[derive(Clone, Copy, Debug)]
pub struct Creep<T> {
    /// On the wheel, along and across the direction of rolling [N].
    pub forces: [T; 2],
    /// Longitudinal and lateral creepage [-], and spin [1/m].
    pub creepages: [T; 3],
    /// On the tip's joint frame, in its axes.
    pub wrench: [T; 6],
}

impl CreepLaw {
    /// For a contact with this pose, relative twist in the tip's axes and normal force.
    pub fn creep<T: Number>(
        &self,
        contact: &RailContact,
        (pose, place): (&Pose<T>, &ContactPosition<T>),
        twist: &[T; 6],
        normal_force: T,
    ) -> Creep<T> {
        let wheel = contact.wheel_point(pose, place.along);
        let normal = contact.normal(place);
        let [vx, vy, vz, wx, wy, wz] = *twist;
        let turning = sum(pose.apply([wx, wy, wz]), wheel.axis.map(|value| value.scaled(self.spin)));
        let mut centre = pose.apply([vx, vy, vz]);
        centre[2] = centre[2].plus(self.velocity);
        let mut of_turning = cross(turning, wheel.arm);
        if self.small_angles {
            of_turning = turned_further(contact.side, wheel.axis, normal, of_turning);
        }
        let sliding = sum(centre, of_turning);
        let rolling: Three<T> = std::array::from_fn(|k| centre[k] - sliding[k].scaled(0.5));
        let speed = dot(rolling, rolling).plus(AT_REST * AT_REST).square_root();
        let (along, across, spin) = if self.small_angles {
            small_angles(contact.side, wheel.axis, normal, turning)
        } else {
            let along = cross(wheel.axis, normal);
            let along = times(along, T::constant(1.0) / dot(along, along).square_root());
            (along, cross(normal, along), dot(turning, normal))
        };
        // The force of spin is perpendicular to the direction of rolling, for either sign of it.
        let sign = if dot(rolling, along).value() < 0.0 { -1.0 } else { 1.0 };
        let [along, across] = [along, across].map(|axis| axis.map(|value| value.scaled(sign)));
        let creepages = [dot(along, sliding) / speed, dot(across, sliding) / speed, spin / speed];
        let forces = self.forces(contact.curvatures(place, wheel.radius), &creepages, normal_force);
        let force = sum(times(along, forces[0]), times(across, forces[1]));
        let local = pose.apply_inverse(force);
        let moment = cross(pose.apply_inverse(wheel.arm), local);
        let wrench = [local[0], local[1], local[2], moment[0], moment[1], moment[2]];
        Creep { forces, creepages, wrench }
    }

    fn forces<T: Number>(&self, [along, across]: [T; 2], creepages: &[T; 3], normal_force: T) -> [T; 2] {
        if normal_force.value() <= 0.0 {
            return [T::constant(0.0); 2];
        }
        let [integral, ratio] = self.ellipse;
        let known = 3.0 * (1.0 - self.poisson) * integral
            / (2.0 * std::f64::consts::PI * self.shear_modulus * ratio.sqrt());
        let size = (normal_force.scaled(known) / (along + across)).power(1.0 / 3.0);
        let limit = normal_force.scaled(self.friction);
        let square = (size * size).scaled(self.shear_modulus);
        let [longitudinal, lateral, spin] = self.kalker;
        let linear = [
            square * creepages[0].scaled(longitudinal),
            square * creepages[1].scaled(lateral) + square * size * creepages[2].scaled(spin),
        ];
        let mut forces = linear.map(|linear| -limit * (linear / limit).hyperbolic_tangent());
        let total = forces[0] * forces[0] + forces[1] * forces[1];
        if total.value() > limit.value() * limit.value() {
            let share = limit / total.square_root();
            forces = forces.map(|force| force * share);
        }
        forces
    }
}

/// Angle of rotation of the axle about the vertical.
fn yaw<T: Number>(axis: Three<T>) -> T {
    (-axis[2] / axis[0]).arc_tangent()
}

/// A vector rotated about the vertical by the difference between the yaw angle for small angles, θ/cos δ, and the
/// actual one.
fn turned_further<T: Number>(side: f64, axis: Three<T>, normal: Three<T>, v: Three<T>) -> Three<T> {
    let yaw = yaw(axis);
    let (s, c) = (yaw / normal[1].scaled(side) - yaw).sine_cosine();
    [c * v[0] + s * v[2], v[1], c * v[2] - s * v[0]]
}

/// Directions along and across the rolling, and the angular velocity about the normal, for small angles.
fn small_angles<T: Number>(
    side: f64,
    axis: Three<T>,
    normal: Three<T>,
    turning: Three<T>,
) -> (Three<T>, Three<T>, T) {
    let (sine, cosine) = (-normal[0], normal[1].scaled(side));
    let (s, c) = (yaw(axis) / cosine).sine_cosine();
    let along = [s, T::constant(0.0), c];
    let across = [c * cosine, sine.scaled(side), -s * cosine].map(|value| value.scaled(side));
    let up = axis[1].scaled(side);
    let (about_up, about_axis) = (turning[1].scaled(side), dot(turning, axis));
    let yaw_rate = (about_up - up * about_axis) / (T::constant(1.0) - up * up);
    let spin = cosine * yaw_rate - sine * (about_axis - yaw_rate * up);
    (along, across, spin)
}
