//! `lissom schema`: the JSON schema of model files.

use clap::Args;
use lissom::model::lower::registry::registry;

use super::outcome::{Exit, Failure};
use super::terminal;

/// Print the JSON schema of model files, for completion and validation in editors.
#[derive(Args)]
#[command(after_help = "\
Example:
  lissom schema > lissom.schema.json

Then put this line first in a model file, for editors with a TOML language server:
  #:schema ./lissom.schema.json")]
pub(super) struct Schema {}

impl Schema {
    // All commands have one signature.
    #[expect(clippy::unused_self, clippy::unnecessary_wraps)]
    pub(super) fn run(self) -> Result<Exit, Failure> {
        terminal::print(&text());
        Ok(Exit::Done)
    }
}

/// The schema.
pub(super) fn text() -> String {
    format!("{:#}\n", lissom::model::schema(&registry()))
}
