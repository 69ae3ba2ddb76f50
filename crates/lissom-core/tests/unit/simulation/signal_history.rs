//! Tests of `simulation::signal_history`, a module of it.

use super::*;

fn history() -> SignalHistory {
    let course = Course { stored: VecDeque::new(), next: Break::Slope, range: [0.0, 1.0] };
    SignalHistory { courses: vec![course] }
}

fn piece(from: f64, value: f64) -> Piece {
    Piece::constant([from, from + 1.0], value)
}

#[test]
fn values_that_jump_are_breaks() {
    let mut history = history();
    for (from, value) in [(0.0, 0.5), (1.0, 0.5), (2.0, 0.6)] {
        history.courses[0].push(piece(from, value));
    }
    let breaks: Vec<Break> = history.courses[0].stored.iter().map(|stored| stored.begins).collect();
    assert_eq!(breaks, [Break::Slope, Break::Smooth, Break::Value]);
}

#[test]
fn a_failed_step_leaves_no_trace() {
    let mut history = history();
    history.courses[0].push(piece(0.0, 0.5));
    history.add_break(Break::Curvature);
    let before = history.clone();
    history.courses[0].push(piece(1.0, 0.5));
    history.add_break(Break::Slope);
    history.courses[0].push(piece(2.0, 0.5));
    history.return_to(1.0, 1e-9);
    assert_eq!(history, before);
}

#[test]
fn each_integral_is_smoother() {
    let mut own = Break::Value;
    let order: Vec<Break> = std::iter::from_fn(|| {
        own = own.integrated();
        (own != Break::Smooth).then_some(own)
    })
    .collect();
    assert_eq!(order, [Break::Slope, Break::Curvature, Break::Third]);
}
