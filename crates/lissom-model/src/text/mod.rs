//! Conversion of text and overrides to one tree of values with their positions. Independent of the meaning of keys.

mod excerpt;
pub(crate) mod number;
pub(crate) mod report;
pub mod toml_text;

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::files::library::Library;
use crate::format::suggest;
use crate::format::top_level;
use crate::text::report::{OVERRIDE, Problem, Shift, Sources, Span};

/// Number of a scope of names, parameters and positions.
pub(crate) type ScopeId = usize;

/// The scope of the model itself.
pub(crate) const ROOT: ScopeId = 0;

/// A value and its position.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) span: Span,
    /// Where its names and positions count.
    pub(crate) scope: ScopeId,
    pub(crate) value: Value,
}

/// A value as TOML has it.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    /// Integer or float; not finite where the text is not.
    Number(f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    Table(Table),
}

/// A key's position and its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) key: Span,
    pub(crate) node: Node,
}

/// Entries by key.
pub(crate) type Table = BTreeMap<String, Entry>;

impl Node {
    /// The table, if it is one.
    pub(crate) fn table(&self) -> Option<&Table> {
        match &self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }

    /// This value where its text is there again, in another scope.
    pub(crate) fn moved(&self, by: Shift, scope: ScopeId) -> Self {
        let value = match &self.value {
            Value::List(list) => Value::List(list.iter().map(|entry| entry.moved(by, scope)).collect()),
            Value::Table(table) => Value::Table(moved(table, by, scope)),
            other => other.clone(),
        };
        Self { span: self.span.moved(by), scope, value }
    }
}

/// Entries of a table where their text is there again, in another scope.
pub(crate) fn moved(table: &Table, by: Shift, scope: ScopeId) -> Table {
    let entry = |(name, entry): (&String, &Entry)| {
        (name.clone(), Entry { key: entry.key.moved(by), node: entry.node.moved(by, scope) })
    };
    table.iter().map(entry).collect()
}

fn node(value: Spanned<DeValue<'_>>) -> Node {
    let span = value.span().into();
    let value = match value.into_inner() {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(integer) => Value::Number(
            i64::from_str_radix(integer.as_str(), integer.radix())
                .map_or_else(|_| integer.as_str().parse().unwrap_or(f64::INFINITY), |value| value as f64),
        ),
        DeValue::Float(float) => Value::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(array) => Value::List(array.into_iter().map(node).collect()),
        DeValue::Table(inner) => Value::Table(table(inner)),
    };
    Node { span, scope: ROOT, value }
}

fn table(table: DeTable<'_>) -> Table {
    let entry = |(key, value): (Spanned<std::borrow::Cow<'_, str>>, _)| {
        let place = key.span().into();
        (key.into_inner().into_owned(), Entry { key: place, node: node(value) })
    };
    table.into_iter().map(entry).collect()
}

/// A tree, its texts, and their errors.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    pub(crate) root: Table,
    pub(crate) sources: Sources,
    pub(crate) problems: Vec<Problem>,
    /// Overrides of entries that exist only after the expansion of parts.
    pub(crate) deferred: Vec<Patch>,
    /// The files it includes.
    pub(crate) library: Arc<Library>,
}

/// Reads the file's `text` and lays the overrides `(path, value)` over it. Included files are looked for in `library`.
pub(crate) fn read(
    text: &str,
    file_name: &str,
    overrides: &[(String, String)],
    library: Arc<Library>,
) -> Tree {
    let sources = Sources::new(file_name, text);
    let (root, problems) = match parse(text) {
        Ok(root) => (root, Vec::new()),
        Err(problem) => (Table::new(), vec![*problem]),
    };
    let mut tree = Tree { root, sources, problems, deferred: Vec::new(), library };
    tree.lay(overrides);
    tree
}

impl Tree {
    /// Leaves out the values and entries that paths lead to, such as `analysis.step` or `springs.damper`.
    pub(crate) fn leave_out(&mut self, paths: &[String]) {
        if !self.problems.is_empty() {
            return;
        }
        for path in paths {
            let start = self.sources.next_start();
            self.sources.push(OVERRIDE, path.trim());
            let (_, patch) = parse_override(path, "0", start);
            let done = patch.and_then(|patch| {
                if patch.is_of_part(&self.root) {
                    let place = patch.path.first().map(|(_, span)| *span).unwrap_or_default();
                    let message = format!("`{path}` is in a part, where nothing can be removed");
                    let help = "change the file that the part is made of, or set another value";
                    return Err(Box::new(Problem::error(place, message).help(help)));
                }
                patch.leave_out(&mut self.root)
            });
            self.problems.extend(done.err().map(|problem| *problem));
        }
    }

