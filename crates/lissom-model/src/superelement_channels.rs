//! Outputs of superelements: modal coordinates, and what a recovery matrix makes of their unknowns.

use std::sync::Arc;

use lissom_core::elements::superelement::Deformation;
use lissom_core::kinematics::Kinematics;
use nalgebra::{DMatrix, DVector};

use crate::channels::{Resolver, Source};
use crate::document::OutputKind;
use crate::lower::Deformed;
use crate::report::{Located, Problem};

/// A matrix times the unknowns of a superelement.
pub(crate) fn recovered(unknowns: &Deformation, matrix: &DMatrix<f64>, at: &Kinematics) -> DVector<f64> {
    matrix * DVector::from_vec(unknowns.unknowns(at))
}

/// Modal coordinates of a superelement, or what its matrix makes of its unknowns.
pub(crate) fn source(
    kind: OutputKind,
    name: &Located<String>,
    names: &Resolver<'_>,
) -> Result<Source, Problem> {
    let unknown = || Problem::error(name.span, format!("there is no superelement called `{}`", name.value));
    let Deformed { unknowns, recovery } = names.deformations.get(&name.value).ok_or_else(unknown)?;
    if kind == OutputKind::Recovered {
        let matrix = recovery.clone().ok_or_else(|| {
            Problem::error(name.span, format!("the superelement `{}` has no `recovery`", name.value)).help(
                "name the file of a matrix there: a row for each output, a column for each row of its mass",
            )
        })?;
        return Ok(Source::Recovered(Arc::clone(unknowns), matrix));
    }
    if unknowns.coordinates().len() == 0 {
        let message = format!("the superelement `{}` has no modal coordinates to record", name.value);
        return Err(Problem::error(name.span, message).help("reduce it with modes, or leave this output out"));
    }
    Ok(Source::Modal(Arc::clone(unknowns)))
}
