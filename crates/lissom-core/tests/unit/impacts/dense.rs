//! Tests of `impacts::dense`, a module of it.

use super::*;

fn problem(compliance: &[f64], free: &[f64], conditions: Vec<Condition>) -> ContactProblem {
    let count = free.len();
    ContactProblem {
        compliance: DMatrix::from_row_slice(count, count, compliance),
        free: DVector::from_row_slice(free),
        conditions,
    }
}

/// A block of unit mass on a plane, pushed down by 10 and aside.
#[test]
fn a_block_sticks_within_its_cone_and_slides_beyond() {
    let unit = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let condition = Condition { friction: 0.5, rebound: 0.0, sliding: None };
    for (push, wanted) in [(4.9, 0.0), (7.0, 2.0)] {
        let problem = problem(&unit, &[-10.0, push * 0.6, push * 0.8], vec![condition.clone()]);
        let forces = problem.solve().expect("it has a solution");
        let after = problem.velocities(&forces);
        assert!((forces[0] - 10.0).abs() < 1e-12 && after[0].abs() < 1e-12);
        assert!((after[1] - 0.6 * wanted).abs() < 1e-9, "{after}");
        assert!((after[2] - 0.8 * wanted).abs() < 1e-9, "{after}");
    }
    let lifted = problem(&unit, &[1.0, 2.0, 0.0], vec![condition]).solve().expect("it has a solution");
    assert_eq!(lifted.amax(), 0.0);
}

/// A rod on its lower end, m = 1, l = 2 (half length 1), J = 1/3, at 45°: G_nn = 1 + 3/2, G_nt = -3/2 towards the rod's lean.
#[test]
fn a_rod_that_slides_into_its_lean_may_be_a_paradox() {
    let rod = [2.5, -1.5, 0.0, -1.5, 2.5, 0.0, 0.0, 0.0, 1.0];
    let sliding = |friction: f64, direction: f64| Condition {
        friction,
        rebound: 0.0,
        sliding: Some(Vector2::new(direction, 0.0)),
    };
    let of = |condition: Condition| problem(&rod, &[-1.0, 0.0, 0.0], vec![condition]);
    // G_nn - μ G_nt d = 0 at μ = 5/3 with d = -1.
    assert_eq!(of(sliding(1.6, -1.0)).paradox(), None);
    assert_eq!(of(sliding(1.7, -1.0)).paradox(), Some(0));
    assert_eq!(of(sliding(1.7, 1.0)).paradox(), None);
    let forces = of(sliding(1.6, -1.0)).solve().expect("it has a solution");
    assert!((forces[0] - 1.0 / (2.5 - 1.6 * 1.5)).abs() < 1e-9, "{forces}");
}
