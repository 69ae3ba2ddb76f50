//! All codes of warnings and failures of the core, for the manual and `lissom explain`.

use crate::assembly::AssemblyError;
use crate::diagnostics::Entry;
use crate::errors::Warning;
use crate::errors::{InitialError, StepError};
use crate::linearized::{
    BucklingError, LinearError, ModeError, ReductionError, ResponseError, StateSpaceError, SteadyError,
};
use crate::path::PathError;
use crate::signals::failure;
use crate::simulation::InputError;
use crate::simulation::SnapshotError;
use crate::simulation::joint_space::JointSpaceError;

/// Their entries: warnings, then failures.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    let of_motions = StepError::ENTRIES.iter().chain(InitialError::ENTRIES).chain(InputError::ENTRIES);
    Warning::ENTRIES.iter().chain(of_motions).chain([&failure::ENTRY]).chain(of_analyses())
}

/// Entries of assembly, paths, linear models and snapshots, which do not concern a motion.
pub(crate) fn of_analyses() -> impl Iterator<Item = &'static Entry> {
    let parts = [
        AssemblyError::ENTRIES,
        JointSpaceError::ENTRIES,
        PathError::ENTRIES,
        LinearError::ENTRIES,
        ModeError::ENTRIES,
        SteadyError::ENTRIES,
        BucklingError::ENTRIES,
        ReductionError::ENTRIES,
        ResponseError::ENTRIES,
        StateSpaceError::ENTRIES,
        SnapshotError::ENTRIES,
    ];
    parts.into_iter().flatten()
}
