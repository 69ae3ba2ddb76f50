//! Contacts of parts, wheels and beams.

mod benchmarks;
mod between_parts;
mod many_parts;
mod of_beams;
mod rigid;
mod rolling;
mod shapes;
mod wheelset;
