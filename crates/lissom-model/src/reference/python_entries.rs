//! The entries of a model as classes of Python, generated from the descriptions that the decoder and the schema use: the contents of
//! `crates/lissom-python/python/lissom/entries/`.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::document::tables::variants;
use crate::format::keys::{Key, Shape};
use crate::format::part_tables::part_motion;
use crate::format::top_level::singular;
use crate::format::top_level::{Holds, Top, Variant, tops};
use crate::registry::Registry;

/// The files by name without extension, with the tables of their entries.
const FILES: [(&str, &str, &[&str]); 11] = [
    ("sections", "Materials and cross sections.", &["materials", "sections"]),
    (
        "parts",
        "Beams, shells, solids, rigid bodies, point masses, superelements and sub-assemblies.",
        &["beams", "shells", "solids", "bodies", "point_masses", "superelements", "parts"],
    ),
    ("joints", "What holds nodes together, one class per kind.", &["joints"]),
    ("springs", "What pulls nodes or joints back, one class per kind.", &["springs"]),
    ("loads", "Applied forces and moments, and those of actuators.", &["loads", "local_loads"]),
    ("contacts", "Parts that may touch, and the solids that are fixed in space.", &["contacts", "ground"]),
    ("feedback", "First-order states, events, and units of other programs.", &["states", "events", "units"]),
    ("hydraulics", "Fluids, and nodes and components of hydraulic networks.", &["fluids", "hydraulics"]),
    ("motions", "How the parts are and move at the start.", &["initial"]),
    ("outputs", "What is recorded, one class per kind.", &["outputs"]),
    ("analyses", "Kind of analysis and its settings.", &["analysis"]),
];
/// Words that mean something else in Python; they get a line below.
const RESERVED: [&str; 11] =
    ["as", "except", "from", "global", "if", "import", "in", "is", "lambda", "not", "with"];
/// The types of values that `_entry.py` has.
const TYPES: [&str; 9] =
    ["Count", "Entry", "Function", "Names", "Number", "Place", "Table", "Tables", "Vector"];
const NOTE: &str = "# Made by `cargo xtask reference` of the program's own tables: do not edit.\n";

/// The texts of the files by name, with the classes of all entries of `registry`.
pub fn python_entries(registry: &Registry) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for (file, summary, tables) in FILES {
        let mut classes = String::new();
        for table in tables {
            of_table(&mut classes, table, registry);
        }
        let mut text = format!("{NOTE}\"\"\"{summary}\"\"\"\n\nfrom __future__ import annotations\n\n");
        text += "from dataclasses import dataclass\n";
        let typing: Vec<&str> =
            ["Any", "ClassVar", "Literal"].into_iter().filter(|name| names(&classes, name)).collect();
        let _ = writeln!(text, "from typing import {}\n", typing.join(", "));
        let own: Vec<&str> = TYPES.into_iter().filter(|name| names(&classes, name)).collect();
        let _ = writeln!(text, "from ._entry import {}\n", own.join(", "));
        files.insert(format!("{file}.py"), format!("{text}\n{}", classes.trim_start()));
    }
    files.insert("_model_tables.py".to_owned(), model_tables(registry));
    files
}

/// Whether `text` names a type.
fn names(text: &str, name: &str) -> bool {
    let letters = |c: char| c.is_alphanumeric() || c == '_';
    let code = text.lines().filter(|line| {
        let line = line.trim_start();
        line.starts_with("class ") || line.contains(": ") && !line.starts_with('"')
    });
    code.flat_map(|line| line.split(|c| !letters(c))).any(|word| word == name)
}

/// Name of the class that all entries of a table are of.
fn base(table: &str) -> String {
    match singular(table) {
        "entry" => camel(table),
        word => camel(word),
    }
}

fn of_table(text: &mut String, table: &str, registry: &Registry) {
    let forms = variants(table, registry).in_code();
    let summary = tops().find(|top| top.name == table).map_or("", |top| top.summary);
    let Some(tag) = forms.tag else {
        for form in &forms.all {
            class(text, &base(table), "Entry", ("_table", table), summary, &form.keys, None);
        }
        if table == "initial" {
            let words = "A rigid motion of some parts at the start.";
            class(text, "PartMotion", "Entry", ("_table", ""), words, &part_motion(), None);
        }
        return;
    };
    let _ = write!(
        text,
        "\n\nclass {}(Entry):\n    \"\"\"{summary}\"\"\"\n\n    __slots__ = ()\n    _table: ClassVar[str] = {table:?}\n    _tag: ClassVar[str] = {tag:?}\n",
        base(table)
    );
    for Variant { word, summary, keys } in &forms.all {
        class(text, &camel(word), &base(table), (tag, word), summary, keys, Some(tag));
    }
}

