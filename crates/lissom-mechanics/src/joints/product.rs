//! Joints that are products of what they say of the place of the tip's point and of what they say of the tip's rotation.
//!
//! Legend: (R, x) relative motion, d displacement along the third axis, Q(φ) rotation by the joint's own coordinates.
//!
//! ```text
//! point   Rᵀ x - d e₃ = 0      line  x - d e₃ = 0      plane  x₃ = 0
//! rotation  axial(QᵀR) = 0     shafts  axial(R)·e₃ = 0
//! ```
//!
//! In the tip's axes the gradient of a tip that rotates about a point of the ground is constant. With a displacement the axes of base and
//! tip agree, by other equations.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::base_axes::force_wrench;
use super::primitives::{JointRotation, elementary};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Branch, Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};

/// Names of the equations of a point or line and of a rotation; those of a plane and of each part alone are among them.
const EQUATIONS: [&str; 6] =
    ["position 1", "position 2", "position 3", "rotation 1", "rotation 2", "rotation 3"];
/// Names of the equations of a point and of shafts.
const OF_SHAFTS: [&str; 4] = ["position 1", "position 2", "position 3", "rotation 3"];

/// Where the tip's point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// Anywhere.
    Free,
    /// At the base's point, or displaced along the third axis.
    Point,
    /// On the base's third axis, whatever the rotation.
    Line,
    /// In the plane of the base's first two axes.
    Plane,
}

/// How the tip is rotated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// In any way.
    Free,
    /// As the base.
    Fixed,
    /// About the third axis, by the first coordinate.
    AboutThirdAxis,
    /// About the first axis, then about the rotated second axis, by both coordinates.
    Cross,
    /// By the same angle about its third axis as the base, whatever the angle between these axes.
    Shafts,
}

/// What distinguishes such a joint from the others.
pub(crate) trait Product: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// Algebraic coordinates of the joint.
    const COORDINATES: &'static [Coordinate] = &[];
    /// Where the tip's point is.
    const PLACE: Place = Place::Point;
    /// How the tip is rotated.
    const TURN: Turn = Turn::Fixed;
    /// Index of d among the coordinates, or of the rotation in proportion to which it is; without it d is zero.
    const SLIDE: Option<usize> = None;

    /// Coordinates at the start.
    fn values(&self) -> [f64; MAX_COORDINATES] {
        [0.0; MAX_COORDINATES]
    }

    /// d per rotation [m/rad]; none if d is a coordinate.
    fn pitch(&self) -> Option<f64> {
        None
    }

    /// Rotation at the start, beside that by the coordinates.
    fn start(&self) -> Rotation {
        Rotation::identity()
    }

    /// See [`Joint::branch`].
    fn branch(&self) -> Option<Branch> {
        None
    }
}

/// Q; `kind` only determines the type of number.
#[inline(always)]
fn rotation<R: Real>(turn: Turn, own: &CoordinateIncrement<R>, kind: R) -> JointRotation<R> {
    match turn {
        Turn::AboutThirdAxis => JointRotation::about_third_axis(&own.angles[0]),
        Turn::Cross => JointRotation::about_first_and_second_axis(&own.angles),
        Turn::Free | Turn::Fixed | Turn::Shafts => JointRotation::none(kind),
    }
}

impl<J: Product> Joint for J {
    const COORDINATES: &'static [Coordinate] = J::COORDINATES;
    const EQUATIONS: EquationCount = EquationCount {
        lengths: match J::PLACE {
            Place::Free => 0,
            Place::Plane => 1,
            Place::Point | Place::Line => 3,
        },
        angles: match J::TURN {
            Turn::Free => 0,
            Turn::Shafts => 1,
            Turn::Fixed | Turn::AboutThirdAxis | Turn::Cross => 3,
        },
    };

    fn equations(&self) -> &'static [&'static str] {
        let EquationCount { lengths, angles } = <J as Joint>::EQUATIONS;
        if J::TURN == Turn::Shafts { &OF_SHAFTS } else { &EQUATIONS[3 - lengths..3 + angles] }
    }

    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let mut constants = [0.0; MAX_CONSTANTS];
        constants[0] = self.pitch().unwrap_or(1.0);
        constants
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let values = self.values();
        let turn = match J::TURN {
            Turn::AboutThirdAxis => Rotation::from_matrix(&elementary(2, values[0])),
            _ => self.start(),
        };
        let displacement = J::SLIDE.map_or(0.0, |slide| self.pitch().unwrap_or(1.0) * values[slide]);
        (values, Motion::new(turn, displacement * Vector3::z()))
    }

    fn branch(&self) -> Option<Branch> {
        Product::branch(self)
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let EquationCount { lengths, .. } = <J as Joint>::EQUATIONS;
        let zero = increment.place.x.like(0.0);
        let mut out = [zero; MAX_EQUATIONS];
        let mut set = |first: usize, Triple { x, y, z }: Triple<R>| {
            (out[first], out[first + 1], out[first + 2]) = (x, y, z);
        };
        match J::PLACE {
            Place::Free => {}
            Place::Point => set(0, increment.place_change),
            Place::Line => set(0, increment.position_change),
            Place::Plane => out[0] = increment.position_change.z,
        }
        if let Some(slide) = J::SLIDE {
            out[2] = out[2].minus_product(constants[0], own.change[slide]);
        }
        match J::TURN {
            Turn::Free => {}
            Turn::Shafts => out[lengths] = increment.rotation_change.axial().z,
            turn => {
                let [x, y, z] = rotation(turn, own, zero).matches_change(increment);
                (out[lengths], out[lengths + 1], out[lengths + 2]) = (x, y, z);
            }
        }
        out
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let EquationCount { lengths, .. } = <J as Joint>::EQUATIONS;
        let zero = mu[0].like(0.0);
        let nothing = Triple::new(zero, zero, zero);
        let force = Triple::new(mu[0], mu[1], mu[2]);
        let mut wrench = match J::PLACE {
            Place::Free => Screw::new(nothing, nothing),
            // The force at the base's point, which is at -Rᵀ x from the tip's.
            Place::Point => Screw::new(force, force.cross(increment.place)),
            Place::Line => force_wrench(increment, force),
            Place::Plane => force_wrench(increment, Triple::new(zero, zero, mu[0])),
        };
        let mut forces = [zero; MAX_COORDINATES];
        let moments = match J::TURN {
            Turn::Free => None,
            Turn::Shafts => Some(Triple::new(zero, zero, mu[lengths])),
            _ => Some(Triple::new(mu[lengths], mu[lengths + 1], mu[lengths + 2])),
        };
        if let Some(moments) = moments {
            let (moment, own) = rotation(J::TURN, own, zero).matches_moments(increment, moments);
            wrench.rotation = wrench.rotation + moment;
            forces = own;
        }
        if let Some(slide) = J::SLIDE {
            forces[slide] = forces[slide].minus_product(constants[0], mu[2]);
        }
        (wrench, forces)
    }
}
