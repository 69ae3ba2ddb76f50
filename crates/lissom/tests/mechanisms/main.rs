//! Mechanisms against closed forms and other programs.

mod import;
mod prescribed_motion;
mod rolling;
#[path = "../support/runs.rs"]
mod runs;
