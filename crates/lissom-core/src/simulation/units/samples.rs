//! Samples of units: each is advanced to a sample when the step that ends there is accepted, from the inputs of the sample before. Its
//! outputs are held values, which change before the signals of that instant are sampled.

use super::{Simulation, UnitFault, begin, step_error};
use crate::errors::{InitialError, StepError};
use crate::instants;
use crate::kinematics::Kinematics;

impl Simulation {
    /// Computes the outputs of sampled units before the first step, and what depends on them.
    ///
    /// # Errors
    /// As [`begin`].
    pub(in crate::simulation) fn begin_samples(&mut self) -> Result<(), InitialError> {
        let system = self.shared_system();
        let mut units = std::mem::take(&mut self.units);
        let mut at = self.state.kinematics.clone();
        let begun = begin((system.signals(), &mut units), true, &mut at, |at| {
            if at.held != self.state.kinematics.held {
                self.begin_with(at.clone())?;
                at.clone_from(&self.state.kinematics);
            }
            Ok(())
        });
        self.units = units;
        begun
    }

    /// Advances the units that are due at the state, from their inputs at the sample before, and sets their outputs in `at`.
    pub(in crate::simulation) fn advance_units(
        &mut self,
        at: &mut Kinematics,
        elapsed: f64,
    ) -> Result<(), StepError> {
        let (time, origin) = (at.time, self.origin.kinematics.time);
        let graph = self.system.signals();
        for (index, ports) in graph.units.iter().enumerate() {
            let Some(samples) = ports.sampled().filter(|own| instants::is_due(time, elapsed, own.period))
            else {
                continue;
            };
            let fault = step_error(ports, time);
            let Some(own) = self.units.get_mut(index) else {
                let cause = "it is not attached to this simulation".to_owned();
                return Err(fault(UnitFault { cause, remedy: "run the model by a session".to_owned() }));
            };
            let (from, period) = (own.progress.reached, samples.period);
            let sample = (elapsed / period).round();
            let ahead = sample - ((from - origin) / period).round();
            let outputs = if ahead == 0.0 {
                // The sample is repeated after it has failed for another reason.
                std::mem::take(&mut own.outputs)
            } else if ahead == 1.0 {
                let inputs = ports.inputs(graph, &self.state.kinematics);
                own.unit.advance([from, period], &inputs).map_err(&fault)?
            } else {
                let cause = format!("it is at t = {from} s already, and cannot return to the sample before");
                let remedy = "start the simulation again, or restore a snapshot".to_owned();
                return Err(fault(UnitFault { cause, remedy }));
            };
            ports.set(&outputs, at).map_err(fault)?;
            (own.outputs, own.progress.reached) = (outputs, origin + sample * period);
        }
        Ok(())
    }
}
