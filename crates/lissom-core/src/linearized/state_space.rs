//! The linear model as first-order equations in as many states as it has degrees of freedom,
//!
//! ```text
//! ẋ = A x + B u,    y = C x + D u
//! ```
//!
//! for models small enough for full matrices. A choice of independent coordinates z, by elimination of the constraints with
//! pivoting, gives η = T z; x = (z, first-order states, ż). Multipliers follow from the rows of the dependent coordinates.

use lissom_solver::Pattern;
use nalgebra::{ColPivQR, DMatrix, Dyn, LU};

use super::model::LinearModel;
use super::output::OutputDerivatives;
use crate::diagnostics::diagnostics;
use crate::kinematics::{Quantity, Subject};
use crate::round_off;

/// Maximum number of coordinates of a model with full matrices.
const MAX_COORDINATES: usize = 600;
/// Ratio of pivots of the reduced mass matrix below which degrees of freedom have no mass.
const SINGULAR: f64 = 1e-13;

/// Matrices of first-order equations.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSpace {
    /// A.
    pub a: DMatrix<f64>,
    /// B, a column for each input.
    pub b: DMatrix<f64>,
    /// C, a row for each output.
    pub c: DMatrix<f64>,
    /// D.
    pub d: DMatrix<f64>,
    /// Names of the states: an unknown, or its rate.
    pub states: Vec<String>,
}

diagnostics! {
    /// First-order equations that do not exist.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure StateSpaceError {
        /// Too many coordinates.
        TooLarge {
            /// Their number.
            coordinates: usize,
        } => "state-space-too-large" {
            cause: ("the model has {coordinates} coordinates: full matrices are formed of at most {MAX_COORDINATES}"),
            remedy: "use the sparse matrices of second order",
            meaning: "Full matrices of first-order equations are formed of small models only.",
        }
        /// Inputs act on constraints.
        PrescribedInput {} => "state-space-prescribed-input" {
            cause: ("an input is a prescribed motion, whose velocity and acceleration would be inputs as well"),
            remedy: "use a load as input",
            meaning: "A prescribed motion is no input of first-order equations, because they contain its velocity and acceleration, too.",
        }
        /// Some degrees of freedom have no mass.
        Massless {} => "state-space-massless" {
            cause: ("degrees of freedom without mass remain, whose velocities are no states"),
            remedy: "specify the mass of all degrees of freedom",
            meaning: "The velocities of degrees of freedom without mass are no states.",
        }
        /// Forces depend on normal forces.
        NormalForces {} => "state-space-normal-forces" {
            cause: ("creep forces of wheels on rails depend on the normal forces, which are not among the states of first-order equations"),
            remedy: "use `lissom modes` or `lissom response`, which support them",
            meaning: "Creep forces depend on normal forces, which are not among the states of first-order equations.",
        }
        /// Constraints between velocities.
        VelocityConstraint {
            /// The constraint.
            constraint: Subject,
        } => "state-space-velocity-constraint" {
            subject: constraint,
            cause: ("{constraint}, a constraint between velocities, is not part of first-order equations in independent coordinates"),
            remedy: "use `lissom modes` or `lissom response`, which support it",
            meaning: "First-order equations in independent coordinates do not contain constraints between velocities.",
        }
        /// A reaction that is recorded is not unique.
        Redundant {} => "state-space-redundant" {
            cause: ("a reaction among the outputs is not unique, because constraints are redundant"),
            remedy: "remove the redundant constraint, or the output",
            meaning: "A reaction among the outputs is not unique, because constraints are redundant.",
        }
    }
}

