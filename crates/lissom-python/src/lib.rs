//! The compiled part of the Python package `lissom`. The package itself, in `python/`, contains what users see; the
//! classes and functions that it uses are here.

mod analyses;
mod animation;
mod batch;
mod cached_session;
mod errors;
mod joints;
mod model;
mod model_methods;
mod pictures;
mod results;
mod simulation;
mod sweep;
mod watch;

use std::path::PathBuf;

use lissom::units;
use pyo3::prelude::*;

/// Serves a unit of another program in this process, until the simulation that started it has no more requests.
#[pyfunction]
fn serve_unit(py: Python<'_>) -> PyResult<()> {
    // Units that contain Python need the interpreter.
    Ok(py.detach(units::serve)?)
}

/// Sets the command that starts a process for a unit.
#[pyfunction]
fn set_unit_host(program: PathBuf, arguments: Vec<String>) {
    units::set_host(program, arguments);
}

/// The compiled part of the package.
#[pymodule]
fn _lissom(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", lissom::VERSION)?;
    errors::add_to(module)?;
    module.add_class::<model::NativeModel>()?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<batch::Batch>()?;
    module.add_class::<sweep::NativeSweep>()?;
    module.add_function(wrap_pyfunction!(analyses::analyse, module)?)?;
    module.add_function(wrap_pyfunction!(analyses::path, module)?)?;
    module.add_function(wrap_pyfunction!(animation::animation, module)?)?;
    module.add_function(wrap_pyfunction!(animation::modes_animation, module)?)?;
    module.add_function(wrap_pyfunction!(animation::folder_animation, module)?)?;
    module.add_function(wrap_pyfunction!(results::column_position, module)?)?;
    module.add_function(wrap_pyfunction!(results::read_folder, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::statistics, module)?)?;
    module.add_function(wrap_pyfunction!(serve_unit, module)?)?;
    module.add_function(wrap_pyfunction!(set_unit_host, module)?)?;
    Ok(())
}
