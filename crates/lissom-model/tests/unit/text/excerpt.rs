//! Tests of `text::excerpt`, a module of it.

use super::*;

fn drawn(text: &str, labels: &[(Range<usize>, &str)]) -> String {
    let labels = labels.iter().map(|(range, words)| Label { range: range.clone(), words }).collect();
    let mut out = String::new();
    Painter { out: &mut out, colour: false }.excerpt(&Excerpt { name: "a.toml", text, labels });
    out
}

#[test]
fn labels_lie_below_their_text() {
    let text = "one = 1\ntwo = \"zwei\"\nthree = 3\n";
    let wanted = concat!(
        "   ╭─[a.toml:2:7]\n",
        " 1 │ one = 1\n",
        " 2 │ two = \"zwei\"\n",
        "   ·       ───┬──\n",
        "   ·          ╰── not a number\n",
        " 3 │ three = 3\n",
        "   ╰────\n",
    );
    assert_eq!(drawn(text, &[(14..20, "not a number")]), wanted);
}

#[test]
fn several_labels_and_distant_lines_are_shown() {
    let text = "a = [1, 2]\nb\nc\nd\ne\nf\ng = 7";
    let wanted = concat!(
        "   ╭─[a.toml:1:6]\n",
        " 1 │ a = [1, 2]\n",
        "   ·      ┬  ┬\n",
        "   ·      │  ╰── later\n",
        "   ·      ╰── first\n",
        " 2 │ b\n",
        "   ⋮\n",
        " 6 │ f\n",
        " 7 │ g = 7\n",
        "   · ─\n",
        "   ╰────\n",
    );
    assert_eq!(drawn(text, &[(5..6, "first"), (8..9, "later"), (21..22, "")]), wanted);
}

#[test]
fn long_lines_are_cut_around_their_labels() {
    let text = format!("short\nkey = [{}WRONG{}]\nend", "1, ".repeat(100), ", 2".repeat(100));
    let start = text.find("WRONG").unwrap();
    let drawn = drawn(&text, &[(start..start + 5, "here")]);
    let lines: Vec<&str> = drawn.lines().collect();
    assert!(drawn.lines().all(|line| line.chars().count() < MAX_COLUMNS + 10), "{drawn}");
    let shown = lines.iter().find(|line| line.contains("WRONG")).unwrap();
    assert!(shown.contains("│ …") && shown.ends_with('…'), "{drawn}");
    let column = |line: &str, sign: char| line.chars().position(|own| own == sign).unwrap();
    assert_eq!(column(lines[3], '─'), column(shown, 'W'), "{drawn}");
    assert!(lines[0].contains("a.toml:2:308"), "{drawn}");
}

#[test]
fn ends_of_texts_lines_and_characters_are_no_trouble() {
    for (text, range) in
        [("", 0..0), ("a", 1..1), ("a\n", 2..9), ("ä\tö = 1\r\nb", 3..5), ("ab\ncd", 1..5), ("ä", 1..2)]
    {
        let drawn = drawn(text, &[(range.clone(), "here")]);
        assert!(drawn.contains("a.toml"), "{text:?} {range:?}: {drawn}");
    }
    let tab = drawn("\tx = 1", &[(1..2, "here")]);
    assert!(tab.contains("│     x = 1\n   ·     ┬\n"), "{tab}");
}

#[test]
fn long_sentences_go_on_in_the_next_line() {
    let mut out = String::new();
    let words = ["word"; 40].join(" ");
    Painter { out: &mut out, colour: false }.sentence(Mark::Cross, &words);
    assert!(out.starts_with("  × word") && out.contains("\n  │ word"), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= WIDTH));
    assert_eq!(out.matches("word").count(), 40);
}
