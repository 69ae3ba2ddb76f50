//! Stiffness and damping matrices of a bearing, which may be unsymmetric and depend on the speed.

use std::sync::Arc;

use nalgebra::{DMatrix, Matrix5, Vector5};

use super::{BearingLaw, Response, ShaftMotion, contribution};
use crate::elements::bushing::{AXIS, SECOND_AXIS, axes};
use crate::elements::contribution::Contribution;
use crate::elements::initial_model::InitialModel;
use crate::elements::kind::{Attached, ElementKind};
use crate::ports::Ports;
use crate::registry::{Function, Parameter, ParameterError, ParameterType, Parameters, optional};

/// Registry entry.
pub(crate) const KIND: ElementKind = ElementKind {
    name: "bearing",
    summary: "Bearing of a rotating shaft: stiffness and damping matrices, which may be unsymmetric and depend on the speed.",
    sample: "stiffness = [[1e6, 2e5], [-2e5, 1e6]]",
    parameters: &[
        optional(
            "stiffness",
            ParameterType::SquareMatrix,
            "N/m, N, N m/rad",
            "For displacements across the shaft (2 x 2), along it and across (3 x 3), across with rotations about both axes (4 x 4), or all \
            (5 x 5); a number is for both directions across.",
        ).or_number(0.0),
        optional(
            "damping",
            ParameterType::SquareMatrix,
            "N s/m, N s, N m s/rad",
            "As `stiffness`.",
        ).or_number(0.0),
        coefficient(
            "k22",
            "N/m",
            "Stiffness over `speed` [rad/s], added to `stiffness`: force along axis 2 per displacement along it.",
        ),
        coefficient("k23", "N/m", "The same for a displacement along axis 3."),
        coefficient("k32", "N/m", "Force along axis 3 per displacement along axis 2."),
        coefficient("k33", "N/m", "The same for a displacement along axis 3."),
        coefficient("c22", "N s/m", "Damping over `speed` [rad/s], added to `damping`, as `k22`."),
        coefficient("c23", "N s/m", "As `k23`."),
        coefficient("c32", "N s/m", "As `k32`."),
        coefficient("c33", "N s/m", "As `k33`."),
        AXIS,
        SECOND_AXIS,
    ],
    ports: Ports::TWO_FRAMES,
    build,
};

const fn coefficient(name: &'static str, unit: &'static str, summary: &'static str) -> Parameter {
    optional(name, ParameterType::FunctionOf("speed"), unit, summary)
}

/// Names of the coefficients over the speed.
const OVER_SPEED: [[&str; 4]; 2] = [["k22", "k23", "k32", "k33"], ["c22", "c23", "c32", "c33"]];
/// Rows and columns of matrices of size 2 to 5.
const SLOTS: [&[usize]; 4] = [&[1, 2], &[0, 1, 2], &[1, 2, 3, 4], &[0, 1, 2, 3, 4]];

/// f = (K + K(s)) q + (C + C(s)) q̇.
#[derive(Debug)]
struct Matrices {
    /// K and C.
    constant: [Matrix5<f64>; 2],
    /// Coefficients over the speed across the shaft by rows, of K and C.
    over_speed: [[Option<Function>; 4]; 2],
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let over_speed = OVER_SPEED
        .map(|names| names.map(|name| parameters.has(name).then(|| parameters.function(name)).transpose()));
    let constant = [matrix(parameters, "stiffness")?, matrix(parameters, "damping")?];
    let mut law = Matrices { constant, over_speed: Default::default() };
    for (own, read) in law.over_speed.iter_mut().flatten().zip(over_speed.into_iter().flatten()) {
        *own = read?;
    }
    contribution(model, attached, axes(parameters)?, (Arc::new(law), None))
}

fn matrix(parameters: &Parameters, key: &'static str) -> Result<Matrix5<f64>, ParameterError> {
    let mut out = Matrix5::zeros();
    if !parameters.has(key) {
        return Ok(out);
    }
    let given = parameters.square_matrix(key)?;
    let both = DMatrix::from_diagonal_element(2, 2, given[(0, 0)]);
    let given = if given.nrows() == 1 { &both } else { given };
    let Some(slots) = SLOTS.iter().find(|slots| slots.len() == given.nrows()) else {
        let problem = format!("must have 2 to 5 rows, not {}", given.nrows());
        return Err(ParameterError::new(key, problem));
    };
    for (i, &row) in slots.iter().enumerate() {
        for (j, &column) in slots.iter().enumerate() {
            out[(row, column)] = given[(i, j)];
        }
    }
    Ok(out)
}

impl BearingLaw for Matrices {
    fn response(&self, motion: &ShaftMotion) -> Response {
        let [mut by_q, mut by_rate] = self.constant;
        let mut by_speed = Vector5::zeros();
        let matrices = [(&mut by_q, &motion.q), (&mut by_rate, &motion.rate)];
        for ((matrix, argument), functions) in matrices.into_iter().zip(&self.over_speed) {
            for (slot, function) in functions.iter().enumerate() {
                if let Some(function) = function {
                    let (row, column) = (1 + slot / 2, 1 + slot % 2);
                    let [value, slope, _] = function.jet(motion.speed);
                    matrix[(row, column)] += value;
                    by_speed[row] += slope * argument[column];
                }
            }
        }
        Response { force: by_q * motion.q + by_rate * motion.rate, by_q, by_rate, by_speed }
    }
}
