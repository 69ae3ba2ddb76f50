//! Random and nasty arguments.

use std::f64::consts::PI;

use lissom_motion::{Vector3, Vector6, screw};
use proptest::prelude::*;

/// Angles at which something changes: zero, underflow, every switch of a series, half turn, nearly a whole turn.
pub(crate) fn nasty_angle() -> impl Strategy<Value = f64> {
    let around = |q: f64| [q.sqrt() * (1.0 - 1e-15), q.sqrt() * (1.0 + 1e-15)];
    let mut angles =
        vec![0.0, 1e-300, 1e-160, 1e-16, 1e-8, 1e-4, 0.1, 1.0, PI - 1e-9, PI, PI + 1e-9, 2.0 * PI - 0.1];
    for q in [1.0 / 16.0, 1.0, 9.0, 22.0] {
        angles.extend(around(q));
    }
    prop_oneof![proptest::sample::select(angles), 0.0..6.18, (-9.0..0.0).prop_map(|x: f64| 10.0_f64.powf(x))]
}

pub(crate) fn direction() -> impl Strategy<Value = Vector3> {
    prop_oneof![
        proptest::sample::select(vec![Vector3::x(), -Vector3::y(), Vector3::z()]),
        [-1.0..1.0, -1.0..1.0, -1.0..1.0]
            .prop_filter("direction", |v| Vector3::from(*v).norm() > 0.1)
            .prop_map(|v| Vector3::from(v).normalize()),
    ]
}

pub(crate) fn length() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1e-200), Just(1e6), 0.0..3.0]
}

pub(crate) fn any_twist() -> impl Strategy<Value = Vector6> {
    (direction(), nasty_angle(), direction(), length())
        .prop_map(|(axis, angle, towards, length)| screw(&(towards * length), &(axis * angle)))
}

pub(crate) fn plain_vector() -> impl Strategy<Value = Vector6> {
    proptest::array::uniform6(-1.0..1.0).prop_map(Vector6::from)
}
