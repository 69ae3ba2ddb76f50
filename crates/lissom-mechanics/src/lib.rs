//! Mechanics of flexible multibody systems in SI: kinematics, elements, joints, wheels and signals. Independent of system
//! and scheme; it receives a step only as durations between stages (`kinematics::step_stages`).
//!
//! This crate opens no file, prints nothing and reads no clock.

pub mod compliance;
pub mod diagnostics;
pub mod dual;
pub mod elements;
pub mod evaluation;
pub mod instants;
pub mod joints;
pub mod kinematics;
pub mod law;
pub mod number;
pub mod ports;
pub mod registry;
pub mod relation;
pub mod round_off;
pub mod signals;
pub mod units;
pub mod wheels;
