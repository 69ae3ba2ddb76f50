//! Tests of `documentel_text`, a module of it.

use super::*;

const TEXT: &str = r#"
lissom = 1
title = "a \"b\"" # a comment
[parameters]
length = 0.1
area = "length^2"
[point_masses."my ball"]
mass = 0.30000000000000004
velocity = [3, 0, "sqrt(2)"]
[outputs.ball]
kind = "position"
of = "my ball"
[analysis]
kind = "dynamics"
end = 1
step = 1e-300
"#;

fn set(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect()
}

#[test]
fn a_text_opened_twice_is_the_same_as_a_text_read_twice() {
    let registry = Registry::default();
    let text = ModelText::read(TEXT, "a.toml", &set(&[("analysis.end", "2")])).unwrap();
    for step in ["1e-1", "1e-2"] {
        let both = set(&[("analysis.end", "2"), ("analysis.step", step)]);
        let once = text.document(&registry, &both[1..]).unwrap();
        let twice = Document::parse_with(TEXT, "a.toml", &registry, &both).unwrap();
        assert_eq!(format!("{once:?}"), format!("{twice:?}"));
    }
    let report = text.document(&registry, &set(&[("analysis.stepp", "1")])).unwrap_err().render(false);
    assert!(report.contains("stepp") && report.contains("[override:1"), "{report}");
}

#[test]
fn what_is_left_out_counts_as_never_written() {
    let registry = Registry::default();
    let without = |paths: &[&str], overrides: &[(&str, &str)]| {
        let paths: Vec<String> = paths.iter().map(|path| (*path).to_owned()).collect();
        let text = ModelText::read_without(TEXT, ("a.toml", &paths), &set(overrides), Arc::default());
        text.and_then(|text| text.document(&registry, &[]))
    };
    let document = without(&["title", "point_masses.\"my ball\".velocity"], &[]).unwrap();
    assert_eq!(document.title, None);
    let document = without(&["parameters.area"], &[("parameters.length", "3")]).unwrap();
    assert_eq!(document.parameters.keys().collect::<Vec<_>>(), ["length"]);
    for (path, words) in [
        ("titel", "did you mean `title`"),
        ("analysis.stepp", "did you mean `step`"),
        ("title.x", "is a value"),
        ("bodies.b", "no `bodies` here"),
    ] {
        let problem = without(&[path], &[]).unwrap_err().render(false);
        assert!(problem.contains(words) && problem.contains("[override:1:"), "{path}: {problem}");
    }
    // A removed value is reported as if it had never existed.
    let problem = without(&["point_masses.\"my ball\".mass"], &[]).unwrap_err().render(false);
    assert!(problem.contains("mass"), "{problem}");
}

#[test]
fn overrides_inside_parts_are_reported() {
    let text = format!("{TEXT}[parts.leg.point_masses.foot]\nmass = 1\n");
    let read = |value: &str| {
        let changes = set(&[("leg.foot.mass", value), ("analysis.end", "2")]);
        ModelText::read(&text, "a.toml", &changes).unwrap().overrides_inside_parts()
    };
    assert_eq!(read("3"), ["leg.foot.mass = 3"]);
    assert_ne!(read("3"), read("4"));
}

#[test]
fn a_text_written_anew_means_the_same() {
    let registry = Registry::default();
    let changed = set(&[("point_masses.\"my ball\".mass", "0.1"), ("analysis.scheme", "generalized-alpha")]);
    let text = ModelText::read(TEXT, "a.toml", &changed[..1]).unwrap();
    let again = text.to_toml();
    assert!(again.contains("mass = 0.1\n") && again.contains("step = 1e-300\n"), "{again}");
    assert!(again.find("length").unwrap() < again.find("area").unwrap(), "order matters: {again}");
    let first = text.document(&registry, &[]).unwrap();
    let second = Document::parse(&again, "a.toml", &registry).unwrap();
    assert_eq!(first.point_masses[0].velocity.unwrap().value, second.point_masses[0].velocity.unwrap().value);
    assert_eq!(first.parameters, second.parameters);
    assert_eq!(first.title, second.title);
    assert_eq!(ModelText::read(&again, "a.toml", &[]).unwrap().to_toml(), again);
}
