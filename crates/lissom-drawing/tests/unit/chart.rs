//! Tests of `chart`, a module of it.

use super::*;
use crate::drawing::palette;

fn wave(index: usize, name: &str) -> Curve {
    let points = (0..200).map(|k| (f64::from(k) * 0.01, (f64::from(k) * 0.1 + index as f64).sin())).collect();
    Curve { name: name.to_owned(), points, ..Curve::new(palette(index)) }
}

#[test]
fn charts_hold_words_and_curves_within_their_frames() {
    let panel = |curves| Panel { x: Axis::new("time [s]"), y: Axis::new("displacement [m]"), curves };
    let panels = vec![panel(vec![wave(0, "x"), wave(1, "y")]), panel(vec![wave(2, "z")])];
    let chart = Chart { title: "Waves".to_owned(), ..Chart::new("waves", panels) };
    let drawing = chart.draw();
    assert_eq!(drawing.size, [760.0, 720.0]);
    let svg = drawing.svg().unwrap();
    for words in ["Waves", "time [s]", "displacement [m]", ">x<", ">z<", "#0072b2", "#009e73", ">1.5<"] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    assert!(drawing.png().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn points_without_a_place_leave_gaps_and_panels_without_points_are_left_out() {
    let mut curve = wave(0, "x");
    curve.points[100].1 = f64::NAN;
    let panel = |curves| Panel { x: Axis::new("t"), y: Axis::new("x"), curves };
    let svg = Chart::new("gap", vec![panel(vec![curve])]).draw().svg().unwrap();
    assert_eq!(svg.matches("stroke=\"#0072b2\"").count(), 3, "two pieces and the legend");
    let nothing = Curve { points: vec![(0.0, f64::NAN)], ..wave(0, "x") };
    let drawing = Chart::new("nothing", vec![panel(vec![nothing])]).draw();
    assert_eq!(drawing.size[1], MARGIN);
    let below = Panel { x: Axis::logarithmic("h"), y: Axis::logarithmic("e"), curves: vec![wave(0, "x")] };
    assert!(Chart::new("logarithmic", vec![below]).draw().svg().is_ok());
}

#[test]
fn every_curve_of_a_long_legend_is_counted() {
    let curves = (0..60).map(|index| wave(index, &format!("curve {index}"))).collect();
    let panel = Panel { x: Axis::new("t"), y: Axis::new("x"), curves };
    let svg = Chart::new("many", vec![panel]).draw().svg().unwrap();
    let shown = svg.matches(">curve ").count();
    assert!(svg.contains(&format!("and {} more", 60 - shown)), "{shown}");
}

#[test]
fn marks_stand_at_their_points() {
    for mark in [Mark::Square, Mark::Triangle, Mark::Diamond] {
        let points = vec![(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
        let curve = Curve { points, mark: Some(mark), ..Curve::new(palette(0)) };
        let panel = Panel { x: Axis::new("t"), y: Axis::new("x"), curves: vec![curve] };
        assert_eq!(Chart::new("marks", vec![panel]).draw().svg().unwrap().matches("Z\" fill").count(), 3);
    }
}

#[test]
fn panels_stand_beside_each_other() {
    let dots = Curve { mark: Some(Mark::Circle), width: 0.0, radius: 1.5, ..wave(0, "") };
    let panel = || Panel { x: Axis::new("t"), y: Axis::new("x"), curves: vec![dots.clone()] };
    let chart = Chart::new("beside", vec![panel(), panel(), panel()]);
    let drawing = Chart { columns: 2, width: 680.0, panel_height: 260.0, ..chart }.draw();
    assert_eq!(drawing.size, [680.0, MARGIN + 520.0]);
    let svg = drawing.svg().unwrap();
    assert_eq!(svg.matches("<circle").count(), 600);
    assert!(!svg.contains("stroke=\"#0072b2\""), "no lines");
    assert!(drawing.png().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn long_titles_have_several_lines_within_the_width() {
    let width = |words: &str| lettering::width(words, f64::from(SMALL_TITLE));
    assert_eq!(title_lines("", TITLE, 400.0).0, Vec::<String>::new());
    assert_eq!(title_lines("Waves", TITLE, 400.0), (vec!["Waves".to_owned()], TITLE));
    let words = "title that goes on ".repeat(12);
    let (of_words, height) = title_lines(words.trim(), TITLE, 400.0);
    assert_eq!((height, of_words.join(" ")), (SMALL_TITLE, words.trim().to_owned()));
    assert!(of_words.len() > 2 && of_words.iter().all(|line| width(line) <= 400.0), "{of_words:?}");
    let name = "a_name_without_spaces".repeat(12);
    let (of_name, _) = title_lines(&name, TITLE, 400.0);
    assert_eq!(of_name.concat(), name);
    assert!(of_name.iter().all(|line| width(line) <= 400.0), "{of_name:?}");
    // A second line makes the drawing higher.
    let height = |title: &str| {
        let curve = Curve { points: vec![(0.0, 0.0), (1.0, 1.0)], ..Curve::new(palette(0)) };
        let panel = Panel { x: Axis::new("x"), y: Axis::new("y"), curves: vec![curve] };
        Chart { title: title.to_owned(), ..Chart::new("waves", vec![panel]) }.draw().size[1]
    };
    assert!(height(&words) > height("Waves") + 10.0);
}
