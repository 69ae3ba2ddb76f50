//! Modes with damping, gyroscopic terms or an unsymmetric stiffness, by shift and invert of the linearised quadratic problem
//!
//! ```text
//! (s² M + s D + K) x + Bᵀ μ = 0,   B x = 0,   v = s x
//! ```
//!
//! One application of the operator is one solve with the saddle-point matrix at the shift σ: (σ²M + σD + K) x + Bᵀμ = -M w₂ - (D + σM) w₁,
//! v = w₁ + σ x. Its eigenvalues are 1/(s - σ). Components of infinite eigenvalues vanish after two applications, because positions and
//! then velocities satisfy the constraints [Cliffe, Garratt and Spence 1994; Meerbergen and Spence 1997]. At a real shift the operator,
//! its basis and its matrix are real; only eigenvectors are complex [Parlett and Saad 1987].

use nalgebra::{DMatrix, Schur};
use num_complex::Complex64;

use super::completion::Spectrum;
use super::krylov::{Krylov, Operator, complex, product};
use super::lanczos::{VIOLATED, round_off};
use super::mode::{Completeness, Mode, ModeError, ModeOptions, Modes};
use super::model::{LinearError, LinearModel};
use super::schur::schur;
use super::shifted::{GeneralShift, Shift, small_square};
use super::{ADDITIONAL_MODES, EIGENVALUE_TOLERANCE, EQUAL, krylov};
use crate::interrupt;
use crate::kinematics::Quantity;
use crate::round_off;

const TOLERANCE: f64 = 1e-8;
const CHECK_INTERVAL: usize = 12;
/// A basis with this number of vectors, and three times the number of requested eigenvalues, is large.
const LARGE_BASIS: usize = 100;
/// Factor of the round-off of zero eigenvalues, which come in defective pairs.
const DEFECTIVE: f64 = 16.0;
/// Round-off of a solve, relative to the shift, for defective eigenvalues: the square root of the usual one.
const SOLVED: f64 = 1e-5;
/// Largest residual of an eigenvector, relative to its image. A larger one belongs to round-off of an infinite eigenvalue, which two
/// applications have removed.
const EIGENVECTOR: f64 = 1e-2;
/// If an eigenvalue is nearer to the shift than this fraction of it, all others are lost in round-off.
const TOO_NEAR: f64 = 1e-4;
/// Relative change of the shift in this case.
const ASIDE: f64 = 0.03;
const MAX_SHIFTS: usize = 3;
/// Candidates of the shift relative to the smallest eigenvalue; the one farthest from all eigenvalues is chosen.
const CANDIDATES: [f64; 6] = [1.0, 0.85, 1.2, 0.7, 1.45, 0.55];

/// Positions and velocities, in units of the model's length and of a rate.
pub(super) struct Inverse<'m, 's, 'a, S> {
    model: &'m LinearModel<'a>,
    solver: &'s mut GeneralShift<'a, S>,
    pub(super) shift: S,
    rate: f64,
    units: Vec<f64>,
    room: Vec<S>,
    right: Vec<S>,
    product: Vec<S>,
}

/// The number field of a shift, and so of the basis.
pub(super) trait Field: Shift {
    /// Another shift nearby.
    fn beside(self, change: f64) -> Self;
    /// The operator's image of a complex vector.
    fn image(operator: &mut Inverse<'_, '_, '_, Self>, vector: &[Complex64], image: &mut [Complex64]);
    /// Schur form: unitary vectors and the triangular matrix.
    fn schur(matrix: &DMatrix<Self>) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)>;
}

impl Field for Complex64 {
    fn beside(self, change: f64) -> Self {
        self * Self::new(1.0 + change, change)
    }

    fn image(operator: &mut Inverse<'_, '_, '_, Self>, vector: &[Complex64], image: &mut [Complex64]) {
        operator.apply(vector, image);
    }

    fn schur(matrix: &DMatrix<Self>) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)> {
        schur(matrix.clone())
    }
}

impl Field for f64 {
    fn beside(self, change: f64) -> Self {
        self * (1.0 + change)
    }

