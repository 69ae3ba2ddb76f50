//! Tests of `signals::delay`, a module of it.

use super::*;

#[test]
fn a_piece_is_the_cubic_through_its_values() {
    let cubic = |t: f64| 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
    let (from, to) = (1.0, 2.5);
    let values = std::array::from_fn(|k| cubic(from + k as f64 / 3.0 * (to - from)));
    let piece = Piece { ends: [from, to], values };
    for time in [0.5, 1.0, 1.2, 2.0, 2.5, 3.0] {
        assert!((piece.at(time) - cubic(time)).abs() < 1e-13, "{time}");
    }
}

#[test]
fn a_window_is_read_piece_by_piece_and_continued_beyond_its_end() {
    let delay = Delay::new(SignalId::new(0), DiscreteValueId::new(1), 0.5, None);
    let mut held = vec![0.0; 1 + window_size()];
    let line = |ends: [f64; 2], values: [f64; 2]| {
        let [first, last] = values;
        let values = std::array::from_fn(|k| first + k as f64 / 3.0 * (last - first));
        Piece { ends, values }
    };
    let pieces = [line([0.0, 1.0], [0.0, 1.0]), line([1.0, 2.0], [1.0, 3.0])];
    delay.fill(pieces.into_iter(), &mut held);
    for (time, wanted) in [(0.75, 0.25), (1.5, 1.0), (2.0, 2.0), (2.5, 3.0), (3.0, 4.0)] {
        assert!((delay.value(time, &held) - wanted).abs() < 1e-14, "{time}");
    }
    assert_eq!(delay.end_of_window(&held), 2.5);
}
