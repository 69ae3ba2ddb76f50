//! Tests of `analyses::campbell::figure`, a module of it.

use super::*;

#[test]
fn lines_rays_crossings_and_damping_are_drawn() {
    let line = |last: f64, whirl| CampbellLine {
        points: vec![(0.0, 10.0), (20.0, last)],
        whirl,
        ..CampbellLine::default()
    };
    let plot = CampbellPlot {
        title: "Rotor".to_owned(),
        x_label: "parameters.speed".to_owned(),
        lines: vec![line(12.0, "forward"), line(8.0, "backward")],
        rays: vec![("1P".to_owned(), vec![(0.0, 0.0), (20.0, 20.0)])],
        crossings: vec![(11.0, 11.0)],
    };
    let svg = plot.draw().unwrap().svg().unwrap();
    for words in ["Rotor", "parameters.speed", "1P", "frequency [Hz]", "1 forward", "2 backward", "crossing"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(svg.matches("stroke-dasharray").count(), 2, "backward whirl, and its sample");
    assert!(!svg.contains("damping"));
    let mut damped = plot.clone();
    damped.lines[0].damping = vec![(0.0, 0.01), (20.0, 0.02)];
    assert!(damped.draw().unwrap().svg().unwrap().contains("damping ratio [-]"));
    let many = CampbellPlot { lines: vec![plot.lines[0].clone(); 20], ..plot.clone() }
        .draw()
        .unwrap()
        .svg()
        .unwrap();
    assert!(many.matches("<circle").count() >= 2 * 7, "lines after the seventh have marks");
    assert!(plot.draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
    assert_eq!(below(&plot.rays[0].1, 15.0), [(0.0, 0.0), (15.0, 15.0)]);
    let flat = CampbellLine { points: vec![(0.0, 0.0), (20.0, 0.0)], ..CampbellLine::default() };
    let flat = CampbellPlot { lines: vec![flat], ..plot };
    assert!(flat.draw().is_err());
    assert!(CampbellPlot { lines: vec![CampbellLine::default()], ..flat }.draw().is_err());
}
