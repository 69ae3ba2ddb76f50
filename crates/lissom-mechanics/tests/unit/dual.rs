//! Tests of `dual`, a module of it.

use super::{Dual, Number};

#[test]
fn derivatives_are_those_of_differences() {
    let formula = |x: f64, y: f64| {
        let (sine, cosine) = (x * y).sin_cos();
        (x.sqrt() * sine + (y / x).tanh() * cosine - (0.3 * y).atan() * x.powf(1.7), x, y)
    };
    let (x, y) = (Dual::<2>::variable(0.7, 0), Dual::<2>::variable(1.3, 1));
    let (sine, cosine) = (x * y).sine_cosine();
    let found = x.square_root() * sine + (y / x).hyperbolic_tangent() * cosine
        - y.scaled(0.3).arc_tangent() * x.power(1.7);
    assert!((found.value - formula(0.7, 1.3).0).abs() < 1e-15);
    let step = 1e-5;
    let by_x = (formula(0.7 + step, 1.3).0 - formula(0.7 - step, 1.3).0) / (2.0 * step);
    let by_y = (formula(0.7, 1.3 + step).0 - formula(0.7, 1.3 - step).0) / (2.0 * step);
    assert!((found.by[0] - by_x).abs() < 1e-9 && (found.by[1] - by_y).abs() < 1e-9, "{found:?}");
}
