//! All forms of the tables of a model file and their keys as texts, for the search by `lissom kinds`.

use lissom_mechanics::registry::Parameter;

use crate::document::tables::variants;
use crate::expression::FUNCTION_NAMES;
use crate::format::keys::{Key, of_parameter};
use crate::format::part_tables::part_motion;
use crate::format::solid_kinds::SOLID_KINDS;
use crate::format::top_level::singular;
use crate::format::top_level::{Holds, tops};
use crate::format::value_types::{RustType, ValueType};
use crate::format::{suggest, synonyms};
use crate::registry::Registry;

/// A key of a form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormKey {
    /// Word in the model file.
    pub name: &'static str,
    /// Description of the value.
    pub holds: String,
    /// Words among which the value is chosen, if it is.
    pub choices: Vec<&'static str>,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Whether it must be given.
    pub required: bool,
    /// One sentence, with the default.
    pub summary: String,
}

/// A form of a table, such as one kind of joint; or a table with a single form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Form {
    /// Heading of the table, such as `[joints.*]`; or the key at the top.
    pub heading: String,
    /// Word of the table at the top.
    pub table: &'static str,
    /// Word for one entry, such as `joint`.
    pub singular: &'static str,
    /// Description of the table.
    pub about: String,
    /// Key whose value chooses the form; none for a single form.
    pub tag: Option<&'static str>,
    /// Value that chooses the form; empty for a single form.
    pub word: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Keys of the form except that which chooses it.
    pub keys: Vec<FormKey>,
}

/// All forms, in the order of the reference.
pub fn forms(registry: &Registry) -> Vec<Form> {
    let mut all = Vec::new();
    for top in tops() {
        let heading = match top.holds {
            Holds::Entries => format!("[{}.*]", top.name),
            Holds::Table | Holds::Values(_) => format!("[{}]", top.name),
            Holds::Value(_) => top.name.to_owned(),
        };
        let form = |tag, word, summary, keys| {
            let about = match &top.holds {
                Holds::Value(shape) => format!("{} Holds {}.", top.summary, shape.value_type().words),
                Holds::Values(shape) => {
                    format!("{} Each entry is {}.", top.summary, shape.value_type().words)
                }
                Holds::Table | Holds::Entries => top.summary.to_owned(),
            };
            let (heading, table) = (heading.clone(), top.name);
            let singular = if singular(top.name) == "entry" { top.name } else { singular(top.name) };
            Form { heading, table, singular, about, tag, word, summary, keys }
        };
        let found = variants(top.name, registry);
        if found.all.is_empty() {
            all.push(form(None, "", top.summary, Vec::new()));
        }
        for variant in found.all {
            let keys = variant.keys.iter().filter(|key| Some(key.name) != found.tag).map(of_key).collect();
            all.push(form(found.tag, variant.word, variant.summary, keys));
        }
        if top.name == "initial" {
            let keys = part_motion().iter().map(of_key).collect();
            let about = "A rigid motion of some parts. A part has at most one.";
            all.push(Form {
                heading: "[initial.*]".to_owned(),
                about: about.to_owned(),
                ..form(None, "", about, keys)
            });
        }
    }
    all.extend(SOLID_KINDS.iter().map(|kind| Form {
        heading: "[bodies.*.shape]".to_owned(),
        table: "shapes",
        singular: "shape",
        about: ABOUT_SHAPES.to_owned(),
        tag: Some("kind"),
        word: kind.word,
        summary: kind.summary,
        keys: kind.all_keys().iter().map(of_key).collect(),
    }));
    all
}

/// Description of `shape`.
pub(crate) const ABOUT_SHAPES: &str = "Solids of bodies, point masses and the ground, by which they are drawn and touch others. `shape` is a table \
     or a list of tables.";

impl From<&Parameter> for FormKey {
    fn from(parameter: &Parameter) -> Self {
        of_key(&of_parameter(parameter))
    }
}

fn of_key(key: &Key) -> FormKey {
    let ValueType { words, rust, .. } = key.holds.value_type();
    let choices = if let RustType::Words(all) | RustType::ListOfWords(all) = rust { all } else { Vec::new() };
    let (Key { name, unit, required, .. }, summary) = (key, key.meaning());
    FormKey { name, holds: words.into_owned(), choices, unit, required: *required, summary }
}

/// Names of the functions of expressions.
pub fn function_names() -> impl Iterator<Item = &'static str> {
    FUNCTION_NAMES.iter().map(|(name, _)| *name)
}

/// The words among `known` that were probably meant by `word`: those with this synonym, otherwise the nearest one.
pub fn meant<'a>(word: &str, known: &[&'a str]) -> Vec<&'a str> {
    let synonyms = synonyms::all_known_for(word, known);
    if synonyms.is_empty() {
        suggest::nearest(word, known.iter().copied()).into_iter().collect()
    } else {
        synonyms
    }
}
