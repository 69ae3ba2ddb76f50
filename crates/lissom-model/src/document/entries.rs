//! The entries of a table, each opened in its form.

use crate::format::top_level::Variants;
use crate::format::top_level::singular;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::Registry;
use crate::text::Node;
use crate::text::report::Span;

/// Tables of parts.
pub(super) const PARTS: [&str; 6] = ["beams", "shells", "solids", "bodies", "point_masses", "superelements"];

/// Reads every entry of a table that has a single form.
pub(super) fn each<'c, 'a, T>(
    context: &'c Context<'a>,
    table: &'static str,
    read: impl Fn(&Reader<'c, 'a>, &str) -> Option<T>,
) -> Vec<T>
where
    'a: 'c,
{
    let mut all = Vec::new();
    let entries = context.entries(table);
    if entries.is_empty() {
        return all;
    }
    let Some(form) = (context.forms)(table, &Registry::default()).all.into_iter().next() else { return all };
    for (name, span, node) in entries {
        let words = format!("{} `{name}`", singular(table));
        let reader = Reader::open(context, node, (words, span), form.keys.clone());
        all.extend(reader.and_then(|reader| read(&reader, name)));
    }
    all
}

/// Reads every entry of a table whose form is chosen by a word.
pub(super) fn each_of_kind<'c, 'a, T>(
    context: &'c Context<'a>,
    table: &'static str,
    registry: &Registry,
    read: impl Fn(&Reader<'c, 'a>, &str, &str) -> Option<T>,
) -> Vec<T>
where
    'a: 'c,
{
    let mut all = Vec::new();
    let entries = context.entries(table);
    if entries.is_empty() {
        return all;
    }
    // All forms of a table are built once for its entries: they take longer than an entry.
    let forms = (context.forms)(table, registry);
    for (name, span, node) in entries {
        let words = format!("{} `{name}`", singular(table));
        all.extend(
            of_form(context, (&forms, registry), (node, words, span))
                .and_then(|(reader, word)| read(&reader, name, word)),
        );
    }
    all
}

/// Opens a table whose form is chosen by a word, and gives the word.
pub(super) fn of_kind<'c, 'a>(
    context: &'c Context<'a>,
    table: &str,
    (node, words, span): (&'c Node, String, Span),
    registry: &Registry,
) -> Option<(Reader<'c, 'a>, &'static str)> {
    of_form(context, (&(context.forms)(table, registry), registry), (node, words, span))
}

/// Opens a table that has one of `forms`.
fn of_form<'c, 'a>(
    context: &'c Context<'a>,
    (forms, registry): (&Variants, &Registry),
    (node, words, span): (&'c Node, String, Span),
) -> Option<(Reader<'c, 'a>, &'static str)> {
    let chosen = crate::reading::reader::tag(
        context,
        node,
        forms.tag?,
        (&forms.words(), |word| registry.table_of(word)),
        (&words, span),
    )?;
    let form = forms.all.iter().find(|form| form.word == chosen.value)?;
    let reader = Reader::open(context, node, (words, span), form.keys.clone())?;
    Some((reader, form.word))
}
