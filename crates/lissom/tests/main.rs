//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod assembly;
mod beams;
#[cfg(feature = "command-line")]
mod command_line;
mod contacts;
#[cfg(feature = "command-line")]
mod defects;
mod gradient;
mod joints;
mod machines;
mod models;
mod paths;
mod peers;
mod published;
#[cfg(feature = "command-line")]
mod resume;
mod rotors;
mod schemes;
mod sessions;
mod signals;
mod springs;
mod statics;
mod study;
mod superelements;
mod support;
mod units;
mod vibrations;
