//! Common functions of readers of XML: parsing, positions in the text, numbers.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use super::ImportError;

pub(super) fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    Document::parse(text).map_err(|error| ImportError::new(format!("this is no XML text: {error}")))
}

/// Name of the root element.
pub(super) fn root_tag(text: &str) -> Result<String, ImportError> {
    Ok(parse(text)?.root_element().tag_name().name().to_owned())
}

pub(super) fn children<'a>(node: Node<'a, 'a>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

/// Line of the text at which an element begins.
pub(super) fn line(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

/// The numbers of a text, if all are finite.
pub(super) fn finite_numbers(text: &str) -> Option<Vec<f64>> {
    let parts: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
    parts.ok().filter(|values| values.iter().all(|value| value.is_finite()))
}

/// Names of elements with how often each occurs, such as `3 <camera>`.
pub(super) fn counted(tags: impl Iterator<Item = String>) -> Vec<String> {
    let mut counts = BTreeMap::<String, usize>::new();
    tags.for_each(|tag| *counts.entry(tag).or_default() += 1);
    counts.iter().map(|(tag, count)| format!("{count} <{tag}>")).collect()
}
