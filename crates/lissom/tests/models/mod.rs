//! Model files from their text to the motion.

#[path = "../../../lissom-model/tests/support/damage.rs"]
mod damage;
mod energy;
mod fuzz_check;
mod multiplier_order;
mod outputs;
mod part_axes;
mod plausibility;
mod step_control;
mod tip_crank;
