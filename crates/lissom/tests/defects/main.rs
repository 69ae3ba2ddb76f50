//! Models that once gave a wrong result with exit code 0 and no warning, or were rejected without reason, and models of the same
//! kinds: against closed forms, independent programs and refined runs.

#[path = "../support/refused.rs"]
mod refused;
#[path = "../support/sessions.rs"]
mod sessions;

mod analyses;
mod clocks;
mod jumps;
mod loops;
