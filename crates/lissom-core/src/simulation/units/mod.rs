//! The running units of a simulation: their start, and their states in snapshots.

mod events;
mod running;
mod samples;

use std::sync::Arc;

use super::{Simulation, SnapshotError};
use crate::errors::{InitialError, StepError};
use crate::kinematics::Kinematics;
use crate::settings::Settings;
use crate::signals::Graph;
use crate::signals::unit_ports::UnitPorts;
use crate::system::{State, System};
use crate::units::{Unit, UnitFault};
use running::Progress;
pub(crate) use running::{RunningUnit, SavedUnit};

fn initial_error(ports: &UnitPorts) -> impl Fn(UnitFault) -> InitialError {
    let unit = ports.name.clone();
    move |UnitFault { cause, remedy }| InitialError::Unit { unit: unit.clone(), cause, remedy }
}

fn step_error(ports: &UnitPorts, time: f64) -> impl Fn(UnitFault) -> StepError {
    let unit = ports.name.clone();
    move |UnitFault { cause, remedy }| StepError::Unit { time, unit: unit.clone(), cause, remedy }
}

/// Initialises the units that are sampled, or the others, with their inputs at `at`, where their outputs or states are set. Units in
/// series pass values on by one unit at a time; a contraction in a loop of feedthrough needs more passes. `settle` updates what depends
/// on the values after each pass.
///
/// # Errors
/// If a unit cannot start, its outputs are not finite, or they do not agree with its inputs.
fn begin(
    (graph, units): (&Graph, &mut [RunningUnit]),
    are_sampled: bool,
    at: &mut Kinematics,
    mut settle: impl FnMut(&mut Kinematics) -> Result<(), InitialError>,
) -> Result<(), InitialError> {
    let are_wanted = |ports: &UnitPorts| ports.sampled().is_some() == are_sampled;
    let disagreement = || {
        let (cause, remedy) = if are_sampled {
            (
                "outputs and inputs of the units at the start depend on each other, and do not agree",
                "let an input depend on a sampled signal instead of the output",
            )
        } else {
            (
                "its inputs at the start are not finite, or do not agree with its outputs",
                "check the expressions of its inputs, and its start values",
            )
        };
        UnitFault { cause: cause.to_owned(), remedy: remedy.to_owned() }
    };
    for pass in 0..100 {
        let mut agree = true;
        for (own, ports) in units.iter_mut().zip(&graph.units).filter(|(_, ports)| are_wanted(ports)) {
            let failed = initial_error(ports);
            let inputs = ports.inputs(graph, at);
            if let Some(evaluation) = own.unit.fault().filter(|found| found.fails_at.is_some()) {
                return Err(failed(evaluation.fault));
            }
            if inputs.iter().any(|input| !input.is_finite()) {
                return Err(failed(disagreement()));
            }
            if pass == 0 || inputs != own.progress.inputs {
                agree = false;
                let begun = own.unit.begin(&inputs).and_then(|values| ports.set(&values, at));
                begun.map_err(failed)?;
                own.progress.inputs = inputs;
            }
        }
        if agree {
            return Ok(());
        }
        settle(at)?;
    }
    let first = graph.units.iter().find(|ports| are_wanted(ports));
    first.map_or(Ok(()), |ports| Err(initial_error(ports)(disagreement())))
}

impl Simulation {
    /// Prepares a simulation as [`new`](Self::new) does, with units that are `started` in the order of the graph of signals.
    ///
    /// # Errors
    /// If consistent initial values do not exist, or a unit cannot start.
    pub fn with_units(
        system: Arc<System>,
        mut state: State,
        settings: Settings,
        started: impl IntoIterator<Item = Result<Arc<dyn Unit>, UnitFault>>,
    ) -> Result<Self, InitialError> {
        let at = &mut state.kinematics;
        let started = started.into_iter().zip(&system.signals().units);
        let started = started.map(|(unit, ports)| unit.map_err(initial_error(ports)));
        at.units = started.collect::<Result<_, _>>()?;
        let running = |unit| RunningUnit {
            unit,
            progress: Progress { reached: at.time, ..Progress::default() },
            outputs: Vec::new(),
            recent: (at.time, 0),
        };
        let mut units: Vec<_> = at.units.iter().cloned().map(running).collect();
        // Initial accelerations follow from the states of units, and inputs at samples from these accelerations.
        begin((system.signals(), &mut units), false, at, |_| Ok(()))?;
        events::end_initialisation(system.signals(), &mut units, at)?;
        let mut simulation = Self::new(system, state, settings)?;
        simulation.units = units;
        simulation.restart_indicators();
        simulation.begin_samples()?;
        Ok(simulation)
    }

    /// Progress and states of all units.
    pub(super) fn save_units(&self) -> Vec<SavedUnit> {
        self.units.iter().map(|own| (own.progress.clone(), own.unit.save())).collect()
    }

    /// Whether snapshots of the simulation can be restored.
    ///
    /// # Errors
    /// The first unit that cannot return its state.
    pub fn check_snapshots(&self) -> Result<(), SnapshotError> {
        self.check_saved(&self.save_units())
    }

    fn check_saved(&self, saved: &[SavedUnit]) -> Result<(), SnapshotError> {
        let units = &self.system.signals().units;
        let mut unsaved = units.iter().zip(saved).filter(|(_, (_, state))| state.is_none());
        unsaved.next().map_or(Ok(()), |(ports, _)| Err(SnapshotError::Unit { unit: ports.name.clone() }))
    }

    /// Returns the units to what was saved.
    pub(super) fn restore_units(&mut self, saved: &[SavedUnit]) -> Result<(), SnapshotError> {
        let all = &self.system.signals().units;
        if self.units.len() != saved.len() {
            let unit = all.first().map(|ports| ports.name.clone()).unwrap_or_default();
            return Err(SnapshotError::Unit { unit });
        }
        self.check_saved(saved)?;
        for ((own, ports), (progress, state)) in self.units.iter_mut().zip(all).zip(saved) {
            own.unit.restore(state.as_deref().unwrap_or_default()).map_err(|fault| {
                SnapshotError::UnitRestore { unit: ports.name.clone(), reason: fault.cause }
            })?;
            own.progress.clone_from(progress);
            own.outputs.clear();
        }
        Ok(())
    }
}
