//! Schemes, and what determines their steps.

mod controlled_forces;
mod several_stages;
mod solver_features;
mod starts;
