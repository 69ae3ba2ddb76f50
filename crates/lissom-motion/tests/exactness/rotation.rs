//! Rotations: exponential and logarithm, quaternions, matrices, axes.

use std::f64::consts::PI;

use lissom_motion::{Matrix3, Rotation, Vector3, rotation_part, translation_part};
use proptest::prelude::*;

use crate::arguments::{any_twist, direction, nasty_angle, plain_vector};
use crate::errors::error;

/// Largest entry of `Rᵀ S - I`, blind to the sign of the quaternion.
fn distance(a: Rotation, b: Rotation) -> f64 {
    (a.inverse() * b).matrix().map_with_location(|i, j, x| x - f64::from(u8::from(i == j))).amax()
}

#[test]
fn half_turns_have_a_definite_logarithm() {
    for axis in [Vector3::x(), -Vector3::x(), Vector3::y(), Vector3::new(0.0, -1.0, 1.0).normalize()] {
        let zero = Rotation::from_quaternion([0.0, axis.x, axis.y, axis.z]).unwrap();
        let minus_zero = Rotation::from_quaternion([-0.0, -axis.x, -axis.y, -axis.z]).unwrap();
        let theta = zero.logarithm();
        assert_eq!(theta, minus_zero.logarithm());
        assert!((theta.norm() - PI).abs() < 1e-15);
        assert!(theta.iter().find(|&&component| component != 0.0).unwrap() > &0.0);
    }
}

#[test]
fn a_quarter_turn_is_right_handed() {
    let quarter = Rotation::about_axis(&Vector3::z(), 0.5 * PI);
    assert!((quarter.apply(&Vector3::x()) - Vector3::y()).norm() < 1e-15);
    assert!(
        (Rotation::exponential(&(Vector3::z() * (0.5 * PI))).apply(&Vector3::x()) - Vector3::y()).norm()
            < 1e-15
    );
    assert_eq!(Rotation::identity(), Rotation::IDENTITY);
    assert_eq!(Rotation::default(), Rotation::IDENTITY);
    assert_eq!(Rotation::IDENTITY.logarithm(), Vector3::zeros());
}

