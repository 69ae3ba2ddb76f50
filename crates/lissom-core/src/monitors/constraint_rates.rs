//! Violation of velocity constraints. Schemes satisfy the constraints of position, and their rates only as well as the step
//! resolves the motion. If drives or loops prescribe the positions, nothing else shows that steps are too long for signals and events that
//! depend on velocities.
//!
//! ```text
//! B v + ∂c/∂t ≈ (c(q + ε v, t + ε) - c(q, t))/ε
//! ```

use lissom_motion::Motion;

use super::monitor::{Accepted, Beginning, Monitor};
use super::pairs::Pairs;
use crate::bytes::{read_bytes, to_bytes};
use crate::errors::{Warning, report_since};
use crate::kinematics::{Kinematics, Quantity};
use crate::round_off::VIOLATION;
use crate::system::System;

/// ε is this fraction of the step, and of the time in which the fastest node moves a representative length or a radian. The
/// truncation error of the difference is ε/2 times the rate, and its round-off 1e-11 of it.
const PART: f64 = 1e-4;

/// Constraint rates above this fraction of the speed are reported: the error of forces is a multiple of it.
const NOTEWORTHY: f64 = 0.02;

/// Violation of velocity constraints at the ends of steps of planned size.
struct ConstraintRates {
    pairs: Pairs,
    /// Sums over all steps examined: constraint rates, and speeds.
    sums: [f64; 2],
    /// Storage for the compared configuration.
    moved: Kinematics,
    before: Vec<f64>,
    after: Vec<f64>,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let system = beginning.problem.system;
    let rates = ConstraintRates::new(system, &beginning.state.kinematics);
    // What is recorded follows from the positions; what signals read are the scheme's velocities.
    let is_read = !(system.signals().signals().is_empty() && system.signals().events().is_empty());
    (is_read && beginning.is_planned_motion()).then(|| Box::new(rates) as Box<dyn Monitor>)
}

impl Monitor for ConstraintRates {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        if !self.pairs.is_due(step.fraction) {
            return;
        }
        self.pairs.is_complete();
        let (from, to) = (&step.start.kinematics, &step.end.kinematics);
        let length = step.integrator.representative.length;
        let found = self.missed(step.problem.system, to, length, to.time - from.time);
        self.sums.iter_mut().zip(found).for_each(|(sum, found)| *sum += found);
        let missed = self.sums[0] / self.sums[1];
        // A disturbance at the start may be small compared with what follows.
        let is_noteworthy = missed > NOTEWORTHY;
        report_since!(warnings, to.time, is_noteworthy, UnresolvedRates { missed });
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.pairs, self.sums))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved).map(|learned| (self.pairs, self.sums) = learned).is_some()
    }
}

impl ConstraintRates {
    fn new(system: &System, at: &Kinematics) -> Self {
        let none = vec![0.0; system.layout().multiplier_count];
        let pairs = Pairs::new();
        Self { pairs, sums: [0.0; 2], moved: at.clone(), before: none.clone(), after: none }
    }

    /// The largest rate of a constraint at these velocities after a step of `step` [s], and the largest speed; lengths
    /// relative to the representative `length` [1/s].
    fn missed(&mut self, system: &System, at: &Kinematics, length: f64, step: f64) -> [f64; 2] {
        let length = if length > 0.0 { length } else { 1.0 };
        let speed = at.nodes.iter().fold(0.0_f64, |most, node| {
            let [linear, angular] = [0, 3].map(|first| node.twist.fixed_rows::<3>(first).norm());
            most.max(linear / length).max(angular)
        });
        if !(speed > 0.0 && speed.is_finite()) {
            return [0.0; 2];
        }
        let short = PART * step.min(1.0 / speed);
        // At rest the difference is round-off.
        if NOTEWORTHY * short * speed < VIOLATION {
            return [0.0; 2];
        }
        let Self { moved, before, after, .. } = self;
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
