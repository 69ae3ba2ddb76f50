//! Profiles of wheels and rails: curves in the plane across the track.

use crate::dual::Number;
use crate::registry::Function;

/// Relative step of the argument for the difference of second derivatives that gives a third one.
const DIFFERENCE_STEP: f64 = 1e-4;

/// Value and three derivatives of a given function; its third derivative is a difference of the second.
fn given(function: &Function, at: f64, length: f64) -> [f64; 4] {
    let step = DIFFERENCE_STEP * length;
    let third = function.second_derivative(at + step) - function.second_derivative(at - step);
    [function.value(at), function.first_derivative(at), function.second_derivative(at), third / (2.0 * step)]
}

/// The radius of a wheel minus its nominal one, over the position along its axis from the nominal circle.
#[derive(Clone, Debug)]
pub enum WheelProfile {
    /// A cone, by its slope.
    Cone(f64),
    /// A function, and a length over which it changes [m].
    Given(Function, f64),
}

impl WheelProfile {
    /// f, f' and f'' at a position.
    pub(super) fn at<T: Number>(&self, place: T) -> [T; 3] {
        let [value, first, second, third] = match self {
            Self::Cone(slope) => [slope * place.value(), *slope, 0.0, 0.0],
            Self::Given(function, length) => given(function, place.value(), *length),
        };
        [place.composed(value, first), place.composed(first, second), place.composed(second, third)]
    }
}

/// The head of a rail over the position u along it, which is 0 at the nominal position of contact.
#[derive(Clone, Debug)]
pub enum RailProfile {
    /// A circle of this radius [m], whose tangent at u = 0 rises outwards by this angle [rad]; u is the length of the arc.
    Circle {
        /// Radius [m].
        radius: f64,
        /// Angle [rad].
        cant: f64,
    },
    /// Height over the lateral position u, and a length over which it changes [m].
    Given(Function, f64),
}

impl RailProfile {
    /// The point (outwards, upwards) [m].
    pub(crate) fn point<T: Number>(&self, u: T) -> [T; 2] {
        match self {
            Self::Circle { radius, cant } => {
                let (sine, cosine) = u.scaled(radius.recip()).plus(-cant).sine_cosine();
                [sine.plus(cant.sin()).scaled(*radius), cosine.plus(-cant.cos()).scaled(*radius)]
            }
            Self::Given(function, length) => {
                let [value, first, ..] = given(function, u.value(), *length);
                [u, u.composed(value, first)]
            }
        }
    }

    /// The normal (outwards, upwards), of length one.
    pub(super) fn normal<T: Number>(&self, u: T) -> [T; 2] {
        match self {
            Self::Circle { radius, cant } => {
                let (sine, cosine) = u.scaled(radius.recip()).plus(-cant).sine_cosine();
                [sine, cosine]
            }
            Self::Given(function, length) => {
                let [_, first, second, _] = given(function, u.value(), *length);
                let slope = u.composed(first, second);
                let size = (slope * slope).plus(1.0).square_root();
                [-slope / size, T::constant(1.0) / size]
            }
        }
    }

    /// Curvature [1/m], positive where the head is convex.
    pub(crate) fn curvature<T: Number>(&self, u: T) -> T {
        match self {
            Self::Circle { radius, .. } => T::constant(radius.recip()),
            Self::Given(function, length) => {
                let [_, first, second, third] = given(function, u.value(), *length);
                let (slope, bend) = (u.composed(first, second), u.composed(second, third));
                -bend * (slope * slope).plus(1.0).power(-1.5)
            }
        }
    }

    /// Radius of the circle that fits it at the nominal position of contact, and the angle of its tangent there.
    pub(super) fn osculating(&self) -> (f64, f64) {
        match self {
            Self::Circle { radius, cant } => (*radius, *cant),
            Self::Given(function, _) => (self.curvature(0.0).recip(), function.first_derivative(0.0).atan()),
        }
    }

    /// Approximate height of a point (outwards, upwards) above the head, and the position u below it.
    pub(super) fn clearance(&self, [outwards, upwards]: [f64; 2]) -> (f64, f64) {
        match self {
            Self::Circle { radius, cant } => {
                let across = outwards - radius * cant.sin();
                let up = upwards + radius * cant.cos();
                (across.hypot(up) - radius, radius * (across.atan2(up) + cant))
            }
            Self::Given(function, _) => {
                let slope = function.first_derivative(outwards);
                ((upwards - function.value(outwards)) / slope.hypot(1.0), outwards)
            }
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/wheels/profile.rs"]
mod tests;
