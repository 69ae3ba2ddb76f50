//! `lissom kinds`: kinds and keys of model files, from the registry.

use std::collections::BTreeMap;
use std::fmt::Write;

use clap::Args;
use lissom::core::ports::Ports;
use lissom::core::registry::Parameter;
use lissom::model::lower::registry::registry;
use lissom::model::registry::{ChoiceEntry, DEFAULT_SCHEMES, KindEntry, Registry};
use lissom::model::{Form, FormKey, forms, function_names, meant, topic, topics};
use serde_json::{Value, json};

use super::outcome::{Exit, Failure};
use super::terminal;

/// List kinds, keys, functions and schemes of model files.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom kinds                    the names of all kinds, by table
  lissom kinds all                everything
  lissom kinds outputs            the kinds of a table with their keys; also joints, sections, analysis …
  lissom kinds reaction           one kind of joint, spring, load, section, output or analysis, or a scheme
  lissom kinds damping            all tables with a key of this name
  lissom kinds smoothstep         functions of expressions
  lissom kinds conveyor           kinds and keys whose explanations contain a word that is no name
  lissom kinds --json             kinds, schemes and solvers for programs")]
pub(super) struct Kinds {
    /// Show kinds and schemes whose names contain this word, and tables, keys, words and functions of this name; `all` for everything.
    name: Option<String>,

    /// Print kinds, schemes and solvers with their parameters as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Column of the explanations in lists of kinds.
const COLUMN: usize = 26;
/// Length of lines of names.
const WIDTH: usize = 110;

impl Kinds {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let registry = registry();
        let catalogue = Catalogue { forms: forms(&registry), registry: &registry };
        let wanted = normal(self.name.as_deref().unwrap_or_default());
        if self.json {
            return catalogue.for_programs(&wanted);
        }
        let mut text = String::new();
        if wanted.is_empty() {
            catalogue.index(&mut text);
        } else if wanted == "all" {
            catalogue.kinds(&mut text, "");
            catalogue.choices(&mut text, "");
            text.push_str(&see_also());
        } else {
            catalogue.table(&mut text, &wanted);
            catalogue.kinds(&mut text, &wanted);
            catalogue.choices(&mut text, &wanted);
            catalogue.keys(&mut text, &wanted);
            if is_function(&wanted) {
                let words = topic(&registry, "function").into_iter();
                section(&mut text, "Functions of expressions\n", words);
            }
        }
        if text.is_empty() {
            catalogue.mentions(&mut text, &wanted);
        }
        if text.is_empty() {
            return Err(catalogue.nothing(&wanted));
        }
        terminal::print(&text);
        Ok(Exit::Done)
    }
}

/// A word in the form in which words are compared.
fn normal(word: &str) -> String {
    word.trim().replace(['-', ' '], "_")
}

fn is_function(word: &str) -> bool {
    ["function", "functions", "expression", "expressions"].contains(&word)
        || function_names().any(|name| name == word)
}

/// Everything that can be found.
struct Catalogue<'a> {
    forms: Vec<Form>,
    registry: &'a Registry,
}

