//! Joints, couplings and drives.

mod couplings;
mod driven_records;
mod gears;
mod generalized_coordinates;
mod joint_space;
mod kinds;
mod latches;
mod rates;
mod redundant;
mod singular_position;
mod slider;
