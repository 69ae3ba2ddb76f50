//! Tests of `drawing`, a module of it.

use super::*;

#[test]
fn drawings_hold_what_was_drawn_and_refuse_what_has_no_place() {
    let mut drawing = Drawing::new("snapshot", [200.0, 100.0]);
    drawing.polygon(vec![[10.0, 10.04], [90.0, 10.0], [50.0, 80.0]], [255, 128, 0]);
    drawing.line(vec![[0.0, 0.0], [200.0, 100.0]], [0, 0, 0], 1.0);
    drawing.words([100.0, 50.0], "t = 1 s < 2 s", 12, Align::Middle, [0, 0, 0]);
    let svg = drawing.svg().unwrap();
    assert!(svg.contains("M10 10L90 10L50 80Z") && svg.contains("#ff8000"), "{svg}");
    assert!(svg.contains("t = 1 s &lt; 2 s"), "{svg}");
    assert!(drawing.png().unwrap().starts_with(b"\x89PNG"));
    drawing.polygon(vec![[f64::NAN, 0.0]; 3], [0; 3]);
    assert!(drawing.svg().is_err() && drawing.png().is_err());
}

#[test]
fn sizes_without_end_are_refused() {
    assert_eq!(Drawing::new("a", [f64::INFINITY, 1.0]).png(), Err(DrawingError::NotFinite));
    assert!(matches!(Drawing::new("a", [1e6, 1e6]).png(), Err(DrawingError::Png(PngError::TooLarge { .. }))));
    assert!(matches!(Drawing::new("a", [0.0, 10.0]).png(), Err(DrawingError::Png(PngError::Nothing))));
}
