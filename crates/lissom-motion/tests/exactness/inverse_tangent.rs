//! The inverse tangent operator and its derivatives against elimination on the power series in extended precision.

use lissom_motion::{
    Matrix6, Vector6, inverse_tangent, inverse_tangent_derivative,
    inverse_tangent_derivative_transpose_times, inverse_tangent_hessian, inverse_tangent_times,
    inverse_tangent_transpose_derivative, inverse_tangent_transpose_times, rotation_inverse_tangent,
    rotation_tangent, screw, tangent,
};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::arguments::{any_twist, plain_vector};
use crate::errors::{TWIST, WRENCH, block_error, error, vector_error};
use crate::series::{
    Jet, constants, derivative_by_jets, inverse_tangent_by_elimination, jets, tangent_series, unit, values,
};

/// The inverse has a pole at a whole turn; the angle itself is known there to so many digits less.
fn conditioning(d: &Vector6) -> f64 {
    let gap = 2.0 * std::f64::consts::PI - d.fixed_rows::<3>(3).norm();
    (6.0 / gap).max(1.0)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn inverse_tangent_is_the_inverse(d in any_twist(), a in plain_vector()) {
        let tolerance = 4e-15 * conditioning(&d);
        let (d_jets, a_jets) = (constants(&d), constants(&a));
        let reference = values(&inverse_tangent_by_elimination(&d_jets, &a_jets, false));
        prop_assert!(vector_error(&d, TWIST, &inverse_tangent_times(&d, &a), &reference) < tolerance);
        let transposed = values(&inverse_tangent_by_elimination(&d_jets, &a_jets, true));
        prop_assert!(vector_error(&d, WRENCH, &inverse_tangent_transpose_times(&d, &a), &transposed) < tolerance);
        let columns = std::array::from_fn::<_, 6, _>(|i| {
            values(&inverse_tangent_by_elimination(&d_jets, &constants(&unit(i)), false))
        });
        prop_assert!(block_error(&d, TWIST, &inverse_tangent(&d), &Matrix6::from_columns(&columns)) < tolerance);
    }

    #[test]
    fn tangent_times_its_inverse_is_the_identity(d in any_twist(), a in plain_vector()) {
        let product = tangent(&d) * inverse_tangent(&d);
        let size = inverse_tangent(&d).amax();
        prop_assert!(error(&product, &Matrix6::identity(), size * (1.0 + d.norm())) < 2e-14);
        let back = inverse_tangent_times(&d, &values(&tangent_series(&constants(&d), &constants(&a))));
        prop_assert!(error(&back, &a, size * (1.0 + d.norm())) < 2e-14);
        let theta = Vector3::new(d[3], d[4], d[5]);
        let inverse = rotation_inverse_tangent(&theta);
        prop_assert!(error(&(inverse * rotation_tangent(&theta)), &nalgebra::Matrix3::identity(), inverse.amax()) < 4e-15);
        let block = inverse_tangent(&screw(&Vector3::zeros(), &theta));
        prop_assert_eq!(block.fixed_view::<3, 3>(0, 0).into_owned(), inverse);
    }

    #[test]
    fn first_derivatives_are_those_of_elimination(d in any_twist(), a in plain_vector(), w in plain_vector()) {
        let tolerance = 1e-14 * conditioning(&d);
        let (a_jets, w_jets) = (constants(&a), constants(&w));
        let by_a = derivative_by_jets(&d, |d| inverse_tangent_by_elimination(d, &a_jets, false));
        prop_assert!(block_error(&d, TWIST, &inverse_tangent_derivative(&d, &a), &by_a) < tolerance);
        let by_w = derivative_by_jets(&d, |d| inverse_tangent_by_elimination(d, &w_jets, true));
        prop_assert!(block_error(&d, WRENCH, &inverse_tangent_transpose_derivative(&d, &w), &by_w) < tolerance);
        let gradient = inverse_tangent_derivative_transpose_times(&d, &a, &w);
        let scale = 1.0 + by_a.amax() / (1.0 + d.amax());
        prop_assert!(vector_error(&d, WRENCH, &gradient, &(by_a.transpose() * w)) < tolerance * scale);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn hessian_is_that_of_elimination(d in any_twist(), a in plain_vector(), w in plain_vector()) {
        let a_jets = constants(&a);
        let reference = Matrix6::from_fn(|i, j| {
            let moved = inverse_tangent_by_elimination(&jets(&d, &unit(i), &unit(j)), &a_jets, false);
            let power = (0..6).fold(Jet::default(), |sum, k| sum + Jet::new(w[k], 0.0, 0.0) * moved[k]);
            power.mixed.value()
        });
        let hessian = inverse_tangent_hessian(&d, &a, &w);
        prop_assert!(block_error(&d, WRENCH, &hessian, &reference) < 2e-14 * conditioning(&d));
    }
}
