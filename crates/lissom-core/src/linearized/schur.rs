//! Schur form of a complex matrix by the single-shift QR algorithm [Golub and Van Loan 2013, section 7.5], with exceptional shifts
//! and deflation where the diagonal vanishes: matrices of shift-and-invert operators have many zero eigenvalues, where a subdiagonal
//! entry is never small relative to its neighbours on the diagonal.

use crate::tuning::MAX_ITERATIONS;
use nalgebra::{DMatrix, Hessenberg};
use num_complex::Complex64;

/// Number of iterations without deflation before an exceptional shift.
const EXCEPTIONAL: usize = 10;
/// A subdiagonal entry below this fraction of the matrix's norm, times the round-off, is zero regardless of its
/// neighbours.
const TINY: f64 = 1e-12;

/// Unitary Q and upper triangular T with A = Q T Qᴴ; none if an entry is not finite or the iteration does not converge.
pub(super) fn schur(matrix: DMatrix<Complex64>) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)> {
    let order = matrix.nrows();
    let norm = matrix.norm();
    if !norm.is_finite() {
        return None;
    }
    if order < 2 {
        return Some((DMatrix::identity(order, order), matrix));
    }
    let (mut q, mut hessenberg) = Hessenberg::new(matrix).unpack();
    let mut high = order - 1;
    let mut iterations = 0;
    while high > 0 {
        let low = block_start(&mut hessenberg, high, norm);
        if low == high {
            high -= 1;
            iterations = 0;
            continue;
        }
        iterations += 1;
        if iterations > MAX_ITERATIONS {
            return None;
        }
        let shift = if iterations % EXCEPTIONAL == 0 {
            hessenberg[(high, high)] + 0.75 * hessenberg[(high, high - 1)].norm()
        } else {
            wilkinson(&hessenberg, high)
        };
        sweep((&mut q, &mut hessenberg), low, high, shift);
    }
    Some((q, hessenberg))
}

/// The first row of the unreduced block that ends at `high`; negligible entries below the diagonal become zero.
fn block_start(hessenberg: &mut DMatrix<Complex64>, high: usize, norm: f64) -> usize {
    let mut low = high;
    while low > 0 {
        let below = hessenberg[(low, low - 1)].norm();
        let beside = hessenberg[(low, low)].norm() + hessenberg[(low - 1, low - 1)].norm();
        if below <= f64::EPSILON * beside.max(TINY * norm) {
            hessenberg[(low, low - 1)] = Complex64::default();
            break;
        }
        low -= 1;
    }
    low
}

/// The eigenvalue of the last block of two that is nearest to its last entry.
fn wilkinson(hessenberg: &DMatrix<Complex64>, high: usize) -> Complex64 {
    let (a, b) = (hessenberg[(high - 1, high - 1)], hessenberg[(high - 1, high)]);
    let (c, d) = (hessenberg[(high, high - 1)], hessenberg[(high, high)]);
    let half = 0.5 * (a - d);
    let root = (half * half + b * c).sqrt();
    let [plus, minus] = [half + root, half - root];
    d + if plus.norm() < minus.norm() { plus } else { minus }
}

/// One QR step of the block from `low` to `high`.
fn sweep(
    (q, hessenberg): (&mut DMatrix<Complex64>, &mut DMatrix<Complex64>),
    low: usize,
    high: usize,
    shift: Complex64,
) {
    let order = hessenberg.nrows();
    let (mut x, mut y) = (hessenberg[(low, low)] - shift, hessenberg[(low + 1, low)]);
    for k in low..high {
        let (cosine, sine) = rotation(x, y);
        for column in k.saturating_sub(1).max(low)..order {
            let (upper, lower) = (hessenberg[(k, column)], hessenberg[(k + 1, column)]);
            hessenberg[(k, column)] = cosine * upper + sine * lower;
            hessenberg[(k + 1, column)] = cosine * lower - sine.conj() * upper;
        }
        let turn = |matrix: &mut DMatrix<Complex64>, rows: usize| {
            for row in 0..rows {
                let (left, right) = (matrix[(row, k)], matrix[(row, k + 1)]);
                matrix[(row, k)] = cosine * left + sine.conj() * right;
                matrix[(row, k + 1)] = cosine * right - sine * left;
            }
        };
        turn(hessenberg, (k + 3).min(high + 1));
        turn(q, order);
        if k > low {
            hessenberg[(k + 1, k - 1)] = Complex64::default();
        }
        if k + 1 < high {
            (x, y) = (hessenberg[(k + 1, k)], hessenberg[(k + 2, k)]);
        }
    }
}

/// c and s with c x + s y = r, c y - s̄ x = 0.
fn rotation(x: Complex64, y: Complex64) -> (f64, Complex64) {
    let size = x.norm().hypot(y.norm());
    if size == 0.0 {
        (1.0, Complex64::default())
    } else if x.norm() == 0.0 {
        (0.0, y.conj() / y.norm())
    } else {
        (x.norm() / size, x / x.norm() * y.conj() / size)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/linearized/schur.rs"]
mod tests;
