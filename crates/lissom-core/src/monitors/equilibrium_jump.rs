//! Load steps that leave the path of equilibria: loads do more work than the model stores.

use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{from_bytes, to_bytes};
use crate::errors::{Warning, warn};

/// Fraction of the work of a load step that must be missing for a jump to be reported. On a path of equilibria that
/// the trapezoidal rule approximates badly, for example with the whole load at once, up to a third is missing.
const JUMP: f64 = 0.6;
/// Energy that the first load step may release, over the value of a linear model.
const RELEASED: f64 = 4.0;

struct EquilibriumJump {
    /// Energy that the first load step releases because its start is not in equilibrium [J].
    released: f64,
    /// Energy that is round-off where nothing resists the motion of drives [J].
    negligible: f64,
    is_first: bool,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let own = beginning.representative;
    // Loads and drives have their final values after a time of one.
    let negligible = f64::EPSILON * (own.stiffness + own.mass) * own.length * own.length;
    let jump = EquilibriumJump { released: beginning.released, negligible, is_first: true };
    (!beginning.problem.settings.scheme.dynamic).then(|| Box::new(jump) as Box<dyn Monitor>)
}

impl Monitor for EquilibriumJump {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let [before, after] = step.energy_balance;
        let is_first = std::mem::replace(&mut self.is_first, false);
        // A start that is not in equilibrium, for example with prestress, releases energy that no load has supplied.
        let is_release = is_first && after.unexplained_work(before).abs() <= RELEASED * self.released;
        let (start, time) = (step.start.kinematics.time, step.end.kinematics.time);
        // Relaxation leaves the path, and has a warning of its own.
        let is_relaxation =
            |warning: &Warning| matches!(warning, Warning::Relaxed { time: at, .. } if *at == time);
        let missing = after.missing_work(before);
        let work = missing * (after.loads + after.drives - before.loads - before.drives).abs();
        if missing > JUMP && work > self.negligible && !is_release && !warnings.iter().any(is_relaxation) {
            warn(warnings, Warning::Jump { start, time, work });
        }
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&self.is_first)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        from_bytes(saved, &mut self.is_first)
    }
}