    fn image(operator: &mut Inverse<'_, '_, '_, Self>, vector: &[Complex64], image: &mut [Complex64]) {
        let mut parts = [vec![0.0; vector.len()], vec![0.0; vector.len()]];
        let real: Vec<f64> = vector.iter().map(|value| value.re).collect();
        let imaginary: Vec<f64> = vector.iter().map(|value| value.im).collect();
        operator.apply(&real, &mut parts[0]);
        operator.apply(&imaginary, &mut parts[1]);
        for ((value, &re), &im) in image.iter_mut().zip(&parts[0]).zip(&parts[1]) {
            *value = Complex64::new(re, im);
        }
    }

    fn schur(matrix: &DMatrix<Self>) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)> {
        // A successful iteration requires two or three sweeps for each eigenvalue.
        let rounds = 10 * matrix.nrows().max(10);
        let Some(schur) = Schur::try_new(matrix.clone(), f64::EPSILON, rounds) else {
            return schur(matrix.map(Complex64::from));
        };
        let (vectors, triangle) = schur.unpack();
        let (mut vectors, mut triangle) = (vectors.map(Complex64::from), triangle.map(Complex64::from));
        make_triangular(&mut vectors, &mut triangle);
        Some((vectors, triangle))
    }
}

/// Transforms the 2 x 2 blocks on the diagonal of a real Schur form, the pairs of complex eigenvalues, to triangular
/// form.
fn make_triangular(vectors: &mut DMatrix<Complex64>, triangle: &mut DMatrix<Complex64>) {
    let order = triangle.nrows();
    for k in 1..order {
        let below = triangle[(k, k - 1)];
        if below == Complex64::default() {
            continue;
        }
        let (a, b, d) = (triangle[(k - 1, k - 1)], triangle[(k - 1, k)], triangle[(k, k)]);
        // The eigenvector (λ - d, c) of [a b; c d].
        let half = 0.5 * (a - d);
        let root = (half * half + b * below).sqrt();
        let eigenvalue = 0.5 * (a + d) + if (half.conj() * root).re >= 0.0 { root } else { -root };
        let first = eigenvalue - d;
        let norm = first.norm().hypot(below.norm());
        let (cosine, sine) = (first / norm, below / norm);
        for column in 0..order {
            let (upper, lower) = (triangle[(k - 1, column)], triangle[(k, column)]);
            triangle[(k - 1, column)] = cosine.conj() * upper + sine.conj() * lower;
            triangle[(k, column)] = cosine * lower - sine * upper;
        }
        for matrix in [&mut *triangle, &mut *vectors] {
            for row in 0..order {
                let (left, right) = (matrix[(row, k - 1)], matrix[(row, k)]);
                matrix[(row, k - 1)] = cosine * left + sine * right;
                matrix[(row, k)] = cosine.conj() * right - sine.conj() * left;
            }
        }
        triangle[(k, k - 1)] = Complex64::default();
    }
}

impl<S: Field> Inverse<'_, '_, '_, S> {
    /// Positions and velocities of a mode in the operator's units.
    pub(super) fn vector_of(&self, mode: &Mode) -> Vec<Complex64> {
        let positions = mode.shape.iter().zip(&self.units).map(|(value, unit)| value * unit);
        let positions: Vec<Complex64> = positions.collect();
        let velocities = positions.iter().map(|value| value * mode.eigenvalue / self.rate);
        let velocities: Vec<Complex64> = velocities.collect();
        [positions, velocities].concat()
    }
}

impl<S: Field> Operator<S> for Inverse<'_, '_, '_, S> {
    fn size(&self) -> usize {
        2 * self.units.len()
    }

    fn apply(&mut self, vector: &[S], image: &mut [S]) {
        let count = self.units.len();
        let parts = &self.model.parts;
        let pattern = self.model.pattern();
        self.right.fill(S::zero());
        let (shift, rate) = (self.shift, self.rate);
        let (positions, velocities) = vector.split_at(count);
        for (values, of_velocities, of_positions) in
            [(&parts.mass, rate, shift), (&parts.damping, 0.0, S::one())]
        {
            for row in 0..count {
                self.room[row] = (velocities[row] * of_velocities + of_positions * positions[row])
                    * self.units[row].recip();
            }
            multiply(&pattern, values, &self.room, &mut self.product);
            for (sum, &value) in self.right.iter_mut().zip(&self.product) {
                *sum -= value;
            }
        }
        self.solver.solve(&mut self.right);
        for row in 0..count {
            let x = self.right[row] * self.units[row];
            image[row] = x;
            image[count + row] = (positions[row] + shift * x) * rate.recip();
        }
    }

    fn is_weighted(&self) -> bool {
        false
    }

    fn weigh(&mut self, vector: &[S], weighted: &mut [S]) {
        weighted.copy_from_slice(vector);
    }
}

