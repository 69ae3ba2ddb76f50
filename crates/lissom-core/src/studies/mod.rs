//! Studies of a model beside its motion.

pub mod factorization;
pub mod joint_space;