impl Catalogue<'_> {
    /// The kinds of joints, springs or loads.
    fn registered(&self, table: &str) -> &[KindEntry] {
        match table {
            "joints" => &self.registry.joints,
            "springs" => &self.registry.springs,
            "loads" => &self.registry.loads,
            _ => &[],
        }
    }

    /// Keys with their words, and the default.
    fn schemes_and_solvers(&self) -> [(&'static str, &[ChoiceEntry], &'static str); 2] {
        [
            ("scheme", &self.registry.schemes, DEFAULT_SCHEMES),
            ("solver", &self.registry.solvers, "the first is the default"),
        ]
    }

    /// The names of all kinds, by table.
    fn index(&self, text: &mut String) {
        for forms in self.forms.chunk_by(|a, b| a.heading == b.heading) {
            let Some(tag) = forms[0].tag else { continue };
            let names = forms.iter().map(|form| form.word);
            section(text, &format!("{}  {tag} = \"…\"", forms[0].heading), names_of(names));
        }
        for (word, choices, _) in self.schemes_and_solvers() {
            let names = choices.iter().map(|choice| choice.name);
            section(text, &format!("[analysis]  {word} = \"…\""), names_of(names));
        }
        section(text, "Functions of expressions", names_of(function_names()));
        text.push_str(&see_also());
    }

    /// Kinds and keys whose explanations contain `wanted`, unless it is another word for one of them.
    fn mentions(&self, text: &mut String, wanted: &str) {
        if !self.meant(wanted).is_empty() {
            return;
        }
        let words = wanted.replace('_', " ");
        let has = |summary: &str| summary.to_lowercase().contains(&words);
        let mut found = BTreeMap::new();
        for form in &self.forms {
            let summary = [form.about.as_str(), form.summary].into_iter().find(|summary| has(summary));
            if let Some(summary) = summary {
                found.entry((&form.heading, form.word, "")).or_insert(summary.to_owned());
            }
            for key in form.keys.iter().filter(|key| has(&key.summary)) {
                found.insert((&form.heading, form.word, key.name), of_key(key));
            }
        }
        let list =
            found.iter().map(|((heading, word, _), words)| format!("  {heading} {word}\n    {words}\n"));
        section(text, &format!("Nothing is called `{wanted}`. Explanations that contain it\n"), list);
    }

    /// Kinds whose names contain `wanted`, by table.
    fn kinds(&self, text: &mut String, wanted: &str) {
        for forms in self.forms.chunk_by(|a, b| a.heading == b.heading) {
            let Some(tag) = forms[0].tag else { continue };
            let found = forms.iter().filter(|form| form.word.contains(wanted));
            let entries = found.map(|form| {
                let own = self.registered(form.table).iter().find(|kind| kind.name == form.word);
                own.map_or_else(|| of_form(form), |kind| of_kind(form, kind))
            });
            section(text, &format!("{}  {tag} = \"…\"", forms[0].heading), entries);
        }
    }

    /// Schemes and solvers whose names contain `wanted`.
    fn choices(&self, text: &mut String, wanted: &str) {
        for (word, choices, default) in self.schemes_and_solvers() {
            let entries = choices.iter().filter(|choice| normal(choice.name).contains(wanted)).map(of_choice);
            section(text, &format!("[analysis]  {word} = \"…\"  ({default})"), entries);
        }
    }

    /// The table called `wanted`: its kinds, or its keys.
    fn table(&self, text: &mut String, wanted: &str) {
        let is_wanted = |form: &&Form| form.table == wanted || normal(form.singular) == wanted;
        let found: Vec<&Form> = self.forms.iter().filter(is_wanted).collect();
        for forms in found.chunk_by(|a, b| a.heading == b.heading) {
            let first = forms[0];
            let choice = first.tag.map(|tag| format!("  {tag} = \"…\"")).unwrap_or_default();
            let list =
                forms.iter().map(|form| if form.tag.is_some() { line(form) } else { keys_of(&form.keys) });
            let blank = if first.tag.is_none() && first.keys.is_empty() { "" } else { "\n" };
            section(text, &format!("{}{choice}\n{}{blank}", first.heading, first.about), list);
            if first.tag.is_some() {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "\n  `lissom kinds {}` explains the keys of one.", first.word);
            }
        }
        if wanted == "analysis" {
            for (word, choices, default) in self.schemes_and_solvers() {
                let list = choices.iter().map(|choice| item(choice.name, choice.summary));
                section(text, &format!("[analysis]  {word} = \"…\"  ({default})"), list);
            }
        }
    }

    /// Keys called `wanted`, and those whose values include that word, with the tables that have them.
    fn keys(&self, text: &mut String, wanted: &str) {
        let mut found: BTreeMap<(&str, String), Vec<&str>> = BTreeMap::new();
        for form in &self.forms {
            let is_wanted = |key: &&FormKey| {
                // Schemes and solvers have entries of their own.
                let has_words = !matches!(key.name, "scheme" | "solver");
                normal(key.name) == wanted
                    || has_words && key.choices.iter().any(|word| normal(word) == wanted)
            };
            for key in form.keys.iter().filter(is_wanted) {
                found.entry((&form.heading, of_key(key))).or_default().push(form.word);
            }
        }
        let list = found.iter().map(|((heading, key), words)| {
            let words = words.iter().filter(|word| !word.is_empty()).copied().collect::<Vec<_>>().join(", ");
            let of = if words.is_empty() { String::new() } else { format!("  {words}") };
            format!("\n  {heading}{of}\n    {key}\n")
        });
        section(text, &format!("Keys and values `{wanted}`"), list);
    }

    /// Names that `wanted` is another word for, or a slip of the pen.
    fn meant(&self, wanted: &str) -> Vec<String> {
        let forms = || self.forms.iter();
        let mut known: Vec<&str> = forms().map(|form| form.word).filter(|word| !word.is_empty()).collect();
        known.extend(forms().flat_map(|form| [form.table, form.singular]));
        known.extend(
            self.schemes_and_solvers().iter().flat_map(|(_, all, _)| all.iter().map(|choice| choice.name)),
        );
        known.extend(forms().flat_map(|form| form.keys.iter().map(|key| key.name)));
        known.extend(function_names());
        meant(wanted, &known).iter().map(|word| format!("`lissom kinds {word}`")).collect()
    }

    /// The failure to find anything, with the nearest word.
    fn nothing(&self, wanted: &str) -> Failure {
        let found = self.meant(wanted);
        let remedy = if found.is_empty() {
            format!("see `lissom kinds`, or `lissom kinds` with one of {}", topics().join(", "))
        } else {
            format!("did you mean {}?", found.join(" or "))
        };
        Failure::request(format!(
            "there is no kind, key, table, scheme or function called `{wanted}`; {remedy}"
        ))
    }

    /// All kinds whose name contains `wanted`, as JSON.
    fn for_programs(&self, wanted: &str) -> Result<Exit, Failure> {
        let parameter = |key: &FormKey| json!({ "name": key.name, "holds": key.holds, "unit": key.unit, "required": key.required, "summary": key.summary });
        let of_form = |form: &Form| -> Value { form.keys.iter().map(parameter).collect() };
        let list =
            |own: &[Parameter]| -> Value { own.iter().map(|own| parameter(&FormKey::from(own))).collect() };
        let mut all = json!({});
        let mut count = 0;
        for forms in self.forms.chunk_by(|a, b| a.heading == b.heading) {
            if forms[0].tag.is_none() {
                continue;
            }
            let entry = |form: &Form| {
                let own = self.registered(form.table).iter().find(|kind| kind.name == form.word);
                let Some(kind) = own else {
                    return json!({ "name": form.word, "summary": form.summary, "parameters": of_form(form) });
                };
                json!({
                    "name": kind.name,
                    "summary": kind.summary,
                    "acts_on": listed(kind.ports),
                    "parameters": list(kind.parameters),
                    "sample": kind.sample,
                })
            };
            let found: Vec<Value> =
                forms.iter().filter(|form| form.word.contains(wanted)).map(entry).collect();
            count += found.len();
            all[forms[0].table] = found.into();
        }
        for (word, choices) in [("schemes", &self.registry.schemes), ("solvers", &self.registry.solvers)] {
            let choice = |choice: &ChoiceEntry| json!({ "name": choice.name, "summary": choice.summary, "parameters": list(choice.parameters) });
            let found: Vec<Value> =
                choices.iter().filter(|choice| normal(choice.name).contains(wanted)).map(choice).collect();
            count += found.len();
            all[word] = found.into();
        }
        if count == 0 {
            return Err(self.nothing(wanted));
        }
        terminal::print(&format!("{all:#}\n"));
        Ok(Exit::Done)
    }
}

