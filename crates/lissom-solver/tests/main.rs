//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod breakdown;
mod exactness;
mod orderings;
mod saddle_points;
mod samples;
mod symmetric;
mod threads;
