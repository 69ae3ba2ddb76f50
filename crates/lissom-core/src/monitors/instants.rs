//! Instants of a motion with steps of planned size: a few steps whose errors exceed those before them, such as a contact or a
//! change between sticking and sliding. Steps that are examined at intervals miss them. They are recognised by the error of the
//! prediction, which costs nothing.

use serde::{Deserialize, Serialize};

/// Prediction errors above this multiple of the level belong to an instant. With 4, a change between sticking and sliding is missed
/// while the level of the one before it decays.
const SPIKE: f64 = 2.0;
/// Fraction of the level that remains after a step: half of it after 35 steps, so that the errors of a vibration do not fall below it
/// between their zeros.
const DECAY: f64 = 0.98;
/// Maximum steps of an instant: longer ones are a new motion, whose errors are estimated from pairs of steps.
const MAX_STEPS: u32 = 12;

/// Prediction errors of the latest steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Instants {
    /// Largest recent error outside instants; none before the first step.
    level: Option<f64>,
    /// Steps of the present instant.
    steps: u32,
}

impl Instants {
    /// Whether the next step, with this error of its prediction, belongs to an instant.
    pub(super) fn contain(&mut self, error: f64) -> bool {
        let level = self.level.unwrap_or(error);
        let is_instant = error > SPIKE * level && self.steps < MAX_STEPS;
        if is_instant {
            self.steps += 1;
        } else {
            self.steps = self.steps.saturating_sub(1);
            self.level = Some(error.max(DECAY * level));
        }
        is_instant
    }
}

#[cfg(test)]
#[path = "../../tests/unit/monitors/instants.rs"]
mod tests;
