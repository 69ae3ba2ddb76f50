//! Numbers of a model file by their paths, such as `bodies.top.mass`.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::expression::Expression;
use crate::text::{self, Value};

/// The number at `path` in a model's `text`, with `overrides` put in place; expressions may name `parameters`.
///
/// # Errors
/// If there is no number at the path; in words.
pub fn number_at(
    text: &str,
    overrides: &[(String, String)],
    parameters: &BTreeMap<String, f64>,
    path: &str,
) -> Result<f64, String> {
    let tree = text::read(text, "", overrides, Arc::default());
    let mut keys = path.split('.').map(str::trim);
    let first = keys.next().unwrap_or_default();
    let mut node = tree.root.get(first).map(|entry| &entry.node);
    for key in keys {
        node = node.and_then(|node| node.table()).and_then(|table| table.get(key)).map(|entry| &entry.node);
    }
    match node.map(|node| &node.value) {
        None => Err(format!(
            "the model file has no number at `{path}`: write it explicitly, even if it is the default"
        )),
        Some(Value::Number(value)) => Ok(*value),
        Some(Value::Text(words)) => Expression::parse(words, None, parameters)
            .ok()
            .and_then(|expression| expression.constant())
            .ok_or_else(|| format!("`{path}` is not a number: \"{words}\"")),
        Some(Value::List(_)) => Err(format!(
            "`{path}` is a list: use a parameter in it, such as \"a\", and write `parameters.a` as the path"
        )),
        Some(Value::Table(_)) => Err(format!("`{path}` is a table: write the path of a number in it")),
        Some(_) => Err(format!("`{path}` is not a number")),
    }
}

/// Names and values of the entries of a table at the top of a model's `text`, with `overrides` put in place, that are written as
/// plain numbers; those that are expressions, which follow from others, are omitted.
pub fn written_numbers(text: &str, overrides: &[(String, String)], table: &str) -> Vec<(String, f64)> {
    let tree = text::read(text, "", overrides, Arc::default());
    let Some(table) = tree.root.get(table).and_then(|entry| entry.node.table()) else { return Vec::new() };
    let number = |(name, _, node): (&str, _, &text::Node)| match node.value {
        Value::Number(value) => Some((name.to_owned(), value)),
        _ => None,
    };
    text::in_order(table).into_iter().filter_map(number).collect()
}
