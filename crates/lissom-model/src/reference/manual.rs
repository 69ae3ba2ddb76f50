//! The reference of the model file as Markdown, made of the same descriptions the decoder and the schema read.

use std::fmt::Write;

use crate::document::tables::variants;
use crate::expression::FUNCTION_NAMES;
use crate::format::keys::Key;
use crate::format::keys::table_keys;
use crate::format::part_tables::part_motion;
use crate::format::solid_kinds::SOLID_KINDS;
use crate::format::top_level::singular;
use crate::format::top_level::{Holds, Top, Variants, tops};
use crate::reference::forms::ABOUT_SHAPES;
use crate::registry::{ChoiceEntry, DEFAULT_SCHEMES, KindEntry, Registry};

const INTRODUCTION: &str = "\
A model is a TOML file. Units are SI, angles radians, axes right-handed.

- **Numbers.** Wherever a number is expected, a text is accepted: an expression of the `[parameters]`, such as
  `\"L/2\"`. A parameter may refer to others.
- **Expressions** consist of numbers, `+ - * / ^ ( )`, `pi`, the parameters, and the functions below; `-t^2` is `-(t^2)`.
  `a < b`, `<=`, `>`, `>=` are 1 if true and 0 if false; `if(condition, a, b)` is `b` if the condition is 0.
  `step(x)` is 0 for x < 0 and 1 otherwise; `smoothstep(x)` increases from 0 at 0 to 1 at 1 with continuous second
  derivative. `random(seed, x)` is uniform between 0 and 1, and `normal(seed, x)` normal with variance 1: another number for each
  whole number nearest to `x`. Functions of time contain `t` [s]; curves and twists contain `s`, from 0 to 1 along the beam.
- **Functions of time** are a number, an expression of `t`, or
  `{ table = [[t, value], …], interpolation = \"linear\" }` (or `\"spline\"`, or `\"monotone\"`, which does not
  overshoot); outside the table the value is that of the nearest end. Instead of `table`, `file = \"motor.csv\"` and
  `columns = [\"time\", \"torque\"]` read two columns of a text file in the model's folder.
- **Sizes** of loads are functions of time, or expressions that contain inputs, signals, states, coordinates of joints such as
  `arm.angle`, and components of outputs such as `tip.u1`.
- **Positions** are three numbers or the name of an entry of `[points]`.
- **Directions** are three numbers, of which only the direction counts, or the letter of an axis, such as `\"z\"` or `\"-x\"`.
- **Solids** are `{ kind = \"box\", sides = [a, b, c] }`, `{ kind = \"cylinder\", radius = r, length = l, axis = \"z\" }`,
  `{ kind = \"tube\", radius = r, inner_radius = i, length = l, axis = \"z\" }` or `{ kind = \"sphere\", radius = r }`; shorter
  `{ box = [a, b, c] }`, `{ cylinder = [r, l] }`, `{ tube = [r, i, l] }` and `{ sphere = r }`. What is drawn of a body may also be
  `{ kind = \"mesh\", file = \"arm.stl\", scale = [1, 1, 1] }`, and has a `position` and a `rotation` in body axes.
- **Nodes** are `\"ground\"`, the name of a body or point mass, `\"beam.start\"`, `\"beam.end\"` or `\"beam@0.5\"`.
  Beams, bodies and point masses share one set of names.
- **Sections** have the order axial, shear 2, shear 3, torsion, bending 2, bending 3; axis 1 is along the beam, axis 3 oriented
  to the beam's `up`. Without `up`, it is oriented to global z, or to y (then x) if the beam is parallel to z.
";

/// The reference of the files that [`Document::parse`](crate::Document::parse) reads with `registry`.
pub fn manual(registry: &Registry) -> String {
    let mut text = String::from("# The model file\n\n");
    text.push_str(INTRODUCTION);
    functions(&mut text);
    for top in tops() {
        of_top(&mut text, top, registry);
    }
    shapes(&mut text);
    text
}

/// Words that [`topic`] accepts in addition to those of the tables.
const FUNCTION_WORDS: [&str; 2] = ["function", "expression"];

/// Contents of a key at the top level of a model file, such as `outputs` or `output`, as Markdown; also the description of a
/// `function`. None if there is no such word.
pub fn topic(registry: &Registry, word: &str) -> Option<String> {
    let mut text = String::new();
    if FUNCTION_WORDS.contains(&word)
        || word.strip_suffix('s').is_some_and(|one| FUNCTION_WORDS.contains(&one))
    {
        let is_reported = |words: &&str| {
            ["- **Expressions**", "- **Functions of time**", "- **Sizes**"]
                .iter()
                .any(|start| words.starts_with(start))
        };
        let items = INTRODUCTION.split("\n- ").skip(1).map(|item| format!("- {}", item.trim_end()));
        items.filter(|item| is_reported(&item.as_str())).for_each(|item| line(&mut text, &item));
        functions(&mut text);
        line(&mut text, "\nA table of a function:");
        keys(&mut text, table_keys().iter());
        return Some(text);
    }
    let top = tops().find(|top| top.name == word || singular(top.name) == word)?;
    of_top(&mut text, top, registry);
    Some(text.trim_start().to_owned())
}

