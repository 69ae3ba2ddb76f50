//! The entries of a model as types of Rust, generated from the descriptions that the decoder and the schema use: the contents of
//! `crates/lissom/src/builder/entries/`.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::document::tables::variants;
use crate::format::keys::{Key, Shape};
use crate::format::part_tables::part_motion;
use crate::format::top_level::Variant;
use crate::format::value_types::RustType;
use crate::registry::Registry;

/// A table and the type of its ids.
type TableAndId = (&'static str, &'static str);

/// The files by name without extension, with the tables of their entries and the types of their ids.
const FILES: [(&str, &str, &[TableAndId]); 11] = [
    ("sections", "Materials and cross sections.", &[("materials", "MaterialId"), ("sections", "SectionId")]),
    (
        "parts",
        "Beams, shells, solids, rigid bodies, point masses and superelements.",
        &[
            ("beams", "BeamId"),
            ("shells", "ShellId"),
            ("solids", "SolidId"),
            ("bodies", "BodyId"),
            ("point_masses", "PointMassId"),
            ("superelements", "SuperelementId"),
        ],
    ),
    (
        "joints",
        "Constraints between nodes, or between coordinates of joints, one type per kind.",
        &[("joints", "JointId")],
    ),
    ("springs", "What pulls nodes or joints back, one type per kind.", &[("springs", "SpringId")]),
    (
        "loads",
        "Applied forces and moments, and those of actuators.",
        &[("loads", "LoadId"), ("local_loads", "LocalLoadId")],
    ),
    (
        "contacts",
        "Parts that may touch, and the solids that are fixed in space.",
        &[("contacts", "ContactId"), ("ground", "GroundId")],
    ),
    ("feedback", "First-order states and events.", &[("states", "StateId"), ("events", "EventId")]),
    (
        "hydraulics",
        "Fluids, and nodes and components of hydraulic networks.",
        &[("fluids", "FluidId"), ("hydraulics", "HydraulicId")],
    ),
    ("motions", "How the parts are and move at the start.", &[("initial", "InitialId")]),
    ("outputs", "What is recorded, one type per kind.", &[("outputs", "OutputId")]),
    ("analyses", "Kind of analysis and its settings.", &[("analysis", "AnalysisId")]),
];

/// Words that a key chooses among, by the name of their type.
type Words = BTreeMap<String, Vec<&'static str>>;

/// The types of all entries of `registry`: the texts of the files by name without extension.
pub fn typed_entries(registry: &Registry) -> BTreeMap<&'static str, String> {
    let mut words = Words::new();
    let mut files = BTreeMap::new();
    for (file, summary, tables) in FILES {
        let mut types = Vec::new();
        for (table, id) in tables {
            let found = variants(table, registry).in_code();
            types.extend(found.all.iter().map(|variant| entry((table, id), found.tag, variant, &mut words)));
        }
        if file == "joints" {
            types.push(nested(("Friction", "Friction in a joint."), &Shape::friction_keys(), &mut words));
            types.push(nested(("Latch", "A latch on a joint."), &Shape::latch_keys(), &mut words));
        }
        if file == "sections" {
            let summary = "Mass of a section, by its parts.";
            types.push(nested(("SliceMass", summary), &Shape::slice_mass_keys(), &mut words));
        }
        if file == "motions" {
            let variant = Variant {
                word: "part_motion",
                summary: "A rigid motion of some parts at the start.",
                keys: part_motion(),
            };
            types.push(entry(("initial", "MotionId"), None, &variant, &mut words));
        }
        let text = text_of(&types);
        files.insert(file, format!("//! {summary}\n\n{}{text}", imports(&text)));
    }
    files.insert("words", words_text(&words));
    files
}

