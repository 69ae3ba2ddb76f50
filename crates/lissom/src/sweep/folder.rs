//! The folder of a sweep: `members.jsonl`, to which every completed member adds a line, and after all of them `sweep.csv`, the
//! same as `sweep.parquet`, and `sweep.json`; requested histories in `histories/`, a file per member. Results from before a crash
//! are read from it again. The only module of sweeps that opens files for output.

use lissom_core::diagnostics::Diagnose;
use std::fs::{File, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use lissom_model::files::{self, Action, FileError, failure};
use lissom_model::output::{Summary, SweepPlot};

use super::table::{write_parquet, write_table};
use super::{MemberOutcome, Sweep};
use crate::results::folder::{FolderError, ResultFolder};

/// Name of the record of members.
const MEMBERS: &str = "members.jsonl";
/// Name of the table.
const TABLE: &str = "sweep.csv";
/// Name of the same table for programs.
const PARQUET: &str = "sweep.parquet";
/// Name of the folder of histories.
const HISTORIES: &str = "histories";
/// Name of the summary.
const SUMMARY: &str = "sweep.json";

/// Why a folder cannot be used for a sweep.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum SweepFolderError {
    /// A file or folder cannot be read or written.
    File(#[from] FileError),
    /// It contains members of another sweep.
    OtherSweep(String),
    /// Another process writes to it.
    Busy(String),
    /// A line of the record is invalid.
    Damaged {
        /// The file.
        path: String,
        /// The line.
        line: usize,
    },
}

/// A folder opened for the members of one sweep, and locked for other processes.
pub struct SweepFolder {
    path: PathBuf,
    members: File,
}

impl SweepFolder {
    /// Opens the folder, creates it if necessary, and returns the existing outcomes, in the order of members. With
    /// `restarts` they are discarded. Table and summary are removed, because they would not match new members.
    ///
    /// # Errors
    /// If it cannot be written, belongs to another sweep, or is in use.
    pub fn open(
        path: &Path,
        sweep: &Sweep,
        restarts: bool,
    ) -> Result<(Self, Vec<MemberOutcome>), SweepFolderError> {
        files::create_folder(path)?;
        let file = path.join(MEMBERS);
        let pictures = PICTURES.iter().flat_map(|name| [format!("{name}.svg"), format!("{name}.png")]);
        let results: Vec<PathBuf> = [TABLE, PARQUET, SUMMARY]
            .map(str::to_owned)
            .into_iter()
            .chain(pictures)
            .map(|name| path.join(name))
            .collect();
        // Before anything is written or removed.
        results.iter().chain([&file]).try_for_each(|file| files::check_target(file))?;
        let wrong = |error| failure(Action::Write, &file, error);
        let mut members = files::open_to_continue(&file)?;
        match members.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(SweepFolderError::Busy(path.display().to_string())),
            Err(TryLockError::Error(error)) => return Err(wrong(error).into()),
        }
        let mut text = String::new();
        if !restarts {
            members.read_to_string(&mut text).map_err(|error| failure(Action::Read, &file, error))?;
        }
        // A line without end was being written when the process was killed.
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let definition = sweep.definition();
        let outcomes = match text[..whole].split_once('\n') {
            Some((head, _)) if head != definition => {
                return Err(SweepFolderError::OtherSweep(path.display().to_string()));
            }
            Some((_, lines)) => outcomes(sweep, lines, &file)?,
            None => Vec::new(),
        };
        results.iter().try_for_each(|file| files::remove(file))?;
        if !sweep.file().histories.is_empty() {
            let histories = path.join(HISTORIES);
            files::create_folder(&histories)?;
            if whole == 0 {
                discard_histories(&histories)?;
            }
        }
        let mut begin = || {
            members.set_len(whole as u64)?;
            members.seek(SeekFrom::End(0))?;
            if whole == 0 { members.write_all(format!("{definition}\n").as_bytes()) } else { Ok(()) }
        };
        begin().map_err(wrong)?;
        Ok((Self { path: path.to_owned(), members }, outcomes))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a member, as one line by one call: if the process is killed the line is complete or truncated, never
    /// mixed.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn append(&mut self, outcome: &MemberOutcome) -> Result<(), FileError> {
        // Before its line: a member with a line has its histories.
        if let Some(history) = &outcome.history {
            let file = self.path.join(HISTORIES).join(history_name(outcome.member));
            let bytes =
                history.parquet(outcome.member).map_err(|error| failure(Action::Write, &file, error))?;
            files::write(&file, &bytes)?;
        }
        let mut line = serde_json::to_string(outcome).unwrap_or_default();
        line.push('\n');
        let written = self.members.write_all(line.as_bytes());
        written.map_err(|error| failure(Action::Write, &self.path.join(MEMBERS), error))
    }

    /// Writes table and summary, after all members have ended. The table appears as a whole.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn finish(
        &self,
        sweep: &Sweep,
        outcomes: &[MemberOutcome],
        summary: &Summary,
    ) -> Result<PathBuf, FileError> {
        let table = self.path.join(TABLE);
        files::write(&table, write_table(sweep, outcomes).as_bytes())?;
        let file = self.path.join(PARQUET);
        let bytes = write_parquet(sweep, outcomes).map_err(|error| failure(Action::Write, &file, error))?;
        files::write(&file, &bytes)?;
        files::write(&self.path.join(SUMMARY), summary.to_json().as_bytes())?;
        Ok(table)
    }
}

/// Names of the pictures, without their extensions.
const PICTURES: [&str; 2] = ["responses", "parallel-coordinates"];

/// Name of the file with the histories of a member.
pub fn history_name(member: usize) -> String {
    format!("member-{member:08}.parquet")
}

/// Removes only histories of another sweep.
fn discard_histories(folder: &Path) -> Result<(), FileError> {
    for path in files::entries(folder) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with("member-") && name.ends_with(".parquet") {
            files::remove(&path)?;
        }
    }
    Ok(())
}

impl SweepFolder {
    /// Draws the table, as SVG and as PNG: collected over varied values, and parallel coordinates.
    ///
    /// # Errors
    /// If a picture cannot be drawn or written.
    pub fn write_plots(&self, plot: &SweepPlot) -> Result<(), FolderError> {
        for picture in [plot.responses()?, plot.parallel_coordinates()?] {
            ResultFolder::write_graphic(&self.path, &picture)?;
        }
        Ok(())
    }
}

/// The outcomes in the lines of a record, in the order of members, each once.
fn outcomes(sweep: &Sweep, lines: &str, path: &Path) -> Result<Vec<MemberOutcome>, SweepFolderError> {
    let mut all = Vec::new();
    for (index, line) in lines.lines().enumerate() {
        let read = serde_json::from_str::<MemberOutcome>(line).ok();
        let fits = |outcome: &MemberOutcome| {
            outcome.member < sweep.len()
                && (outcome.diagnosis.is_some() || outcome.values.len() == sweep.file().collect.len())
        };
        let damaged = || SweepFolderError::Damaged { path: path.display().to_string(), line: index + 2 };
        all.push(read.filter(fits).ok_or_else(damaged)?);
    }
    all.sort_by_key(|outcome| outcome.member);
    all.dedup_by_key(|outcome| outcome.member);
    Ok(all)
}
