//! The tangent operator, its derivatives and the exponential against power series in extended precision.

use lissom_motion::{
    Matrix3, Matrix6, Motion, Vector3, rotation_exponential_minus_identity, tangent, tangent_derivative,
    tangent_derivative_transpose_times, tangent_hessian, tangent_rate_times, tangent_times,
    tangent_transpose_derivative, tangent_transpose_times,
};
use proptest::prelude::*;

use crate::arguments::{any_twist, plain_vector};
use crate::errors::{TWIST, WRENCH, block_error, error, vector_error};
use crate::series::{
    Jet, constants, derivative_by_jets, exponential_series, jets, tangent_series, tangent_transpose_series,
    unit, values,
};
use crate::wide::Wide;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn exponential_is_the_matrix_exponential(d in any_twist()) {
        let reference = exponential_series(&constants(&d));
        let value = |i: usize, j: usize| reference[j][i].value.value();
        let motion = Motion::exponential(&d);
        prop_assert!(error(&motion.rotation.matrix(), &Matrix3::from_fn(value), 1.0) < 2e-15);
        let size = d.fixed_rows::<3>(0).amax();
        prop_assert!(error(&motion.position, &Vector3::from_fn(|i, _| value(i, 3)), size) < 4e-15);
    }

    #[test]
    fn tangent_is_its_power_series(d in any_twist(), a in plain_vector()) {
        let d_jets = constants(&d);
        let reference = values(&tangent_series(&d_jets, &constants(&a)));
        prop_assert!(vector_error(&d, TWIST, &tangent_times(&d, &a), &reference) < 4e-15);
        let transposed = values(&tangent_transpose_series(&d_jets, &constants(&a)));
        prop_assert!(vector_error(&d, WRENCH, &tangent_transpose_times(&d, &a), &transposed) < 4e-15);
        let columns = std::array::from_fn::<_, 6, _>(|i| values(&tangent_series(&d_jets, &constants(&unit(i)))));
        prop_assert!(block_error(&d, TWIST, &tangent(&d), &Matrix6::from_columns(&columns)) < 4e-15);
    }

    #[test]
    fn first_derivatives_are_those_of_the_series(d in any_twist(), a in plain_vector(), w in plain_vector()) {
        let (a_jets, w_jets) = (constants(&a), constants(&w));
        let by_a = derivative_by_jets(&d, |d| tangent_series(d, &a_jets));
        prop_assert!(block_error(&d, TWIST, &tangent_derivative(&d, &a), &by_a) < 1e-14);
        let by_w = derivative_by_jets(&d, |d| tangent_transpose_series(d, &w_jets));
        prop_assert!(block_error(&d, WRENCH, &tangent_transpose_derivative(&d, &w), &by_w) < 1e-14);
        let gradient = tangent_derivative_transpose_times(&d, &a, &w);
        prop_assert!(vector_error(&d, WRENCH, &gradient, &(by_a.transpose() * w)) < 1e-14);
        prop_assert!(vector_error(&d, TWIST, &tangent_rate_times(&d, &w, &a), &(by_a * w)) < 1e-14);
    }

    #[test]
    fn small_increments_keep_their_digits(d in any_twist(), scale in 0..300_i32) {
        let psi = d * 10.0_f64.powi(-scale);
        let series = exponential_series(&constants(&psi));
        let one = Wide::new(-1.0);
        let minus_identity = |i: usize, j: usize| if i == j { series[j][i].value + one } else { series[j][i].value };
        let reference = Matrix3::from_fn(|i, j| minus_identity(i, j).value());
        let theta = Vector3::new(psi[3], psi[4], psi[5]);
        // The reference itself subtracts the identity from 31 digits; near a whole turn the difference has the error of the angle.
        let floor = theta.norm().max(1e-14);
        prop_assert!(error(&rotation_exponential_minus_identity(&theta), &reference, floor) < 4e-15);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(150) })]

    #[test]
    fn hessian_is_that_of_the_series(d in any_twist(), a in plain_vector(), w in plain_vector()) {
        let a_jets = constants(&a);
        let reference = Matrix6::from_fn(|i, j| {
            let moved = tangent_series(&jets(&d, &unit(i), &unit(j)), &a_jets);
            let power = (0..6).fold(Jet::default(), |sum, k| sum + Jet::new(w[k], 0.0, 0.0) * moved[k]);
            power.mixed.value()
        });
        prop_assert!(block_error(&d, WRENCH, &tangent_hessian(&d, &a, &w), &reference) < 2e-14);
    }
}
