//! What a recovery matrix makes of the deformation of a superelement.

use std::sync::Arc;

use lissom_core::elements::superelement::Deformation;
use lissom_core::kinematics::{CoordinateId, Quantity};
use lissom_core::system::System;
use nalgebra::{DMatrix, DVector};

use super::differences::Touched;
use super::frames::name_of;
use super::modal::deformed;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, Subjects, WITHOUT_GRADIENT};
use crate::document::{Declaration, Feature, Output, Subject};
use crate::lower::Deformed;
use crate::report::Problem;

/// Registry entry.
pub(crate) const RECOVERED: Declaration = Declaration {
    word: "recovered",
    summary: "Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.",
    subject: Subject::Superelement,
    features: &[Feature::Fatigue],
    components: &[],
    build: Build::System(WITHOUT_GRADIENT, |output, _, subjects| quantity(output, subjects)),
};
/// A matrix times the unknowns of a superelement.
struct Recovered {
    unknowns: Arc<Deformation>,
    matrix: Arc<DMatrix<f64>>,
}

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let Deformed { unknowns, recovery } = deformed(name, subjects.names)?;
    let matrix = recovery.clone().ok_or_else(|| {
        Problem::error(name.span, format!("the superelement `{}` has no `recovery`", name.value))
            .help("name the file of a matrix there: a row for each output, a column for each row of its mass")
    })?;
    Ok(Arc::new(Recovered { unknowns: Arc::clone(unknowns), matrix }))
}

impl OutputQuantity for Recovered {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        Some((1..=self.matrix.nrows()).map(|k| (format!("r{k}"), "")).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let unknowns = DVector::from_vec(self.unknowns.unknowns(at.motion()));
        out.extend((&*self.matrix * unknowns).iter());
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let nodes = self.unknowns.nodes().iter().copied().collect();
        Some(Touched { nodes, coordinates: self.unknowns.coordinates().collect(), ..Touched::default() })
    }
}
