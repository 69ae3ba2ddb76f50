//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod assembly;
mod beams;
mod contacts;
mod gradient;
mod joints;
mod machines;
mod models;
mod paths;
mod peers;
mod published;
mod rotors;
mod schemes;
mod sessions;
mod shells;
mod signals;
mod solids;
mod springs;
mod statics;
mod study;
mod superelements;
mod support;
mod temperature;
mod units;
mod vibrations;