/// The types that `text` names.
fn imports(text: &str) -> String {
    const KNOWN: [(&str, &[&str]); 4] = [
        (
            "ids",
            &[
                "BeamId",
                "ContactId",
                "FluidId",
                "HydraulicId",
                "InputId",
                "JointId",
                "LocalLoadId",
                "MaterialId",
                "Part",
                "Quantity",
                "SectionId",
                "SpringId",
                "SuperelementId",
            ],
        ),
        ("builder::entry", &["entries", "keys"]),
        (
            "builder::values",
            &["Inertia", "Mass", "Matrix", "Node", "PositionOrNode", "SectionMass", "Shear", "Solid"],
        ),
        ("builder::expression", &["Expression", "Function"]),
    ];
    let names = |word: &&&str| {
        let letters = |c: char| c.is_alphanumeric() || c == '_';
        // What is beyond the type of a key are words about it.
        text.lines()
            .filter(|line| !line.trim_start().starts_with("///") && !line.contains("=>"))
            .filter_map(|line| line.split(" = ").next())
            .any(|line| line.split(|c| !letters(c)).any(|part| part == **word))
    };
    let mut lines: Vec<String> = Vec::new();
    for (module, known) in KNOWN {
        let used: Vec<&str> = known.iter().filter(names).copied().collect();
        match used.as_slice() {
            [] => {}
            [one] => lines.push(format!("use crate::{module}::{one};\n")),
            several => lines.push(format!("use crate::{module}::{{{}}};\n", several.join(", "))),
        }
    }
    lines.sort();
    let words = if text.contains("words::") { "use super::words;\n" } else { "" };
    format!("{words}{}\n", lines.concat())
}

/// A type to be declared.
struct Declared {
    name: String,
    /// How its declaration begins.
    heading: String,
    /// Each key that may be omitted, with its documentation.
    optional: Vec<String>,
}

/// Declarations; keys that several types have are declared once.
fn text_of(types: &[Declared]) -> String {
    let owners = |key: &String| -> Vec<&str> {
        let has = |declared: &&Declared| declared.optional.contains(key);
        types.iter().filter(has).map(|declared| declared.name.as_str()).collect()
    };
    let mut text = String::from("entries! {\n");
    let mut shared: Vec<(Vec<&str>, String)> = Vec::new();
    for declared in types {
        text.push_str(&declared.heading);
        for key in &declared.optional {
            let owners = owners(key);
            if owners.len() == 1 {
                text.push_str(key);
            } else if let Some((_, keys)) = shared.iter_mut().find(|(known, _)| *known == owners) {
                if !keys.contains(key) {
                    keys.push_str(key);
                }
            } else {
                shared.push((owners, key.clone()));
            }
        }
        line(&mut text, "    }\n");
    }
    text.truncate(text.trim_end().len());
    line(&mut text, "\n}\n");
    for (owners, keys) in shared {
        line(&mut text, &format!("keys! {{\n    [{}]\n{keys}}}\n", owners.join(", ")));
    }
    text
}

fn entry(
    (table, id): (&str, &str),
    tag: Option<&'static str>,
    variant: &Variant,
    words: &mut Words,
) -> Declared {
    let word = if variant.word.is_empty() { single(table) } else { variant.word };
    let summary = if variant.summary.is_empty() { summary_of(table) } else { variant.summary };
    let name = if variant.word == "expression" { "ExpressionOutput".to_owned() } else { camel(word) };
    let tagged = tag.map_or(String::new(), |tag| format!("{tag}: "));
    let heading = format!("    /// {}\n    {name} => {id}, {tagged}{word:?} {{\n", sentence(summary));
    with_keys(Declared { name, heading, optional: Vec::new() }, &variant.keys, tag, words)
}

fn nested((name, summary): (&str, &str), keys: &[Key], words: &mut Words) -> Declared {
    let heading = format!("    /// {}\n    {name} {{\n", sentence(summary));
    with_keys(Declared { name: name.to_owned(), heading, optional: Vec::new() }, keys, None, words)
}

/// Adds the arguments of `new` and the optional keys to declarations.
fn with_keys(mut declared: Declared, keys: &[Key], tag: Option<&str>, words: &mut Words) -> Declared {
    let typed: Vec<(&Key, String)> = keys
        .iter()
        .filter(|key| Some(key.name) != tag)
        .filter_map(|key| Some((key, type_of(key, words)?)))
        .collect();
    let (required, optional): (Vec<_>, Vec<_>) = typed.into_iter().partition(|(key, _)| key.required);
    for (key, holds) in &required {
        declared.heading += &row("* ", key, holds, &about(key));
    }
    for (key, holds) in &optional {
        declared.optional.push(row("", key, holds, &sentence(&about(key))));
    }
    declared
}

/// The declaration of a key with its mark and its meaning.
fn row(mark: &str, key: &Key, holds: &str, words: &str) -> String {
    format!("        {mark}{}: {holds} = {:?}, {words:?};\n", identifier(key.name), key.name)
}

