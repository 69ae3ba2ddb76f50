//! Readings: quantities that depend on the solution of a step, such as accelerations and reactions, for sampled signals. They
//! are evaluated at the instant of a sample, at the end of a step, and are held values in between.

use std::sync::Arc;

use super::{State, System};
use lissom_mechanics::kinematics::DiscreteValueId;

/// A number that depends on the whole state.
pub trait Quantity: Send + Sync {
    /// Value of the quantity [SI].
    fn value(&self, system: &System, state: &State) -> f64;
}

/// A held value, and the quantity that it has at samples.
#[derive(Clone)]
pub struct Reading {
    /// The held value.
    pub held: DiscreteValueId,
    /// The quantity.
    pub quantity: Arc<dyn Quantity>,
}

impl System {
    /// Assigns quantities to held values that were added as readings.
    pub fn assign_readings(&mut self, readings: Vec<Reading>) {
        self.readings = readings;
    }

    /// Whether any sampled signal depends on a reading.
    pub fn has_readings(&self) -> bool {
        !self.readings.is_empty()
    }

    /// Held values and what they are at `state`.
    pub fn take_readings<'a>(
        &'a self,
        state: &'a State,
    ) -> impl Iterator<Item = (DiscreteValueId, f64)> + 'a {
        self.readings.iter().map(|reading| (reading.held, reading.quantity.value(self, state)))
    }
}
