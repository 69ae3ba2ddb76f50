//! What velocities miss: schemes hold the constraints, and their rates only as well as the step resolves the motion. Where drives or
//! loops prescribe the places, nothing else shows that steps are too long.
//!
//! ```text
//! B v + ∂c/∂t ≈ (c(q + ε v, t + ε) - c(q, t))/ε
//! ```

use lissom_motion::Motion;

use crate::kinematics::{Kinematics, Quantity};
use crate::system::System;

/// ε is this part of the time in which the fastest node goes a representative length, or a radian, and of the step: what the difference
/// errs is half of it times the rate, and round-off 1e-11 of it.
const PART: f64 = 1e-4;

/// Room for what is compared.
#[derive(Clone, Debug)]
pub(crate) struct ConstraintRates {
    moved: Kinematics,
    before: Vec<f64>,
    after: Vec<f64>,
}

impl ConstraintRates {
    pub(crate) fn new(system: &System, at: &Kinematics) -> Self {
        let none = vec![0.0; system.layout().multiplier_count];
        Self { moved: at.clone(), before: none.clone(), after: none }
    }

    /// The largest rate of a constraint at these velocities behind a step of `step` [s], and the largest speed; lengths in
    /// representative `length` [1/s].
    pub(crate) fn missed(&mut self, system: &System, at: &Kinematics, length: f64, step: f64) -> [f64; 2] {
        let length = if length > 0.0 { length } else { 1.0 };
        let speed = at.nodes.iter().fold(0.0_f64, |most, node| {
            let [linear, angular] = [0, 3].map(|first| node.twist.fixed_rows::<3>(first).norm());
            most.max(linear / length).max(angular)
        });
        if !(speed > 0.0 && speed.is_finite()) {
            return [0.0; 2];
        }
        let short = PART * step.min(1.0 / speed);
        let Self { moved, before, after } = self;
        moved.time = at.time + short;
        moved.elapsed = 0.0;
        moved.nodes.clone_from(&at.nodes);
        moved.coordinates.clone_from(&at.coordinates);
        moved.held.clone_from(&at.held);
        moved.multipliers.clone_from(&at.multipliers);
        for node in &mut moved.nodes {
            node.frame = node.frame * Motion::exponential(&(short * node.twist));
        }
        for own in &mut moved.coordinates {
            own.value += short * own.rate;
        }
        system.violations(at, before);
        system.violations(moved, after);
        let quantities = &system.layout().quantities()[system.layout().coordinate_count()..];
        let rate = |((before, after), quantity): ((&f64, &f64), &Quantity)| {
            let unit = if *quantity == Quantity::Length { length } else { 1.0 };
            (after - before).abs() / (unit * short)
        };
        [before.iter().zip(after.iter()).zip(quantities).map(rate).fold(0.0_f64, f64::max), speed]
    }
}
