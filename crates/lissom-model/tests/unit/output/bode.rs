//! Tests of `output::bode`, a module of it.

use super::*;

#[test]
fn phases_go_on_beyond_half_a_turn() {
    let found = unwound(&[-3.0, 3.0, 2.9]);
    assert!((found[1] - (3.0 - 2.0 * PI)).abs() < 1e-15 && (found[2] - (2.9 - 2.0 * PI)).abs() < 1e-15);
}

#[test]
fn both_panels_are_drawn_and_nothing_is_refused() {
    let frequencies = vec![0.1, 1.0, 10.0];
    let curve = ("tip.u3 / push".to_owned(), vec![1.0, 30.0, 0.01], vec![0.0, -1.5, -3.1]);
    let plot = BodePlot {
        name: "response".to_owned(),
        title: "Cantilever".to_owned(),
        frequencies,
        curves: vec![curve],
    };
    let svg = plot.draw().unwrap().svg().unwrap();
    for words in ["Cantilever", "tip.u3 / push", "frequency [Hz]", "phase"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(plot.draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
    let nothing = BodePlot { curves: vec![("a".to_owned(), vec![0.0; 3], vec![0.0; 3])], ..plot };
    assert!(nothing.draw().is_err());
}