/// product = A x for real values.
fn multiply<S: Shift>(pattern: &lissom_solver::Pattern, values: &[f64], vector: &[S], product: &mut [S]) {
    product.fill(S::zero());
    for (column, &factor) in vector.iter().enumerate() {
        if factor == S::zero() {
            continue;
        }
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        for (&row, &value) in pattern.row_indices()[range.clone()].iter().zip(&values[range]) {
            product[row] += factor * value;
        }
    }
}

/// An eigenvalue 1/(s - σ) of the operator, its coefficients in the basis, and the residual.
struct Estimate {
    value: Complex64,
    weights: Vec<Complex64>,
    residual: f64,
}

/// Computes the modes nearest to the shift.
pub(super) fn find(model: &LinearModel<'_>, options: &ModeOptions) -> Result<Modes, ModeError> {
    match options.shift {
        Some(frequency) if frequency > 0.0 => {
            // A frequency from a list of modes is an eigenvalue itself.
            let shift = Complex64::new(0.0, (1.0 + 2.0 * TOO_NEAR) * std::f64::consts::TAU * frequency);
            let mut solver = GeneralShift::on(model.system, model.structure(), &model.representative);
            find_near(model, options, (&mut solver, shift), options.count + ADDITIONAL_MODES)
        }
        _ => {
            let mut solver = GeneralShift::on(model.system, model.structure(), &model.representative);
            // Steadily rolling wheels have many zero eigenvalues, which hide the others from a small shift; their motions have
            // the rate of rotation.
            let shift = if model.rolls_on() { model.spin().norm() } else { first_shift(model, &mut solver)? };
            // Conjugates and the second zero of each rigid mode are found as well.
            find_near(model, options, (&mut solver, shift), 2 * (options.count + ADDITIONAL_MODES))
        }
    }
}

/// Computes the modes nearest to `shift`, among the `wanted` nearest eigenvalues or more.
fn find_near<'a, S: Field>(
    model: &LinearModel<'a>,
    options: &ModeOptions,
    (solver, shift): (&mut GeneralShift<'a, S>, S),
    mut wanted: usize,
) -> Result<Modes, ModeError> {
    let mut shift = shift;
    let mut modes: Vec<Mode>;
    let is_empty;
    let mut attempt = 0;
    'shifts: loop {
        let mut operator = inverse(model, solver, shift)?;
        let mut krylov = Krylov::new(operator.size());
        let mut is_exhausted = krylov.start(&mut operator, krylov::BLOCK, 2) == 0;
        loop {
            let estimates = search(&mut krylov, &mut operator, wanted, &mut is_exhausted)?;
            let largest = estimates.first().map_or(0.0, |estimate| estimate.value.norm());
            if attempt < MAX_SHIFTS && largest * TOO_NEAR * operator.shift.size() > 1.0 {
                shift = shift.beside(ASIDE);
                attempt += 1;
                continue 'shifts;
            }
            let found = estimates.iter().filter_map(|estimate| mode(model, &mut operator, &krylov, estimate));
            modes = found.collect();
            keep_independent_rigid_modes(&mut modes);
            if modes.iter().filter(|mode| model.counts(mode)).count() >= options.count || is_exhausted {
                is_empty = modes.is_empty() && krylov.order() > 0;
                break 'shifts;
            }
            wanted += 2 * krylov::BLOCK;
        }
    }
    // Pivots do not count modes here. For small models all eigenvalues are computed; in others there are at most two for
    // each degree of freedom under the constraints, unless constraints are redundant.
    let spectrum = Spectrum::of(model, shift.size());
    if let Some(spectrum) = &spectrum {
        spectrum.complete(model, &mut modes, complex(shift), options.count);
    }
    let eigenvalues: usize = modes.iter().map(|mode| if mode.eigenvalue.im == 0.0 { 1 } else { 2 }).sum();
    let layout = model.system.layout();
    let equations = layout.multiplier_rows().len() - model.redundant;
    let freedoms = layout.coordinate_count().saturating_sub(equations);
    let most = match &spectrum {
        Some(spectrum) => spectrum.values.len(),
        None if freedoms == 0 || solver.has_redundant_constraints() => usize::MAX,
        // Rolling bodies have more positions than velocities, and latches that are released do not constrain.
        None => 2 * (freedoms + layout.of_velocities.len()),
    };
    if (is_empty && modes.is_empty()) || eigenvalues > most {
        return Err(ModeError::NotConverged {});
    }
    let mut left = options.count;
    let last = modes.iter().position(|mode| {
        left -= usize::from(model.counts(mode));
        left == 0
    });
    modes.truncate(last.map_or(modes.len(), |last| last + 1));
    modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Ok(Modes { modes, completeness: Completeness::NotCounted })
}

