//! Singular values of small matrices to double precision, for any ratio of their magnitudes: one-sided Jacobi in
//! extended precision.
//!
//! Hestenes 1958: rotations from the right make the columns orthogonal; their lengths are then the singular
//! values. In double precision values below 1e-16 of the largest are noise; here the limit is about 1e-30.

use lissom_solver::{Pattern, Scalar};

use super::extended::Extended;

/// Columns are considered orthogonal if the cosine between them is below this: the remainder changes the lengths by a
/// relative amount of that order.
const ORTHOGONAL: f64 = 1e-13;

/// Convergence is quadratic after a few sweeps; more than this number are never needed.
const SWEEPS: usize = 60;

/// Singular values, largest first, of a square matrix of `size` rows, given column by column.
///
/// # Panics
/// If there are not `size²` numbers.
pub(super) fn singular_values(size: usize, matrix: &[f64]) -> Vec<f64> {
    assert_eq!(matrix.len(), size * size, "a square matrix");
    let mut columns: Vec<Vec<Extended>> = matrix
        .chunks(size.max(1))
        .map(|column| column.iter().copied().map(Extended::from).collect())
        .collect();
    // Long columns first: fewer sweeps [de Rijk 1989].
    columns.sort_by(|a, b| dot(b, b).to_f64().total_cmp(&dot(a, a).to_f64()));
    for _ in 0..SWEEPS {
        let mut orthogonal = true;
        for second in 1..size {
            let (before, from_second) = columns.split_at_mut(second);
            for first in before {
                orthogonal &= make_orthogonal(first, &mut from_second[0]);
            }
        }
        if orthogonal {
            break;
        }
    }
    let mut values: Vec<f64> = columns.iter().map(|column| dot(column, column).sqrt().to_f64()).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Condition number in the 2-norm of the matrix with these values: largest over smallest singular value, infinite for
/// a singular matrix. Accurate up to about 1e28. The time grows with the cube of the size.
///
/// # Panics
/// If the number of values is not that of the entries in the pattern.
pub(super) fn condition_number<S: Scalar>(pattern: &Pattern, values: &[S]) -> f64 {
    assert_eq!(values.len(), pattern.entries(), "one value for each entry of the pattern");
    let count = pattern.size();
    if count == 0 {
        return 1.0;
    }
    // A complex matrix has the singular values of [Re, -Im; Im, Re], which has each of them twice.
    let size = if S::COMPLEX { 2 * count } else { count };
    let mut matrix = vec![0.0; size * size];
    for column in 0..count {
        let start = pattern.column_starts()[column];
        for (offset, &row) in pattern.column(column).iter().enumerate() {
            let [real, imaginary] = values[start + offset].parts();
            matrix[row + column * size] = real;
            if S::COMPLEX {
                matrix[row + count + (column + count) * size] = real;
                matrix[row + count + column * size] = imaginary;
                matrix[row + (column + count) * size] = -imaginary;
            }
        }
    }
    let values = singular_values(size, &matrix);
    let (largest, smallest) = (values[0], values[size - 1]);
    if smallest > 0.0 || largest.is_nan() { largest / smallest } else { f64::INFINITY }
}

fn dot(a: &[Extended], b: &[Extended]) -> Extended {
    a.iter().zip(b).fold(Extended::ZERO, |sum, (&a, &b)| sum + a * b)
}

/// Rotates two columns until they are orthogonal; returns whether they were so before.
fn make_orthogonal(first: &mut [Extended], second: &mut [Extended]) -> bool {
    let (a, b, c) = (dot(first, first), dot(second, second), dot(first, second));
    let limit = ORTHOGONAL * (a.to_f64().sqrt() * b.to_f64().sqrt());
    // A column of zeros is orthogonal to every other, and remains zero.
    if c.to_f64().abs() <= limit {
        return true;
    }
    // The smaller root t of t² + 2 ζ t = 1, tangent of the angle [Rutishauser 1966].
    let zeta = (b - a) / (c + c);
    let size = zeta.abs();
    let root = (Extended::ONE + size * size).sqrt();
    let tangent = Extended::ONE / (size + root);
    let tangent = if zeta < Extended::ZERO { -tangent } else { tangent };
    let cosine = Extended::ONE / (Extended::ONE + tangent * tangent).sqrt();
    let sine = cosine * tangent;
    for (x, y) in first.iter_mut().zip(second) {
        let (old, other) = (*x, *y);
        *x = cosine * old - sine * other;
        *y = sine * old + cosine * other;
    }
    false
}

#[cfg(test)]
mod tests {
    use num_complex::Complex64;
    use proptest::prelude::*;

    use super::*;

    /// Binomial coefficients `(i + j over i)`, all exact in double precision.
    fn pascal(size: usize) -> Vec<f64> {
        let mut matrix = vec![1.0; size * size];
        for j in 1..size {
            for i in 1..size {
                matrix[i + j * size] = matrix[i - 1 + j * size] + matrix[i + (j - 1) * size];
            }
        }
        matrix
    }

    fn full(size: usize) -> Pattern {
        Pattern::from_entries(size, (0..size).flat_map(|i| (0..size).map(move |j| (i, j))))
    }

    #[test]
    fn pascal_matrices_have_reciprocal_pairs() {
        // The inverse is similar to the matrix: the reciprocal of every singular value is also one.
        let size = 20;
        let values = singular_values(size, &pascal(size));
        assert!(values[0] / values[size - 1] > 1e20);
        for (large, small) in values.iter().zip(values.iter().rev()) {
            assert!((large * small - 1.0).abs() < 1e-9, "{large:e} {small:e}");
        }
    }

    #[test]
    fn shear_is_known_in_closed_form() {
        for exponent in [0, 4, 8, 12] {
            let x = 10.0_f64.powi(exponent);
            let values = singular_values(2, &[1.0, 0.0, x, 1.0]);
            let wanted = f64::midpoint(x * x + 2.0, x * (x * x + 4.0).sqrt());
            let condition = values[0] / values[1];
            assert!((condition / wanted - 1.0).abs() < 1e-7, "{condition:e} for {wanted:e}");
        }
    }

    #[test]
    fn saddle_points_beyond_double_precision() {
        // [a, 1; 1, 0] has the singular values (√(a² + 4) ± a)/2.
        let a = 1e12;
        let condition = condition_number(&full(2), &[a, 1.0, 1.0, 0.0]);
        assert!((condition / (a * a) - 1.0).abs() < 1e-9, "{condition:e}");
        let turned = [a, 1.0, 1.0, 0.0].map(|value| Complex64::from_polar(1.0, 0.0) * value * Complex64::i());
        assert!((condition_number(&full(2), &turned) / condition - 1.0).abs() < 1e-12);
    }

    #[test]
    fn singular_and_empty_matrices() {
        assert_eq!(singular_values(0, &[]), Vec::<f64>::new());
        assert_eq!(condition_number::<f64>(&full(0), &[]), 1.0);
        assert_eq!(condition_number(&full(2), &[1.0, 0.0, 0.0, 0.0]), f64::INFINITY);
    }

    proptest! {
        #[test]
        fn permutations_and_signs_do_not_matter(numbers in prop::collection::vec(-1.0..1.0_f64, 16)) {
            let values = singular_values(4, &numbers);
            let mut other: Vec<f64> = numbers.iter().map(|value| -value).collect();
            other.rotate_left(4);
            let again = singular_values(4, &other);
            for (a, b) in values.iter().zip(&again) {
                prop_assert!((a - b).abs() <= 1e-12 * values[0]);
            }
            // The squares sum up to the square of the Frobenius norm.
            let (sum, norm) = (values.iter().map(|x| x * x).sum::<f64>(), numbers.iter().map(|x| x * x).sum::<f64>());
            prop_assert!((sum - norm).abs() <= 1e-12 * norm.max(1e-300));
        }
    }
}
