//! Inserts the contents of parts into the model's tables, once for each part. Operates on the tree of values without evaluating
//! them.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Expanded, MAX_PARTS, Outside, PLACED_TABLES, Placement, Scope, overrides};
use crate::files::library::{Library, joined};
use crate::files::ready_made;
use crate::format::part_tables;
use crate::format::suggest;
use crate::format::top_level::{self, VERSION};
use crate::text::report::{Origin, Problem, Shift, Sources, Span};
use crate::text::{self, Entry, Node, Table, Tree, Value, in_order};
use crate::text::{ROOT, ScopeId};

/// How deep parts may contain parts.
const DEPTH: usize = 32;

/// Expands all parts of `tree`.
///
/// # Errors
/// All that is wrong with them, and the texts in which it is.
pub(crate) fn expand(tree: Tree) -> Result<Expanded, (Vec<Problem>, Sources)> {
    let Tree { mut root, sources, problems, deferred, library } = tree;
    let parts = root.remove("parts");
    let mut work = Expansion {
        library: &library,
        files: BTreeMap::new(),
        folder: sources
            .first_name()
            .rsplit_once('/')
            .map_or(String::new(), |(folder, _)| format!("{folder}/")),
        into: Expanded::plain(root, sources),
        problems,
    };
    if let Some(table) = work.into.root.get("parameters").and_then(|entry| entry.node.table()) {
        work.into.scopes[ROOT].parameters = in_list(table);
    }
    if let Some(parts) = parts {
        match parts.node.table() {
            Some(table) => work.level(table, &Level { scope: ROOT, file: String::new(), chain: Vec::new() }),
            None => work.report(
                parts.node.span,
                "`parts` must be a table",
                "write [parts.leg] and below it what it is",
            ),
        }
    }
    for patch in deferred {
        let done = overrides::apply(patch, &mut work.into);
        work.problems.extend(done.err().map(|problem| *problem));
    }
    if !work.problems.is_empty() {
        return Err((work.problems, work.into.sources));
    }
    flatten_sections(&mut work);
    if !work.problems.is_empty() {
        return Err((work.problems, work.into.sources));
    }
    place_entries(&mut work.into);
    work.into.library = Arc::clone(&library);
    Ok(work.into)
}

fn in_list(table: &Table) -> Vec<(String, Span, Node)> {
    in_order(table).into_iter().map(|(name, key, node)| (name.to_owned(), key, node.clone())).collect()
}

/// Writes sections with `shape = { kind = "tube", radius = … }` as `shape = "tube"` and `radius = …`.
fn flatten_sections(work: &mut Expansion<'_>) {
    let Some(Value::Table(sections)) = work.into.root.get_mut("sections").map(|entry| &mut entry.node.value)
    else {
        return;
    };
    let mut twice = Vec::new();
    for (name, section) in sections {
        let Value::Table(table) = &mut section.node.value else { continue };
        let Some(Value::Table(shape)) = table.get_mut("shape").map(|shape| &mut shape.node.value) else {
            continue;
        };
        let shape = std::mem::take(shape);
        // Without a kind it is reported as a shape that is missing.
        table.remove("shape");
        for (key, entry) in shape {
            let key = if key == "kind" { "shape".to_owned() } else { key };
            if let Some(first) = table.insert(key.clone(), entry) {
                twice.push((first.key, format!("section `{name}` has `{key}` twice")));
            }
        }
    }
    for (span, message) in twice {
        work.report(span, &message, "write it beside `shape` or within it");
    }
}

/// Creates a scope for each entry with `in`, placed as that part.
fn place_entries(expanded: &mut Expanded) {
    let Expanded { root, scopes, .. } = expanded;
    for word in PLACED_TABLES {
        let Some(Value::Table(table)) = root.get_mut(word).map(|entry| &mut entry.node.value) else {
            continue;
        };
        for entry in table.values_mut() {
            let Some(part) = entry.node.table().and_then(|table| table.get("in")).cloned() else { continue };
            let around = entry.node.scope;
            let prefix = scopes[around].prefix.clone();
            let placements = vec![Placement { part: Some(part.node.clone()), ..Placement::default() }];
            scopes.push(Scope { placements, ..Scope::within(around, &prefix, part.key) });
            entry.node = entry.node.moved(Shift::default(), scopes.len() - 1);
            // The name of the part is one of the scope around.
            if let Value::Table(table) = &mut entry.node.value {
                table.insert("in".to_owned(), part);
            }
        }
    }
}

