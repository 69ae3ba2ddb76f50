//! Whether the energy that a scheme dissipates shifts the phase of a long motion without damping or drives.
//!
//! ```text
//! δφ = ∫ δω/ω dφ ≈ ½ ∫ δE/E dφ = ¼ d s²/a,      d = min over two windows of |ΔE| / (E Δs)
//! ```
//!
//! Legend: s path of the motion so far, a its largest displacement, so that φ = s/a, E energy exchanged, ω frequency of a motion of
//! this energy: δω/ω = ½ δE/E is that of large rotations. A motion in which stiffnesses change little has a smaller shift, in
//! proportion; a linear one has none. The windows reach from a quarter to a half of the path, and from there to the present: stiff vibrations that
//! the scheme damps at the start of a motion shift nothing afterwards.

use serde::{Deserialize, Serialize};

use super::monitor;
use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{from_bytes, to_bytes};
use crate::elements::Spring;
use crate::errors::{Warning, report_since};
use crate::integrator::error_estimate::{MIN_REFERENCE, excursion};
use crate::kinematics::Kinematics;
use crate::linearized::LinearModel;
use crate::settings::Problem;
use crate::system::State;

/// Marks in the time in which the path doubles.
const MARKS_PER_DOUBLING: usize = 4;

/// Energy lost along the path of a motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct EnergyDrift {
    path: f64,
    farthest: f64,
    /// Path, in units of the model's length, and energy lost [J] at marks, at equal ratios of paths from 1 on.
    marks: Vec<[f64; 2]>,
    /// How much frequencies depend on the energy, from 0 to 1, as far as it is known.
    nonlinearity: f64,
    /// Whether anything is damped.
    is_damped: bool,
}

impl EnergyDrift {
    /// Records the energy `lost` so far, of the energy `exchanged` [J]. At a mark: the estimated shift of the phase [rad].
    fn shift(&mut self, lost: f64, exchanged: f64) -> Option<f64> {
        let ratio = (MARKS_PER_DOUBLING as f64).recip().exp2();
        if self.path < self.marks.last().map_or(1.0, |mark| ratio * mark[0]) {
            return None;
        }
        self.marks.push([self.path, lost]);
        let count = self.marks.len();
        let first = count.checked_sub(2 * MARKS_PER_DOUBLING + 1)?;
        let rate = |from: usize| {
            let [[from, before], [to, after]] =
                [from, from + MARKS_PER_DOUBLING].map(|mark| self.marks[mark]);
            (after - before) / (to - from)
        };
        let rates = [rate(first), rate(first + MARKS_PER_DOUBLING)];
        let steady = if rates[0] * rates[1] > 0.0 { rates[0].abs().min(rates[1].abs()) } else { 0.0 };
        let shift = 0.25 * steady / exchanged * self.path * self.path / self.farthest.max(MIN_REFERENCE);
        shift.is_finite().then_some(shift)
    }
}

/// How much frequencies depend on the energy, from 0 to 1, as far as this is seen between the configurations `origin` and `state`: the
/// change of stiffnesses, relative to the largest one, or the square of the largest rotation. None if anything is damped.
fn nonlinearity(
    Problem { system, settings }: Problem<'_>,
    origin: &Kinematics,
    state: &State,
) -> Option<f64> {
    let stiffness = |at: &Kinematics| {
        let mut resting = state.clone();
        resting.kinematics.clone_from(at);
        resting.kinematics.stop();
        let model = LinearModel::of(system, &resting, settings.solver).ok()?;
        let is_undamped = model.parts().damping.iter().all(|&value| value == 0.0);
        is_undamped.then(|| model.parts().stiffness.clone())
    };
    let (before, after) = (stiffness(origin)?, stiffness(&state.kinematics)?);
    let largest = before.iter().chain(&after).fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    let changes = before.iter().zip(&after).map(|(before, after)| (before - after).abs() / largest);
    let nodes = origin.nodes.iter().zip(&state.kinematics.nodes);
    let turns = nodes
        .map(|(from, to)| (from.frame.rotation.inverse() * to.frame.rotation).logarithm().norm_squared());
    Some(changes.chain(turns).fold(0.0, f64::max).min(1.0))
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let Problem { system, settings } = beginning.problem;
    let is_free = system.drives().is_empty()
        && system.layout().states.is_empty()
        && system.layout().of_velocities.is_empty();
    let is_free = is_free && !system.elements_with(|own| own.spring).any(Spring::dissipates);
    let is_adaptive = settings.scheme.dynamic && settings.control.is_some();
    (is_free && is_adaptive).then(|| Box::<EnergyDrift>::default() as Box<dyn Monitor>)
}

impl Monitor for EnergyDrift {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, end) = (step.problem.system, &step.end.kinematics);
        let length = step.integrator.representative.length;
        self.path += excursion(system, (&step.start.kinematics, end), length);
        if self.farthest < 1.0 {
            self.farthest = self.farthest.max(excursion(system, (step.origin, end), length));
        }
        let [_, after] = step.energy_balance;
        let Some(shift) = self.shift(after.lost, after.turned_over) else { return };
        if shift < monitor::NOTEWORTHY || self.is_damped {
            return;
        }
        let Some(seen) = nonlinearity(step.problem, step.origin, step.end) else {
            self.is_damped = true;
            return;
        };
        self.nonlinearity = self.nonlinearity.max(seen);
        let shift = self.nonlinearity * shift;
        if shift < monitor::NOTEWORTHY {
            return;
        }
        let lost = after.lost / after.turned_over;
        report_since!(warnings, end.time, true, EnergyDrift { shift, lost });
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(self)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        from_bytes(saved, self)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/monitors/energy_drift.rs"]
mod tests;