/// Names in lines of moderate length.
fn names_of<'a>(names: impl Iterator<Item = &'a str>) -> impl Iterator<Item = String> {
    let mut lines: Vec<String> = Vec::new();
    for name in names {
        match lines.last_mut() {
            Some(line) if line.len() + name.len() < WIDTH => line.extend([", ", name]),
            _ => lines.push(format!("  {name}")),
        }
    }
    lines.into_iter().map(|line| line + "\n")
}

/// Where more is explained.
fn see_also() -> String {
    format!("\nSee also `lissom kinds WORD` for a name or: {}\n", topics().join(", "))
}

fn section(text: &mut String, heading: &str, entries: impl Iterator<Item = String>) {
    let mut entries = entries.peekable();
    if entries.peek().is_none() {
        return;
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text.push_str(heading);
    text.push('\n');
    text.extend(entries);
}

/// A name and its explanation.
fn item(name: &str, words: &str) -> String {
    format!("  {name:<COLUMN$}{words}\n")
}

/// A kind in the list of its table: its summary and the names of its keys.
fn line(form: &Form) -> String {
    let names: Vec<&str> = form.keys.iter().map(|key| key.name).collect();
    let keys =
        if names.is_empty() { String::new() } else { format!("  {:<COLUMN$}{}\n", "", names.join(", ")) };
    item(form.word, form.summary) + &keys
}

fn of_form(form: &Form) -> String {
    format!("\n  {}: {}\n{}", form.word, form.summary, keys_of(&form.keys))
}

fn of_kind(form: &Form, kind: &KindEntry) -> String {
    let acts_on = listed(kind.ports);
    let mut text = format!("\n  {}: {}\n    acts on     {acts_on}\n", kind.name, kind.summary);
    let own = form.keys.iter().filter(|key| kind.parameters.iter().any(|known| known.name == key.name));
    text.push_str(&keys_of(&own.cloned().collect::<Vec<_>>()));
    let name = form.singular;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    sample      [{}.my_{name}]", form.table);
    for line in std::iter::once(&*format!("kind = \"{}\"", kind.name))
        .chain(kind.ports.0.iter().map(|port| port.sample).filter(|line| !line.is_empty()))
        .chain(kind.sample.lines())
    {
        let _ = writeln!(text, "                {line}");
    }
    text
}

fn of_choice(choice: &ChoiceEntry) -> String {
    let own: Vec<&str> = choice.parameters.iter().map(|parameter| parameter.name).collect();
    let own = if own.is_empty() { String::new() } else { format!("    keys        {}\n", own.join(", ")) };
    format!("\n  {}: {}\n{own}", choice.name, choice.summary)
}

fn keys_of(keys: &[FormKey]) -> String {
    let heading = |index: usize| if index == 0 { "keys" } else { "" };
    let lines =
        keys.iter().enumerate().map(|(index, key)| format!("    {:<11} {}\n", heading(index), of_key(key)));
    lines.collect()
}

fn of_key(key: &FormKey) -> String {
    let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
    let need = if key.required { "" } else { ", optional" };
    format!("{}: {}{unit}{need}. {}", key.name, key.holds, key.summary)
}

/// The keys of a kind's ports in one line. A key with an explanation ends with a semicolon.
fn listed(ports: Ports) -> String {
    let mut text = String::new();
    let mut separator = "";
    for port in ports.0.iter().filter(|port| !port.listed.is_empty()) {
        text = text + separator + port.listed;
        let rest = port.listed.strip_prefix(port.key);
        separator = if rest.is_some_and(|rest| rest.starts_with(':')) { "; " } else { ", " };
    }
    if text.is_empty() { "nothing: it has coordinates of its own".to_owned() } else { text }
}