/// A real shift of about the magnitude of the smallest nonzero eigenvalues.
fn first_shift<'a>(model: &LinearModel<'a>, solver: &mut GeneralShift<'a, f64>) -> Result<f64, ModeError> {
    let rate = small_square(&model.representative).sqrt();
    let mut operator = inverse(model, solver, rate)?;
    let mut krylov = Krylov::new(operator.size());
    krylov.start(&mut operator, krylov::BLOCK, 2);
    for _ in 0..5 * krylov::BLOCK {
        if !krylov.step(&mut operator) {
            break;
        }
    }
    let estimates = estimates(&krylov)?;
    let found: Vec<Complex64> = estimates
        .iter()
        .filter_map(|estimate| mode(model, &mut operator, &krylov, estimate))
        .map(|mode| mode.eigenvalue)
        .filter(|eigenvalue| eigenvalue.norm() > 0.0)
        .collect();
    let least = found.iter().map(|value| value.norm()).fold(f64::INFINITY, f64::min);
    if !least.is_finite() {
        return Ok(rate);
    }
    // At a growing real eigenvalue the matrix is singular. Nearer to zero the pivots of rigid modes vanish, and the other
    // eigenvalues are lost in round-off.
    let distance = |shift: f64| found.iter().map(|value| (value - shift).norm() / shift).fold(1.0, f64::min);
    let best =
        CANDIDATES.iter().map(|part| part * least).max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    Ok(best.unwrap_or(least).max(rate))
}

pub(super) fn inverse<'m, 's, 'a, S: Field>(
    model: &'m LinearModel<'a>,
    solver: &'s mut GeneralShift<'a, S>,
    shift: S,
) -> Result<Inverse<'m, 's, 'a, S>, ModeError> {
    let mut tried = shift;
    let mut result = solver.factor(&model.parts, tried);
    // An eigenvalue is at the shift.
    for change in [1e-6, 1e-4, 1e-2] {
        if result.is_ok() {
            break;
        }
        tried = shift.beside(change);
        result = solver.factor(&model.parts, tried);
    }
    result.map_err(|error| model.stopped(&error))?;
    let layout = model.system.layout();
    let units = layout.quantities()[..layout.coordinate_count()]
        .iter()
        .map(|quantity| match quantity {
            Quantity::Length | Quantity::State => 1.0,
            Quantity::Angle => model.representative.length,
        })
        .collect();
    let room = vec![S::zero(); layout.size()];
    let rate = tried.size();
    Ok(Inverse { model, solver, shift: tried, rate, units, right: room.clone(), product: room.clone(), room })
}

