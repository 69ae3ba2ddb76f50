//! Reads a sweep file: words, values, and the table of samples.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::sampling::{Draw, SAMPLINGS, SamplingKind, WORDS};
use super::statistic::{self, STATISTICS};
use super::window::{self, Window};
use super::{Collected, MAX_MEMBERS, SweepFile, SweepValue, VERSION, Variation, Varied};
use crate::format::keys::{Key, Shape, choice, required, unitless};
use crate::format::suggest;
use crate::format::top_level::Variants;
use crate::parts::Expanded;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::ROOT;
use crate::text::report::{Problem, Report, Severity, Span};
use crate::text::toml_text::{inline, key};
use crate::text::{self, Node, Value, in_order};

/// Columns of the table in addition to the varied paths and the collected scalars.
const OTHER_COLUMNS: [&str; 6] =
    ["member", "state", "time", "steps", "max_constraint_violation", "diagnosis"];

impl SweepFile {
    /// Reads a sweep file's text. `file_name` is for messages only.
    ///
    /// # Errors
    /// If anything is wrong: a report of all mistakes that could be found.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, Report> {
        let tree = text::read(text, file_name, &[], Arc::default());
        if !tree.problems.is_empty() {
            return Err(Report::new(tree.problems, &tree.sources));
        }
        let plain = Expanded::plain(tree.root.clone(), tree.sources.clone());
        let context =
            Context::new(&plain, |_, _| Variants { tag: None, is_inferred: false, all: Vec::new() });
        let root = Node { span: Span::default(), scope: ROOT, value: Value::Table(tree.root.clone()) };
        let sweep = decode(&context, &root);
        let problems = context.into_problems();
        match sweep {
            Some(sweep) if problems.iter().all(|problem| problem.severity == Severity::Warning) => Ok(sweep),
            _ if problems.is_empty() => {
                // Every reader that gives nothing has reported why; this is for the case that one forgot.
                let problem = Problem::error(Span::default(), "the sweep could not be read");
                Err(Report::new(vec![problem], &tree.sources))
            }
            _ => Err(Report::new(problems, &tree.sources)),
        }
    }
}

fn keys() -> Vec<Key> {
    vec![
        required("lissom_sweep", Shape::Version, "", "version of the format of sweep files"),
        unitless("model", Shape::Text, "path of the model file, relative to this file"),
        unitless("sampling", choice(&WORDS), "how values are combined or drawn").or_word(SAMPLINGS[0].name),
        unitless(
            "members",
            Shape::Count(1, MAX_MEMBERS),
            "number of members, for random and quasi-random sampling",
        ),
        unitless("seed", Shape::Count(0, 1 << 53), "start of the random numbers").or_count(0),
        unitless("set", Shape::Table, "paths of the model and the value each has in all members"),
        required("vary", Shape::Table, "", "paths of the model and the values of each"),
        required("collect", Shape::Table, "", "scalars to be collected by name, such as max(tip.u2)"),
        unitless("histories", Shape::Words, "columns whose histories are written, such as [\"tip.u2\"]"),
    ]
}

fn decode(context: &Context<'_>, root: &Node) -> Option<SweepFile> {
    let reader = Reader::open(context, root, ("the sweep".to_owned(), Span::default()), keys())?;
    version(context, &reader)?;
    let word = reader.choice("sampling")?.value;
    let sampling = SAMPLINGS.iter().find(|kind| kind.name == word)?;
    let seed = reader.count("seed")?.value as u64;
    let set = set(context, &reader);
    let vary = vary(context, &reader, sampling)?;
    let collect = collect(context, &reader)?;
    let histories = histories(context, &reader);
    check_columns(context, &vary, &collect, &set);
    if context.has_errors() {
        return None;
    }
    let (members, samples) = samples(context, &reader, sampling, &vary, seed)?;
    let model = reader.text("model").map(|model| model.value.to_owned());
    Some(SweepFile {
        model,
        set,
        sampling: sampling.name,
        seed,
        vary: vary.into_iter().map(|(varied, _)| varied).collect(),
        collect: collect.into_iter().map(|(collected, _)| collected).collect(),
        histories,
        members,
        samples,
    })
}

