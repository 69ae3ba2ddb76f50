//! A joint's coordinate that is a function of time, c = φ - f(t). Its multiplier is the drive's moment or force.

use crate::kinematics::CoordinateId;
use crate::registry::Function;

/// A driven coordinate.
#[derive(Clone, Debug)]
pub struct Prescribed {
    /// The driven coordinate.
    pub coordinate: CoordinateId,
    /// Value of the coordinate as a function of time [rad, m].
    pub value: Function,
}

impl Prescribed {
    /// Violation, evaluated from absolute positions.
    pub fn violation(&self, coordinate: f64, time: f64) -> f64 {
        coordinate - self.value.value(time)
    }

    /// Change of the violation over the time interval `elapsed` [s] that ends at `time`.
    pub fn violation_change(&self, change: f64, time: f64, elapsed: f64) -> f64 {
        change - function_change(&self.value, time, elapsed)
    }
}

/// `f(b) - f(a)` over the time interval `elapsed` = h [s] that ends at `time`. Over short times the difference cancels; an integral of
/// the derivative does not, and is used if both agree within round-off. With values at both ends and in the middle m it is
///
/// ```text
/// ∫ f' dt = h (7 f'(a) + 16 f'(m) + 7 f'(b))/30 + h² (f''(a) - f''(b))/60
/// ```
///
/// up to an error of h⁷. Where the second derivative jumps at an end, as it may at a breakpoint, three Gauss points replace it.
fn function_change(function: &Function, time: f64, elapsed: f64) -> f64 {
    let half = 0.5 * elapsed;
    let middle = time - half;
    let [start, centre, end] = [time - elapsed, middle, time].map(|time| function.jet(time));
    let difference = end[0] - start[0];
    let rounding = 4.0 * f64::EPSILON * (start[0].abs() + end[0].abs() + time.abs() * centre[1].abs());
    let by_ends = elapsed / 30.0 * (7.0 * (start[1] + end[1]) + 16.0 * centre[1])
        + elapsed * elapsed / 60.0 * (start[2] - end[2]);
    if (by_ends - difference).abs() <= rounding {
        return by_ends;
    }
    let slope = |x: f64| function.first_derivative(middle + x * half);
    let offset = 0.6_f64.sqrt();
    let integral = half * (5.0 * (slope(-offset) + slope(offset)) + 8.0 * centre[1]) / 9.0;
    if (integral - difference).abs() <= rounding { integral } else { difference }
}

#[cfg(test)]
#[path = "../../tests/unit/joints/prescribed.rs"]
mod tests;
