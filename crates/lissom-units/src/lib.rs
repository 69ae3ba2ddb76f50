//! Functional mock-up units (FMI 2.0 and 3.0) of other programs. A unit is loaded by a process of its own,
//! [`serve`], so that a unit that crashes does not end the simulation; [`Request`] and [`Reply`] are the messages between them.

mod ffi;
mod host;
mod messages;

pub use ffi::end_group;
pub use host::serve;
pub use messages::{
    Answer, Equations, Group, Opening, Point, Reply, Request, Standard, Variable, VariableType, receive, send,
};
