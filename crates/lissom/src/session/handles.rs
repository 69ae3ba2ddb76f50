//! A session of a model that was built in code: access by ids of the builder, and copies of it.

use lissom_core::diagnostics::Diagnose;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use lissom_core::simulation::InputError;
use lissom_core::simulation::SnapshotError;
use lissom_core::system::State;

use super::{Observed, Session};
use crate::ids::{ForeignId, IdNames, InputId, OutputId, Quantity};
use crate::run::timings::Timings;

/// Why an id cannot be read or set.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum ReadError {
    /// The model was read from a text: its parts have no ids.
    NotBuilt,
    /// The id belongs to another model.
    Foreign(#[from] ForeignId),
    /// An override has removed the output.
    NotRecorded(String),
    /// The input cannot be set.
    Input(#[from] InputError),
}

impl Session {
    fn ids(&self) -> Result<&IdNames, ReadError> {
        self.ids.as_deref().ok_or(ReadError::NotBuilt)
    }

    pub(crate) fn with_ids(self, ids: Option<Arc<IdNames>>) -> Self {
        Self { ids, ..self }
    }

    /// The present positions, velocities, accelerations and multipliers. To start a session from a state, use
    /// [`Prepared::session_from`](crate::Prepared::session_from).
    pub fn state(&self) -> &State {
        self.simulation.state()
    }

    /// The present components of an output, in the order of its columns [SI]. They are stored in the session until the next
    /// call, which does not allocate.
    ///
    /// # Errors
    /// If the output belongs to another model.
    pub fn output(&mut self, output: OutputId) -> Result<&[f64], ReadError> {
        let mut values = std::mem::take(&mut self.read);
        values.clear();
        let name = self.ids()?.name(output)?;
        let channel = self.observed.channels().iter().find(|channel| channel.name == name);
        self.values_of(channel.ok_or_else(|| ReadError::NotRecorded(name.to_owned()))?, &mut values);
        self.read = values;
        Ok(&self.read)
    }

    /// Indices of the components of an output in the [`columns`](Self::columns) and in records.
    ///
    /// # Errors
    /// If the output belongs to another model.
    pub fn columns_of(&self, output: OutputId) -> Result<Range<usize>, ReadError> {
        let name = self.ids()?.name(output)?;
        let is_own = |column: &crate::Column| column.output == name;
        let first = self.columns.iter().position(is_own);
        let first = first.ok_or_else(|| ReadError::NotRecorded(name.to_owned()))?;
        Ok(first..first + self.columns.iter().filter(|column| is_own(column)).count())
    }

    /// The present value of a signal, an input or a state.
    ///
    /// # Errors
    /// If it belongs to another model.
    pub fn quantity(&self, quantity: impl Into<Quantity>) -> Result<f64, ReadError> {
        let id = quantity.into().0;
        self.value(self.ids()?.name(id)?).ok_or_else(|| id.foreign().into())
    }

    /// Sets an input from now on, until it is set again.
    ///
    /// # Errors
    /// If it belongs to another model, if the value is not finite, or no motion is consistent with it.
    pub fn set(&mut self, input: InputId, value: f64) -> Result<(), ReadError> {
        let name = self.ids()?.name(input)?.to_owned();
        Ok(self.set_input(&name, value)?)
    }

    /// A second session in the same state, which continues from there to the same bits. It shares the system, and
    /// writes no states.
    ///
    /// # Errors
    /// If the tangent in use cannot be factorised again.
    pub fn try_clone(&self) -> Result<Self, SnapshotError> {
        let simulation = self.simulation.try_clone()?;
        Ok(Self {
            observed: Observed::new(&simulation, self.observed.channels().to_vec()),
            simulation,
            columns: self.columns.clone(),
            signals: self.signals.clone(),
            between: self.between.clone(),
            schedule: self.schedule.clone(),
            statistics_window: self.statistics_window.clone(),
            tally: self.tally.clone(),
            timings: Timings::new(),
            scale: self.scale,
            telemetry: self.telemetry.clone(),
            read: Vec::new(),
            state_writers: Vec::new(),
            warnings: self.warnings.clone(),
            ids: self.ids.clone(),
            began: Instant::now(),
        })
    }
}
