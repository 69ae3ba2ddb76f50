//! Tests of `output::log_plot`, a module of it.

use super::*;

fn figure(curves: Vec<(String, Vec<(f64, f64)>)>) -> LogFigure {
    let texts = ["conditioning", "Pendulum", "step size [s]", "condition number [-]"].map(str::to_owned);
    let [name, title, x_label, y_label] = texts;
    LogFigure { name, title, x_label, y_label, curves, guides: Vec::new() }
}

#[test]
fn curves_over_many_decades_are_drawn() {
    let steep = (0..9).map(|k| (10.0_f64.powi(-k), 10.0_f64.powi(4 * k))).collect();
    let flat = (0..9).map(|k| (10.0_f64.powi(-k), 14.0)).collect();
    let figure = figure(vec![("none".to_owned(), steep), ("physical".to_owned(), flat)]);
    let svg = figure.draw().unwrap().svg().unwrap();
    for words in ["Pendulum", "step size [s]", "condition number [-]", ">none<", ">physical<", "#d55e00"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(figure.draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn numbers_without_logarithm_are_left_out() {
    let points = vec![(1.0, f64::INFINITY), (0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0)];
    assert!(figure(vec![("none".to_owned(), points.clone())]).draw().is_err());
    let one = vec![(1.0, 10.0)];
    let svg =
        figure(vec![("none".to_owned(), points), ("unit".to_owned(), one)]).draw().unwrap().svg().unwrap();
    assert!(svg.contains(">unit<") && !svg.contains(">none<"));
}

#[test]
fn coinciding_curves_and_guides_are_all_seen() {
    let line =
        |factor: f64| (0..5).map(|k| (10.0_f64.powi(k), factor * 10.0_f64.powi(-k))).collect::<Vec<_>>();
    let dashed = |svg: &str| svg.matches("stroke-dasharray").count();
    let of = |curves: Vec<(String, Vec<(f64, f64)>)>| figure(curves).draw().unwrap().svg().unwrap();
    let apart = of(vec![("a".to_owned(), line(1.0)), ("b".to_owned(), line(2.0))]);
    let equal = of(vec![("a".to_owned(), line(1.0)), ("b".to_owned(), line(1.01))]);
    assert_eq!(dashed(&apart), 0);
    assert!(dashed(&equal) > 0 && equal.contains("3.3"), "{equal}");
    let mut guided = figure(vec![("a".to_owned(), line(1.0))]);
    guided.guides = vec![("order 1".to_owned(), line(0.1))];
    let svg = guided.draw().unwrap().svg().unwrap();
    assert!(svg.contains(">order 1<") && dashed(&svg) > 0);
}
