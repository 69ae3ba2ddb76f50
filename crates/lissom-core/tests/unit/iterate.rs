//! Tests of `iterate`, a module of it.

use super::*;

#[test]
fn a_correction_is_undone_exactly() {
    let xi = Vector6::from([3.0, -1.0, 2.0, 0.4, 1.5, -0.7]);
    let there_and_back = correction(&xi, false) * correction(&-xi, true);
    assert!(there_and_back.logarithm().norm() < 1e-15);
    let layout = Layout {
        node_rows: vec![[LOCKED; 6], [0, 1, 2, 3, 4, 5]],
        coordinate_rows: vec![6],
        ..Layout::default()
    };
    let before = vec![0.3, 0.1, -0.2, 0.5, -0.4, 0.1, 2.0];
    let corrections = [0.2, -0.1, 0.4, 0.1, 0.3, -0.6, 0.5];
    let mut increments = before.clone();
    subtract_corrections(&layout, (&corrections, 1.0), &mut increments);
    assert!((increments[6] - 1.5).abs() < 1e-15);
    subtract_corrections(&layout, (&corrections, -1.0), &mut increments);
    assert!(increments.iter().zip(&before).all(|(now, then)| (now - then).abs() < 1e-15));
}

#[test]
fn the_tangent_of_a_force_without_balance_becomes_symmetric() {
    let layout = Layout { node_rows: vec![[0, 1, 2, 3, 4, 5]], ..Layout::default() };
    let pattern = Pattern::from_cliques(6, [&[0, 1, 2, 3, 4, 5][..]]);
    // A force r at a node that turns: its components vary by r x θ.
    let r = [1.0, 2.0, 3.0];
    let mut values = vec![0.0; 36];
    for (row, column, value) in [(0, 1, -r[2]), (0, 2, r[1]), (1, 2, -r[0])] {
        for (row, column, value) in [(row, column, value), (column, row, -value)] {
            values[pattern.position(row, 3 + column).expect("in the clique")] = value;
            values[pattern.position(3 + row, 3 + column).expect("in the clique")] = value;
        }
    }
    hold_unbalanced_forces(&layout, &pattern, &mut values);
    assert!(values.iter().all(|value| *value == 0.0), "{values:?}");
}
