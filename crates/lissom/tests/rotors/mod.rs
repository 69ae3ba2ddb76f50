//! Rotors: bearings, whirl and critical speeds.

mod bearings;
mod campbell;
mod multiblade;
mod shaft;