impl LinearModel<'_> {
    /// First-order equations with these right-hand sides as inputs, by row, and these outputs with the direct derivative of
    /// each with respect to each input.
    ///
    /// # Errors
    /// If there are none, or they would be too large.
    pub fn state_space(
        &self,
        inputs: &[Vec<f64>],
        outputs: &[(OutputDerivatives, Vec<f64>)],
    ) -> Result<StateSpace, StateSpaceError> {
        let count = self.coordinate_count();
        if count > MAX_COORDINATES {
            return Err(StateSpaceError::TooLarge { coordinates: count });
        }
        if inputs.iter().any(|input| input[count..].iter().any(|&value| value != 0.0)) {
            return Err(StateSpaceError::PrescribedInput {});
        }
        if self.system.sees_multipliers() {
            return Err(StateSpaceError::NormalForces {});
        }
        if let Some(row) = self.moving_velocity_rows().next() {
            return Err(StateSpaceError::VelocityConstraint {
                constraint: self.system.layout().subject_of(row),
            });
        }
        let reduced = self.reduced(inputs)?;
        reduced.with_outputs(self, outputs, inputs)
    }

    /// A of ẋ = A x with at most `most` states, velocities in units of `rate` [1/s]; none if there are no such equations or they
    /// would be larger.
    pub(super) fn first_order(&self, most: usize, rate: f64) -> Option<DMatrix<f64>> {
        let freedoms = self.coordinate_count().saturating_sub(self.system.layout().multiplier_rows().len());
        if 2 * freedoms > most || self.coordinate_count() > MAX_COORDINATES {
            return None;
        }
        if self.system.sees_multipliers() || self.moving_velocity_rows().next().is_some() {
            return None;
        }
        let reduced = self.reduced(&[]).ok()?;
        let (z, x) = (reduced.t.ncols(), reduced.s.ncols());
        let states = 2 * z + x;
        let mut a = DMatrix::zeros(states, states);
        a.view_mut((0, z + x), (z, z)).fill_with_identity();
        a.rows_mut(z, x).copy_from(&reduced.rates);
        a.rows_mut(z + x, z).copy_from(&reduced.accelerations);
        a.columns_mut(z + x, z).scale_mut(rate);
        a.rows_mut(z + x, z).scale_mut(rate.recip());
        (states <= most).then_some(a)
    }

    /// Rows of constraints of velocities, which are not those of positions in a moving state.
    fn moving_velocity_rows(&self) -> impl Iterator<Item = usize> {
        let rows = self.system.layout().velocity_rows();
        rows.filter(|_| !self.is_at_rest())
    }

    /// Full matrices of the rows and columns of coordinates.
    fn full(&self, values: &[f64]) -> DMatrix<f64> {
        let count = self.coordinate_count();
        let pattern = self.pattern();
        let mut full = DMatrix::zeros(count, count);
        for_each(&pattern, values, count, |row, column, value| {
            if row < count {
                full[(row, column)] += value;
            }
        });
        full
    }

    fn reduced(&self, inputs: &[Vec<f64>]) -> Result<Reduced, StateSpaceError> {
        let layout = self.system.layout();
        let count = self.coordinate_count();
        let multipliers = layout.multiplier_rows().len();
        let pattern = self.pattern();
        let mut gradient = DMatrix::zeros(multipliers, count);
        for_each(&pattern, &self.parts.constraint, count, |row, column, value| {
            if row >= count {
                gradient[(row - count, column)] += value;
            }
        });
        let unit = |row: usize| match layout.quantities()[row] {
            Quantity::Length | Quantity::State => 1.0,
            Quantity::Angle => self.length(),
        };
        let scaled = DMatrix::from_fn(multipliers, count, |i, j| gradient[(i, j)] / unit(j));
        let (order, rank, change) = dependent(&scaled);
        let is_state = |row: usize| layout.states().any(|(state, ..)| state == row);
        let (states, places): (Vec<usize>, Vec<usize>) =
            order[rank..].iter().copied().partition(|&row| is_state(row));
        let column_of = |row: usize| order[rank..].iter().position(|&other| other == row).unwrap_or(0);
        let transformation = |rows: &[usize]| {
            let mut t = DMatrix::zeros(count, rows.len());
            for (k, &row) in rows.iter().enumerate() {
                t[(row, k)] = 1.0;
                for (i, &own) in order[..rank].iter().enumerate() {
                    t[(own, k)] = change[(i, column_of(row))] * unit(row) / unit(own);
                }
            }
            t
        };
        let (t, s) = (transformation(&places), transformation(&states));
        let [mass, damping, stiffness] =
            [&self.parts.mass, &self.parts.damping, &self.parts.stiffness].map(|values| self.full(values));
        let forces = DMatrix::from_fn(count, inputs.len(), |row, k| inputs[k][row]);
        // First the states' rates, then accelerations: each as columns for z, x, ż and u.
        let (z, x) = (places.len(), states.len());
        let u = inputs.len();
        let width = 2 * z + x + u;
        let side = |left: &DMatrix<f64>| {
            let mut sum = DMatrix::zeros(left.ncols(), width);
            sum.columns_mut(0, z).copy_from(&-(left.tr_mul(&stiffness) * &t));
            sum.columns_mut(z, x).copy_from(&-(left.tr_mul(&stiffness) * &s));
            sum.columns_mut(z + x, z).copy_from(&-(left.tr_mul(&damping) * &t));
            sum.columns_mut(2 * z + x, u).copy_from(&left.tr_mul(&forces));
            sum
        };
        let rates = solve(&(s.tr_mul(&damping) * &s), side(&s))?;
        let right = side(&t) - t.tr_mul(&damping) * &s * &rates;
        let accelerations = solve(&(t.tr_mul(&mass) * &t), right)?;
        let mut names: Vec<String> = places.iter().chain(&states).map(|&row| layout.name_of(row)).collect();
        names.extend(places.iter().map(|&row| format!("rate of {}", layout.name_of(row))));
        let dependent = order[..rank].to_vec();
        Ok(Reduced { t, s, rates, accelerations, names, mass, damping, stiffness, gradient, dependent })
    }
}