/// Extends the basis until the `wanted` largest eigenvalues have converged, or it is exhausted.
fn search<S: Field>(
    krylov: &mut Krylov<S>,
    operator: &mut Inverse<'_, '_, '_, S>,
    wanted: usize,
    is_exhausted: &mut bool,
) -> Result<Vec<Estimate>, ModeError> {
    let mut since = 0;
    loop {
        interrupt::check().map_err(LinearError::from)?;
        if !*is_exhausted && !krylov.step(operator) {
            *is_exhausted = krylov.start(operator, krylov::BLOCK, 2) == 0;
        }
        since += 1;
        let is_early = since < CHECK_INTERVAL.max(krylov.order() / 8) || krylov.order() < wanted;
        if !*is_exhausted && is_early {
            continue;
        }
        since = 0;
        let mut estimates = estimates(krylov)?;
        *is_exhausted |= krylov.order() >= operator.size();
        let tolerance =
            if krylov.order() > LARGE_BASIS + 3 * wanted { EIGENVALUE_TOLERANCE } else { TOLERANCE };
        let converged = |estimate: &Estimate| estimate.residual <= tolerance * estimate.value.norm();
        let are_enough = estimates.len() >= wanted && estimates.iter().take(wanted).all(converged);
        if are_enough || *is_exhausted {
            let largest = estimates.first().map_or(0.0, |estimate| estimate.value.norm());
            estimates.retain(|estimate| {
                estimate.value.norm() > round_off::ITERATED_EIGENVALUE * largest
                    && (*is_exhausted || converged(estimate))
            });
            return Ok(estimates);
        }
    }
}

/// Eigenvalues of the operator in the present basis, in descending order.
fn estimates<S: Field>(krylov: &Krylov<S>) -> Result<Vec<Estimate>, ModeError> {
    let order = krylov.order();
    if order == 0 {
        return Ok(Vec::new());
    }
    let matrix = DMatrix::from_fn(order, order, |row, column| krylov.entry(row, column));
    let (vectors, triangle) = S::schur(&matrix).ok_or(ModeError::NotConverged {})?;
    let scale = triangle.iter().fold(0.0_f64, |most, value| most.max(value.norm()));
    let mut all: Vec<Estimate> = (0..order)
        .map(|k| {
            let value = triangle[(k, k)];
            let mut own = vec![Complex64::default(); order];
            own[k] = Complex64::new(1.0, 0.0);
            for row in (0..k).rev() {
                let sum: Complex64 = (row + 1..=k).map(|j| triangle[(row, j)] * own[j]).sum();
                let gap = triangle[(row, row)] - value;
                let least = f64::EPSILON * scale;
                own[row] = -sum / if gap.norm() > least { gap } else { Complex64::new(least, 0.0) };
            }
            let mut weights: Vec<Complex64> =
                (0..order).map(|i| (0..=k).map(|j| vectors[(i, j)] * own[j]).sum()).collect();
            let norm = weights.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt();
            for weight in &mut weights {
                *weight /= norm;
            }
            let residual = krylov.complex_residual(&weights);
            Estimate { value, weights, residual }
        })
        .collect();
    all.sort_by(|a, b| b.value.norm().total_cmp(&a.value.norm()));
    Ok(all)
}

/// The mode of an estimate; none if it is the complex conjugate of another.
fn mode<S: Field>(
    model: &LinearModel<'_>,
    operator: &mut Inverse<'_, '_, '_, S>,
    krylov: &Krylov<S>,
    estimate: &Estimate,
) -> Option<Mode> {
    let eigenvalue = complex(operator.shift) + estimate.value.inv();
    // The conjugate is among the estimates.
    if eigenvalue.im < -round_off::ITERATED_EIGENVALUE * eigenvalue.norm()
        && !is_defective(eigenvalue, operator.shift.size())
    {
        return None;
    }
    let vector = krylov.combine_complex(&estimate.weights);
    mode_of(model, operator, vector, estimate.value).map(|mut mode| {
        mode.residual = estimate.residual / estimate.value.norm();
        mode
    })
}

/// Whether an eigenvalue is so small compared with the shift that it may be one of a defective pair at zero.
fn is_defective(eigenvalue: Complex64, shift: f64) -> bool {
    eigenvalue.norm_sqr() <= DEFECTIVE * shift.powi(2) * SOLVED
}