fn version(context: &Context<'_>, reader: &Reader<'_, '_>) -> Option<()> {
    let node = reader.node("lissom_sweep")?;
    if matches!(node.value, Value::Number(number) if number == VERSION as f64) {
        return Some(());
    }
    let help = format!("this program reads version {VERSION}: write `lissom_sweep = {VERSION}`");
    context.fail(node.span, "this version of the format of sweep files is not supported", help)
}

/// Leaves of nested tables with their paths. `is_leaf` states whether a table itself is a leaf.
fn leaves<'n>(
    node: &'n Node,
    path: &str,
    is_leaf: &dyn Fn(&Node) -> bool,
    found: &mut Vec<(String, Span, &'n Node)>,
) {
    let Some(table) = node.table() else { return };
    for (name, span, inner) in in_order(table) {
        // A name with a dot is a path as it is written; others are keys.
        let step = if name.contains('.') { name.to_owned() } else { key(name) };
        let path = if path.is_empty() { step } else { format!("{path}.{step}") };
        if inner.table().is_some() && !is_leaf(inner) {
            leaves(inner, &path, is_leaf, found);
        } else {
            found.push((path, span, inner));
        }
    }
}

fn table_of<'c>(context: &Context<'_>, reader: &Reader<'c, '_>, word: &str) -> Option<&'c Node> {
    let node = reader.node(word)?;
    if node.table().is_some() {
        Some(node)
    } else {
        context.wrong_type(node, &format!("`{word}`"), "a table")
    }
}

fn set(context: &Context<'_>, reader: &Reader<'_, '_>) -> Vec<(String, String)> {
    let mut found = Vec::new();
    if let Some(node) = table_of(context, reader, "set") {
        leaves(node, "", &|_| false, &mut found);
    }
    found.into_iter().map(|(path, _, node)| (path, inline(node))).collect()
}

/// Words of which each makes a table a variation.
const MARKS: [&str; 3] = ["values", "from", "mean"];

fn vary(
    context: &Context<'_>,
    reader: &Reader<'_, '_>,
    sampling: &SamplingKind,
) -> Option<Vec<(Varied, Span)>> {
    let node = table_of(context, reader, "vary")?;
    let is_leaf = |node: &Node| {
        node.table().is_some_and(|table| {
            let is_value = |mark: &&str| table.get(*mark).is_some_and(|entry| entry.node.table().is_none());
            table.is_empty() || MARKS.iter().any(is_value)
        })
    };
    let mut found = Vec::new();
    leaves(node, "", &is_leaf, &mut found);
    if found.is_empty() {
        return context.fail(
            node.span,
            "the sweep varies no values",
            "add for example vary.\"analysis.step\" = [1e-3, 1e-4]",
        );
    }
    let of = |(path, span, node): (String, Span, &Node)| {
        let variation = variation(context, (&path, span), node)?;
        check_sampling(context, (&path, span), &variation, sampling);
        Some((Varied { path, variation }, span))
    };
    let all: Vec<Option<_>> = found.into_iter().map(of).collect();
    all.into_iter().collect()
}

fn variation(context: &Context<'_>, (path, span): (&str, Span), node: &Node) -> Option<Variation> {
    let what = format!("the variation of `{path}`");
    if let Value::List(list) = &node.value {
        return listed(context, list, node.span, &what);
    }
    let Some(table) = node.table() else {
        return context.fail(
            node.span,
            format!("{what} must be a list of values or a table"),
            "write [1, 2, 3], { from = 1, to = 3, count = 5 } or { mean = 1, standard_deviation = 0.1 }; \
             a fixed value belongs below [set]",
        );
    };
    let open = |keys| Reader::open(context, node, (what.clone(), span), keys);
    if table.contains_key("values") {
        let reader = open(vec![required("values", Shape::Rows, "", "the values")])?;
        let values = reader.node("values")?;
        let Value::List(list) = &values.value else {
            return context.wrong_type(values, &reader.words("values"), "a list");
        };
        return listed(context, list, values.span, &what);
    }
    if table.contains_key("mean") || table.contains_key("standard_deviation") {
        let reader = open(vec![
            required("mean", Shape::Number, "", "mean"),
            required("standard_deviation", Shape::Positive, "", "standard deviation"),
        ])?;
        let (mean, deviation) = (reader.number("mean"), reader.number("standard_deviation"));
        return Some(Variation::Normal { mean: mean?.value, standard_deviation: deviation?.value });
    }
    let reader = open(vec![
        required("from", Shape::Number, "", "the first value"),
        required("to", Shape::Number, "", "the last value"),
        unitless("count", Shape::Count(2, MAX_MEMBERS), "number of values, for grids and lists"),
        unitless("spacing", choice(&["linear", "logarithmic"]), "between the values").or_word("linear"),
    ])?;
    let (from, to) = (reader.number("from"), reader.number("to"));
    let count = reader.count("count").map(|count| count.value);
    let logarithmic = reader.choice("spacing")?.value == "logarithmic";
    let (from, to) = (from?, to?);
    if from.value == to.value {
        let help = "write two different numbers, or a fixed value below [set]";
        return context.fail(to.span, format!("{what} ends where it begins"), help);
    }
    if logarithmic && !(from.value > 0.0 && to.value > 0.0) {
        let message = format!("{what} is logarithmic and must be greater than zero");
        return context.fail(from.span, message, "write two numbers greater than zero, or remove `spacing`");
    }
    Some(Variation::Range { from: from.value, to: to.value, count, logarithmic })
}

