//! Common functions of readers of XML: parsing, positions in the text, numbers.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::{Document, Node};

use super::ImportError;
use crate::encodings::tags::tags;
pub(super) use crate::encodings::tags::{MAX_DEPTH, too_deep, without_comments};

/// Parses a text.
///
/// # Errors
/// If it is no XML text, or elements are nested more deeply than [`MAX_DEPTH`].
pub(super) fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    if let Some(at) = too_deep(text) {
        let line = 1 + text[..at].matches('\n').count();
        let message =
            format!("line {line}: more than {MAX_DEPTH} elements contain each other one in the other");
        return Err(ImportError::new(message));
    }
    Document::parse(text).map_err(|error| ImportError::new(format!("this is no XML text: {error}")))
}

/// The text with declarations of the prefixes of names that it lacks, which programs that know no namespaces accept.
pub(super) fn with_prefixes(mut text: String) -> String {
    let mut declared = BTreeSet::new();
    while let Err(roxmltree::Error::UnknownNamespace(prefix, _)) = Document::parse(&text) {
        let Some((at, _)) = tags(&text).find(|(_, tag)| !tag.starts_with("<!") && !tag.starts_with("<?"))
        else {
            break;
        };
        let name = text[at..].find(|sign: char| sign.is_whitespace() || sign == '>' || sign == '/');
        let Some(length) = name.filter(|_| declared.insert(prefix.clone())) else { break };
        text.insert_str(at + length, &format!(" xmlns:{prefix}=\"{prefix}\""));
    }
    text
}

/// Whether an element belongs to another format than the root.
pub(super) fn is_foreign(node: Node<'_, '_>) -> bool {
    node.is_element() && node.tag_name().namespace() != node.document().root_element().tag_name().namespace()
}

/// Name of the root element.
pub(super) fn root_tag(text: &str) -> Result<String, ImportError> {
    Ok(parse(text)?.root_element().tag_name().name().to_owned())
}

/// Children of this tag, without those of other formats.
pub(super) fn children<'a>(node: Node<'a, 'a>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.has_tag_name(tag) && !is_foreign(*child))
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

/// Where the lines of a text begin: for the locations of all its elements, without a scan of the text for each.
#[derive(Default)]
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn of(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at).collect())
    }

    /// Location at which an element of the text begins, such as `line 3`.
    pub(super) fn location(&self, node: Node<'_, '_>) -> String {
        format!("line {}", 1 + self.0.partition_point(|at| *at < node.range().start))
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