/// Calls `take` with every entry of the columns before `count`.
fn for_each(pattern: &Pattern, values: &[f64], count: usize, mut take: impl FnMut(usize, usize, f64)) {
    for column in 0..count {
        for at in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            take(pattern.row_indices()[at], column, values[at]);
        }
    }
}

/// Columns of the constraints in an order in which the first `rank` depend on the others, and the matrix of this
/// dependence.
fn dependent(gradient: &DMatrix<f64>) -> (Vec<usize>, usize, DMatrix<f64>) {
    let count = gradient.ncols();
    let mut order = DMatrix::from_fn(1, count, |_, j| j as f64);
    if gradient.nrows() == 0 {
        return ((0..count).collect(), 0, DMatrix::zeros(0, count));
    }
    let factors = ColPivQR::new(gradient.clone());
    factors.p().permute_columns(&mut order);
    let r = factors.r();
    let largest = r[(0, 0)].abs();
    let most = r.nrows().min(r.ncols());
    let rank = (0..most).take_while(|&k| r[(k, k)].abs() > round_off::RANK * largest).count();
    let corner = r.view((0, 0), (rank, rank)).into_owned();
    let mut change = -r.view((0, rank), (rank, count - rank)).into_owned();
    corner.solve_upper_triangular_mut(&mut change);
    (order.iter().map(|&column| column as usize).collect(), rank, change)
}

fn solve(matrix: &DMatrix<f64>, right: DMatrix<f64>) -> Result<DMatrix<f64>, StateSpaceError> {
    if matrix.nrows() == 0 {
        return Ok(right);
    }
    let size = |k: usize| matrix[(k, k)].abs().sqrt().max(f64::MIN_POSITIVE);
    let scaled =
        DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / (size(i) * size(j)));
    let factors: LU<f64, Dyn, Dyn> = scaled.lu();
    let pivots = factors.u().diagonal().abs();
    let (least, most) = (pivots.min(), pivots.max());
    if !most.is_finite() || least <= SINGULAR * most {
        return Err(StateSpaceError::Massless {});
    }
    let scaled = DMatrix::from_fn(right.nrows(), right.ncols(), |i, j| right[(i, j)] / size(i));
    let solution = factors.solve(&scaled).ok_or(StateSpaceError::Massless {})?;
    Ok(DMatrix::from_fn(right.nrows(), right.ncols(), |i, j| solution[(i, j)] / size(i)))
}

