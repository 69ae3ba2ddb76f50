//! A band Krylov basis (Ruhe 1979): vectors wait in a queue, each image under the operator is orthogonalised against the
//! basis and appended to it. Several starting vectors find eigenvalues of that multiplicity; new ones may be added at any
//! time. Independent of mechanics.

use lissom_motion::WIDTH;
use std::collections::VecDeque;

use lissom_solver::Scalar;
use num_complex::Complex64;

pub(super) use crate::saddle_point::potential::Noise;

/// Number of starting vectors: eigenvalues of this multiplicity are found at once.
pub(super) const BLOCK: usize = 6;
/// Steps between two computations of the eigenvalues of a symmetric operator.
pub(super) const CHECK_INTERVAL: usize = 8;
/// Maximum number of restarts with new vectors, each of which finds vectors to which the others were orthogonal.
pub(super) const MAX_RESTARTS: usize = 6;
/// Remainder of an image after orthogonalisation, relative to the image, below which it is a combination of the
/// basis.
const DEPENDENT: f64 = 1e-11;

/// Fraction of a vector's norm that must remain after orthogonalisation, otherwise it is repeated.
const KEPT: f64 = 0.7;

/// An operator with the inner product in which its basis is orthonormal.
pub(super) trait Operator<S> {
    /// Length of the vectors.
    fn size(&self) -> usize;
    /// The image of a vector.
    fn apply(&mut self, vector: &[S], image: &mut [S]);
    /// Whether the inner product differs from Σ conj(x_i) y_i.
    fn is_weighted(&self) -> bool {
        true
    }
    /// The weighted vector w with ⟨x, y⟩ = Σ conj(w(x)_i) y_i.
    fn weigh(&mut self, vector: &[S], weighted: &mut [S]);
}

/// The complex conjugate; the number itself if it is real.
pub(super) fn conjugate<S: Scalar>(value: S) -> S {
    let [real, imaginary] = value.parts();
    S::from_parts(real, -imaginary)
}

/// Converts a number to a complex one.
pub(super) fn complex<S: Scalar>(value: S) -> Complex64 {
    let [real, imaginary] = value.parts();
    Complex64::new(real, imaginary)
}

/// Σ conj(a_i) b_i.
pub(super) fn product<S: Scalar>(a: &[S], b: &[S]) -> S {
    // Several partial sums, so that they are independent.
    let mut sums = [S::zero(); WIDTH];
    let (blocks_of_a, blocks_of_b) = (a.chunks_exact(WIDTH), b.chunks_exact(WIDTH));
    let rest = blocks_of_a.remainder().iter().zip(blocks_of_b.remainder());
    let rest = rest.fold(S::zero(), |sum, (&a, &b)| sum + conjugate(a) * b);
    for (a, b) in blocks_of_a.zip(blocks_of_b) {
        for k in 0..WIDTH {
            sums[k] += conjugate(a[k]) * b[k];
        }
    }
    sums.into_iter().fold(rest, |sum, part| sum + part)
}

