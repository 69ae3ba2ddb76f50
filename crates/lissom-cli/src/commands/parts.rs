//! `lissom parts`: ready-made parts, to be included by their names or copied.

use std::path::PathBuf;

use clap::Args;
use lissom::model::files;
use lissom::model::files::ready_made::{self, PARTS};

use super::outcome::{Exit, Failure};
use super::terminal;

/// List ready-made parts, print one, or write it to a file.
///
/// A model includes a part by `include = "lissom:NAME"` in a table `[parts.…]`, without a copy. The comments of a part list its
/// names, parameters and outputs.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom parts                                   the names of all parts
  lissom parts speed-drive                       the file of a part, with its names, parameters and outputs
  lissom parts speed-drive --out drive.toml      a copy to be changed")]
pub(super) struct Parts {
    /// Name of a part.
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Write the part to this file, which must not exist.
    #[arg(long, value_name = "FILE", requires = "name")]
    out: Option<PathBuf>,
}

impl Parts {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let Some(name) = self.name else {
            terminal::print(&list());
            return Ok(Exit::Done);
        };
        let part = ready_made::find(&name).map_err(|missing| {
            let help = missing.help.map(|help| format!("; {help}")).unwrap_or_default();
            Failure::request(format!("{}{help}", missing.message))
        })?;
        let Some(path) = self.out else {
            terminal::print(part.text);
            return Ok(Exit::Done);
        };
        if path.exists() {
            let message =
                format!("`{}` already exists and is not overwritten: choose another name", path.display());
            return Err(Failure::request(message));
        }
        files::write(&path, part.text.as_bytes()).map_err(|error| Failure::new(Exit::Failed, &error))?;
        terminal::print(&format!("{} is written; include it by its path.\n", path.display()));
        Ok(Exit::Done)
    }
}

fn list() -> String {
    let rows = PARTS.map(|part| format!("  {:<20}  {}\n", part.name, part.summary));
    format!("{}\n`lissom parts NAME` prints a part; `include = \"lissom:NAME\"` uses it.\n", rows.concat())
}
