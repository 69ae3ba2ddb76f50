//! Errors of vectors and matrices, relative to sizes that rounding may be compared with.

use lissom_motion::{Matrix6, Vector6};

/// Largest difference, relative to the largest entry of the reference plus `floor`.
pub(crate) fn error<R, C, S1, S2>(
    computed: &nalgebra::Matrix<f64, R, C, S1>,
    reference: &nalgebra::Matrix<f64, R, C, S2>,
    floor: f64,
) -> f64
where
    R: nalgebra::Dim,
    C: nalgebra::Dim,
    S1: nalgebra::RawStorage<f64, R, C>,
    S2: nalgebra::RawStorage<f64, R, C>,
{
    let mut worst = 0.0_f64;
    let mut largest = floor;
    for (a, b) in computed.iter().zip(reference.iter()) {
        assert!(a.is_finite(), "not finite: {a}");
        worst = worst.max((a - b).abs());
        largest = largest.max(b.abs());
    }
    if largest == 0.0 { worst } else { worst / largest }
}

/// Rows where the dual part of a twist or of a wrench is.
pub(crate) const TWIST: usize = 0;
pub(crate) const WRENCH: usize = 3;

/// Largest error of a block, relative to itself, to one, and to `|u|` where the translation `u` enters.
pub(crate) fn vector_error(d: &Vector6, dual_row: usize, computed: &Vector6, reference: &Vector6) -> f64 {
    [0, 3].into_iter().fold(0.0, |worst: f64, i| {
        let floor = if i == dual_row { 1.0 + d.fixed_rows::<3>(0).norm() } else { 1.0 };
        worst.max(error(&computed.fixed_rows::<3>(i), &reference.fixed_rows::<3>(i), floor))
    })
}

/// The same for the blocks of a matrix whose columns are twists.
pub(crate) fn block_error(d: &Vector6, dual_row: usize, computed: &Matrix6, reference: &Matrix6) -> f64 {
    let mut worst = 0.0_f64;
    for i in [0, 3] {
        for j in [0, 3] {
            let is_dual = i == dual_row && j == 3;
            let floor = if is_dual { 1.0 + d.fixed_rows::<3>(0).norm() } else { 1.0 };
            worst = worst.max(error(
                &computed.fixed_view::<3, 3>(i, j),
                &reference.fixed_view::<3, 3>(i, j),
                floor,
            ));
        }
    }
    worst
}