/// y += factor x.
pub(super) fn add<S: Scalar>(y: &mut [S], factor: S, x: &[S]) {
    for (y, &x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// The basis, and the operator in it.
pub(super) struct Krylov<S> {
    pub(super) basis: Vec<Vec<S>>,
    /// Basis vectors, weighted; empty if the inner product is not weighted.
    weighted: Vec<Vec<S>>,
    /// Columns of the operator's matrix in the basis, as long as the basis was when they were computed.
    pub(super) columns: Vec<Vec<S>>,
    /// Indices of basis vectors whose images are not yet known.
    waiting: VecDeque<usize>,
    image: Vec<S>,
    weights: Vec<S>,
    noise: Noise,
}

impl<S: Scalar> Krylov<S> {
    pub(super) fn new(size: usize) -> Self {
        Self {
            basis: Vec::new(),
            weighted: Vec::new(),
            columns: Vec::new(),
            waiting: VecDeque::new(),
            image: vec![S::zero(); size],
            weights: vec![S::zero(); size],
            noise: Noise(1),
        }
    }

    /// Number of basis vectors whose images are known.
    pub(super) fn order(&self) -> usize {
        self.columns.len()
    }

    /// Adds `count` random vectors after `purifications` applications of the operator to each; returns how many are
    /// independent of the basis.
    pub(super) fn start(
        &mut self,
        operator: &mut dyn Operator<S>,
        count: usize,
        purifications: usize,
    ) -> usize {
        let mut added = 0;
        'vectors: for _ in 0..count {
            let mut vector: Vec<S> =
                (0..operator.size()).map(|_| S::from_real(self.noise.number())).collect();
            for _ in 0..purifications {
                operator.apply(&vector, &mut self.image);
                std::mem::swap(&mut vector, &mut self.image);
                // After each application the components along the basis are removed: otherwise the largest
                // eigenvalues would reduce all others to round-off.
                let whole = self.norm(operator, &vector);
                for _ in 0..2 {
                    for (known, weighted) in self.basis.iter().zip(weighted(&self.basis, &self.weighted)) {
                        let part = product(weighted, &vector);
                        add(&mut vector, S::zero() - part, known);
                    }
                }
                let norm = self.norm(operator, &vector);
                if norm <= DEPENDENT * whole || norm == 0.0 || !norm.is_finite() {
                    continue 'vectors;
                }
                for value in &mut vector {
                    *value *= S::from_real(norm.recip());
                }
            }
            self.image.copy_from_slice(&vector);
            added += usize::from(self.append(operator).is_some());
        }
        added
    }

    fn norm(&mut self, operator: &mut dyn Operator<S>, vector: &[S]) -> f64 {
        operator.weigh(vector, &mut self.weights);
        product(&self.weights, vector).parts()[0].max(0.0).sqrt()
    }

    /// Computes the image of the next waiting vector; false if there is none.
    pub(super) fn step(&mut self, operator: &mut dyn Operator<S>) -> bool {
        let Some(next) = self.waiting.pop_front() else { return false };
        debug_assert_eq!(next, self.columns.len());
        let vector = std::mem::take(&mut self.basis[next]);
        operator.apply(&vector, &mut self.image);
        self.basis[next] = vector;
        let before = self.basis.len();
        let (mut column, norm) = self.append_image(operator);
        if self.basis.len() > before {
            column.push(S::from_real(norm));
        }
        self.columns.push(column);
        true
    }

    /// The operator's matrix among the vectors whose images are known, and its rows below, by column.
    pub(super) fn entry(&self, row: usize, column: usize) -> S {
        self.columns[column].get(row).copied().unwrap_or(S::zero())
    }

    /// Σ_j y_j v_j.
    pub(super) fn combine(&self, weights: &[S]) -> Vec<S> {
        let mut sum = vec![S::zero(); self.image.len()];
        for (&weight, vector) in weights.iter().zip(&self.basis) {
            add(&mut sum, weight, vector);
        }
        sum
    }

    /// Σ_j y_j v_j with complex weights.
    pub(super) fn combine_complex(&self, weights: &[Complex64]) -> Vec<Complex64> {
        let mut sum = vec![Complex64::default(); self.image.len()];
        for (&weight, vector) in weights.iter().zip(&self.basis) {
            for (sum, &value) in sum.iter_mut().zip(vector) {
                *sum += weight * complex(value);
            }
        }
        sum
    }

    /// Norm of the component of the operator's image outside the known vectors, for their combination `weights`.
    pub(super) fn residual(&self, weights: &[S]) -> f64 {
        self.residual_of(weights, |entry| entry)
    }

    /// Norm of the component of the operator's image outside the known vectors, for complex weights.
    pub(super) fn complex_residual(&self, weights: &[Complex64]) -> f64 {
        self.residual_of(weights, complex)
    }

    fn residual_of<T: Scalar>(&self, weights: &[T], convert: impl Fn(S) -> T) -> f64 {
        let order = self.order();
        let below = (order..self.basis.len()).map(|row| {
            let sum = weights
                .iter()
                .enumerate()
                .fold(T::zero(), |sum, (column, &weight)| sum + convert(self.entry(row, column)) * weight);
            let [real, imaginary] = sum.parts();
            real * real + imaginary * imaginary
        });
        below.sum::<f64>().sqrt()
    }

    fn append(&mut self, operator: &mut dyn Operator<S>) -> Option<usize> {
        let before = self.basis.len();
        self.append_image(operator);
        (self.basis.len() > before).then_some(before)
    }

    /// Orthogonalises the image against the basis and appends the remainder, if any; returns the coefficients and the norm
    /// of the remainder.
    fn append_image(&mut self, operator: &mut dyn Operator<S>) -> (Vec<S>, f64) {
        operator.weigh(&self.image, &mut self.weights);
        let whole = product(&self.weights, &self.image).parts()[0].max(0.0).sqrt();
        let mut column = vec![S::zero(); self.basis.len()];
        let mut norm = whole;
        // Repeated only if much was removed: twice is enough then (Parlett 1980), or a third time if nearly nothing remains.
        for _ in 0..3 {
            let before = norm;
            for (coefficient, (vector, weighted)) in
                column.iter_mut().zip(self.basis.iter().zip(weighted(&self.basis, &self.weighted)))
            {
                let part = product(weighted, &self.image);
                *coefficient += part;
                add(&mut self.image, S::zero() - part, vector);
            }
            operator.weigh(&self.image, &mut self.weights);
            norm = product(&self.weights, &self.image).parts()[0].max(0.0).sqrt();
            if norm > KEPT * before {
                break;
            }
        }
        if norm <= DEPENDENT * whole || !norm.is_finite() || norm == 0.0 {
            return (column, 0.0);
        }
        let factor = S::from_real(norm.recip());
        self.waiting.push_back(self.basis.len());
        self.basis.push(self.image.iter().map(|&value| value * factor).collect());
        if operator.is_weighted() {
            self.weighted.push(self.weights.iter().map(|&value| value * factor).collect());
        }
        (column, norm)
    }
}

/// The weighted vectors of a basis: the basis itself if it is not weighted.
fn weighted<'b, S>(basis: &'b [Vec<S>], weighted: &'b [Vec<S>]) -> &'b [Vec<S>] {
    if weighted.is_empty() { basis } else { weighted }
}
