//! Samples of units: each is advanced to a sample when the step that ends there is accepted, from the inputs of the sample before. Its
//! outputs are held values, which change before the signals of that instant are sampled.

use super::units::{AttachedUnit, Unit, UnitFault, check_finite};
use super::{SavedEquations, Simulation, SnapshotError};
use crate::errors::{InitialError, StepError};
use crate::instants;
use crate::kinematics::Kinematics;

impl Simulation {
    /// Attaches the units of the model, in the order of its graph of signals, and computes their outputs at the start. Inputs that
    /// depend on outputs of units are updated until both agree.
    ///
    /// # Errors
    /// If a unit cannot start, its outputs are not finite, or they do not agree with its inputs.
    pub fn attach_units(&mut self, units: Vec<Box<dyn Unit>>) -> Result<(), InitialError> {
        self.units.units =
            units.into_iter().map(|unit| AttachedUnit { unit, samples: 0, outputs: Vec::new() }).collect();
        self.begin_units()
    }

    /// Computes the outputs of all units before the first step.
    ///
    /// # Errors
    /// As [`attach_units`](Self::attach_units).
    pub(super) fn begin_units(&mut self) -> Result<(), InitialError> {
        // Units in series pass values on by one unit at a time; a contraction in a loop of feedthrough needs more passes.
        for _ in 0..100 {
            let mut at = self.state.kinematics.clone();
            for (own, ports) in self.units.units.iter_mut().zip(&self.system.signals().units) {
                let inputs: Vec<f64> = ports.inputs.iter().map(|held| at.held[held.index()]).collect();
                let mut outputs = vec![0.0; ports.outputs.len()];
                let begun = own.unit.begin(&inputs, &mut outputs);
                let begun = begun.and_then(|()| check_finite(&ports.output_names, &outputs));
                begun.map_err(|UnitFault { cause, remedy }| InitialError::Unit {
                    unit: ports.name.clone(),
                    cause,
                    remedy,
                })?;
                for (held, output) in ports.outputs.iter().zip(outputs) {
                    at.held[held.index()] = output;
                }
            }
            if at.held == self.state.kinematics.held {
                return Ok(());
            }
            self.begin_with(at)?;
        }
        let first = self.system.signals().units.first();
        Err(InitialError::Unit {
            unit: first.map(|ports| ports.name.clone()).unwrap_or_default(),
            cause: "outputs and inputs of the units at the start depend on each other, and do not agree"
                .to_owned(),
            remedy: "let an input depend on a sampled signal instead of the output".to_owned(),
        })
    }

    /// Advances the units that are due at the state, from their inputs at the sample before, and sets their outputs in `at`.
    pub(super) fn advance_units(&mut self, at: &mut Kinematics, elapsed: f64) -> Result<(), StepError> {
        let time = at.time;
        let graph = self.system.signals();
        for (index, ports) in graph.units.iter().enumerate() {
            if !instants::is_due(time, elapsed, ports.period) {
                continue;
            }
            let fault = |UnitFault { cause, remedy }: UnitFault| StepError::Unit {
                time,
                unit: ports.name.clone(),
                cause,
                remedy,
            };
            let Some(own) = self.units.units.get_mut(index) else {
                let cause = "it is not attached to this simulation".to_owned();
                return Err(fault(UnitFault { cause, remedy: "run the model by a session".to_owned() }));
            };
            let sample = (elapsed / ports.period).round() as u64;
            if sample == own.samples {
                // The sample is repeated after it has failed for another reason.
                for (output, value) in ports.outputs.iter().zip(&own.outputs) {
                    at.held[output.index()] = *value;
                }
                continue;
            }
            if sample != own.samples + 1 {
                let there = self.origin.kinematics.time + own.samples as f64 * ports.period;
                let cause = format!("it is at t = {there} s already, and cannot return to the sample before");
                let remedy = "start the simulation again, or restore a snapshot".to_owned();
                return Err(fault(UnitFault { cause, remedy }));
            }
            let held = &self.state.kinematics.held;
            let inputs: Vec<f64> = ports.inputs.iter().map(|input| held[input.index()]).collect();
            let mut outputs = vec![0.0; ports.outputs.len()];
            let from = self.origin.kinematics.time + own.samples as f64 * ports.period;
            own.unit.advance([from, ports.period], &inputs, &mut outputs).map_err(fault)?;
            check_finite(&ports.output_names, &outputs).map_err(fault)?;
            for (output, value) in ports.outputs.iter().zip(&outputs) {
                at.held[output.index()] = *value;
            }
            (own.samples, own.outputs) = (sample, outputs);
        }
        Ok(())
    }

    /// Whether snapshots of the simulation can be restored.
    ///
    /// # Errors
    /// The first unit that cannot return its state.
    pub fn check_snapshots(&self) -> Result<(), SnapshotError> {
        self.check_saved(&self.units.save(), &self.exchanged.save())
    }

    /// Names of all units: of those with samples, then of those with equations.
    fn unit_names(&self) -> impl Iterator<Item = &str> {
        let graph = self.system.signals();
        let exchanged = graph.exchanged.iter().map(|ports| ports.slot.name());
        graph.units.iter().map(|ports| ports.name.as_str()).chain(exchanged)
    }

    fn check_saved(
        &self,
        saved: &[(u64, Option<Vec<u8>>)],
        exchanged: &[SavedEquations],
    ) -> Result<(), SnapshotError> {
        let states = saved.iter().map(|(_, state)| state).chain(exchanged.iter().map(|(_, state)| state));
        let mut unsaved = self.unit_names().zip(states).filter(|(_, state)| state.is_none());
        unsaved.next().map_or(Ok(()), |(name, _)| Err(SnapshotError::Unit { unit: name.to_owned() }))
    }

    /// Returns the units to saved states.
    pub(super) fn restore_units(
        &mut self,
        saved: &[(u64, Option<Vec<u8>>)],
        exchanged: &[SavedEquations],
    ) -> Result<(), SnapshotError> {
        let ports = &self.system.signals().units;
        if (self.units.units.len(), self.exchanged.count()) != (saved.len(), exchanged.len()) {
            let unit = self.unit_names().next().unwrap_or_default().to_owned();
            return Err(SnapshotError::Unit { unit });
        }
        self.check_saved(saved, exchanged)?;
        self.exchanged.restore(exchanged)?;
        for ((own, ports), (samples, state)) in self.units.units.iter_mut().zip(ports).zip(saved) {
            let state = state.as_deref().unwrap_or_default();
            own.unit.restore(state).map_err(|fault| SnapshotError::UnitRestore {
                unit: ports.name.clone(),
                reason: fault.cause,
            })?;
            (own.samples, own.outputs) = (*samples, Vec::new());
        }
        Ok(())
    }
}
