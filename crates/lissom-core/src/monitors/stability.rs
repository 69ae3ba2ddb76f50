//! Whether equilibria are stable: whether the stiffness, multipliers included, has negative eigenvalues among the motions
//! that satisfy the constraints. They are counted by the signs of pivots [Sylvester's law of inertia].

use super::monitor::{Accepted, Beginning, Monitor};
use crate::bytes::{read_bytes, to_bytes};
use crate::consistent::mobility::mobility;
use crate::errors::{Warning, report};
use crate::linearized::{LinearModel, Verdict, is_stable_like, verdict};
use crate::settings::Problem;
use crate::system::State;

/// Stability of the equilibria of load steps.
#[derive(Default)]
pub(crate) struct Stability {
    /// Load parameters [s] at which the number of unstable directions changes, each with the new number; none if that
    /// cannot be determined.
    pub(crate) changes: Vec<(f64, Option<usize>)>,
    /// The last load parameter at which the equilibrium was stable [s].
    stable_at: Option<f64>,
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let is_static = !beginning.problem.settings.scheme.dynamic;
    is_static.then(|| Box::new(Stability::default()) as Box<dyn Monitor>)
}

/// Directions in which an equilibrium is unstable; none if that cannot be determined: in motion, if the stiffness is
/// singular, and if it derives from no energy, for example with follower loads.
pub(crate) fn unstable_directions(Problem { system, settings }: Problem<'_>, state: &State) -> Option<usize> {
    if settings.scheme.dynamic {
        return None;
    }
    let directions = LinearModel::of(system, state, settings.solver).ok()?.unstable_directions()?;
    // The pivot of a constraint that looks redundant may have the wrong sign: what is fully driven is not unstable.
    Some(if directions == 0 { 0 } else { directions.min(mobility(system, state).freedoms) })
}

impl Stability {
    /// The warning of the first unstable equilibrium, with the stability of the last one.
    fn warning(&self, known: Option<&Warning>, now: f64, unstable: Option<usize>) -> Option<Warning> {
        let written = crate::number::Written;
        if let Some(Warning::Unstable { time, directions, onset, .. }) = known {
            let state = match unstable {
                Some(0) => "is stable".to_owned(),
                Some(number) => format!("is unstable in {number} direction(s)"),
                None => "has an unknown stability".to_owned(),
            };
            let last = format!("; the last one, at t = {}, {state}", written(now));
            return Some(Warning::Unstable {
                time: *time,
                directions: *directions,
                onset: onset.clone(),
                last,
            });
        }
        let directions = unstable.filter(|directions| *directions > 0)?;
        let onset = self.stable_at;
        let onset =
            onset.map_or(String::new(), |last| format!(", the one at t = {} was stable", written(last)));
        Some(Warning::Unstable { time: now, directions, onset, last: String::new() })
    }
}

impl Monitor for Stability {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let time = step.end.kinematics.time;
        let (system, integrator) = (step.problem.system, &mut *step.integrator);
        let (representative, work) = (&integrator.representative, &mut *integrator.work);
        let is_certain = integrator.jacobian_state.has_tangent
            && is_stable_like(system, step.end, representative, (&integrator.scaled, &mut work.tangent));
        let verdict = if is_certain {
            Verdict::Stable
        } else {
            verdict(system, step.end, (representative, &work.redundancy))
        };
        let directions = match verdict {
            Verdict::Stable => Some(0),
            Verdict::NoEnergy => None,
            Verdict::Open => unstable_directions(step.problem, step.end),
        };
        if self.changes.last().is_none_or(|(_, known)| *known != directions) {
            self.changes.push((time, directions));
        }
        let is_known = |warning: &Warning| matches!(warning, Warning::Unstable { .. });
        report(warnings, is_known, |known| self.warning(known, time, directions));
        if directions == Some(0) {
            self.stable_at = Some(time);
        }
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(&self.changes, self.stable_at))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved).map(|learned| (self.changes, self.stable_at) = learned).is_some()
    }
}
