//! From a tree of values back to TOML, in the order of the text it came from.

use std::fmt::Write;

use crate::text::number::number_text;
use crate::text::{Node, Table, Value, in_order};

/// A table as a file: values first, then the tables in it, each below its heading.
pub(crate) fn file(root: &Table) -> String {
    let mut text = String::new();
    tables(root, &mut Vec::new(), &mut text);
    text
}

fn tables<'t>(table: &'t Table, path: &mut Vec<&'t str>, text: &mut String) {
    let entries = in_order(table);
    let (inner, values): (Vec<_>, Vec<_>) =
        entries.into_iter().partition(|(_, _, node)| node.table().is_some());
    if !path.is_empty() && (!values.is_empty() || inner.is_empty()) {
        let names: Vec<String> = path.iter().map(|name| key(name)).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}[{}]", if text.is_empty() { "" } else { "\n" }, names.join("."));
    }
    for (name, _, node) in values {
        let _ = writeln!(text, "{} = {}", key(name), inline(node));
    }
    for (name, _, node) in inner {
        if let Some(inner) = node.table() {
            path.push(name);
            tables(inner, path, text);
            path.pop();
        }
    }
}

/// A value on one line.
pub(crate) fn inline(node: &Node) -> String {
    match &node.value {
        Value::Text(text) => quoted(text),
        Value::Number(number) if number.is_nan() => "nan".to_owned(),
        Value::Number(number) => number_text(*number),
        Value::Flag(flag) => flag.to_string(),
        // No value of a model is a date: the decoder has rejected it.
        Value::Date => "\"date\"".to_owned(),
        Value::List(list) => format!("[{}]", list.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let entry = |(name, _, node): (&str, _, &Node)| format!("{} = {}", key(name), inline(node));
            format!("{{ {} }}", in_order(table).into_iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A key, in quotes where it needs them.
pub fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { quoted(name) }
}

/// A text in the quotes of TOML.
pub fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
