//! Whether an equilibrium is stable: whether the stiffness at it, multipliers included, has negative eigenvalues among
//! the motions that the constraints leave. They are counted by the signs of pivots [Sylvester's law of inertia].

use super::simulation::{Simulation, warn};
use crate::judge::Warning;
use crate::linear::LinearModel;

impl Simulation {
    /// Directions in which the equilibrium that was reached last is unstable; none where that cannot be determined: in motion,
    /// where the stiffness is singular, and where it belongs to no energy, as with loads that turn with the model.
    pub fn unstable_directions(&mut self) -> Option<usize> {
        if self.settings.scheme.dynamic {
            return None;
        }
        let model = LinearModel::of_positions(&self.system, &self.state, self.settings.solver).ok()?;
        model.unstable_directions()
    }

    /// Takes note of whether the equilibrium reached last is stable.
    pub(crate) fn note_stability(&mut self) {
        if self.settings.scheme.dynamic {
            return;
        }
        let time = self.state.kinematics.time;
        let directions = self.unstable_directions();
        if self.stability.last().is_none_or(|(_, known)| *known != directions) {
            self.stability.push((time, directions));
        }
        match directions {
            Some(0) => self.stable_at = Some(time),
            Some(directions) => {
                let onset = self.stable_at;
                let onset =
                    onset.map_or(String::new(), |last| format!(", the one at t = {last:.6e} was stable"));
                warn(&mut self.warnings, Warning::Unstable { time, directions, onset });
            }
            None => {}
        }
    }
}
