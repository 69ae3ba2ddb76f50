//! Tests of `pictures::picture::visible`, a module of it.

use super::*;

fn square(low: f64, high: f64, near: f64) -> Laid {
    vec![[low, low, near], [high, low, near], [high, high, near], [low, high, near]]
}

#[test]
fn nearer_faces_hide_others() {
    let faces = [square(0.0, 1.0, 0.0), square(0.2, 0.6, 1.0), square(0.3, 0.5, 0.5), square(0.7, 0.9, -1.0)];
    // Of a model that travels a hundred times its size, too.
    for size in [1.0, 100.0] {
        let buffer = ItemBuffer::of(&faces, size);
        let seen: Vec<Seen> = (0..4).map(|k| buffer.seen(&faces[k], k)).collect();
        assert_eq!(seen, [Seen::Partly, Seen::Wholly, Seen::Hidden, Seen::Hidden]);
        // A part of the first that is not covered, and one that is.
        assert_eq!(buffer.seen(&square(0.65, 0.95, 0.0), 0), Seen::Wholly);
        assert_eq!(buffer.seen(&square(0.25, 0.55, 0.0), 0), Seen::Hidden);
    }
}

#[test]
fn faces_that_pass_through_each_other_are_both_seen() {
    let slope = |rise: f64| vec![[0.0, 0.0, -rise], [1.0, 0.0, rise], [1.0, 1.0, rise], [0.0, 1.0, -rise]];
    let faces = [slope(0.5), slope(-0.5)];
    let buffer = ItemBuffer::of(&faces, 1.0);
    assert_eq!([0, 1].map(|k| buffer.seen(&faces[k], k)), [Seen::Partly, Seen::Partly]);
}

#[test]
fn lines_are_hidden_where_something_is_nearer() {
    let faces = [square(0.0, 1.0, 0.0), square(0.4, 0.6, 1.0)];
    let buffer = ItemBuffer::of(&faces, 1.0);
    let parts = buffer.seen_parts([[0.0, 0.5, 0.0], [1.0, 0.5, 0.0]]);
    let [[_, end], [begin, _]] = parts[..] else { panic!("{parts:?}") };
    assert!((end[0] - 0.4).abs() < 3e-3 && (begin[0] - 0.6).abs() < 3e-3, "{parts:?}");
    assert_eq!(buffer.seen_parts([[0.0, 0.5, 2.0], [1.0, 0.5, 2.0]]), [[[0.0, 0.5], [1.0, 0.5]]]);
    // A border is seen, as beside it there is nothing.
    assert_eq!(buffer.seen_parts([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]).len(), 1);
}

#[test]
fn narrow_faces_are_not_missed() {
    let narrow =
        |near: f64| vec![[0.3, 0.5001, near], [0.7, 0.5001, near], [0.7, 0.5002, near], [0.3, 0.5002, near]];
    let faces = [square(0.0, 1.0, 0.0), narrow(1.0), narrow(-1.0)];
    let buffer = ItemBuffer::of(&faces, 1.0);
    assert_eq!(buffer.seen(&faces[1], 1), Seen::Hidden);
    assert_eq!([0, 1, 2].map(|k| buffer.is_missed(&faces[k])), [false, true, false]);
}

#[test]
fn nothing_and_points_are_no_trouble() {
    assert_eq!(ItemBuffer::of(&[], 1.0).nearest.len(), 1);
    assert_eq!(ItemBuffer::of(&[], 1.0).seen_parts([[0.0; 3]; 2]).len(), 1);
    let point = vec![[0.0; 3]; 4];
    let buffer = ItemBuffer::of(std::slice::from_ref(&point), 0.0);
    assert_eq!(buffer.seen(&point, 0), Seen::Hidden);
}