fn class(
    text: &mut String,
    name: &str,
    parent: &str,
    (fixed, word): (&str, &str),
    summary: &str,
    keys: &[Key],
    tag: Option<&str>,
) {
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\n\n@dataclass(kw_only=True, slots=True)\nclass {name}({parent}):\n    \"\"\"{summary}"
    );
    let own: Vec<&Key> = keys.iter().filter(|key| Some(key.name) != tag).collect();
    let _ = write!(text, "{}", if own.is_empty() { "\"\"\"\n\n" } else { "\n\n    Args:\n" });
    for key in &own {
        let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
        let must = if key.required { "" } else { ", or nothing" };
        let about = format!(
            "{}: {}{unit}; {}{must}.",
            identifier(key.name),
            key.meaning().trim_end_matches('.'),
            key.holds.value_type().words
        );
        let _ = writeln!(text, "        {}", about.replace('\\', "\\\\"));
    }
    if word == "initial" {
        text.push_str("        motions: rigid motions of some parts, by names of their own; `PartMotion`, or nothing.\n");
    }
    if !own.is_empty() {
        text.push_str("    \"\"\"\n\n");
    }
    let _ = writeln!(text, "    {}: ClassVar[str] = {word:?}", if tag.is_some() { "_form" } else { fixed });
    if !own.is_empty() {
        text.push('\n');
    }
    for key in &own {
        let holds = key.holds.value_type().python;
        let rest = if key.required { holds.into_owned() } else { format!("{holds} | None = None") };
        let _ = writeln!(text, "    {}: {rest}", identifier(key.name));
    }
    if word == "initial" {
        text.push_str("    motions: dict[str, PartMotion] | None = None\n");
    }
}

/// Base class of `Model`: a property for every key at the top level of a model file.
fn model_tables(registry: &Registry) -> String {
    let mut text = format!(
        "{NOTE}\"\"\"The tables of a model, and the classes of their entries.\"\"\"\n\nfrom __future__ import annotations\n\n\
         from typing import Any\n\nfrom . import {}\nfrom ._entry import Entry, ModelTree\n",
        FILES.map(|(file, ..)| file).join(", ")
    );
    for (file, _, tables) in FILES {
        let classes: Vec<String> = tables.iter().map(|table| base(table)).collect();
        let _ = writeln!(text, "from .{file} import {}", classes.join(", "));
    }
    text += "\n#: The classes of the entries of a table: one, or several by the word that chooses.\n";
    text += "CLASSES: dict[str, type[Entry] | dict[str, type[Entry]]] = {\n";
    let file_of =
        |table: &str| FILES.iter().find(|(.., tables)| tables.contains(&table)).map(|(file, ..)| *file);
    for top in tops() {
        let Some(file) = file_of(top.name) else { continue };
        let forms = variants(top.name, registry).in_code();
        if forms.tag.is_none() {
            let _ = writeln!(text, "    {:?}: {file}.{},", top.name, base(top.name));
            continue;
        }
        let _ = writeln!(text, "    {:?}: {{", top.name);
        for form in &forms.all {
            let _ = writeln!(text, "        {:?}: {file}.{},", form.word, camel(form.word));
        }
        text += "    },\n";
    }
    text += "}\n\n#: The words at the top of a model file, in order.\n";
    let order: Vec<String> = tops().map(|top| format!("    {:?},\n", top.name)).collect();
    let _ = write!(text, "ORDER = (\n{})\n\n\nclass ModelTables(ModelTree):\n", order.concat());
    text += "    \"\"\"The tables of a model as attributes. What is changed in them counts from then on.\"\"\"\n\n    __slots__ = ()\n";
    for top in tops().filter(|top| !matches!(top.holds, Holds::Value(Shape::Version))) {
        property(&mut text, top, file_of(top.name));
    }
    text
}

fn property(text: &mut String, top: &Top, file: Option<&str>) {
    let name = top.name;
    let class = file.map(|_| base(name));
    let holds = match (&top.holds, class) {
        (Holds::Entries, Some(class)) => format!("dict[str, {class}]"),
        (Holds::Table, Some(class)) => format!("{class} | None"),
        (Holds::Value(Shape::Text), _) => "str | None".to_owned(),
        (Holds::Values(_), _) => "dict[str, Any]".to_owned(),
        _ => "Any".to_owned(),
    };
    let read = if holds.starts_with("dict") { "_table" } else { "_value" };
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "
    @property
    def {name}(self) -> {holds}:
        \"\"\"{}\"\"\"
        of: {holds} = self.{read}({name:?})
        return of

    @{name}.setter
    def {name}(self, of: {holds}) -> None:
        self._set({name:?}, of)
",
        top.summary
    );
}

fn camel(word: &str) -> String {
    let part = |part: &str| {
        let mut letters = part.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    };
    word.split(['_', '-', ' ']).map(part).collect()
}

fn identifier(name: &str) -> String {
    if RESERVED.contains(&name) { format!("{name}_") } else { name.to_owned() }
}
