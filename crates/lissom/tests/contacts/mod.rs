//! Contacts of parts, wheels and beams.

mod benchmarks;
mod between_parts;
mod impacts_of_many;
mod many_parts;
mod of_beams;
mod planned_steps;
mod registry;
mod rigid;
mod rolling;
mod shapes;
mod stacks;
mod surfaces;
mod wheelset;
