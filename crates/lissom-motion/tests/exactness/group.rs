//! The group of motions: exponential and logarithm, composition, adjoint action, and what the tangent means on it.

use std::f64::consts::PI;

use lissom_motion::{
    CurvedTangent, DualMatrix, Matrix6, Motion, Pose, Rotation, Screw, ScrewTangent, Vector6,
    coadjoint_matrix, inverse_tangent, inverse_tangent_times, inverse_tangent_transpose_times, lie_bracket,
    lie_bracket_matrix, rotation_part, rotation_tangent, tangent, tangent_derivative,
    tangent_derivative_rate, tangent_derivative_transpose_times, tangent_hessian, tangent_rate,
    tangent_rate_times, tangent_times, tangent_transpose_derivative, tangent_transpose_times,
    translation_part,
};
use proptest::prelude::*;

use crate::arguments::{any_twist, plain_vector};
use crate::errors::error;
use crate::series::unit;

/// Rotation and position of `a⁻¹ b` away from none, the position relative to `size`.
fn distance(a: Motion, b: Motion, size: f64) -> f64 {
    let rotation = (a.rotation.inverse() * b.rotation).matrix();
    let turned = rotation.map_with_location(|i, j, x| x - f64::from(u8::from(i == j))).amax();
    turned.max((a.position - b.position).amax() / (1.0 + size))
}

/// Sixth-order central difference of `f` at 0.
fn difference<R: nalgebra::Dim, C: nalgebra::Dim>(
    f: impl Fn(f64) -> nalgebra::OMatrix<f64, R, C>,
) -> nalgebra::OMatrix<f64, R, C>
where
    nalgebra::DefaultAllocator: nalgebra::allocator::Allocator<R, C>,
{
    let h = 5e-3;
    let central = |n: f64| f(n * h) - f(-n * h);
    (central(1.0) * 45.0 - central(2.0) * 9.0 + central(3.0)) / (60.0 * h)
}

