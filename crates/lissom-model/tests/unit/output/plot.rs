//! Tests of `output::plot`, a module of it.

use super::*;
use crate::output::{Column, Writer};

fn record(rows: u32, value: impl Fn(f64) -> Vec<f64>, columns: &[Column]) -> Record {
    let mut record = Record::default();
    record.begin(columns).unwrap();
    for i in 0..rows {
        let time = f64::from(i) * 1e-4;
        record.row(time, &value(time)).unwrap();
    }
    record
}

fn displacement() -> Vec<Column> {
    ["x", "y", "z"].map(|component| Column::new("mid span", component, "displacement", "m")).to_vec()
}

#[test]
fn figures_have_titles_labels_and_curves() {
    let mut columns = displacement();
    columns.push(Column::new("root", "force", "reaction", "N"));
    columns.push(Column::new("root", "moment", "reaction", "N m"));
    let record = record(5000, |t| vec![t.sin(), t.cos(), 0.0, 1.0, t], &columns);
    let figures = figures(&record, "Tip crank");
    let names: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["mid_span", "root"]);
    let svg = figures[0].draw().unwrap().svg().unwrap();
    for words in ["Tip crank: mid span", "displacement [m]", "time [s]", ">x<", ">z<", "#009e73"] {
        assert!(svg.contains(words), "{words}");
    }
    let svg = figures[1].draw().unwrap().svg().unwrap();
    for words in ["Tip crank: root", "reaction [N]", "reaction [N m]"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(figures[1].draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn units_distinguish_the_quantities_of_one_output() {
    for (quantity, unit, words) in [
        ("relative", "rad", "relative rotation"),
        ("relative motion", "rad", "relative rotation"),
        ("relative", "m", "relative displacement"),
        ("relative motion", "m", "relative displacement"),
        ("relative", "rad/s", "relative angular velocity"),
        ("relative", "m/s", "relative velocity"),
        ("momentum", "N s", "momentum"),
        ("momentum", "N m s", "angular momentum"),
        ("spring", "N", "force of spring"),
        ("spring", "N m", "moment of spring"),
        ("spring", "m", "elongation"),
        ("spring", "rad", "rotation"),
        ("spring", "m/s", "rate of elongation"),
        ("spring", "rad/s", "rate of rotation"),
        ("velocity", "m/s", "velocity"),
    ] {
        assert_eq!(quantity_of(&Column::new("a", "x", quantity, unit)), words, "{quantity} [{unit}]");
    }
}

#[test]
fn small_and_large_values_get_a_prefix() {
    assert_eq!(prefixed(7e-3, "m"), (1e-3, " [mm]".to_owned()));
    assert_eq!(prefixed(0.5, "m"), (1.0, " [m]".to_owned()));
    assert_eq!(prefixed(2e4, "N m"), (1e3, " [kN m]".to_owned()));
    assert_eq!(prefixed(9999.0, "N"), (1.0, " [N]".to_owned()));
    assert_eq!(prefixed(1e-5, ""), (1.0, String::new()));
    assert_eq!(prefixed(0.0, "m"), (1.0, " [m]".to_owned()));
    assert_eq!(prefixed(1e-30, "m"), (1.0, " [m]".to_owned()));
}

#[test]
fn thinning_keeps_extremes_and_ends() {
    let value = |t: f64| vec![if (t - 1.2345).abs() < 1e-5 { 9.0 } else { (50.0 * t).sin() }; 3];
    let record = record(100_000, value, &displacement());
    let points = thinned(record.times.iter().copied().zip(record.values[0].iter().copied()).collect());
    assert!(points.len() <= POINTS && points.len() > POINTS / 2, "{}", points.len());
    assert!(points.iter().any(|point| point.1 == 9.0));
    assert_eq!(points.first().unwrap().0, 0.0);
    assert_eq!(points.last().unwrap().0, *record.times.last().unwrap());
    assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
}

#[test]
fn constants_gaps_and_nothing_are_drawn_or_refused() {
    let zero = record(10, |_| vec![0.0; 3], &displacement());
    assert!(
        figures(&zero, "")
            .iter()
            .all(|figure| figure.draw().unwrap().png().is_ok() && figure.draw().unwrap().svg().is_ok())
    );
    let huge = record(10, |t| vec![1e300 * t, -1e300, f64::NAN], &displacement());
    assert!(figures(&huge, "").iter().all(|figure| figure.draw().unwrap().png().is_ok()));
    let one = record(1, |_| vec![1.0; 3], &displacement());
    assert!(figures(&one, "").iter().all(|figure| figure.draw().unwrap().png().is_ok()));
    let nothing = record(10, |_| vec![f64::NAN; 3], &displacement());
    assert!(figures(&nothing, "")[0].draw().is_err());
}

/// Two outputs in one plot, one of them an expression: one figure, whose legend has their names.
#[test]
fn outputs_of_one_plot_are_drawn_together() {
    let columns = [
        Column::new("left", "f3", "spring force", "N").in_plot(Some("forces".to_owned())),
        Column::new("sum", "value", "sum", "N").in_plot(Some("forces".to_owned())),
        Column::new("left", "m1", "spring force", "N m").in_plot(Some("forces".to_owned())),
        Column::new("alone", "value", "alone", "kN"),
        Column::new("tip", "u1", "displacement", "m"),
    ];
    let of = figures(&record(5, |t| vec![t; 5], &columns), "press");
    let titles: Vec<&str> = of.iter().map(|own| own.title.as_str()).collect();
    assert_eq!(titles, ["press: forces", "press: alone", "press: tip"]);
    let panel = |figure: usize, index: usize| {
        let own: &Panel = &of[figure].panels[index];
        let names: Vec<&str> = own.curves.iter().map(|(name, _)| name.as_str()).collect();
        format!("{} [{}]: {}", own.quantity, own.unit, names.join(" "))
    };
    assert_eq!(panel(0, 0), "spring force, sum [N]: left.f3 sum");
    assert_eq!(panel(0, 1), "spring force [N m]: left.m1");
    assert_eq!(panel(1, 0), "alone [kN]: alone");
    assert_eq!(panel(2, 0), "displacement [m]: u1");
}

/// Gaps beside positions would be a straight line, and round-off is zero.
#[test]
fn positions_of_contacts_have_a_panel_and_round_off_is_zero() {
    let of = |component: &str, unit: &str| Column::new("floor", component, "contact force", unit);
    let columns =
        [of("gap", "m"), of("f1", "N"), of("f3", "N"), of("slip", "m/s"), of("x1", "m"), of("x3", "m")];
    let values = |t: f64| vec![1e-4 * t, 1e-14 * t, 10.0, t, 3.0, 0.5];
    let own = &figures(&record(5, values, &columns), "")[0];
    let panel = |panel: &Panel| {
        let names: Vec<&str> = panel.curves.iter().map(|(name, _)| name.as_str()).collect();
        format!("{} [{}]: {}", panel.quantity, panel.unit, names.join(" "))
    };
    let panels: Vec<String> = own.panels.iter().map(panel).collect();
    let forces = "contact force [N]: f1 f3";
    assert_eq!(
        panels,
        ["gap [m]: gap", forces, "sliding velocity [m/s]: slip", "centre of contact [m]: x1 x3"]
    );
    assert!(own.panels[1].curves[0].1.iter().all(|point| point.1 == 0.0));
    assert!(own.panels[0].curves[0].1.iter().any(|point| point.1 > 0.0));
    // A run draws curves that it has kept row by row.
    let kept = CurveRecord::from(&record(5, values, &columns));
    assert!(
        figures_of_curves(&kept, "", usize::MAX)[0].panels[1].curves[0].1.iter().all(|point| point.1 == 0.0)
    );
}

#[test]
fn figures_have_different_names_and_panels_by_unit() {
    let outputs = ["a b", "a_b", "a.b", "a-b"];
    let mut columns = outputs.map(|output| Column::new(output, "x", "displacement", "m")).to_vec();
    columns.push(Column::new("a_b", "f", "spring", "N"));
    columns.push(Column::new("a_b", "y", "displacement", "m"));
    let of = figures(&record(5, |t| vec![t; 6], &columns), "");
    let names: Vec<(&str, &str)> = of.iter().map(|own| (own.name.as_str(), own.title.as_str())).collect();
    assert_eq!(names, [("a_b", "a b"), ("a_b_2", "a_b"), ("a_b_3", "a.b"), ("a-b", "a-b")]);
    let panels: Vec<(&str, &str, usize)> =
        of[1].panels.iter().map(|own| (own.quantity.as_str(), own.unit.as_str(), own.curves.len())).collect();
    assert_eq!(panels, [("displacement", "m", 2), ("force of spring", "N", 1)]);
    assert_eq!(of[1].panels[1].names, ["a_b.f"]);
    assert_eq!(file_name("a b.c-d/ä1"), "a_b.c-d_ä1");
}

/// Both extremes of each stretch, in the order of time.
#[test]
fn thinned_curves_are_made_of_the_extremes_of_equal_stretches() {
    for rows in [POINTS, POINTS + 1, 3 * POINTS - 7] {
        let wave = |k: usize| ((7 * k) % 11) as f64;
        let all: Vec<(f64, f64)> = (0..rows).map(|k| (k as f64, wave(k))).collect();
        let kept = thinned(all.clone());
        assert!(kept.len() <= POINTS && (rows > POINTS || kept == all), "{rows}: {}", kept.len());
        assert_eq!([kept.first(), kept.last()], [all.first(), all.last()]);
        assert!(kept.iter().all(|point| all[point.0 as usize] == *point));
        if rows > POINTS {
            let size = rows.div_ceil(POINTS / 2 - 1);
            for stretch in all.chunks(size) {
                let within: Vec<f64> = kept
                    .iter()
                    .filter(|point| stretch[0].0 <= point.0 && point.0 <= stretch[stretch.len() - 1].0)
                    .map(|point| point.1)
                    .collect();
                let most = stretch.iter().map(|point| point.1).fold(f64::MIN, f64::max);
                let least = stretch.iter().map(|point| point.1).fold(f64::MAX, f64::min);
                assert!(within.contains(&most) && within.contains(&least), "{rows}: {stretch:?}");
            }
        }
    }
    let gaps = thinned(vec![(0.0, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0), (2.0, 3.0)]);
    assert_eq!(gaps, [(0.0, 1.0), (2.0, 3.0)]);
}

#[test]
fn points_of_a_path_are_a_fifth_of_a_percent_of_its_extent_apart() {
    // An ellipse away from the origin, with extents of 20 and 4.
    let at = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 1e5;
        (100.0 + 10.0 * angle.cos(), -50.0 + 2.0 * angle.sin())
    };
    let mut all: Vec<(f64, f64)> = (0..=100_000).map(at).collect();
    all.insert(5, (f64::NAN, 0.0));
    all.insert(9, (0.0, f64::INFINITY));
    let kept = thinned_path(all);
    assert_eq!(kept.first(), Some(&at(0)));
    assert_eq!(kept.last(), Some(&at(100_000)));
    assert!(kept.len() < 2000);
    for pair in kept.windows(2).take(kept.len() - 2) {
        let apart = ((pair[1].0 - pair[0].0).abs() / 20.0).max((pair[1].1 - pair[0].1).abs() / 4.0);
        assert!(apart > 0.002 && apart < 0.00205, "{pair:?}: {apart}");
    }
    // Along one axis alone.
    let line: Vec<(f64, f64)> = (0..=10_000).map(|k| (3.0, f64::from(k))).collect();
    for kept in [thinned_path(line.clone()), thinned_path(line.iter().map(|&(x, y)| (y, x)).collect())] {
        assert!((450..=501).contains(&kept.len()), "{}", kept.len());
    }
}

#[test]
fn panels_are_drawn_with_prefixes_dashes_and_ranges() {
    let curve = |scale: f64| ("c".to_owned(), vec![(1.0, scale), (2.0, -3.0 * scale), (4.0, 1e-9 * scale)]);
    let panel = Panel {
        quantity: "force".to_owned(),
        unit: "N".to_owned(),
        names: Vec::new(),
        curves: [1e4, 2e3, 3e3, 5.0].map(curve).to_vec(),
    };
    let time = panel.draw(&Axis::time()).unwrap();
    assert_eq!((time.x.label.as_str(), time.y.label.as_str()), ("time [s]", "force [kN]"));
    assert_eq!(time.x.range, Some([1.0, 4.0]));
    assert_eq!(time.curves[0].points, [(1.0, 10.0), (2.0, -30.0), (4.0, 1e-9 * 1e4 / 1e3)]);
    let dashes: Vec<bool> = time.curves.iter().map(|own| own.is_dashed).collect();
    assert_eq!(dashes, [false, false, false, true]);
    let path = panel.draw(&Axis::column("x [m]")).unwrap();
    assert_eq!((path.x.label.as_str(), path.x.range), ("x [m]", None));
    // Over decades neither negative values are drawn nor those far below the largest one.
    let decades = panel.draw(&Axis::frequency()).unwrap();
    assert_eq!(decades.x.label, "frequency [Hz]");
    assert_eq!(decades.curves[0].points, [(1.0, 10.0)]);
    assert_eq!(decades.curves[3].points, [(1.0, 5e-3)]);
    let low = Panel { curves: vec![("c".to_owned(), vec![(1.0, -1.0)])], ..panel.clone() };
    assert!(low.draw(&Axis::frequency()).is_none() && low.draw(&Axis::time()).is_some());
    // Prefixes at their limits.
    for (most, unit, wanted) in [
        (0.1, "J", (1.0, " [J]")),
        (0.0999, "J", (1e-3, " [mJ]")),
        (1e4, "W", (1e3, " [kW]")),
        (1e7, "Pa", (1e6, " [MPa]")),
        (1e10, "rad", (1e9, " [Grad]")),
        (1e-3, "m/s", (1e-3, " [mm/s]")),
        (9.9e-4, "m/s", (1e-6, " [µm/s]")),
        (1e-9, "m", (1e-9, " [nm]")),
        (1e-12, "m", (1e-12, " [pm]")),
        (1e5, "1/m", (1.0, " [1/m]")),
        (1e5, "kN", (1.0, " [kN]")),
        (1e-3, "mm", (1.0, " [mm]")),
        (1e20, "m", (1.0, " [m]")),
    ] {
        assert_eq!(prefixed(most, unit), (wanted.0, wanted.1.to_owned()), "{most} {unit}");
    }
}
