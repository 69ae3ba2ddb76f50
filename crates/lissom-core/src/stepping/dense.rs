//! Values between the ends of a step, to the order of the scheme: poses by the cubic Hermite interpolation of both
//! poses and twists.
//!
//! ```text
//! H(x) = H₀ exp ψ(x),   ψ(0) = 0,  ψ'(0) = h V₀,  ψ(1) = log(H₀⁻¹ H₁),  ψ'(1) = T(ψ(1))⁻¹ h V₁
//! ```
//!
//! x = 0 … 1 over the step. The error is of order h⁴. Multipliers and accelerations are interpolated linearly.

use lissom_motion::{Motion, Vector6, inverse_tangent_times, tangent_times};

use crate::system::State;

/// Writes the state at `time` [s] between two states of one motion to `out`.
pub(crate) fn interpolate(from: &State, to: &State, time: f64, out: &mut State) {
    let (start, end) = (&from.kinematics, &to.kinematics);
    let duration = end.time - start.time;
    let x = if duration > 0.0 { ((time - start.time) / duration).clamp(0.0, 1.0) } else { 1.0 };
    at_share(from, to, x, out);
    out.kinematics.time = time;
}

/// The state at the step fraction `x` between two states, 1 at its end, or beyond it by extrapolation.
pub(crate) fn at_share(from: &State, to: &State, x: f64, out: &mut State) {
    let (start, end) = (&from.kinematics, &to.kinematics);
    let duration = end.time - start.time;
    out.kinematics.held.clone_from(&start.held);
    let between = |a: f64, b: f64| a + x * (b - a);
    out.kinematics.time = start.time + x * duration;
    out.kinematics.elapsed = 0.0;
    for ((node, a), b) in out.kinematics.nodes.iter_mut().zip(&start.nodes).zip(&end.nodes) {
        let whole = (a.frame.inverse() * b.frame).logarithm();
        let first = duration * a.twist;
        let last = inverse_tangent_times(&whole, &(duration * b.twist));
        let (place, rate) = hermite(x, &whole, &first, &last);
        node.frame = a.frame * Motion::exponential(&place);
        node.twist = if duration > 0.0 { tangent_times(&place, &rate) / duration } else { b.twist };
        node.acceleration = a.acceleration + x * (b.acceleration - a.acceleration);
    }
    for ((own, a), b) in out.kinematics.coordinates.iter_mut().zip(&start.coordinates).zip(&end.coordinates) {
        let place = Vector6::from_element(b.value - a.value);
        let (place, rate) = hermite(
            x,
            &place,
            &Vector6::from_element(duration * a.rate),
            &Vector6::from_element(duration * b.rate),
        );
        own.value = a.value + place[0];
        own.rate = if duration > 0.0 { rate[0] / duration } else { b.rate };
        own.acceleration = between(a.acceleration, b.acceleration);
    }
    out.accumulated.clear();
    let accumulated = from.accumulated.iter().zip(&to.accumulated);
    out.accumulated.extend(accumulated.map(|(a, b)| between(*a, *b)));
    for ((own, a), b) in out.multipliers.iter_mut().zip(&from.multipliers).zip(&to.multipliers) {
        *own = between(*a, *b);
    }
    out.kinematics.show_multipliers(&out.multipliers);
}

/// Position and rate at x of the cubic from 0 to `whole` with these rates at its ends.
fn hermite(x: f64, whole: &Vector6, first: &Vector6, last: &Vector6) -> (Vector6, Vector6) {
    let (square, cube) = (x * x, x * x * x);
    let place =
        (3.0 * square - 2.0 * cube) * whole + (x - 2.0 * square + cube) * first + (cube - square) * last;
    let rate = (6.0 * x - 6.0 * square) * whole
        + (1.0 - 4.0 * x + 3.0 * square) * first
        + (3.0 * square - 2.0 * x) * last;
    (place, rate)
}