fn moderate_twist() -> impl Strategy<Value = Vector6> {
    (plain_vector(), 0.0..3.0).prop_map(|(v, scale)| v * scale)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn logarithm_undoes_exponential(d in any_twist()) {
        let motion = Motion::exponential(&d);
        let size = translation_part(&d).amax();
        let logarithm = motion.logarithm();
        prop_assert!(distance(Motion::exponential(&logarithm), motion, 2.0 * size) < 2e-15);
        let angle = rotation_part(&d).norm();
        if angle < PI - 1e-10 {
            prop_assert!((rotation_part(&logarithm) - rotation_part(&d)).amax() <= 1e-15 * angle);
            prop_assert!((translation_part(&logarithm) - translation_part(&d)).amax() <= 6e-15 * size);
        }
    }

    #[test]
    fn motions_form_a_group(a in any_twist(), b in any_twist(), c in any_twist(), p in plain_vector()) {
        let [a, b, c] = [a, b, c].map(|d| Motion::exponential(&d));
        let size = a.position.norm() + b.position.norm() + c.position.norm();
        prop_assert!(distance((a * b) * c, a * (b * c), size) < 4e-15);
        prop_assert!(distance(a * a.inverse(), Motion::identity(), size) < 2e-15);
        prop_assert!(distance(a.inverse() * b, b.relative_to(&a), size) < 3e-15);
        prop_assert!(distance(a * b.relative_to(&a), b, size) < 4e-15);
        prop_assert_eq!(a * Motion::identity(), a);
        let point = translation_part(&p);
        let place = (a * b).transform_point(&point);
        prop_assert!((place - a.transform_point(&b.transform_point(&point))).amax() < 4e-15 * (1.0 + size));
        prop_assert!((a.inverse_transform_point(&a.transform_point(&point)) - point).amax() < 4e-15 * (1.0 + size));
        prop_assert_eq!(Motion::translation(point), Motion::new(Rotation::identity(), point));
    }

    #[test]
    fn adjoint_is_a_homomorphism_and_its_variants_agree(a in any_twist(), b in any_twist(), v in plain_vector(), w in plain_vector()) {
        let (g, h) = (Motion::exponential(&a), Motion::exponential(&b));
        let size = (1.0 + g.position.norm()) * (1.0 + h.position.norm());
        prop_assert!(error(&(g * h).adjoint(), &(g.adjoint() * h.adjoint()), size) < 4e-15);
        prop_assert!(error(&g.adjoint_times(&v), &(g.adjoint() * v), 1.0 + g.position.norm()) < 8e-15);
        prop_assert!(error(&g.adjoint_inverse_times(&v), &(g.inverse().adjoint() * v), 1.0 + g.position.norm()) < 8e-15);
        prop_assert!(error(&g.adjoint_transpose_times(&w), &(g.adjoint().transpose() * w), 1.0 + g.position.norm()) < 8e-15);
        prop_assert!(error(&g.adjoint_inverse_transpose_times(&w), &(g.inverse().adjoint().transpose() * w), 1.0 + g.position.norm()) < 8e-15);
        // Ad of an exponential is the exponential of ad: Ad_exp(d) [v, w] = [Ad v, Ad w].
        let left = g.adjoint_times(&lie_bracket(&v, &w));
        let right = lie_bracket(&g.adjoint_times(&v), &g.adjoint_times(&w));
        prop_assert!(error(&left, &right, 1.0 + g.position.norm()) < 1e-14);
        // H exp(v) H⁻¹ = exp(Ad_H v).
        let moved = g * Motion::exponential(&v) * g.inverse();
        prop_assert!(distance(moved, Motion::exponential(&g.adjoint_times(&v)), g.position.norm()) < 1e-14);
    }

    #[test]
    fn tangent_intertwines_with_the_adjoint(d in any_twist()) {
        // T(-d) = Ad_exp(d) T(d), and T(d) ad_d = I - Ad_exp(-d).
        let motion = Motion::exponential(&d);
        let size = 1.0 + translation_part(&d).norm();
        prop_assert!(error(&(motion.adjoint() * tangent(&d)), &tangent(&-d), size) < 1e-14);
        let left = tangent(&d) * lie_bracket_matrix(&d);
        prop_assert!(error(&left, &(Matrix6::identity() - motion.inverse().adjoint()), size) < 1e-14);
        // A constant body velocity along d: T(d) d = d.
        prop_assert!(error(&tangent_times(&d, &d), &d, size) < 1e-14);
    }

    #[test]
    fn transposes_are_transposes(d in any_twist(), a in plain_vector(), w in plain_vector()) {
        let size = 10.0 * (1.0 + translation_part(&d).norm());
        prop_assert!((w.dot(&tangent_times(&d, &a)) - a.dot(&tangent_transpose_times(&d, &w))).abs() < 2e-15 * size);
        let gradient = tangent_derivative_transpose_times(&d, &a, &w);
        prop_assert!(error(&gradient, &(tangent_derivative(&d, &a).transpose() * w), size) < 2e-15);
        let hessian = tangent_hessian(&d, &a, &w);
        prop_assert!(error(&hessian, &hessian.transpose(), size) < 1e-15);
        // w·(∂(T a)/∂d) r is bilinear in a: the same as a·(∂(Tᵀ w)/∂d) r.
        let r = Vector6::from_fn(|i, _| a[5 - i] - w[i]);
        let (left, right) = (w.dot(&tangent_rate_times(&d, &r, &a)), a.dot(&(tangent_transpose_derivative(&d, &w) * r)));
        prop_assert!((left - right).abs() < 4e-15 * size);
        let rate = tangent_rate(&d, &r) * a;
        prop_assert!(error(&rate, &tangent_rate_times(&d, &r, &a), size) < 4e-15);
        // wᵀ (∂²(T a)/∂d∂d r) is the Hessian's product with r, and ∂(T a)/∂d is linear in a.
        let row = tangent_derivative_rate(&d, (&a, &w), &r).transpose() * w;
        let expected = hessian * r + tangent_derivative(&d, &w).transpose() * w;
        prop_assert!(error(&row, &expected, size) < 1e-14);
    }

    #[test]
    fn prepared_tangents_are_the_functions(d in any_twist(), a in plain_vector()) {
        let prepared = ScrewTangent::new(&d);
        let size = 1.0 + translation_part(&d).norm();
        prop_assert!(error(&prepared.matrix(), &tangent(&d), size) < 1e-15);
        prop_assert!(error(&prepared.times(&a), &tangent_times(&d, &a), size) < 1e-15);
        prop_assert!(error(&prepared.transpose_times(&a), &tangent_transpose_times(&d, &a), size) < 1e-15);
        prop_assert_eq!(ScrewTangent::inverse(&d).matrix(), inverse_tangent(&d));
        let (logarithm, inverse) = Pose::from(&Motion::exponential(&d)).logarithm_and_inverse_tangent();
        let logarithm = Vector6::from(logarithm);
        prop_assert_eq!(logarithm, Motion::exponential(&d).logarithm());
        let expected = inverse_tangent_times(&logarithm, &a);
        prop_assert!(error(&Vector6::from(inverse.times((&a).into())), &expected, size) < 1e-15);
        let expected = inverse_tangent_transpose_times(&logarithm, &a);
        prop_assert!(error(&Vector6::from(inverse.transpose_times((&a).into())), &expected, size) < 1e-15);
        let theta = rotation_part(&d);
        prop_assert!(error(&tangent(&d).fixed_view::<3, 3>(3, 3).into_owned(), &rotation_tangent(&theta), 1.0) < 1e-15);
    }
}