/// Unit of the value at `path` of a model file, such as `bodies.arm.mass`; none if forms of the table have different ones.
pub fn unit_of(registry: &Registry, path: &str) -> Option<&'static str> {
    let (table, rest) = path.split_once('.')?;
    let name = rest.rsplit('.').next()?;
    let all = variants(table, registry).all;
    let mut units = all.iter().flat_map(|form| &form.keys).filter(|key| key.name == name).map(|key| key.unit);
    let first = units.next()?;
    (!first.is_empty() && units.all(|unit| unit == first)).then_some(first)
}

/// The words that [`topic`] accepts.
pub fn topics() -> Vec<&'static str> {
    let tables = tops().filter(|top| !matches!(top.holds, Holds::Value(_)));
    let name = |top: &'static Top| if singular(top.name) == "entry" { top.name } else { singular(top.name) };
    tables.map(name).chain(["function"]).collect()
}

/// The kinds of solids.
fn shapes(text: &mut String) {
    line(text, &format!("\n## `shape`\n\n{ABOUT_SHAPES}"));
    for kind in &SOLID_KINDS {
        line(text, &format!("\n### `shape = {{ kind = \"{}\" }}`\n\n{}", kind.word, kind.summary));
        keys(text, kind.all_keys().iter());
    }
}

fn functions(text: &mut String) {
    let names: Vec<String> = FUNCTION_NAMES.iter().map(|(name, _)| format!("`{name}`")).collect();
    line(text, &format!("\nFunctions: {}.", names.join(", ")));
}

fn of_top(text: &mut String, top: &Top, registry: &Registry) {
    let must = if top.required { " Required." } else { "" };
    match &top.holds {
        Holds::Value(shape) => {
            line(
                text,
                &format!("\n## `{}`\n\n{}{must} Holds {}.", top.name, top.summary, shape.value_type().words),
            );
        }
        Holds::Values(shape) => {
            line(
                text,
                &format!(
                    "\n## `[{}]`\n\n{} Each entry is {}.",
                    top.name,
                    top.summary,
                    shape.value_type().words
                ),
            );
        }
        Holds::Table => {
            line(text, &format!("\n## `[{}]`\n\n{}{must}", top.name, top.summary));
            forms(text, top.name, registry);
            if top.name == "initial" {
                line(text, "\n### `[initial.…]`\n\nA rigid motion of some parts. A part has at most one.");
                keys(text, part_motion().iter());
            }
        }
        Holds::Entries => {
            line(text, &format!("\n## `[{}.…]`\n\n{}{must}", top.name, top.summary));
            forms(text, top.name, registry);
        }
    }
}

fn line(text: &mut String, words: &str) {
    text.push_str(words);
    text.push('\n');
}

fn forms(text: &mut String, name: &str, registry: &Registry) {
    let Variants { tag, all, .. } = variants(name, registry);
    for form in &all {
        if let Some(tag) = tag {
            line(text, &format!("\n### `{tag} = \"{}\"`\n\n{}", form.word, form.summary));
        }
        // The word that chooses the form is in its heading.
        keys(text, form.keys.iter().filter(|key| Some(key.name) != tag));
        let kinds: &[KindEntry] = match name {
            "joints" => &registry.joints,
            "springs" => &registry.springs,
            "loads" => &registry.loads,
            _ => &[],
        };
        if let Some(entry) =
            kinds.iter().find(|entry| entry.name == form.word).filter(|entry| !entry.sample.is_empty())
        {
            line(text, &format!("\n```toml\n{}\n```", entry.sample.trim_end()));
        }
    }
    if name == "analysis" {
        choices(text, ("Schemes", DEFAULT_SCHEMES), &registry.schemes);
        choices(text, ("Solvers", "the first is the default"), &registry.solvers);
    }
}

fn choices(text: &mut String, (heading, default): (&str, &str), table: &[ChoiceEntry]) {
    line(text, &format!("\n{heading}; {default}:\n"));
    for entry in table {
        let own: Vec<String> =
            entry.parameters.iter().map(|parameter| format!("`{}`", parameter.name)).collect();
        let own = if own.is_empty() { String::new() } else { format!(" Takes {}.", own.join(", ")) };
        line(text, &format!("- `{}`: {}{own}", entry.name, entry.summary));
    }
}

fn keys<'k>(text: &mut String, keys: impl Iterator<Item = &'k Key>) {
    let mut heading = Some("\n| key | holds | unit | |\n| --- | --- | --- | --- |");
    for key in keys {
        if let Some(heading) = heading.take() {
            line(text, heading);
        }
        let must = if key.required { "**required**; " } else { "" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {must}{} |",
            key.name,
            key.holds.value_type().words,
            key.unit,
            key.meaning()
        );
    }
}

#[cfg(test)]
#[path = "../../tests/unit/reference/manual.rs"]
mod tests;
