//! Common functions of readers of XML: parsing, positions in the text, numbers.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use super::ImportError;

/// Largest number of elements that contain an element one in the other, and of files that include each other so. The readers are
/// recursive.
pub(super) const MAX_DEPTH: usize = 500;

/// Parses a text.
///
/// # Errors
/// If it is no XML text, or elements are nested more deeply than [`MAX_DEPTH`].
pub(super) fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    let document =
        Document::parse(text).map_err(|error| ImportError::new(format!("this is no XML text: {error}")))?;
    let mut depths = Vec::new();
    for node in document.descendants().filter(Node::is_element) {
        let around = node.parent_element().map_or(0, |parent| depths[parent.id().get_usize()]);
        let depth = around + 1;
        if depth > MAX_DEPTH {
            let message = format!(
                "{}: <{}> is the {depth}th of elements that contain each other: at most {MAX_DEPTH} are read",
                location(node),
                node.tag_name().name()
            );
            return Err(ImportError::new(message));
        }
        depths.resize(node.id().get_usize(), 0);
        depths.push(depth);
    }
    Ok(document)
}

/// Name of the root element.
pub(super) fn root_tag(text: &str) -> Result<String, ImportError> {
    Ok(parse(text)?.root_element().tag_name().name().to_owned())
}

pub(super) fn children<'a>(node: Node<'a, 'a>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

/// Target of a processing instruction after which the text is that of another file, from a line on: `line file`, without a
/// file for that of the robot.
pub(super) const SOURCE: &str = "lissom-source";

/// Location at which an element begins, such as `line 3`, or `line 3 of legs.xml` for an included file.
pub(super) fn location(node: Node<'_, '_>) -> String {
    let before = &node.document().input_text()[..node.range().start];
    let lines = |text: &str| text.matches('\n').count();
    let marked = before.rsplit_once(&format!("<?{SOURCE} ")).and_then(|(_, marked)| {
        let (own, since) = marked.split_once("?>")?;
        let (line, file) = own.split_once(' ')?;
        Some((line.parse::<usize>().ok()? + lines(since), file))
    });
    match marked {
        Some((line, file)) if !file.is_empty() => format!("line {line} of {file}"),
        Some((line, _)) => format!("line {line}"),
        None => format!("line {}", 1 + lines(before)),
    }
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