#[test]
fn axes_that_span_no_plane_are_refused() {
    let (zero, axis) = (Vector3::zeros(), Vector3::new(1.0, 2.0, 3.0));
    for (first, second) in [(zero, axis), (axis, zero), (axis, axis * -7.0), (axis, axis * f64::NAN)] {
        assert_eq!(Rotation::from_axis_and_reference(&first, &second), None);
    }
    assert_eq!(Rotation::from_columns(&Vector3::x(), &Vector3::y(), &-Vector3::z()), None);
    assert_eq!(Rotation::from_columns(&Vector3::x(), &Vector3::y(), &zero), None);
    assert_eq!(Rotation::from_columns(&(Vector3::x() * 2.0), &(Vector3::y() * 0.5), &Vector3::z()), None);
    assert_eq!(Rotation::from_quaternion([0.0; 4]), None);
    assert_eq!(Rotation::from_quaternion([1.0, f64::NAN, 0.0, 0.0]), None);
    assert_eq!(Rotation::from_quaternion([f64::INFINITY, 0.0, 0.0, 0.0]), None);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn logarithm_undoes_exponential(axis in direction(), angle in nasty_angle()) {
        let theta = axis * angle;
        let rotation = Rotation::exponential(&theta);
        let logarithm = rotation.logarithm();
        prop_assert!(logarithm.norm() <= PI * (1.0 + 2e-16));
        if angle < PI - 1e-10 {
            prop_assert!((logarithm - theta).amax() <= 1e-15 * angle, "{logarithm} {theta}");
        }
        prop_assert!(distance(Rotation::exponential(&logarithm), rotation) < 1.5e-15);
        let other = rotation.quaternion().map(|component| -component);
        prop_assert_eq!(Rotation::from_quaternion(other).unwrap().logarithm().norm() <= PI * (1.0 + 2e-16), true);
        // The norm of the axis is 1 to round-off, so that the angles of both differ by a few 1e-16 of the angle.
        prop_assert!(distance(Rotation::about_axis(&axis, angle), rotation) < 2e-15 + 4e-16 * angle);
    }

    #[test]
    fn products_and_matrices_agree(a in any_twist(), b in any_twist(), v in plain_vector()) {
        let (r, s) = (Rotation::exponential(&rotation_part(&a)), Rotation::exponential(&rotation_part(&b)));
        let v = translation_part(&v);
        prop_assert!(error(&(r * s).matrix(), &(r.matrix() * s.matrix()), 1.0) < 3e-15);
        prop_assert!((r.apply(&v) - r.matrix() * v).amax() < 2e-15);
        prop_assert!((r.apply_inverse(&v) - r.matrix().transpose() * v).amax() < 2e-15);
        prop_assert!((r.inverse().apply(&v) - r.apply_inverse(&v)).amax() < 2e-15);
        prop_assert!(error(&(r.matrix().transpose() * r.matrix()), &Matrix3::identity(), 1.0) < 4e-15);
        prop_assert!((r.matrix().determinant() - 1.0).abs() < 5e-15);
    }

    #[test]
    fn matrices_and_quaternions_go_round(a in any_twist(), scale in -200..200_i32) {
        let rotation = Rotation::exponential(&rotation_part(&a));
        prop_assert!(distance(Rotation::from_matrix(&rotation.matrix()), rotation) < 2e-15);
        let columns = rotation.matrix();
        let [x, y, z] = [0, 1, 2].map(|j| columns.column(j).into_owned());
        prop_assert!(distance(Rotation::from_columns(&x, &y, &z).unwrap(), rotation) < 2e-15);
        let factor = 10.0_f64.powi(scale);
        let scaled = rotation.quaternion().map(|component| component * factor);
        prop_assert!(distance(Rotation::from_quaternion(scaled).unwrap(), rotation) < 2e-15);
    }

    #[test]
    fn the_nearest_rotation_is_the_polar_factor(a in any_twist(), p in plain_vector(), size in -8.0..-0.7) {
        // A rotation times a symmetric positive matrix: the rotation is the nearest one.
        let rotation = Rotation::exponential(&rotation_part(&a));
        let (d, o) = (translation_part(&p), rotation_part(&p));
        let strain = Matrix3::new(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z) * 10.0_f64.powf(size);
        let nearest = Rotation::from_matrix(&(rotation.matrix() * (Matrix3::identity() + strain)));
        prop_assert!(distance(nearest, rotation) < 1e-14);
    }

    #[test]
    fn axis_and_reference_span_the_first_two_axes(
        a in plain_vector(),
        size in -100..100_i32,
        sine in (-8.0..0.0).prop_map(|x: f64| 10.0_f64.powf(x)),
    ) {
        let axis = translation_part(&a);
        prop_assume!(axis.cross(&rotation_part(&a)).norm() > 1e-2);
        let aside = axis.cross(&rotation_part(&a)).normalize();
        let reference = (axis.normalize() + aside * sine) * 10.0_f64.powi(size);
        let rotation = Rotation::from_axis_and_reference(&axis, &reference).unwrap();
        prop_assert!((rotation.apply(&Vector3::x()) - axis.normalize()).amax() < 2e-15);
        let in_body = rotation.apply_inverse(&reference) / reference.norm();
        prop_assert!(in_body.z.abs() < 2e-15 && in_body.y > 0.5 * sine);
    }

    #[test]
    fn normalising_removes_drift(a in any_twist(), b in any_twist()) {
        let step = Rotation::exponential(&rotation_part(&a));
        let mut rotation = Rotation::exponential(&rotation_part(&b));
        for _ in 0..1000 {
            rotation = rotation * step;
        }
        let length: f64 = rotation.normalized().quaternion().iter().map(|component| component * component).sum();
        prop_assert!((length - 1.0).abs() < 1e-15);
        prop_assert!(distance(rotation.normalized(), rotation) < 1e-12);
    }
}