/// The equations in independent coordinates; columns of rates and accelerations are z, x, ż and u.
struct Reduced {
    t: DMatrix<f64>,
    s: DMatrix<f64>,
    rates: DMatrix<f64>,
    accelerations: DMatrix<f64>,
    names: Vec<String>,
    mass: DMatrix<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    gradient: DMatrix<f64>,
    dependent: Vec<usize>,
}

impl Reduced {
    fn with_outputs(
        self,
        model: &LinearModel<'_>,
        outputs: &[(OutputDerivatives, Vec<f64>)],
        inputs: &[Vec<f64>],
    ) -> Result<StateSpace, StateSpaceError> {
        let count = model.coordinate_count();
        let (z, x, u) = (self.t.ncols(), self.s.ncols(), inputs.len());
        let (states, width) = (2 * z + x, 2 * z + x + u);
        // Positions, rates and accelerations of all coordinates, from z, x, ż and u.
        let mut place = DMatrix::zeros(count, width);
        place.columns_mut(0, z).copy_from(&self.t);
        place.columns_mut(z, x).copy_from(&self.s);
        let mut rate = &self.s * &self.rates;
        let mut own = rate.columns_mut(z + x, z);
        own += &self.t;
        let acceleration = &self.t * &self.accelerations;
        let multipliers = if outputs.iter().any(|(output, _)| !output.by_multiplier.is_empty()) {
            // Constraints that are released exert no force.
            let constraints = model.system.constraints().filter(|own| !own.is_released(&model.at));
            let acting: Vec<usize> = constraints
                .flat_map(|own| own.first_multiplier()..own.first_multiplier() + own.equations())
                .collect();
            if self.dependent.len() < acting.len() {
                return Err(StateSpaceError::Redundant {});
            }
            let mut rest = -(&self.mass * &acceleration + &self.damping * &rate + &self.stiffness * &place);
            for (k, input) in inputs.iter().enumerate() {
                for row in 0..count {
                    rest[(row, states + k)] += input[row];
                }
            }
            let square = self.gradient.select_rows(&acting).select_columns(&self.dependent).transpose();
            let forces = square.lu().solve(&rest.select_rows(&self.dependent));
            let forces = forces.ok_or(StateSpaceError::Redundant {})?;
            let mut multipliers = DMatrix::zeros(self.gradient.nrows(), width);
            for (own, force) in acting.iter().zip(forces.row_iter()) {
                multipliers.set_row(*own, &force);
            }
            multipliers
        } else {
            DMatrix::zeros(self.gradient.nrows(), width)
        };
        let mut rows = DMatrix::zeros(outputs.len(), width);
        for (k, (output, direct)) in outputs.iter().enumerate() {
            for (of, values) in [
                (&output.by_place, &place),
                (&output.by_rate, &rate),
                (&output.by_acceleration, &acceleration),
            ] {
                for (&row, factor) in of {
                    let mut own = rows.row_mut(k);
                    own += *factor * values.row(row);
                }
            }
            for (&row, factor) in &output.by_multiplier {
                let mut own = rows.row_mut(k);
                own += *factor * multipliers.row(row - count);
            }
            for (input, value) in direct.iter().enumerate() {
                rows[(k, states + input)] += value;
            }
        }
        let mut first = DMatrix::zeros(states, width);
        first.view_mut((0, z + x), (z, z)).fill_with_identity();
        first.rows_mut(z, x).copy_from(&self.rates);
        first.rows_mut(z + x, z).copy_from(&self.accelerations);
        Ok(StateSpace {
            a: first.columns(0, states).into_owned(),
            b: first.columns(states, u).into_owned(),
            c: rows.columns(0, states).into_owned(),
            d: rows.columns(states, u).into_owned(),
            states: self.names,
        })
    }
}
