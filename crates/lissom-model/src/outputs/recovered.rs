//! What a recovery matrix makes of the deformation of a superelement.

use std::sync::Arc;

use lissom_flexible::superelement::Deformation;
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, LOCKED, NodeId, Quantity, USUAL_UNKNOWNS};
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};
use lissom_system::OutputDerivatives;
use nalgebra::{DMatrix, DVector, RowDVector};

use super::Deformed;
use super::derivatives::add;
use super::frames::name_of;
use super::modal::deformed;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const RECOVERED: Declaration = Declaration {
    word: "recovered",
    summary: "Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.",
    subject: Subject::Superelement,
    features: &[Feature::Fatigue],
    components: &[],
    build: Build::Motion(quantity),
};
/// A matrix times the unknowns of a superelement.
struct Recovered {
    unknowns: Arc<Deformation>,
    matrix: Arc<DMatrix<f64>>,
    /// Each number by itself, where a gradient has room for the unknowns.
    rows: Vec<Arc<dyn Measurement>>,
}

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let Deformed { unknowns, recovery } = deformed(name, subjects.names)?;
    let matrix = recovery.clone().ok_or_else(|| {
        Problem::error(name.span, format!("the superelement `{}` has no `recovery`", name.value))
            .help("name the file of a matrix there: a row for each output, a column for each row of its mass")
    })?;
    let row = |index: usize| -> Arc<dyn Measurement> {
        let coordinates = unknowns.coordinates().collect();
        Arc::new(Row { unknowns: Arc::clone(unknowns), coordinates, matrix: Arc::clone(&matrix), index })
    };
    let count = if unknowns.size() <= USUAL_UNKNOWNS { matrix.nrows() } else { 0 };
    let rows = (0..count).map(row).collect();
    Ok(Arc::new(Recovered { unknowns: Arc::clone(unknowns), matrix, rows }))
}

fn recovered(unknowns: &Deformation, matrix: &DMatrix<f64>, at: &Kinematics) -> DVector<f64> {
    matrix * DVector::from_vec(unknowns.unknowns(at))
}

impl OutputQuantity for Recovered {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        Some((1..=self.matrix.nrows()).map(|k| (format!("r{k}"), "")).collect())
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.extend(recovered(&self.unknowns, &self.matrix, at.motion()).iter());
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let layout = at.system.layout();
        let nodes = self.unknowns.nodes().iter().flat_map(|&node| layout.rows_of_node(node).iter().copied());
        let coordinates = self.unknowns.coordinates().map(|own| layout.row_of_coordinate(own) as u32);
        let rows: Vec<u32> = nodes.chain(coordinates).collect();
        let gradient = &*self.matrix * self.unknowns.gradient(at.motion());
        let of = |row: RowDVector<f64>| {
            let mut own = OutputDerivatives::default();
            let free = rows.iter().zip(&row).filter(|(row, _)| **row != LOCKED);
            free.for_each(|(&row, &value)| add(&mut own.by_place, row as usize, value));
            own
        };
        Some(gradient.row_iter().map(|row| of(row.into_owned())).collect())
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        &self.rows
    }
}

/// A row of a matrix times the unknowns of a superelement with few unknowns.
struct Row {
    unknowns: Arc<Deformation>,
    coordinates: Vec<CoordinateId>,
    matrix: Arc<DMatrix<f64>>,
    index: usize,
}

impl Measurement for Row {
    fn nodes(&self) -> &[NodeId] {
        self.unknowns.nodes()
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinates
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let mut values = [0.0; MAX_COMPONENTS];
        // As it is recorded, to the last bit.
        values[0] = recovered(&self.unknowns, &self.matrix, at)[self.index];
        values
    }

    fn gradient(&self, _: usize, at: &Kinematics) -> Gradient {
        let row = self.matrix.row(self.index) * self.unknowns.gradient(at);
        let mut gradient = Gradient::zero();
        gradient.by_place[..row.len()].copy_from_slice(row.as_slice());
        gradient
    }
}