fn listed(context: &Context<'_>, list: &[Node], span: Span, what: &str) -> Option<Variation> {
    if list.is_empty() {
        return context.fail(span, format!("{what} has no values"), "write at least one");
    }
    let value = |node: &Node| match &node.value {
        Value::Number(number) if number.is_finite() => Some(SweepValue::Number(*number)),
        Value::Number(_) => {
            context.fail(node.span, format!("{what} has a number that is not finite"), "remove it")
        }
        Value::Text(text) if text.contains(['\n', '\r']) => {
            context.fail(node.span, format!("{what} has a text of several lines"), "write it on one line")
        }
        Value::Text(text) => Some(SweepValue::Text(text.clone())),
        Value::Date => context.fail(node.span, format!("{what} has a date"), "no value of a model is a date"),
        _ => Some(SweepValue::Toml(inline(node))),
    };
    let values: Vec<Option<SweepValue>> = list.iter().map(value).collect();
    values.into_iter().collect::<Option<Vec<_>>>().map(Variation::Listed)
}

/// Whether the sampling can do with the variation.
fn check_sampling(
    context: &Context<'_>,
    (path, span): (&str, Span),
    variation: &Variation,
    sampling: &SamplingKind,
) {
    let name = sampling.name;
    match (&sampling.draw, variation) {
        (Draw::Indices(_), variation) if variation.count().is_none() => {
            let message = format!("the sampling `{name}` requires the number of values of `{path}`");
            context.fail::<()>(
                span,
                message,
                "list them, or specify `from`, `to` and `count`; or choose another `sampling`",
            );
        }
        (Draw::Fractions(_), Variation::Range { count: Some(_), .. }) => {
            let message =
                format!("`count` of `{path}` has no meaning: the sampling `{name}` draws the values");
            context.fail::<()>(span, message, "remove `count`: `members` specifies the number");
        }
        _ => {}
    }
}

fn collect(context: &Context<'_>, reader: &Reader<'_, '_>) -> Option<Vec<(Collected, Span)>> {
    let node = table_of(context, reader, "collect")?;
    let entries = node.table().map(in_order).unwrap_or_default();
    if entries.is_empty() {
        return context.fail(
            node.span,
            "the sweep collects no values",
            "add for example collect.tip = \"final(tip.u2)\"",
        );
    }
    let of = |(name, span, node): (&str, Span, &Node)| {
        let Value::Text(text) = &node.value else {
            return context.wrong_type(
                node,
                &format!("`{name}` of `collect`"),
                "a text, such as \"max(tip.u2)\"",
            );
        };
        let words = || {
            let names = STATISTICS.iter().map(|statistic| statistic.name);
            format!(
                "write a statistic and a column, such as \"max(tip.u2)\"; statistics are {}",
                suggest::list(names)
            )
        };
        let parts = text.trim().strip_suffix(')').and_then(|text| text.split_once('('));
        let Some((word, column)) = parts else {
            return context.fail(node.span, format!("`{name}` of `collect` cannot be read"), words());
        };
        let (word, arguments) = (word.trim(), window::split(column));
        let Some(found) = statistic::find(word) else {
            let known = STATISTICS.iter().map(|statistic| statistic.name);
            let help = suggest::help(word, known).unwrap_or_else(words);
            return context.fail(node.span, format!("`{word}` is not a statistic"), help);
        };
        let window = match Window::of_parts(&arguments[1..]) {
            Ok(window) => window,
            Err(error) => return context.fail(node.span, error.message, error.remedy),
        };
        let (name, column) = (name.to_owned(), arguments[0].to_owned());
        let position = context.sources.position(node.span);
        Some((Collected { name, statistic: found.name, column, window, position }, span))
    };
    let all: Vec<Option<_>> = entries.into_iter().map(of).collect();
    all.into_iter().collect()
}

