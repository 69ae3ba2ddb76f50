//! Tests of `analyses::study::members`, a module of it.

use super::*;

#[test]
fn results_keep_their_order() {
    let squares = in_parallel(100, |index| index * index);
    assert!(squares.iter().enumerate().all(|(index, &square)| square == index * index));
    assert!(in_parallel(0, |index| index).is_empty());
}

#[test]
fn once_asked_to_stop_all_stop() {
    let watch = |done: usize, planned: usize| {
        assert!(done <= planned);
        if done >= 2 * OFTEN { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let effort = Effort::new(&watch, 1000);
    let steps = |_| (1..=500).take_while(|&step| effort.note(step).is_continue()).count();
    let taken: Vec<usize> = (0..2).map(steps).collect();
    assert_eq!(taken, [2 * OFTEN - 1, OFTEN - 1]);
}
