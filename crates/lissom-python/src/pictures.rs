//! Pictures of simulations as arrays.

use lissom::pictures::picture::{Framing, View};
use lissom_model::output::Image;
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Maximum width and height [pixels].
const MAX_SIDE: u32 = 4096;

/// What Python calls the frame of a picture: size, view, center and extent.
pub(crate) type Wanted = ([u32; 2], String, Option<[f64; 3]>, Option<f64>);

/// The frame of a picture, if it is valid.
pub(crate) fn framing((size, view, center, extent): Wanted) -> PyResult<Framing> {
    let view = match &*view {
        "chosen" => View::Chosen,
        "oblique" => View::Oblique,
        "front" => View::Front,
        "side" => View::Side,
        "top" => View::Top,
        other => {
            let known = "`chosen`, `oblique`, `front`, `side` and `top`";
            return Err(PyValueError::new_err(format!("there is no view `{other}`; the views are {known}")));
        }
    };
    if size.iter().any(|side| !(1..=MAX_SIDE).contains(side)) {
        let message = format!("the sides of a picture must be from 1 to {MAX_SIDE} pixels, not {size:?}");
        return Err(PyValueError::new_err(message));
    }
    if center.is_some_and(|center| center.iter().any(|x| !x.is_finite())) {
        return Err(PyValueError::new_err("the center of a picture must be finite"));
    }
    if extent.is_some_and(|extent| !(extent > 0.0 && extent.is_finite())) {
        return Err(PyValueError::new_err("the extent of a picture must be greater than zero and finite"));
    }
    Ok(Framing { view, size, center: center.map(Into::into), extent })
}

/// An array of shape (height, width, 3).
pub(crate) fn array(py: Python<'_>, image: Image) -> PyResult<Bound<'_, PyArray3<u8>>> {
    let [width, height] = image.size.map(|side| side as usize);
    PyArray1::from_vec(py, image.pixels.into_flattened()).reshape([height, width, 3])
}
