//! Tests of `joints::centerline`, a module of it.

use super::*;

fn line() -> Centerline {
    Centerline::new(vec![0.0, 0.2, 0.3, 0.5, 0.7, 0.9, 1.2, 1.4, 1.5]).expect("ascending")
}

fn place(node: usize) -> Vector3 {
    let s = line().knots[node];
    Vector3::new(s, (2.0 * s).sin(), (1.0 + s).ln())
}

#[test]
fn polynomials_of_the_fourth_degree_are_met_exactly() {
    let line = line();
    let quartic = |s: f64| {
        [
            1.0 + 2.0 * s - 0.7 * s.powi(3) + 0.4 * s.powi(4),
            2.0 - 2.1 * s * s + 1.6 * s.powi(3),
            -4.2 * s + 4.8 * s * s,
            -4.2 + 9.6 * s,
        ]
    };
    for k in 0..=30 {
        let s = -0.05 + 1.6 * f64::from(k) / 30.0;
        let support = line.at(s);
        for derivative in 0..4 {
            let weights = &support.weights[derivative][..support.count];
            let values = weights.iter().enumerate();
            let sum: f64 = values.map(|(k, w)| w * quartic(line.knots[support.first + k])[0]).sum();
            assert!((sum - quartic(s)[derivative]).abs() < 1e-9, "{s} {derivative}: {sum}");
        }
    }
}

/// The curvature of a sine falls with the third power of the distance of the nodes, between nodes and at both ends.
#[test]
fn curvature_converges_with_the_third_power() {
    let miss = |count: usize| {
        let knots: Vec<f64> = (0..=count).map(|k| 2.0 * k as f64 / count as f64).collect();
        let line = Centerline::new(knots.clone()).expect("ascending");
        let sine = |node: usize| Vector3::new(knots[node].sin(), 0.0, 0.0);
        let misses = (0..=400).map(|k| 0.005 * f64::from(k));
        misses.map(|s| (line.at(s).sum(2, sine).x + s.sin()).abs()).fold(0.0, f64::max)
    };
    let [coarse, fine] = [16, 32].map(miss);
    assert!(fine < 3e-4 && coarse / fine > 7.0, "{coarse:e}, {fine:e}");
}

/// The line turns twice, so that several of its points are nearest within their surroundings: samples of every interval decide.
#[test]
fn the_nearest_position_of_a_winding_line_is_found_in_every_interval() {
    let knots: Vec<f64> = [0.0, 0.5, 1.1, 1.5, 2.2, 2.9, 3.3, 4.0].to_vec();
    let line = Centerline::new(knots.clone()).expect("ascending");
    let place = |node: usize| {
        let s: f64 = knots[node];
        Vector3::new((1.6 * s).sin(), 0.2 * s, 0.1 * (1.6 * s).cos())
    };
    for k in 0..=80 {
        let s = 0.05 * f64::from(k);
        let support = line.at(s);
        let [on_line, tangent] = [0, 1].map(|derivative| support.sum(derivative, place));
        let beside = tangent.cross(&Vector3::z()).normalize();
        let found = line.nearest(&(on_line + 0.01 * beside), place);
        assert!((found - s).abs() < 1e-9, "{found}, not {s}");
    }
}

/// A straight line is reproduced by two or more nodes, with its arc length and its tangent.
#[test]
fn straight_lines_of_two_and_more_nodes_are_met_exactly() {
    for knots in [vec![0.4, 1.7], vec![0.4, 1.0, 1.7], vec![0.4, 0.7, 1.1, 1.7]] {
        let line = Centerline::new(knots.clone()).expect("ascending");
        for s in [0.3, 0.4, 0.6, 1.05, 1.7, 1.9] {
            let support = line.at(s);
            let expected = [3.0 - 2.0 * s, -2.0, 0.0, 0.0];
            for (weights, expected) in support.weights.iter().zip(expected) {
                let weights = weights[..support.count].iter().enumerate();
                let sum: f64 = weights.map(|(k, w)| w * (3.0 - 2.0 * knots[support.first + k])).sum();
                assert!((sum - expected).abs() < 1e-12, "{knots:?} {s}: {sum}, {expected}");
            }
        }
    }
}

#[test]
fn place_tangent_and_curvature_go_on_across_nodes() {
    let line = line();
    for node in 1..line.knots.len() - 1 {
        let s = line.knots[node];
        let [before, after] = [line.within(node - 1, s), line.within(node, s)];
        for derivative in 0..3 {
            let jump = before.sum(derivative, place) - after.sum(derivative, place);
            assert!(jump.norm() < 1e-12, "{node} {derivative}: {jump}");
        }
    }
    for s in [-0.1, 0.1, 0.31, 0.69, 1.0, 1.3, 1.6] {
        let step = 1e-4;
        for derivative in 0..3 {
            let [a, b] = [s - step, s + step].map(|at| line.at(at).sum(derivative, place));
            let exact = line.at(s).sum(derivative + 1, place);
            assert!(((b - a) / (2.0 * step) - exact).norm() < 1e-5, "{s} {derivative}");
        }
    }
}

#[test]
fn changes_are_differences_and_keep_their_digits() {
    let line = line();
    for (from, change) in [(0.1, 0.05), (0.1, 1.3), (1.45, -1.4), (0.3, 0.4), (-0.1, 1.8)] {
        let wanted = line.at(from + change).sum(0, place) - line.at(from).sum(0, place);
        let miss = (line.change(0, (from, change), place) - wanted).norm();
        assert!(miss < 1e-14, "{from} {change}: {miss:e}");
        let wanted = line.at(from + change).sum(1, place) - line.at(from).sum(1, place);
        let miss = (line.change(1, (from, change), place) - wanted).norm();
        assert!(miss < 1e-13, "{from} {change}: {miss:e}");
    }
    let tiny = line.change(0, (0.5, 1e-9), place);
    let tangent = line.at(0.5).sum(1, place);
    assert!((tiny / 1e-9 - tangent).norm() < 1e-8);
}

#[test]
fn the_nearest_place_is_found() {
    let line = line();
    for s in [0.0, 0.2, 0.7, 1.1, 1.5] {
        let found = line.nearest(&line.at(s).sum(0, place), place);
        assert!((found - s).abs() < 1e-12, "{s}: {found}");
    }
    // Points near an arc, up to four fifths of its radius on the inner side.
    let on_arc = |node: usize| Vector3::new(line.knots[node].cos(), line.knots[node].sin(), 0.0);
    for (s, share) in [(0.2, 0.5), (0.5, 0.8), (0.9, 0.8), (1.1, -2.0)] {
        let [on_line, tangent, curvature] = [0, 1, 2].map(|order| line.at(s).sum(order, on_arc));
        let across = curvature - tangent * (curvature.dot(&tangent) / tangent.norm_squared());
        let found = line.nearest(&(on_line + share * across.normalize()), on_arc);
        assert!((found - s).abs() < 1e-10, "{s} {share}: {found}");
    }
    assert_eq!(Centerline::new(vec![0.0]), None);
    assert_eq!(Centerline::new(vec![0.0, 1.0, 1.0]), None);
}
