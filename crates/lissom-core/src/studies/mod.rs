//! Studies of a model other than its motion.

pub mod factorization;
pub mod joint_space;