/// Columns of which everything is kept, each once.
fn histories(context: &Context<'_>, reader: &Reader<'_, '_>) -> Vec<String> {
    let Some(node) = reader.node("histories") else { return Vec::new() };
    let Value::List(entries) = &node.value else {
        context.wrong_type::<()>(node, "`histories`", "a list of columns, such as [\"tip.u2\"]");
        return Vec::new();
    };
    let mut all: Vec<String> = Vec::new();
    for entry in entries {
        match &entry.value {
            Value::Text(name) if all.contains(name) || name == "time" || name == "member" => {
                let message = format!("the histories would have two columns `{name}`");
                context.fail::<()>(
                    entry.span,
                    message,
                    "name each column of the model once; member and time are always there",
                );
            }
            Value::Text(name) => all.push(name.clone()),
            _ => {
                context.wrong_type::<()>(entry, "an entry of `histories`", "a text, such as \"tip.u2\"");
            }
        }
    }
    all
}

/// Every column of the table requires a distinct name, and a path has either one value or several.
fn check_columns(
    context: &Context<'_>,
    vary: &[(Varied, Span)],
    collect: &[(Collected, Span)],
    set: &[(String, String)],
) {
    let mut known: BTreeSet<&str> = OTHER_COLUMNS.into_iter().collect();
    let paths = vary.iter().map(|(varied, span)| (varied.path.as_str(), *span));
    let names = collect.iter().map(|(collected, span)| (collected.name.as_str(), *span));
    for (name, span) in paths.chain(names) {
        if !known.insert(name) {
            let message = format!("the table would have two columns `{name}`");
            context.fail::<()>(
                span,
                message,
                "choose another name for what is collected; vary each path once",
            );
        }
    }
    for (varied, span) in vary {
        if set.iter().any(|(path, _)| *path == varied.path) {
            let message = format!("`{}` is set and varied", varied.path);
            context.fail::<()>(*span, message, "remove it below [set]");
        }
    }
}

/// Number of members, and the table of samples.
fn samples(
    context: &Context<'_>,
    reader: &Reader<'_, '_>,
    sampling: &SamplingKind,
    vary: &[(Varied, Span)],
    seed: u64,
) -> Option<(usize, Vec<f64>)> {
    let span = reader.node("sampling").map_or(vary[0].1, |node| node.span);
    let fail = |message: String| context.fail::<()>(span, message, "change `sampling`, or the values");
    let name = sampling.name;
    let of = |path: usize| &vary[path % vary.len()].0.variation;
    match sampling.draw {
        Draw::Indices(draw) => {
            for key in
                ["members", "seed"].into_iter().filter_map(|key| reader.node(key).map(|node| (key, node)))
            {
                let message = format!("`{}` has no effect: the sampling `{name}` is not random", key.0);
                context.fail::<()>(key.1.span, message, "remove it, or choose another `sampling`");
            }
            let counts: Vec<usize> = vary.iter().filter_map(|(varied, _)| varied.variation.count()).collect();
            let indices = draw(&counts).map_err(fail);
            let indices = indices.ok().filter(|indices| !indices.is_empty())?;
            let samples = indices.iter().enumerate().map(|(at, index)| of(at).at_index(*index)).collect();
            Some((indices.len() / vary.len(), samples))
        }
        Draw::Fractions(draw) => {
            let Some(members) = reader.count("members") else {
                return match reader.node("members") {
                    Some(_) => None,
                    None => context.fail(
                        span,
                        format!("the sampling `{name}` requires the number of members"),
                        "add `members = 64`",
                    ),
                };
            };
            let drawn = draw(vary.len(), members.value, seed).map_err(fail).ok()?;
            let samples = drawn.iter().enumerate().map(|(at, u)| of(at).at_fraction(*u)).collect();
            Some((members.value, samples))
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/sweep/decode.rs"]
mod tests;
