//! Whether steps come through singular positions of closed loops: what the judge sees of them is reported here.

use super::simulation::{Simulation, warn};

impl Simulation {
    /// Takes note of whether the step that was accepted has come through a singular position.
    pub(super) fn note_singular_positions(&mut self) {
        if self.singular.is_empty() {
            return;
        }
        let (before, at) = (&self.previous.kinematics, &self.state.kinematics);
        let length = self.representative.length;
        // Load steps have no velocities; each is looked at.
        let way = if self.settings.scheme.dynamic && length > 0.0 {
            self.representative.largest_speed(&self.system, at) / length * (at.time - before.time)
        } else {
            f64::INFINITY
        };
        if let Some(warning) = self.singular.look(&self.system, at, way) {
            warn(&mut self.warnings, warning);
        }
    }
}
