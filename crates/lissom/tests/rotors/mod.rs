//! Rotors: bearings, whirl and critical speeds.

mod averaged;
mod bearings;
mod campbell;
mod multiblade;
mod shaft;
mod still_axes;
