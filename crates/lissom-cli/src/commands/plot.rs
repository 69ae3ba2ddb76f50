//! `lissom plot`: plots of one or several folders of results, over time, another column or frequency.

use std::path::{Path, PathBuf};

use clap::Args;
use lissom::model::output::CurveRecord;
use lissom::model::output::{Over, Source, plots};
use lissom::{FolderError, Record, ResultFolder};

use super::outcome::{Exit, Failure};
use super::results::warn_of_incomplete;
use super::terminal;

/// Plot the `history.csv` of one or several folders of results.
///
/// Without options the plots of `lissom run` are redrawn for one folder. Otherwise the files are named `plot-….svg` and
/// `plot-….png`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom plot out/pendulum                                  all outputs over time
  lissom plot out/pendulum --of bob.y --over bob.x          a path: out/pendulum/plot-bob.y-over-bob.x.svg
  lissom plot out/tip-crank --of midspan --spectrum         amplitudes over frequency
  lissom plot out/coarse out/fine --out out/compared        outputs of both, in one plot each

Exit code: 0 success; 2 no such folder, output or column.")]
pub(super) struct Plot {
    /// Folders of results.
    #[arg(value_name = "RESULT", required = true)]
    folders: Vec<PathBuf>,

    /// Outputs or columns, such as `tip` or `tip.u3` [default: all that the folders have in common].
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    of: Vec<String>,

    /// Plot over this column instead of time.
    #[arg(long, value_name = "COLUMN", conflicts_with = "spectrum")]
    over: Option<String>,

    /// Plot amplitudes over frequency.
    #[arg(long)]
    spectrum: bool,

    /// Folder for the plots [default: the first folder of results].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Plot {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let bad = |error: FolderError| Failure::new(Exit::BadModel, &error);
        let failed = |error: FolderError| Failure::new(Exit::Failed, &error);
        let found: Vec<(ResultFolder, Record, String)> = self
            .folders
            .iter()
            .map(|folder| ResultFolder::open(folder).map_err(bad))
            .collect::<Result<_, _>>()?;
        self.folders.iter().for_each(|folder| lissom::protect_results(folder));
        self.folders.iter().for_each(|folder| warn_of_incomplete(folder));
        let is_plain = self.of.is_empty() && self.over.is_none() && !self.spectrum && self.out.is_none();
        let [(first, record, title), others @ ..] = &*found else {
            return Err(Failure::request("name a folder of results"));
        };
        if is_plain && others.is_empty() {
            first.write_plots(&CurveRecord::from(record), title, usize::MAX).map_err(failed)?;
            return Ok(Exit::Done);
        }
        let names = names(&self.folders);
        let is_one = others.is_empty();
        let sources: Vec<Source<'_>> = (names.iter().zip(&found))
            .map(|(name, (_, record, _))| Source { name: if is_one { "" } else { name }, record })
            .collect();
        let over = match &self.over {
            Some(column) => Over::Column(column),
            None if self.spectrum => Over::Frequency,
            None => Over::Time,
        };
        let drawn =
            plots(&sources, &self.of, over, title).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        for words in &drawn.left_out {
            terminal::complain(&format!("note: {words}\n"));
        }
        let target = self.out.as_deref().unwrap_or_else(|| first.path());
        for file in ResultFolder::write_figures(target, &drawn.figures).map_err(failed)? {
            terminal::print(&format!("{}\n", file.display()));
        }
        Ok(Exit::Done)
    }
}

/// The shortest distinct endings of the folders' names.
fn names(folders: &[PathBuf]) -> Vec<String> {
    let last = |folder: &Path, count: usize| -> String {
        let parts: Vec<String> =
            folder.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
        parts[parts.len().saturating_sub(count)..].join("/")
    };
    let most = folders.iter().map(|folder| folder.components().count()).max().unwrap_or(1);
    for count in 1..=most {
        let names: Vec<String> = folders.iter().map(|folder| last(folder, count)).collect();
        if (1..names.len()).all(|k| !names[..k].contains(&names[k])) {
            return names;
        }
    }
    // The same folder twice: numbers distinguish the curves.
    folders.iter().enumerate().map(|(k, folder)| format!("{} ({})", last(folder, 1), k + 1)).collect()
}

#[cfg(test)]
#[path = "../../tests/unit/commands/plot.rs"]
mod tests;
