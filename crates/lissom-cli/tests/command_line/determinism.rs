//! What must not change a single bit: the order in which a file says things.

use std::collections::BTreeMap;

use crate::support::{Folder, example, lissom};

/// The tables of a model file in reverse order.
fn reversed(text: &str) -> String {
    let mut blocks = vec![String::new()];
    for line in text.lines() {
        if line.starts_with('[') {
            blocks.push(String::new());
        }
        let last = blocks.len() - 1;
        blocks[last].push_str(line);
        blocks[last].push('\n');
    }
    // What is before the first table belongs to none.
    blocks[1..].reverse();
    blocks.concat()
}

/// The columns of a table by their names, as they are written.
fn columns(table: &str) -> BTreeMap<&str, Vec<&str>> {
    let mut lines = table.lines().map(|line| line.split(','));
    let mut columns: Vec<(&str, Vec<&str>)> =
        lines.next().into_iter().flatten().map(|name| (name, Vec::new())).collect();
    for line in lines {
        for ((_, values), value) in columns.iter_mut().zip(line) {
            values.push(value);
        }
    }
    columns.into_iter().collect()
}

#[test]
fn sections_in_another_order_give_the_same_bits() {
    let folder = Folder::new("order");
    let models = [
        ("four-bar", "0.3"),
        ("tip-crank", "0.3"),
        ("satellite-latching-booms", "2"),
        ("double-wishbone", "0.3"),
        ("controlled-arm", "0.3"),
    ];
    for (name, end) in models {
        let text = std::fs::read_to_string(example(name)).expect("an example");
        folder.write("given.toml", &text);
        folder.write("reversed.toml", &reversed(&text));
        let table = |model: &str| {
            let (end, out) = (format!("analysis.end={end}"), format!("{model}.out"));
            let run =
                lissom(&["run", model, "--no-plots", "--quiet", "--set", &end, "--out", &out], folder.path());
            assert_eq!(run.code, 0, "{name}: {}", run.errors);
            std::fs::read_to_string(folder.path().join(out).join("history.csv")).expect("a table")
        };
        let (given, reversed) = (table("given.toml"), table("reversed.toml"));
        assert!(given.lines().count() > 10, "{name}");
        let (given, reversed) = (columns(&given), columns(&reversed));
        assert!(given == reversed, "{name}: {:?}", given.keys().find(|key| given[*key] != reversed[*key]));
    }
}
