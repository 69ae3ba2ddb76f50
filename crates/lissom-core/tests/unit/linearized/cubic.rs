//! Tests of `linearized::cubic`, a module of it.

use super::*;
use crate::flexible::superelement::TurningMatrices;

/// Four unknowns besides the first interface: two bending, one that is stretched by both, and one that is twisted by both
/// together.
fn order() -> (SecondOrder, DMatrix<f64>, DMatrix<f64>) {
    let size = 10;
    let mut cubic = vec![DMatrix::zeros(size, size); size];
    let mut add = |value: f64, [i, j, k]: [usize; 3]| {
        for [a, b, c] in [[i, j, k], [j, k, i], [k, i, j], [i, k, j], [k, j, i], [j, i, k]] {
            cubic[a][(b, c)] = value;
        }
    };
    add(3e3, [8, 6, 6]);
    add(2e3, [8, 7, 7]);
    add(5.0, [9, 6, 7]);
    let zeros = || DMatrix::zeros(size, size);
    let turning = || TurningMatrices {
        slope: DMatrix::zeros(6, size),
        inertia: [zeros(), zeros(), zeros(), zeros(), zeros(), zeros()],
        momentum: [zeros(), zeros(), zeros()],
    };
    let direct = GeometricMatrices {
        moment: [zeros(), zeros(), zeros()],
        points: turning(),
        sections: turning(),
        shortening: Vec::new(),
    };
    let order = SecondOrder { direct, cubic, turning: Vec::new(), spun: Vec::new(), pushed: Vec::new() };
    let mut stiffness = zeros();
    for (row, value) in [(6, 1.0), (7, 3.0), (8, 1e3), (9, 20.0)] {
        stiffness[(row, row)] = value;
    }
    (order, DMatrix::identity(size, size), stiffness)
}

/// The third derivatives of ½ (y + h)·K (y + h) are T, for any assignment to modes; bending is shortened by the stretched
/// mode.
#[test]
fn the_square_has_the_third_derivatives() {
    let (order, mass, stiffness) = order();
    let size = mass.nrows();
    let map = DMatrix::identity(size, size);
    let found = order.kept(&map, [&mass, &stiffness, &stiffness], 10);
    let cubic = |y: &DVector<f64>| {
        found
            .shortening
            .iter()
            .map(|own| 0.5 * y.dot(&(&own.matrix * y)) * own.direction.dot(&(&stiffness * y)))
            .sum::<f64>()
    };
    let exact = |y: &DVector<f64>| {
        order.cubic.iter().enumerate().map(|(i, own)| y[i] * y.dot(&(own * y))).sum::<f64>() / 6.0
    };
    for direction in [[1.0, 0.0, 0.3, 0.0], [0.4, -0.7, 0.2, 1.1], [0.0, 1.0, -0.5, 0.3]] {
        let mut y = DVector::zeros(size);
        y.rows_mut(6, 4).copy_from_slice(&direction);
        assert!(
            (cubic(&y) - exact(&y)).abs() < 1e-9 * exact(&y).abs().max(1.0),
            "{} {}",
            cubic(&y),
            exact(&y)
        );
    }
    // Bending by 1 is shortened by T / λ, without any other effect.
    let mut bent = DVector::zeros(size);
    bent[6] = 1.0;
    let mut moved = DVector::zeros(size);
    for own in &found.shortening {
        moved.axpy(0.5 * bent.dot(&(&own.matrix * &bent)), &own.direction, 1.0);
    }
    assert!((moved[8] - 1.5).abs() < 1e-5 && moved[7].abs() < 1e-6, "{moved}");
}