/// A table `parts` and its context.
struct Level {
    scope: ScopeId,
    /// Path of the file it is written in, empty for the model's.
    file: String,
    /// Files that include each other down to here.
    chain: Vec<String>,
}

/// Contents of a part.
struct Content {
    table: Table,
    /// Path and text of the file, if it is one.
    file: Option<(String, Arc<str>)>,
    /// Parameters that are given in place of the content's own.
    given: BTreeMap<String, Entry>,
    /// Names that are handed in.
    handed: BTreeMap<String, Entry>,
    placements: Vec<Placement>,
    /// Whether the text of the part itself is the content: then it is where it is.
    is_own: bool,
}

/// A file's text and its contents.
type Read = (Arc<str>, Arc<Table>);

struct Expansion<'l> {
    library: &'l Library,
    files: BTreeMap<String, Option<Read>>,
    /// Folder of the model as messages show it.
    folder: String,
    into: Expanded,
    problems: Vec<Problem>,
}

impl Expansion<'_> {
    fn report(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        self.problems.push(Problem::error(span, message).help(help));
    }

    fn fail<T>(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.report(span, message, help);
        None
    }

    fn level(&mut self, parts: &Table, level: &Level) {
        for (name, key, node) in in_order(parts) {
            self.part((name, key, node), parts, level);
        }
    }

    fn part(
        &mut self,
        (name, key, node): (&str, Span, &Node),
        siblings: &Table,
        level: &Level,
    ) -> Option<()> {
        let Some(table) = node.table() else {
            return self.fail(
                node.span,
                format!("part `{name}` must be a table"),
                "write [parts.name] and below it what it is",
            );
        };
        let usable = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
        if name.is_empty() || !name.chars().all(usable) || name == "ground" {
            let help = "names of parts are made of letters, digits, `_` and `-`; `ground` is the fixed frame";
            return self.fail(key, format!("`{name}` cannot be the name of a part"), help);
        }
        if level.chain.len() >= DEPTH {
            let message = format!("part `{name}` lies {DEPTH} levels deep in other parts");
            return self.fail(key, message, "let fewer parts contain each other");
        }
        let count = self.count(name, table)?;
        let content = self.content((name, key, table), siblings, level, &mut Vec::new())?;
        let is_array = table.contains_key("count");
        for index in 1..=count {
            if self.into.instances.len() >= MAX_PARTS {
                return self.fail(
                    key,
                    format!("the model has more than {MAX_PARTS} parts"),
                    "give a smaller `count`",
                );
            }
            let own = is_array.then_some((index, count));
            let number = own.map_or_else(String::new, |(index, _)| index.to_string());
            self.instance((&format!("{name}{number}"), key), own, &content, level)?;
        }
        Some(())
    }

    fn count(&mut self, name: &str, table: &Table) -> Option<usize> {
        let Some(entry) = table.get("count") else { return Some(1) };
        match entry.node.value {
            Value::Number(count) if count.fract() == 0.0 && count >= 1.0 && count <= MAX_PARTS as f64 => {
                Some(count as usize)
            }
            _ => {
                let message =
                    format!("`count` of part `{name}` must be a whole number from 1 to {MAX_PARTS}");
                self.fail(
                    entry.node.span,
                    message,
                    "write the number itself, as in `count = 3`; it is known before the parameters are",
                )
            }
        }
    }

    /// Contents of the part `name`; `path` is the chain of `like` references that leads to it.
    fn content(
        &mut self,
        (name, key, table): (&str, Span, &Table),
        siblings: &Table,
        level: &Level,
        path: &mut Vec<String>,
    ) -> Option<Content> {
        self.check_keys(name, table)?;
        let own = Placement {
            part: table.get("in").map(|entry| entry.node.clone()),
            position: table.get("position").map(|entry| entry.node.clone()),
            rotation: table.get("rotation").map(|entry| entry.node.clone()),
        };
        let given = self.entries(name, table, "parameters")?;
        let handed = self.entries(name, table, "names")?;
        let is_content = |word: &&String| top_level::has_named_entries(word) && word.as_str() != "parameters";
        let inline = table.keys().find(is_content).cloned();
        match (table.get("include"), table.get("like"), inline) {
            (Some(include), None, None) => {
                let (path, text, content) = self.include(name, &include.node, level)?;
                let table = Table::clone(&content);
                Some(Content { table, file: Some((path, text)), given, handed, placements: vec![own], is_own: false })
            }
            (None, Some(like), None) => {
                let Value::Text(other) = &like.node.value else {
                    return self.fail(like.node.span, format!("`like` of part `{name}` must be a text"), "name another part");
                };
                let Some(entry) = siblings.get(other).filter(|_| other != name) else {
                    let known = siblings.keys().map(String::as_str).filter(|known| *known != name);
                    let problem = Problem::error(like.node.span, format!("part `{name}` is like `{other}`, which is no other part here"));
                    self.problems.push(problem.label("no such part").help("name a part of the same table").maybe_help(suggest::help(other, known)));
                    return None;
                };
                path.push(name.to_owned());
                if path.contains(other) {
                    return self.fail(like.node.span, format!("part `{name}` is like itself"), "let one of these parts have a content of its own");
                }
                if path.len() >= DEPTH {
                    return self.fail(like.node.span, format!("part `{}` is like another one through {DEPTH} others", path[0]), "be like the part that has the content");
                }
                let Some(table) = entry.node.table() else {
                    return self.fail(entry.node.span, format!("part `{other}` must be a table"), "write [parts.name] and below it what it is");
                };
                if table.contains_key("count") {
                    return self.fail(like.node.span, format!("part `{other}` is an array"), "be like a part without `count`, or raise that count");
                }
                let mut content = self.content((other, entry.key, table), siblings, level, path)?;
                content.is_own = false;
                content.given.extend(given);
                content.handed.extend(handed);
                content.placements.push(own);
                Some(content)
            }
            (None, None, Some(_)) => {
                if let Some((_, entry)) = handed.first_key_value() {
                    return self.fail(entry.key, format!("part `{name}` knows the names around it"), "leave out `names`: they are for included files");
                }
                let content: Table = table.iter().filter(|(word, _)| top_level::has_named_entries(word)).map(|(word, entry)| (word.clone(), entry.clone())).collect();
                let is_own = !table.contains_key("count");
                Some(Content { table: content, file: None, given: BTreeMap::new(), handed, placements: vec![own], is_own })
            }
            (None, None, None) => self.fail(key, format!("part `{name}` is made of nothing"), "add `include = \"file.toml\"`, `like = \"another part\"` or tables such as [parts.leg.bodies.rod]"),
            _ => self.fail(key, format!("part `{name}` is made of two things"), "give one of `include`, `like` and tables of its own"),
        }
    }

    fn check_keys(&mut self, name: &str, table: &Table) -> Option<()> {
        let keys = part_tables::part();
        let known = || keys.iter().map(|key| key.name);
        let mut good = Some(());
        for (word, entry) in table {
            if !known().any(|key| key == word) {
                let problem = Problem::error(entry.key, format!("part `{name}` has an unknown key `{word}`"));
                let help = suggest::nearest(word, known()).map(|near| format!("did you mean `{near}`?"));
                let problem =
                    problem.label("unknown").help("a part has a content, a position, parameters and names");
                self.problems.push(problem.maybe_help(help));
                good = None;
            }
        }
        good
    }

    /// The entries of the table `word` of a part.
    fn entries(&mut self, name: &str, table: &Table, word: &str) -> Option<BTreeMap<String, Entry>> {
        let Some(entry) = table.get(word) else { return Some(BTreeMap::new()) };
        match &entry.node.value {
            Value::Table(table) => Some(table.clone()),
            _ => self.fail(
                entry.node.span,
                format!("`{word}` of part `{name}` must be a table"),
                "write { name = value }",
            ),
        }
    }

    /// Path, text and tree of a file that is included.
    fn include(&mut self, name: &str, node: &Node, level: &Level) -> Option<(String, Arc<str>, Arc<Table>)> {
        let Value::Text(written) = &node.value else {
            return self.fail(
                node.span,
                format!("`include` of part `{name}` must be a text"),
                "write the path of a file, relative to this one",
            );
        };
        let path = joined(&level.file, written);
        if level.chain.contains(&path) {
            let chain: Vec<&str> = level
                .chain
                .iter()
                .skip_while(|file| **file != path)
                .map(String::as_str)
                .chain([path.as_str()])
                .collect();
            let message = format!("`{path}` includes itself: {}", chain.join(" includes "));
            return self.fail(node.span, message, "leave out one of these parts");
        }
        if !self.files.contains_key(&path) {
            let read = self.read(&path, node.span);
            self.files.insert(path.clone(), read);
        }
        let (text, table) = self.files.get(&path)?.clone()?;
        Some((path, text, table))
    }

    /// The path as messages show it.
    fn shown(&self, path: &str) -> String {
        let folder = if path.starts_with(ready_made::PREFIX) { "" } else { &self.folder };
        format!("{folder}{path}")
    }

    fn read(&mut self, path: &str, span: Span) -> Option<Read> {
        let text = match self.library.text(path) {
            Ok(text) => text,
            Err(missing) => {
                let is_file = !path.starts_with(ready_made::PREFIX);
                let help = is_file.then(|| "paths are relative to the file that contains them".to_owned());
                let problem = Problem::error(span, missing.message);
                self.problems.push(problem.maybe_help(help).maybe_help(missing.help));
                return None;
            }
        };
        let shown = self.shown(path);
        let length = text.len();
        let table = match text::parse(&text) {
            Ok(table) => table,
            Err(problem) => {
                let start = self.into.sources.push_shared(&shown, text, None);
                self.problems
                    .push(Problem { span: problem.span.moved(Shift::of_text(length, start)), ..*problem });
                return None;
            }
        };
        let wrong: Vec<(Span, String, String)> = in_order(&table)
            .into_iter()
            .filter_map(|(word, key, node)| {
                wrong_word(word, node).map(|(message, help)| (key, message, help))
            })
            .collect();
        if wrong.is_empty() {
            return Some((text, Arc::new(table)));
        }
        let start = self.into.sources.push_shared(&shown, text, None);
        for (key, message, help) in wrong {
            self.report(key.moved(Shift::of_text(length, start)), message, help);
        }
        None
    }

    fn instance(
        &mut self,
        (name, key): (&str, Span),
        index: Option<(usize, usize)>,
        content: &Content,
        level: &Level,
    ) -> Option<()> {
        let around = self.into.scopes[level.scope].prefix.clone();
        let full = format!("{around}{name}");
        let header = if index.is_some() {
            self.into.scopes.push(Scope { index, ..Scope::within(level.scope, &around, key) });
            self.into.scopes.len() - 1
        } else {
            level.scope
        };
        let own = self.into.scopes.len();
        let origin = Origin { part: full.clone(), place: key };
        let shift = match &content.file {
            Some((path, text)) => {
                let shown = self.shown(path);
                let start = self.into.sources.push_shared(&shown, Arc::clone(text), Some(origin));
                Shift::of_text(text.len(), start)
            }
            None if content.is_own => Shift::default(),
            None => self.into.sources.push_again(key, origin),
        };
        let table = text::moved(&content.table, shift, own);
        let at_header = |node: &Option<Node>| node.as_ref().map(|node| node.moved(Shift::default(), header));
        let placements = content.placements.iter().map(|placement| Placement {
            part: at_header(&placement.part),
            position: at_header(&placement.position),
            rotation: at_header(&placement.rotation),
        });
        let outside = match &content.file {
            Some(_) => Outside::Handed(
                content
                    .handed
                    .iter()
                    .map(|(name, entry)| (name.clone(), entry.node.moved(Shift::default(), header)))
                    .collect(),
            ),
            None => Outside::All,
        };
        let parameters = self.parameters(&full, &table, content, header)?;
        self.check_handed(&full, &table, content)?;
        self.into.scopes.push(Scope {
            parent: Some(header),
            prefix: format!("{full}."),
            outside,
            parameters,
            index,
            placements: placements.collect(),
            place: key,
        });
        if self.into.instances.insert(full.clone(), own).is_some() {
            return self.fail(
                key,
                format!("there are two parts called `{full}`"),
                "parts of an array have names with numbers, such as `leg1`: choose another name",
            );
        }
        self.merge(&table, &format!("{full}."));
        if let Some(Value::Table(parts)) = table.get("parts").map(|entry| &entry.node.value) {
            let mut chain = level.chain.clone();
            let file = match &content.file {
                Some((path, _)) => path.clone(),
                None => level.file.clone(),
            };
            chain.push(file.clone());
            self.level(parts, &Level { scope: own, file, chain });
        }
        Some(())
    }

    /// Parameters of the contents, where specified values replace its own.
    fn parameters(
        &mut self,
        full: &str,
        table: &Table,
        content: &Content,
        header: ScopeId,
    ) -> Option<Vec<(String, Span, Node)>> {
        let mut own = match table.get("parameters").map(|entry| &entry.node.value) {
            Some(Value::Table(table)) => in_list(table),
            _ => Vec::new(),
        };
        for (name, entry) in &content.given {
            if let Some((_, _, node)) = own.iter_mut().find(|(known, ..)| known == name) {
                *node = entry.node.moved(Shift::default(), header);
                continue;
            }
            let help = suggest::help(name, own.iter().map(|(known, ..)| known.as_str()));
            let message = format!("what `{full}` is made of has no parameter `{name}`");
            let problem = Problem::error(entry.key, message).label("unknown");
            let help_first = "its [parameters] list them with their defaults";
            self.problems.push(problem.help(help_first).maybe_help(help));
            return None;
        }
        Some(own)
    }

    /// A name that is handed in must be free inside.
    fn check_handed(&mut self, full: &str, table: &Table, content: &Content) -> Option<()> {
        for (name, entry) in &content.handed {
            let is_there = |inner: &Entry| inner.node.table().is_some_and(|inner| inner.contains_key(name));
            if table.values().any(is_there) || name == "ground" {
                return self.fail(
                    entry.key,
                    format!("`{name}` is handed to `{full}`, which has something of this name itself"),
                    "choose another name, inside and here",
                );
            }
        }
        Some(())
    }

    /// Puts entries into the model's tables.
    fn merge(&mut self, table: &Table, prefix: &str) {
        for (word, entry) in table {
            if !top_level::has_named_entries(word) || matches!(word.as_str(), "parameters" | "parts") {
                continue;
            }
            let Value::Table(inner) = &entry.node.value else {
                self.report(
                    entry.node.span,
                    format!("`{word}` must be a table"),
                    "write [name.entry] and below it its keys",
                );
                continue;
            };
            let empty = || Entry {
                key: entry.key,
                node: Node { value: Value::Table(Table::new()), ..entry.node.clone() },
            };
            let into = self.into.root.entry(word.clone()).or_insert_with(empty);
            // A word that is no table is reported by the decoder.
            let Value::Table(into) = &mut into.node.value else { continue };
            into.extend(inner.iter().map(|(name, entry)| (format!("{prefix}{name}"), entry.clone())));
        }
    }
}

/// Error of a key at the top level of an included file, if there is one.
fn wrong_word(word: &str, node: &Node) -> Option<(String, String)> {
    match word {
        "title" | "parameters" | "parts" => None,
        "lissom" if matches!(node.value, Value::Number(version) if version == VERSION as f64) => None,
        "lissom" => Some((
            "this version of the format is not supported".to_owned(),
            format!("write `lissom = {VERSION}`"),
        )),
        word if top_level::has_named_entries(word) => None,
        word if top_level::tops().any(|top| top.name == word) => Some((
            format!("`{word}` is not allowed in an included file: it belongs to the model as a whole"),
            "move it to the model's own file".to_owned(),
        )),
        word => {
            let help = suggest::help(word, top_level::tops().map(|top| top.name))
                .unwrap_or_else(|| "leave it out".to_owned());
            Some((format!("`{word}` is not a key of a model file"), help))
        }
    }
}
