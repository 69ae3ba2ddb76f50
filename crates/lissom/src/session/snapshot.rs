//! Storage and restoration of a session between two steps.

use std::io;

use lissom_core::simulation::{Snapshot, SnapshotError};
use lissom_model::sweep::WindowedHistory;
use serde::{Deserialize, Serialize};

use super::Session;
use crate::encodings::sealed;
use crate::run::report::EnergyChange;
use crate::run::schedule::Schedule;
use crate::run::telemetry::Telemetry;

/// Receives snapshots of a run.
pub trait Checkpoints {
    /// Whether snapshots are required.
    fn are_wanted(&self) -> bool;

    /// Whether one is due after this number of steps.
    fn is_due(&mut self, steps: usize) -> bool;

    /// Stores one. All earlier records have been written.
    ///
    /// # Errors
    /// If it cannot be stored.
    fn keep(&mut self, snapshot: &SessionSnapshot) -> io::Result<()>;
}

/// Stores no snapshots.
pub(super) struct NoCheckpoints;

impl Checkpoints for NoCheckpoints {
    fn are_wanted(&self) -> bool {
        false
    }
    fn is_due(&mut self, _: usize) -> bool {
        false
    }
    fn keep(&mut self, _: &SessionSnapshot) -> io::Result<()> {
        Ok(())
    }
}

/// A session between two steps. Serialises with serde.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SessionSnapshot {
    simulation: Snapshot,
    schedule: Schedule,
    records: usize,
    violation: f64,
    energy: EnergyChange,
    telemetry: Telemetry,
    histories: Vec<WindowedHistory>,
}

impl SessionSnapshot {
    /// As bytes, for storage or transfer.
    ///
    /// # Panics
    /// Never: plain numbers can be serialised to memory.
    pub fn to_bytes(&self) -> Vec<u8> {
        sealed::to_bytes(self).expect("plain numbers can always be written to memory")
    }

    /// From the result of [`to_bytes`](Self::to_bytes).
    ///
    /// # Errors
    /// If the bytes are not a snapshot of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        sealed::from_bytes(bytes).ok_or(SnapshotError::Damaged {})
    }
}

impl Session {
    /// The state of the session, with all data needed to continue from there to the last bit.
    pub fn snapshot(&self) -> SessionSnapshot {
        SessionSnapshot {
            simulation: self.simulation.snapshot(),
            schedule: self.schedule.clone(),
            records: self.tally.records,
            violation: self.tally.violation,
            energy: self.tally.energy,
            telemetry: self.telemetry.clone(),
            histories: self.tally.histories.clone(),
        }
    }

    /// Returns, or advances, to the state of a snapshot of this model.
    ///
    /// # Errors
    /// If it was taken of another model, or by another version of the program. The session is then unchanged.
    pub fn restore(&mut self, from: &SessionSnapshot) -> Result<(), SnapshotError> {
        self.simulation.restore(&from.simulation)?;
        self.schedule.clone_from(&from.schedule);
        (self.tally.records, self.tally.violation) = (from.records, from.violation);
        self.tally.energy = from.energy;
        self.tally.histories.clone_from(&from.histories);
        self.telemetry.clone_from(&from.telemetry);
        Ok(())
    }
}
