//! What a run consists of besides its session: schedule, receivers of states, report, durations and telemetry.

pub(crate) mod report;
pub(crate) mod results;
pub(crate) mod schedule;
pub(crate) mod state_writer;
pub mod telemetry;
pub(crate) mod timings;
