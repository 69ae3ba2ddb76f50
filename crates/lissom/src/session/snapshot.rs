//! A session between two steps, kept and given back.

use std::io;

use lissom_core::stepping::{Snapshot, SnapshotError};
use lissom_model::sweep::Accumulator;
use serde::{Deserialize, Serialize};

use super::Session;
use crate::report::EnergyChange;
use crate::schedule::Schedule;
use crate::sealed;
use crate::telemetry::Telemetry;

/// Where a run leaves snapshots.
pub trait Checkpoints {
    /// Whether any are wanted.
    fn are_wanted(&self) -> bool;

    /// Whether one is due after so many steps.
    fn is_due(&mut self, steps: usize) -> bool;

    /// Keeps one. All rows that were recorded before it have been written.
    ///
    /// # Errors
    /// If it cannot be kept.
    fn keep(&mut self, snapshot: &SessionSnapshot) -> io::Result<()>;
}

/// None.
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
    histories: Vec<Accumulator>,
}

impl SessionSnapshot {
    /// As bytes, to be kept or sent.
    ///
    /// # Panics
    /// Never: plain numbers can always be written to memory.
    pub fn to_bytes(&self) -> Vec<u8> {
        sealed::to_bytes(self).expect("plain numbers can always be written to memory")
    }

    /// From what [`to_bytes`](Self::to_bytes) gave.
    ///
    /// # Errors
    /// If the bytes are no snapshot of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        sealed::from_bytes(bytes).ok_or(SnapshotError::Damaged)
    }
}

impl Session {
    /// Where the session is, with all that is needed to go on from there to the last bit.
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

    /// Goes back, or on, to where a snapshot of this model was taken.
    ///
    /// # Errors
    /// If it was taken of another model, or by another version of the program. The session is then as it was.
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