/// The mode of an eigenvector of the operator, positions and velocities, and its eigenvalue 1/(s - σ); none if it is not a mode.
pub(super) fn mode_of<S: Field>(
    model: &LinearModel<'_>,
    operator: &mut Inverse<'_, '_, '_, S>,
    mut vector: Vec<Complex64>,
    value: Complex64,
) -> Option<Mode> {
    let mut eigenvalue = complex(operator.shift) + value.inv();
    if eigenvalue.im.abs() <= round_off::ITERATED_EIGENVALUE * eigenvalue.norm() {
        eigenvalue.im = 0.0;
    }
    let square_of_shift = operator.shift.size().powi(2);
    let is_defective = is_defective(eigenvalue, operator.shift.size());
    if eigenvalue.im < 0.0 && !is_defective {
        return None;
    }
    let mut image = vec![Complex64::default(); vector.len()];
    for _ in 0..2 {
        S::image(operator, &vector, &mut image);
        std::mem::swap(&mut vector, &mut image);
    }
    let size = |values: &[Complex64]| product(values, values).re.sqrt();
    let mut residual = 0.0;
    if !is_defective {
        S::image(operator, &vector, &mut image);
        let missed: Vec<Complex64> = image.iter().zip(&vector).map(|(image, x)| image - value * x).collect();
        residual = size(&missed) / size(&image);
        let is_one = residual <= EIGENVECTOR;
        if !is_one {
            return None;
        }
    }
    let count = operator.units.len();
    let mut shape: Vec<Complex64> =
        vector[..count].iter().zip(&operator.units).map(|(value, unit)| value / unit).collect();
    normalise(model, &mut shape);
    // States have no mass, and their rates no round-off from stiffness.
    let quantities = model.system.layout().quantities();
    let size_of = |(value, quantity): (&Complex64, &Quantity)| {
        if *quantity == Quantity::State { 0.0 } else { value.norm() }
    };
    let sizes: Vec<f64> = shape.iter().zip(quantities).map(size_of).collect();
    let of_solve = SOLVED.powi(2) * square_of_shift;
    if eigenvalue.norm_sqr() <= DEFECTIVE * round_off(model, &sizes, 1.0) + of_solve {
        eigenvalue = Complex64::default();
    }
    if model.violation(&shape) >= VIOLATED {
        return None;
    }
    (eigenvalue.im >= 0.0).then(|| Mode::new(eigenvalue, shape, residual))
}

/// Normalises to unit modal mass with the largest entry real, or the largest entry to 1 if the mode has no mass.
fn normalise(model: &LinearModel<'_>, shape: &mut [Complex64]) {
    let size = model.system.layout().size();
    let (mut room, mut product) = (vec![Complex64::default(); size], vec![Complex64::default(); size]);
    room[..shape.len()].copy_from_slice(shape);
    multiply(&model.pattern(), &model.parts.mass, &room, &mut product);
    let mass: f64 = shape.iter().zip(&product).map(|(x, y)| (x.conj() * y).re).sum();
    let largest =
        shape.iter().fold(Complex64::default(), |most, x| if x.norm() > most.norm() { *x } else { most });
    if largest.norm() == 0.0 {
        return;
    }
    let size = if mass > 0.0 { mass.sqrt() } else { largest.norm() };
    let factor = largest.conj() / (largest.norm() * size);
    for value in shape {
        *value *= factor;
    }
}

/// Removes modes with eigenvalue zero whose shapes depend linearly on earlier ones.
fn keep_independent_rigid_modes(modes: &mut Vec<Mode>) {
    let mut basis: Vec<Vec<Complex64>> = Vec::new();
    modes.retain(|mode| {
        if mode.eigenvalue != Complex64::default() {
            return true;
        }
        let mut rest = mode.shape.clone();
        let whole: f64 = rest.iter().map(Complex64::norm_sqr).sum();
        for known in &basis {
            let part: Complex64 = known.iter().zip(&rest).map(|(x, y)| x.conj() * y).sum();
            for (value, x) in rest.iter_mut().zip(known) {
                *value -= part * x;
            }
        }
        let left: f64 = rest.iter().map(Complex64::norm_sqr).sum();
        if left <= EQUAL * EQUAL * whole {
            return false;
        }
        let norm = left.sqrt();
        basis.push(rest.into_iter().map(|value| value / norm).collect());
        true
    });
}