/// Rows of six as a matrix.
fn matrix_of(rows: &[Screw<f64>; 6]) -> Matrix6 {
    Matrix6::from_rows(&rows.map(|row| Vector6::from(row).transpose()))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn matrices_of_dual_numbers_multiply_rows(d in any_twist(), a in plain_vector(), w in plain_vector(), v in any_twist()) {
        let rows = [a, w, a + w, a - w, a * 2.0, w * 3.0].map(|row| Screw::from(&row));
        let matrix = matrix_of(&rows);
        let curved = CurvedTangent::new((&d).into());
        let size = 1.0 + translation_part(&d).norm();
        let tangent = curved.operator.matrix();
        let left = matrix_of(&tangent.transpose_times_rows(&rows));
        prop_assert!(error(&left, &(self::tangent(&d).transpose() * matrix), size) < 4e-15);
        let right = matrix_of(&tangent.times_from_right(&rows));
        prop_assert!(error(&right, &(matrix * self::tangent(&d)), size) < 4e-15);
        let added = |wrench_matrix: DualMatrix<f64>| {
            let mut sum = rows;
            wrench_matrix.add_to(&mut sum);
            matrix_of(&sum)
        };
        let hessian = added(curved.hessian((&a).into(), (&w).into()));
        prop_assert!(error(&hessian, &(matrix + tangent_hessian(&d, &a, &w)), size) < 4e-15);
        let turned = curved.operator.transpose_derivative((&w).into());
        let expected = tangent_transpose_derivative(&d, &w);
        prop_assert!(error(&added(turned), &(matrix + expected), size) < 4e-15);
        prop_assert!(error(&added(turned.transposed()), &(matrix + expected.transpose()), size) < 4e-15);
        let bracket = added(DualMatrix::coadjoint((&w).into()));
        prop_assert!(error(&bracket, &(matrix + coadjoint_matrix(&w)), 1.0) < 4e-15);
        let half = curved.operator.derivative((&a).into()).scaled_by(0.5).plus_scaled(tangent, 2.0);
        let expected = tangent_derivative(&d, &a) * 0.5 + self::tangent(&d) * 2.0;
        prop_assert!(error(&matrix_of(&half.times_from_right(&rows)), &(matrix * expected), size) < 4e-15);
        let motion = Motion::exponential(&v);
        let adjoint = Pose::from(&motion).adjoint_inverse();
        let expected = matrix * motion.inverse().adjoint();
        prop_assert!(error(&matrix_of(&adjoint.times_from_right(&rows)), &expected, 1.0 + motion.position.norm()) < 8e-15);
    }

    #[test]
    fn tangent_is_the_body_derivative_of_the_exponential(d in moderate_twist()) {
        let here = Motion::exponential(&d);
        let columns = std::array::from_fn::<_, 6, _>(|i| {
            difference(|t| Motion::exponential(&(d + unit(i) * t)).relative_to(&here).logarithm())
        });
        prop_assert!(error(&tangent(&d), &Matrix6::from_columns(&columns), 1.0) < 1e-11);
    }

    #[test]
    fn derivatives_are_differences(d in moderate_twist(), a in plain_vector(), w in plain_vector()) {
        let by = |f: &dyn Fn(Vector6) -> Vector6| {
            Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|i| difference(|t| f(d + unit(i) * t))))
        };
        prop_assert!(error(&tangent_derivative(&d, &a), &by(&|d| tangent_times(&d, &a)), 1.0) < 1e-11);
        prop_assert!(error(&tangent_transpose_derivative(&d, &w), &by(&|d| tangent_transpose_times(&d, &w)), 1.0) < 1e-11);
        prop_assert!(error(&tangent_hessian(&d, &a, &w), &by(&|d| tangent_derivative_transpose_times(&d, &a, &w)), 1.0) < 1e-11);
    }
}