/// Rust type of a key; none for those that are not used in code.
fn type_of(key: &Key, words: &mut Words) -> Option<String> {
    match key.holds.value_type().rust {
        // Code has functions for the placement of parts in each other.
        _ if key.holds == Shape::Text && key.name == "in" => None,
        // A signal, an input or a state.
        _ if key.holds == Shape::Text && key.name == "of" => Some("Quantity".to_owned()),
        RustType::Fixed(fixed) => Some(fixed.to_owned()),
        RustType::Words(known) => Some(format!("words::{}", word_type(key, &known, words))),
        RustType::ListOfWords(known) => Some(format!("Vec<words::{}>", word_type(key, &known, words))),
        RustType::Id("inputs") => Some("InputId".to_owned()),
        RustType::Id(table) => {
            let mut known = FILES.iter().flat_map(|(_, _, tables)| *tables);
            known.find(|(name, _)| *name == table).map(|(_, id)| (*id).to_owned())
        }
        RustType::Absent => None,
    }
}

/// Name of the type for the words of a key.
fn word_type(key: &Key, known: &[&'static str], words: &mut Words) -> String {
    let mut name = camel(key.name);
    if known.contains(&"positive") {
        name.insert_str(0, "Signed");
    }
    while words.get(&name).is_some_and(|other| other != known) {
        name.push_str("Of");
        name.push_str(&camel(known[known.len() - 1]));
    }
    words.insert(name.clone(), known.to_vec());
    name
}

fn words_text(words: &Words) -> String {
    let mut text =
        String::from("//! Words that keys choose among.\n\nuse crate::builder::entry::words;\n\nwords! {\n");
    for (name, known) in words {
        let all: Vec<String> = known.iter().map(|word| format!("{} = {word:?}", camel(word))).collect();
        line(&mut text, &format!("    {name} {{ {} }}", all.join(", ")));
    }
    text + "}\n"
}

/// The word for one entry of a table that has a single form.
fn single(table: &str) -> &'static str {
    match table {
        "materials" => "material",
        "beams" => "beam",
        "shells" => "shell",
        "solids" => "elastic_solid",
        "bodies" => "body",
        "point_masses" => "point_mass",
        "superelements" => "superelement",
        "states" => "state",
        "events" => "event",
        "fluids" => "fluid",
        "contacts" => "contact",
        "local_loads" => "local_load",
        "ground" => "ground",
        "initial" => "initial_motion",
        _ => "entry",
    }
}

fn summary_of(table: &str) -> &'static str {
    match table {
        "materials" => "An isotropic elastic material.",
        "beams" => "A flexible beam.",
        "shells" => "A flexible shell or plate.",
        "solids" => "An elastic solid.",
        "bodies" => "A rigid body.",
        "point_masses" => "A mass without extension.",
        "superelements" => "A linear elastic part that is given by reduced matrices.",
        "states" => "A first-order state: a number whose time derivative is an expression.",
        "fluids" => "A fluid of hydraulic parts.",
        "events" => "What happens when an expression passes through zero.",
        "local_loads" => "A force and a moment that depend on the motion of their own points.",
        "contacts" => "Two parts that may touch, by their shapes.",
        "ground" => "Solids that are fixed in space.",
        "initial" => "A rigid motion of all parts at the start, or static equilibrium.",
        _ => "An entry.",
    }
}

/// A key as a name of Rust.
fn identifier(key: &str) -> &str {
    match key {
        "E" => "youngs_modulus",
        "G" => "shear_modulus",
        "nu" => "poisson_ratio",
        "static" => "static_friction",
        "in" => "seen_in",
        "of" => "of",
        name => name,
    }
}

/// Meaning of a key, with its unit.
fn about(key: &Key) -> String {
    let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
    let meaning = key.meaning();
    let summary = meaning.trim_end_matches('.');
    escaped(&format!("{summary}{unit}"))
}

/// With a capital and a full stop.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}

/// Brackets are no links and no tags, outside of code.
fn escaped(words: &str) -> String {
    let mut inside = false;
    let mut text = String::new();
    for letter in words.chars() {
        inside ^= letter == '`';
        if !inside && matches!(letter, '[' | ']' | '<' | '>' | '*' | '_') {
            text.push('\\');
        }
        text.push(letter);
    }
    text
}

fn camel(word: &str) -> String {
    let capital = |part: &str| {
        let mut letters = part.chars();
        letters.next().map(|first| first.to_uppercase().to_string() + letters.as_str()).unwrap_or_default()
    };
    word.split(['_', '-', ' ']).map(capital).collect()
}

fn line(text: &mut String, words: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{words}");
}
