//! The shared library of functional mock-up units (FMI 3.0, co-simulation) that `lissom fmu` packs with a model: reads the model
//! from the unit's resources and takes it on from communication point to communication point. No mechanics is done here.

mod ffi;
mod instance;
