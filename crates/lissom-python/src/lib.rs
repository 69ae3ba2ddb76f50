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

use pyo3::prelude::*;

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
    Ok(())
}
