//! `lissom new`: a model to start from.

use std::path::{Path, PathBuf};

use clap::Args;
use lissom::model::files;

use super::outcome::{Exit, Failure};
use super::terminal;

/// The model, complete except for its title.
const TEMPLATE: &str = include_str!("new_model.toml");

/// Schema of model files beside the model, which its first line names for editors.
const SCHEMA: &str = "lissom.schema.json";

/// Write a commented model to start from: a slider crank with a flexible rod.
///
/// The JSON schema of model files is written beside it, for completion in editors, unless there is one.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom new press                             writes press.toml
  lissom view press.toml --open                simulates it and shows it
  lissom live press.toml --open                simulates again whenever the file is saved")]
pub(super) struct New {
    /// Name of the model; the file is NAME.toml.
    #[arg(value_name = "NAME")]
    name: PathBuf,
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
        let text = TEMPLATE.replace("@title@", &title);
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
