//! No argument that is finite and not absurd makes a number that is not finite.

use std::f64::consts::PI;

use lissom_motion::{
    Motion, Rotation, Vector3, Vector6, inverse_tangent, inverse_tangent_derivative, inverse_tangent_hessian,
    rotation_exponential_minus_identity, rotation_part, screw, tangent, tangent_derivative,
    tangent_derivative_transpose_times, tangent_hessian, translation_part,
};

fn extremes() -> Vec<f64> {
    let mut values =
        vec![0.0, f64::from_bits(1), f64::MIN_POSITIVE, 1e-300, 1e-162, 1e-154, 1e-100, 1e-16, 1e-8];
    values.extend([0.25, 1.0, 3.0, 5.0, 7.0, 8.0, 100.0, 1e8, 1e16, 1e30]);
    for n in 1..8 {
        let turn = PI * f64::from(n);
        values.extend([turn, turn.next_up(), turn.next_down()]);
    }
    values.extend([39.478_417_604_357_43_f64.sqrt(), 157.913_670_417_429_73_f64.sqrt(), 60.0_f64.sqrt()]);
    values
}

fn finite<const N: usize>(values: [&[f64]; N], twist: &Vector6) {
    assert!(values.iter().all(|list| list.iter().all(|value| value.is_finite())), "{twist}: {values:?}");
}

#[test]
fn nothing_is_ever_not_finite() {
    let axes = [Vector3::x(), -Vector3::z(), Vector3::new(1.0, -2.0, 0.5).normalize()];
    let other = Vector6::new(1.0, -2.0, 3.0, -0.5, 0.25, 1.0);
    for angle in extremes() {
        for length in [0.0, 1e-300, 1e-8, 1.0, 1e8] {
            for axis in axes {
                let d = screw(&(Vector3::new(0.6, 0.0, -0.8) * length), &(axis * angle));
                let motion = Motion::exponential(&d);
                finite(
                    [motion.position.as_slice(), motion.logarithm().as_slice(), motion.adjoint().as_slice()],
                    &d,
                );
                finite([tangent(&d).as_slice(), inverse_tangent(&d).as_slice()], &d);
                finite(
                    [
                        tangent_derivative(&d, &other).as_slice(),
                        tangent_hessian(&d, &other, &other).as_slice(),
                    ],
                    &d,
                );
                finite([inverse_tangent_derivative(&d, &other).as_slice()], &d);
                finite([inverse_tangent_hessian(&d, &other, &other).as_slice()], &d);
                finite([tangent_derivative_transpose_times(&d, &other, &other).as_slice()], &d);
                finite([rotation_exponential_minus_identity(&rotation_part(&d)).as_slice()], &d);
            }
        }
    }
}

#[test]
fn a_far_away_motion_keeps_its_small_relative_motion() {
    // Two frames 1e6 m away from the origin, 1e-9 rad and 1e-3 m apart.
    let step = Vector6::new(1e-3, 0.0, -2e-3, 1e-9, 3e-9, -2e-9);
    let base =
        Motion::new(Rotation::exponential(&Vector3::new(0.3, -2.0, 1.0)), Vector3::new(1e6, -2e6, 3e6));
    let error = (base * Motion::exponential(&step)).relative_to(&base).logarithm() - step;
    assert!(translation_part(&error).amax() < 1e-9, "{error}");
    assert!(rotation_part(&error).amax() < 2e-16, "{error}");
}
