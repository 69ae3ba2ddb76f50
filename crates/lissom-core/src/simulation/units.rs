//! Units: models of other programs that are attached to a simulation.

pub use crate::signals::exchange::UnitFault;

/// A model of another program.
pub trait Unit: Send + Sync {
    /// Computes the outputs at the start for these inputs. Is called again with other inputs, until the unit is first advanced.
    ///
    /// # Errors
    /// If the unit cannot start.
    fn begin(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), UnitFault>;

    /// Advances with constant inputs over an interval, from a time [s] by a duration [s], and computes the outputs there.
    ///
    /// # Errors
    /// If the unit cannot take the step.
    fn advance(&mut self, interval: [f64; 2], inputs: &[f64], outputs: &mut [f64]) -> Result<(), UnitFault>;

    /// State of the unit; none if the unit cannot return it.
    fn save(&self) -> Option<Vec<u8>>;

    /// Returns to a state that [`save`](Self::save) of this unit, or of another instance of it, has returned.
    ///
    /// # Errors
    /// If that is not possible.
    fn restore(&mut self, state: &[u8]) -> Result<(), UnitFault>;
}

/// Units of a simulation, in the order of those of its graph of signals.
#[derive(Default)]
pub(crate) struct AttachedUnits {
    pub(super) units: Vec<AttachedUnit>,
}

/// A unit and the sample that it has reached.
pub(super) struct AttachedUnit {
    pub(super) unit: Box<dyn Unit>,
    /// Number of samples to which it has been advanced.
    pub(super) samples: u64,
    /// Outputs there; none before the first sample and after a snapshot is restored.
    pub(super) outputs: Vec<f64>,
}

impl AttachedUnits {
    /// States of all units, with the samples they have reached.
    pub(crate) fn save(&self) -> Vec<(u64, Option<Vec<u8>>)> {
        self.units.iter().map(|own| (own.samples, own.unit.save())).collect()
    }
}

pub(super) fn check_finite(names: &[String], outputs: &[f64]) -> Result<(), UnitFault> {
    let wrong = names.iter().zip(outputs).find(|(_, output)| !output.is_finite());
    wrong.map_or(Ok(()), |(name, output)| {
        let cause = format!("its output `{name}` is {output}");
        Err(UnitFault { cause, remedy: "look for the cause in its inputs and parameters".to_owned() })
    })
}
