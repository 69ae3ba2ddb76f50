//! Models that once gave a wrong result with exit code 0 and no warning, or were rejected without reason, and models of the same
//! kinds: against closed forms, independent programs and refined runs. `ordinary`, `rows` and `superelements` run the program on every model of
//! `models/`; the other modules test variations.

mod analyses;
mod at_rest;
mod clocks;
mod jumps;
mod loops;
mod ordinary;
mod redundant_loops;
mod results;
mod rows;
mod superelements;