    /// Applies the overrides `(path, value)`.
    pub(crate) fn lay(&mut self, overrides: &[(String, String)]) {
        let readable = self.problems.is_empty();
        for (path, value) in overrides {
            let start = self.sources.next_start();
            let (shown, patch) = parse_override(path, value, start);
            self.sources.push(OVERRIDE, &shown);
            // Without a readable file there is nothing to override.
            let done = patch.and_then(|patch| match () {
                () if !readable => Ok(()),
                () if patch.is_of_part(&self.root) => {
                    self.deferred.push(patch);
                    Ok(())
                }
                () => patch.apply(&mut self.root),
            });
            self.problems.extend(done.err().map(|problem| *problem));
        }
    }
}

/// Only the first error in the text is reported: subsequent ones are usually its consequences.
pub(crate) fn parse(text: &str) -> Result<Table, Box<Problem>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    let place = |error: &toml::de::Error| error.span().map_or(Span::default(), Span::from);
    if let Some(first) = errors.iter().min_by_key(|error| place(error)) {
        return Err(Box::new(syntax_problem(first.message(), place(first), text)));
    }
    let root = table(root.into_inner());
    match control_character(&root) {
        Some((span, sign)) => {
            let message = format!("the text contains the control character U+{:04X}", u32::from(sign));
            let help = "remove it: it would change what terminals and other programs show";
            Err(Box::new(Problem::error(span, message).help(help)))
        }
        None => Ok(root),
    }
}

/// The first control character of the keys and texts, except for tabs and ends of lines.
fn control_character(table: &Table) -> Option<(Span, char)> {
    fn in_value(node: &Node) -> Option<(Span, char)> {
        match &node.value {
            Value::Text(text) => in_text(text, node.span),
            Value::List(list) => list.iter().find_map(in_value),
            Value::Table(table) => control_character(table),
            Value::Number(_) | Value::Flag(_) | Value::Date => None,
        }
    }
    fn in_text(text: &str, span: Span) -> Option<(Span, char)> {
        let sign = text.chars().find(|sign| sign.is_control() && !['\t', '\n', '\r'].contains(sign))?;
        Some((span, sign))
    }
    table.iter().find_map(|(name, entry)| in_text(name, entry.key).or_else(|| in_value(&entry.node)))
}

fn syntax_problem(message: &str, mut span: Span, text: &str) -> Problem {
    // An empty range cannot be underlined: use the character before it.
    if span.start >= span.end {
        let end = span.start.min(text.len());
        let start =
            text.get(..end).and_then(|before| before.char_indices().next_back()).map_or(0, |(at, _)| at);
        span = Span { start, end: end.max(start) };
    }
    let help = if message.contains("duplicate") {
        "every name and key may be given only once in its table"
    } else if message.contains("string values must be quoted") {
        "texts and expressions are in quotes, such as \"sin(t)\"; numbers are written as 1.5 or 2e11"
    } else if text.get(span.end..).is_some_and(|rest| rest.starts_with(','))
        && text.get(..span.end).is_some_and(|before| before.ends_with(|last: char| last.is_ascii_digit()))
    {
        "decimals have a point, such as 1.5"
    } else {
        "the file is TOML: key = value lines below [table] headings"
    };
    Problem::error(span, format!("the text is not TOML: {message}")).help(help)
}

/// A value and the keys that lead to it.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    pub(crate) path: Vec<(String, Span)>,
    pub(crate) value: Node,
}

/// Reads `path = value` as if it stood at `start`. A value that is no TOML counts as a text.
fn parse_override(path: &str, value: &str, start: usize) -> (String, Result<Patch, Box<Problem>>) {
    let (path, value) = (path.trim(), value.trim());
    let padding = " ".repeat(start);
    let read = |shown: &str| parse(&format!("{padding}{shown}"));
    let depth = match read(&format!("{path} = 0")) {
        Ok(probe) if !path.contains(['\n', '\r']) => depth(&probe),
        _ => {
            let span = Span { start, end: start + path.len() };
            let problem = Problem::error(span, format!("`{path}` is not a path to a value"));
            let help = "write for example analysis.step=1e-4 or materials.steel.E=2e11";
            return (format!("{path} = {value}"), Err(Box::new(problem.help(help))));
        }
    };
    let plain = format!("{path} = {value}");
    let marked = value.starts_with(['"', '\'', '[', '{']);
    if !value.contains(['\n', '\r']) {
        let patch = read(&plain);
        if patch.is_ok() || marked {
            return (plain, patch.and_then(|table| descend(table, depth)));
        }
    }
    let quoted = format!("{path} = {}", toml::Value::String(value.to_owned()));
    let patch = read(&quoted).and_then(|table| descend(table, depth));
    (quoted, patch)
}

