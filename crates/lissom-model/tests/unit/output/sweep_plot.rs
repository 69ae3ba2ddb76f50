//! Tests of `output::sweep_plot`, a module of it.

use super::*;

fn axis(name: &str, values: &[f64]) -> SweepAxis {
    SweepAxis { name: name.to_owned(), values: values.to_vec(), is_logarithmic: false }
}

#[test]
fn every_member_is_a_dot_in_every_panel_and_a_line_across_the_axes() {
    let mut plot = SweepPlot {
        title: "Pendulum".to_owned(),
        varied: vec![axis("mass", &[1.0, 2.0, 3.0]), axis("same", &[5.0; 3])],
        collected: vec![axis("swing", &[0.1, 0.4, 0.9])],
    };
    let svg = plot.responses().unwrap().svg().unwrap();
    assert_eq!(svg.matches("<circle").count(), 6);
    for words in ["Pendulum: 3 members", "mass", "swing"] {
        assert!(svg.contains(words), "{words}");
    }
    let svg = plot.parallel_coordinates().unwrap().svg().unwrap();
    assert!(svg.contains("swing") && svg.contains("same"));
    assert!(plot.parallel_coordinates().unwrap().png().unwrap().starts_with(b"\x89PNG"));
    for axis in plot.varied.iter_mut().chain(&mut plot.collected) {
        axis.values = (0..5000).map(f64::from).collect();
    }
    assert!(plot.responses().unwrap().svg().unwrap().contains("2000 of 5000 members"));
    plot.varied[0].values.clear();
    assert!(plot.responses().is_err());
}

/// Positions of the lines of this width, in their order.
fn lines(svg: &str, width: &str) -> Vec<Vec<[f64; 2]>> {
    let width = format!("stroke-width=\"{width}\"");
    let paths = svg.lines().filter(|line| line.contains("fill=\"none\"") && line.contains(&width));
    let places = |line: &str| {
        let path = line.split('"').nth(1).unwrap_or_default();
        let numbers: Vec<f64> = path
            .split(|c: char| c.is_alphabetic() || c == ' ' || c == ',')
            .filter_map(|number| number.parse().ok())
            .collect();
        numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    paths.map(places).collect()
}

#[test]
fn lines_across_the_axes_have_large_values_at_the_top_and_names_above() {
    let plot = SweepPlot {
        title: "Pendulum".to_owned(),
        varied: vec![
            SweepAxis { is_logarithmic: true, ..axis("mass", &[1.0, 10.0, 100.0]) },
            axis("same", &[5.0; 3]),
        ],
        collected: vec![axis("swing", &[0.9, 0.4, 0.1])],
    };
    let svg = plot.parallel_coordinates().unwrap().svg().unwrap();
    let (top, middle, bottom) = (76.0, 250.0, 424.0);
    let [first, second, third] = [110.0, 330.0, 550.0];
    // Of 0.1 to 0.9 there are three eighths below 0.4.
    let swing = bottom - 0.375 * (bottom - top);
    assert_eq!(
        lines(&svg, "1"),
        [
            [[first, bottom], [second, middle], [third, top]],
            [[first, middle], [second, middle], [third, swing]],
            [[first, top], [second, middle], [third, bottom]],
        ]
    );
    let axes: Vec<_> = [first, second, third].map(|x| [[x, top], [x, bottom]]).into();
    assert_eq!(lines(&svg, "1.2"), axes);
    for (words, x, y) in [
        ("Pendulum: 3 members", second, 28.0),
        ("mass", first, 52.0),
        ("100", first, 69.0),
        ("1", first, 440.0),
        ("swing", third, 52.0),
        ("0.9", third, 69.0),
        ("0.1", third, 440.0),
    ] {
        let begin = format!("<text x=\"{x}\" y=\"{y}\" ");
        let end = format!(">{words}</text>");
        assert!(svg.lines().any(|line| line.starts_with(&begin) && line.ends_with(&end)), "{words}: {svg}");
    }
}

#[test]
fn a_member_without_a_number_has_no_line_and_the_others_keep_theirs() {
    let plot = SweepPlot {
        title: String::new(),
        varied: vec![axis("mass", &[1.0, 2.0, 3.0])],
        collected: vec![axis("swing", &[0.0, f64::NAN, 4.0])],
    };
    let found = lines(&plot.parallel_coordinates().unwrap().svg().unwrap(), "1");
    assert_eq!(found, [[[110.0, 424.0], [330.0, 424.0]], [[110.0, 76.0], [330.0, 76.0]]]);
}

#[test]
fn numbers_are_short_and_colours_pale() {
    for (number, words) in [
        (0.0, "0"),
        (-2.5, "-2.5"),
        (0.123_46, "0.1235"),
        (0.001, "0.001"),
        (1.5e-5, "1.5e-5"),
        (99_990.0, "99990"),
        (123_456.0, "123500"),
    ] {
        assert_eq!(short(number), words);
    }
    assert_eq!([paler([10, 20, 255], 1.0), paler([10, 20, 255], 0.0)], [[10, 20, 255], [255; 3]]);
    assert_eq!(paler([55, 155, 255], 0.5), [155, 205, 255]);
}

#[test]
fn words_are_numbered() {
    let axis = SweepAxis::of_words("scheme", &["hht", "radau-iia", "hht"].map(str::to_owned));
    assert_eq!(axis.values, [0.0, 1.0, 0.0]);
    assert_eq!(axis.name, "scheme (0 hht, 1 radau-iia)");
}
