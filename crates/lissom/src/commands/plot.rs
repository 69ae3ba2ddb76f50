//! `lissom plot`: draws the plots of a folder of results anew.

use std::path::PathBuf;

use clap::Args;
use lissom::ResultFolder;

use super::{Exit, Failure};

/// Draw the plots of a folder of results anew, from its `history.csv`.
#[derive(Args)]
#[command(after_help = "\
Example:
  lissom plot out/pendulum")]
pub(super) struct Plot {
    /// The folder of results.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Plot {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (folder, record, title) =
            ResultFolder::open(&self.folder).map_err(|error| Failure::folder(Exit::BadModel, &error))?;
        folder.write_plots(&record, &title).map_err(|error| Failure::folder(Exit::Failed, &error))?;
        Ok(Exit::Done)
    }
}