fn depth(table: &Table) -> usize {
    table.values().next().and_then(|entry| entry.node.table()).map_or(1, |inner| 1 + depth(inner))
}

fn descend(mut table: Table, depth: usize) -> Result<Patch, Box<Problem>> {
    let mut path = Vec::new();
    loop {
        let Some((name, Entry { key, node })) = table.pop_first() else {
            return Err(Box::new(Problem::error(Span::default(), "the override is empty")));
        };
        path.push((name, key));
        match node.value {
            Value::Table(inner) if path.len() < depth => table = inner,
            value => return Ok(Patch { path, value: Node { value, ..node } }),
        }
    }
}

impl Patch {
    /// Whether it leads into a part, which has no entries yet, as `leg2.rod.mass` or `bodies."leg2.rod".mass` do.
    fn is_of_part(&self, root: &Table) -> bool {
        let has_parts = root.get("parts").is_some_and(|entry| entry.node.table().is_some());
        match self.path.as_slice() {
            [(first, _), (second, _), ..] if top_level::tops().any(|top| top.name == first) => {
                has_parts && top_level::has_named_entries(first) && second.contains('.')
            }
            [_, _, ..] => has_parts,
            _ => false,
        }
    }

    /// Puts the value in its place.
    pub(crate) fn apply(self, root: &mut Table) -> Result<(), Box<Problem>> {
        self.check(root)?;
        let Self { mut path, mut value } = self;
        let Some((last, key)) = path.pop() else { return Ok(()) };
        let mut table = root;
        for (name, key) in path {
            let value_scope = value.scope;
            let empty = || Entry {
                key,
                node: Node { span: key, scope: value_scope, value: Value::Table(Table::new()) },
            };
            let message = format!("`{name}` is a value, not a table: the path does not exist");
            let node = &mut table.entry(name).or_insert_with(empty).node;
            // Values inside a part are interpreted there.
            value = value.moved(Shift::default(), node.scope);
            let Value::Table(inner) = &mut node.value else {
                return Err(Box::new(Problem::error(key, message).help("remove the rest of the path")));
            };
            table = inner;
        }
        // A replaced entry keeps its position in the order, because parameters may refer to those above them.
        let key = table.get(&last).map_or(key, |entry| entry.key);
        table.insert(last, Entry { key, node: value });
        Ok(())
    }

    /// Removes the value at the path.
    fn leave_out(self, root: &mut Table) -> Result<(), Box<Problem>> {
        let Some(((last, place), above)) = self.path.split_last() else { return Ok(()) };
        let missing = |table: &Table, name: &str, place: Span| {
            let known = table.keys().map(String::as_str);
            let problem = Problem::error(place, format!("the model has no `{name}` here to be removed"));
            Box::new(problem.label("not in the file").maybe_help(suggest::help(name, known)))
        };
        let mut table = root;
        for (name, place) in above {
            if !table.contains_key(name) {
                return Err(missing(table, name, *place));
            }
            let Some(Entry { node: Node { value: Value::Table(inner), .. }, .. }) = table.get_mut(name)
            else {
                let message = format!("`{name}` is a value, not a table: the path does not exist");
                return Err(Box::new(Problem::error(*place, message).help("remove the rest of the path")));
            };
            table = inner;
        }
        if table.remove(last).is_none() {
            return Err(missing(table, last, *place));
        }
        Ok(())
    }

    /// An override changes existing entries: it cannot add a part, a material or a parameter.
    fn check(&self, root: &Table) -> Result<(), Box<Problem>> {
        let [(first, _), (second, place), ..] = self.path.as_slice() else { return Ok(()) };
        if !top_level::has_named_entries(first) {
            return Ok(());
        }
        let entries = root.get(first).and_then(|entry| entry.node.table());
        if entries.is_some_and(|entries| entries.contains_key(second)) {
            return Ok(());
        }
        let known = entries.into_iter().flat_map(BTreeMap::keys).map(String::as_str);
        let problem = Problem::error(*place, format!("the model has no `{first}.{second}` to override"));
        Err(Box::new(problem.label("not in the file").maybe_help(suggest::help(second, known))))
    }
}

/// Entries in the order of the text.
pub(crate) fn in_order(table: &Table) -> Vec<(&str, Span, &Node)> {
    let mut entries: Vec<_> =
        table.iter().map(|(name, entry)| (name.as_str(), entry.key, &entry.node)).collect();
    entries.sort_by_key(|(_, span, _)| *span);
    entries
}
