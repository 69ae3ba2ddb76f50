//! `lissom new`: a model to start from. A template is a file in `templates/` and a line here.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use lissom::model::files;

use super::outcome::{Exit, Failure};
use super::terminal;

/// A machine to start from.
struct Template {
    name: &'static str,
    summary: &'static str,
    /// The model, complete except for its title.
    text: &'static str,
}

/// A template whose file has its name.
macro_rules! template {
    ($name:literal, $summary:literal) => {
        Template { name: $name, summary: $summary, text: include_str!(concat!("templates/", $name, ".toml")) }
    };
}

/// All of them, the usual one first.
const TEMPLATES: [Template; 7] = [
    template!("slider-crank", "a driven crank, a flexible rod and a slider"),
    template!("vehicle", "a car with four sprung wheels that is driven and steered"),
    template!("robot", "an arm of three joints with motors and their control"),
    template!("crane", "a flexible tower crane with trolley, rope and winch"),
    template!("rotor", "a flexible shaft with an unbalanced disc, run up in bearings"),
    template!("wing", "a flexible wing in a gust, with the aerodynamics of its sections"),
    template!("turbine", "a wind turbine with flexible blades, tower, generator and wake"),
];

/// Schema of model files beside the model, which its first line names for editors.
const SCHEMA: &str = "lissom.schema.json";

/// Write a commented model to start from: a slider crank, or another machine by `--template`.
///
/// The JSON schema of model files is written beside it, for completion in editors, unless there is one.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom new press                             writes press.toml
  lissom new car --template vehicle            writes a car
  lissom view press.toml --open                simulates it and shows it
  lissom live press.toml --open                simulates again whenever the file is saved")]
pub(super) struct New {
    /// Name of the model; the file is NAME.toml.
    #[arg(value_name = "NAME")]
    name: PathBuf,
    /// The machine.
    #[arg(long, value_name = "TEMPLATE", default_value = TEMPLATES[0].name, value_parser = names())]
    template: String,
}

/// The names of all templates, with their summaries for `--help`.
fn names() -> PossibleValuesParser {
    PossibleValuesParser::from(TEMPLATES.map(|own| PossibleValue::new(own.name).help(own.summary)))
}

impl New {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let mut path = self.name.clone();
        if path.extension().is_none_or(|extension| extension != "toml") {
            path.as_mut_os_string().push(".toml");
        }
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if stem.is_empty() || stem == ".toml" {
            return Err(Failure::request(format!("`{}` is not a valid model name", self.name.display())));
        }
        if path.exists() {
            let message =
                format!("`{}` already exists and is not overwritten: choose another name", path.display());
            return Err(Failure::request(message));
        }
        // Quoted as TOML text, because it may contain any letters.
        let title = stem.replace('\\', "\\\\").replace('"', "\\\"");
        let template = TEMPLATES.iter().find(|own| own.name == self.template).unwrap_or(&TEMPLATES[0]);
        let text = template.text.replace("@title@", &title);
        let write = |path: &Path, text: &str| {
            files::write(path, text.as_bytes()).map_err(|error| Failure::new(Exit::Failed, &error))
        };
        write(&path, &text)?;
        let schema = path.with_file_name(SCHEMA);
        if !schema.exists() {
            write(&schema, &super::schema::text())?;
        }
        terminal::print(&render(&path));
        Ok(Exit::Done)
    }
}

fn render(path: &Path) -> String {
    let path = path.display();
    format!(
        "{path} is written. Next:\n  lissom view {path} --open    simulate it and watch the motion\n  \
         lissom live {path} --open    simulate again whenever you save the file\n  \
         lissom kinds                 kinds and keys of a model file\n"
    )
}
