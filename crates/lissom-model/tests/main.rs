//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod document;
mod energy;
mod fuzz;
mod fuzz_check;
mod multiplier_order;
mod part_axes;
mod parts;
mod step_control;
mod support;
mod tip_crank;
