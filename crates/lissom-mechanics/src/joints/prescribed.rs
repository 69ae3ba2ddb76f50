//! A joint's coordinate that is a function of time, c = φ - f(t). Its multiplier is the drive's moment or force.

use crate::kinematics::CoordinateId;
use crate::registry::Function;

/// A driven coordinate.
#[derive(Clone, Debug)]
pub struct Prescribed {
    /// The driven coordinate.
    pub coordinate: CoordinateId,
    /// Its value as a function of time [rad, m].
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

/// `f(time) - f(time - elapsed)`. Over short times the difference cancels; the integral of the derivative, by three
/// Gauss points, does not. The integral is used if both agree within round-off.
fn function_change(function: &Function, time: f64, elapsed: f64) -> f64 {
    const OFFSET: f64 = 0.774_596_669_241_483_4;
    let (start, end) = (function.value(time - elapsed), function.value(time));
    let difference = end - start;
    let half = 0.5 * elapsed;
    let middle = time - half;
    let slope = |x: f64| function.first_derivative(middle + x * half);
    let integral = half * (5.0 * (slope(-OFFSET) + slope(OFFSET)) + 8.0 * slope(0.0)) / 9.0;
    let rounding = 4.0 * f64::EPSILON * (start.abs() + end.abs() + time.abs() * slope(0.0).abs());
    if (integral - difference).abs() <= rounding { integral } else { difference }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::registry::TimeFunction;

    #[derive(Debug)]
    struct Sine;

    impl TimeFunction for Sine {
        fn value(&self, time: f64) -> f64 {
            time.sin()
        }
        fn first_derivative(&self, time: f64) -> f64 {
            time.cos()
        }
        fn second_derivative(&self, time: f64) -> f64 {
            -time.sin()
        }
    }

    #[test]
    fn short_changes_keep_their_digits_and_long_ones_are_exact() {
        let function: Function = Arc::new(Sine);
        let from = 0.7_f64;
        for exponent in 1..10 {
            let to = from + 10.0_f64.powi(-exponent);
            let width = to - from;
            // sin b - sin a = 2 cos((a + b)/2) sin((b - a)/2)
            let exact = 2.0 * (0.5 * (from + to)).cos() * (0.5 * width).sin();
            let change = function_change(&function, to, width);
            let allowed = if exponent < 3 { 1e-13 } else { 1e-15 };
            assert!((change - exact).abs() <= allowed * exact.abs().max(1e-2 * allowed), "{exponent}");
        }
    }
}
