//! The shared library of functional mock-up units (FMI 3.0, co-simulation) that `lissom fmu` packs with a model: reads the model
//! from the unit's resources and advances it from communication point to communication point.

mod ffi;
mod instance;
