//! Checks of the values of a matrix: whether they are finite, and the largest magnitude.

use crate::pattern::Pattern;
use crate::report::FactorError;
use crate::scalar::Scalar;

/// Largest magnitude among the values.
///
/// # Errors
/// [`FactorError::NotFinite`] with the column of the first value that is not finite.
pub(crate) fn largest_entry<S: Scalar>(pattern: &Pattern, values: &[S]) -> Result<f64, FactorError> {
    largest_magnitude(values).ok_or_else(|| first_not_finite(pattern, values))
}

/// Largest magnitude, if all values are finite.
#[inline(always)]
pub(crate) fn largest_magnitude<S: Scalar>(values: &[S]) -> Option<f64> {
    const LANES: usize = 32;
    let mut largest = [0.0_f64; LANES];
    // Zero times a finite number is zero; any other product is not.
    let mut probe = [0.0_f64; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for lane in 0..LANES {
            let magnitude = chunk[lane].magnitude();
            probe[lane] += magnitude * 0.0;
            largest[lane] = if magnitude > largest[lane] { magnitude } else { largest[lane] };
        }
    }
    for (lane, value) in rest.iter().enumerate() {
        let magnitude = value.magnitude();
        probe[lane] += magnitude * 0.0;
        largest[lane] = if magnitude > largest[lane] { magnitude } else { largest[lane] };
    }
    if probe.iter().all(|&probe| probe == 0.0) {
        return Some(largest.iter().fold(0.0, |largest, &lane| largest.max(lane)));
    }
    None
}

/// The column of the first value that is not finite.
#[cold]
pub(crate) fn first_not_finite<S: Scalar>(pattern: &Pattern, values: &[S]) -> FactorError {
    let entry = values.iter().position(|value| !value.magnitude().is_finite()).unwrap_or(0);
    let unknown = pattern.column_starts().partition_point(|&start| start <= entry) - 1;
    FactorError::NotFinite { unknown }
}
