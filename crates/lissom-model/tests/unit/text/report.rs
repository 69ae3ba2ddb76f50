//! Tests of `text::report`, a module of it.

use super::*;

#[test]
fn a_span_behind_the_file_is_shown_in_its_override() {
    let mut sources = Sources::new("a.toml", "x = 1\n");
    let start = sources.push("--set", "analysis.step = 0");
    let span = Span { start: start + 16, end: start + 17 };
    assert_eq!(sources.text(span), "0");
    let report = Report::new(vec![Problem::error(span, "bad").label("here").help("try")], &sources);
    let text = report.render(false);
    assert!(text.contains("[--set:1:17]") && text.contains("analysis.step = 0"), "{text}");
    assert!(text.contains("here") && text.contains("help: try"), "{text}");
    assert_eq!(report.to_string(), "a.toml: 1 error");
}

#[test]
fn a_place_is_in_a_table() {
    let text = "gravity = 1\n[joints.hinge]\naxis = [0, 0, 0]\n[springs]\ns.stiffness = 1\nt = 2\n";
    let at = |words: &str| table_at(text, text.find(words).unwrap());
    assert_eq!(at("1\n").as_deref(), Some("gravity"));
    assert_eq!(at("hinge]").as_deref(), Some("joints.hinge"));
    assert_eq!(at("[0, 0").as_deref(), Some("joints.hinge"));
    assert_eq!(at("1\nt").as_deref(), Some("springs.s"));
    assert_eq!(at("2").as_deref(), Some("springs"));
    assert_eq!(table_at("points = [\n[1],\n[2, 3]]\n", 15).as_deref(), None);
    assert_eq!(table_at("analysis.step = 0", 16).as_deref(), Some("analysis"));
}

#[test]
fn a_warning_names_its_entry_within_its_part() {
    let text = "[joints.\"a hinge\"]\naxis = 1\n";
    let mut sources = Sources::new("a.toml", text);
    let origin = Origin { part: "arm".to_owned(), place: Span::default() };
    let start = sources.push_shared("b.toml", text.into(), Some(origin));
    let warning = |start: usize| Problem::warning(Span { start, end: start + 4 }, "wrong").help("mend it");
    let report = Report::new(vec![warning(19), warning(start + 19)], &sources);
    let found: Vec<_> = report.remarks().collect();
    let parts: Vec<_> = found.iter().map(|remark| remark.part.entry()).collect();
    assert_eq!(parts, [Some("a hinge"), Some("arm.a hinge")]);
    assert_eq!((found[0].message.as_str(), found[0].help.as_str()), ("wrong", "mend it"));
}

#[test]
fn of_many_problems_the_first_are_shown_and_the_rest_are_counted() {
    let text = "x = 1\n".repeat(8000);
    let starts = line_starts(&text);
    let problem = |line: usize| {
        Problem::error(Span { start: starts[line], end: starts[line] + 2 }, format!("problem {line}"))
    };
    let report = Report::new((0..8000).map(problem).collect(), &Sources::new("a.toml", &text));
    let shown = report.render(false);
    assert!(shown.contains("problem 49\n") && !shown.contains("problem 50\n"), "{shown}");
    assert!(shown.contains("and 7950 more") && report.len() == 8000);
    let value = report.to_value();
    assert_eq!((&value[7999]["line"], &value[7999]["column"]), (&8000.into(), &1.into()));
    assert_eq!(value[0]["line"], 1);
}

#[test]
fn errors_come_before_warnings_and_in_the_order_of_the_text() {
    let at = |start| Span { start, end: start + 1 };
    let problems = vec![Problem::warning(at(0), "c"), Problem::error(at(4), "b"), Problem::error(at(2), "a")];
    let report = Report::new(problems, &Sources::new("a.toml", "abcdefg"));
    let order: Vec<_> = report.problems().map(|problem| problem.message.as_str()).collect();
    assert_eq!(order, ["a", "b", "c"]);
    assert_eq!(report.to_string(), "a.toml: 2 errors, 1 warning");
}
