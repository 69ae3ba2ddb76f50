//! Opens all files, for reading and for writing. Independent of their formats.
//! Files of a model (its text, included files, tables, meshes, matrices) are *inputs*: they are recorded, and are never
//! overwritten, by any path or link. Only regular files are read and written. Whole files are replaced atomically: after a
//! failure the file has its earlier contents, or does not exist.

pub(crate) mod data_file;
pub mod library;
pub(crate) mod matrix_file;
pub(crate) mod matrix_market;
mod npz;
pub(crate) mod polar_file;
pub mod ready_made;
pub mod tyre_file;
pub(crate) mod wind_box;

use lissom_mechanics::diagnostics::Diagnose;
use std::collections::BTreeSet;
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::format::suggest;

/// Operation on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Reading a text.
    Read,
    /// Creating or writing a file.
    Write,
    /// Creating a folder.
    CreateFolder,
}

/// A file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
pub struct FileError {
    /// The operation.
    pub action: Action,
    /// The file or folder.
    pub path: PathBuf,
    /// Why not, in words.
    pub reason: String,
    /// A remedy.
    pub help: Option<String>,
    /// The system's error.
    #[source]
    pub source: io::Error,
}

/// How names of unfinished files begin.
const UNFINISHED: &str = ".lissom-";

/// Canonical paths of all inputs that were read.
static INPUTS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Memory that this process can have [bytes], if the system reports it: that of the machine, or the limit of the address space.
pub(crate) fn available_memory() -> Option<f64> {
    let installed = fs::read_to_string("/proc/meminfo").ok().and_then(|report| {
        let line = report.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
        let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
        Some(1024.0 * kilobytes)
    });
    let limit = fs::read_to_string("/proc/self/limits").ok().and_then(|report| {
        let line = report.lines().find_map(|line| line.strip_prefix("Max address space"))?;
        line.split_whitespace().next()?.parse::<f64>().ok()
    });
    installed.into_iter().chain(limit).reduce(f64::min)
}

/// Rejects existing files that are not regular: reading a pipe or a device could block or never end.
fn check_regular(path: &Path) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, IsADirectory};
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(io::Error::new(IsADirectory, "it is a folder")),
        Ok(metadata) if !metadata.is_file() => {
            Err(io::Error::new(InvalidInput, "it is not a regular file, but a pipe, a socket or a device"))
        }
        _ => Ok(()),
    }
}

/// The contents of a file of the model, which nothing will write over.
///
/// # Errors
/// If it is no regular file, or cannot be read.
pub fn read_input(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = read(path)?;
    protect(path);
    Ok(bytes)
}

/// Treats a file as an input, if it is there: nothing will write over it.
pub fn protect(path: &Path) {
    if let Ok(path) = path.canonicalize() {
        INPUTS.lock().unwrap_or_else(PoisonError::into_inner).insert(path);
    }
}

/// The contents of a file.
///
/// # Errors
/// If it is no regular file, or cannot be read.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    check_regular(path)?;
    fs::read(path)
}

/// The text of a file of the model, which nothing will write over.
///
/// # Errors
/// If the file is not there, is no text, or may not be read; with the name of a similar file.
pub fn read_input_text(path: &Path) -> Result<String, FileError> {
    text_of(path, read_input(path))
}

/// The text of a file.
///
/// # Errors
/// If the file is not there, is no text, or may not be read; with the name of a similar file.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    text_of(path, read(path))
}

fn text_of(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<String, FileError> {
    let invalid = |_| io::Error::from(io::ErrorKind::InvalidData);
    bytes.and_then(|bytes| String::from_utf8(bytes).map_err(invalid)).map_err(|source| {
        let (reason, help) = match source.kind() {
            io::ErrorKind::NotFound => ("there is no such file".to_owned(), similar_file(path)),
            io::ErrorKind::InvalidData => {
                let help = "a model file must be text in UTF-8: save it as such in the editor";
                ("it is not a text file".to_owned(), Some(help.to_owned()))
            }
            io::ErrorKind::IsADirectory => {
                ("it is a folder".to_owned(), Some("name a file in it".to_owned()))
            }
            io::ErrorKind::InvalidInput => {
                (source.to_string(), Some("write its contents to a file first".to_owned()))
            }
            _ => (source.to_string(), None),
        };
        FileError { action: Action::Read, path: path.to_owned(), reason, help, source }
    })
}

/// The input that `path` leads to, directly or by links, if it leads to one.
fn input_at(path: &Path) -> Option<PathBuf> {
    let target = path.canonicalize().ok()?;
    let inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    if inputs.contains(&target) {
        return Some(target);
    }
    // Another name of the same file.
    let own = fs::metadata(&target).ok().filter(has_several_names)?;
    let is_same = |input: &&PathBuf| fs::metadata(input).is_ok_and(|other| are_same(&own, &other));
    inputs.iter().find(is_same).cloned()
}

#[cfg(unix)]
fn has_several_names(metadata: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    metadata.is_file() && metadata.nlink() > 1
}

#[cfg(unix)]
fn are_same(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(not(unix))]
fn has_several_names(_: &Metadata) -> bool {
    false
}

#[cfg(not(unix))]
fn are_same(_: &Metadata, _: &Metadata) -> bool {
    false
}

/// Rejects files that must not be written or removed: inputs, and files that are not regular.
///
/// # Errors
/// With the reason.
pub fn check_target(path: &Path) -> Result<(), FileError> {
    let refuse = |source: io::Error, help: &str| FileError {
        action: Action::Write,
        path: path.to_owned(),
        reason: source.to_string(),
        help: Some(help.to_owned()),
        source,
    };
    if let Some(input) = input_at(path) {
        let words = format!("it is the input `{}`, which would be lost", input.display());
        let source = io::Error::new(io::ErrorKind::AlreadyExists, words);
        return Err(refuse(source, "choose another file or folder with `--out`"));
    }
    check_regular(path).map_err(|source| refuse(source, "choose another file or folder"))
}

/// A file in the same folder whose name is nearly that of `path`, or the files of its kind that are there.
fn similar_file(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(entries) = fs::read_dir(folder) else {
        return Some(format!("the folder `{}` does not exist either", folder.display()));
    };
    let names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| Path::new(name).extension() == path.extension())
        .collect();
    let wanted = path.file_name()?.to_str()?;
    suggest::help(wanted, names.iter().map(String::as_str))
}

/// Creates a folder and its parents; an existing one is accepted.
///
/// # Errors
/// If it cannot be created.
pub fn create_folder(path: &Path) -> Result<(), FileError> {
    fs::create_dir_all(path).map_err(|source| failure(Action::CreateFolder, path, source))
}

/// Creates a file for incremental writing; an existing one is replaced by an empty one.
///
/// # Errors
/// If it cannot be created, or is an input.
pub fn create_file(path: &Path) -> Result<BufWriter<File>, FileError> {
    create(path).map(BufWriter::new)
}

/// Creates a file for incremental writing without a buffer.
///
/// # Errors
/// If it cannot be created, or is an input.
pub fn create(path: &Path) -> Result<File, FileError> {
    check_target(path)?;
    File::create(path).map_err(|source| failure(Action::Write, path, source))
}

/// Opens a file to be read and written on, as it is, and creates it if it is not there.
///
/// # Errors
/// If it cannot be opened or created, or is an input.
pub fn open_to_continue(path: &Path) -> Result<File, FileError> {
    check_target(path)?;
    let opened = File::options().create(true).truncate(false).read(true).write(true).open(path);
    opened.map_err(|source| failure(Action::Write, path, source))
}

/// Opens a file that is there to append to it, after it was cut to `length` [bytes].
///
/// # Errors
/// If it cannot be written, is shorter (then with the words `missing`), or is an input.
pub fn open_cut(path: &Path, length: u64, missing: &str) -> Result<File, FileError> {
    check_target(path)?;
    let opened = File::options().append(true).open(path).and_then(|file| {
        if file.metadata()?.len() < length {
            return Err(io::Error::new(io::ErrorKind::UnexpectedEof, missing));
        }
        file.set_len(length)?;
        Ok(file)
    });
    opened.map_err(|source| failure(Action::Write, path, source))
}

/// The length of a file that is written on [bytes], once all of it is on the disk.
///
/// # Errors
/// If it is not there or cannot be written.
pub fn synchronized_length(path: &Path) -> io::Result<u64> {
    let file = File::options().append(true).open(path)?;
    file.sync_data()?;
    Ok(file.metadata()?.len())
}

/// Paths of the entries of a folder; none if it cannot be read.
pub fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

/// Whether `name` is that of a file which was not finished when the program was killed.
pub fn is_unfinished(name: &str) -> bool {
    name.starts_with(UNFINISHED)
}

/// Removes a file, if it is there.
///
/// # Errors
/// If it cannot be removed, or is an input.
pub fn remove(path: &Path) -> Result<(), FileError> {
    // Of a name that no file can have there is none.
    if fs::symlink_metadata(path).is_err() {
        return Ok(());
    }
    check_target(path)?;
    fs::remove_file(path).map_err(|source| failure(Action::Write, path, source))
}

/// Writes a whole file at once: whoever reads it finds the former contents or the new ones, also after a failure.
///
/// # Errors
/// If it cannot be written, or is an input; the former file is then as it was.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    check_target(path)?;
    write_atomically(path, contents, false).map_err(|source| failure(Action::Write, path, source))
}

/// Writes a whole file at once, as [`write`] does, and waits until it is on the disk.
///
/// # Errors
/// As [`write`].
pub fn write_durably(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    check_target(path)?;
    write_atomically(path, contents, true).map_err(|source| failure(Action::Write, path, source))
}

fn write_atomically(path: &Path, contents: &[u8], is_durable: bool) -> io::Result<()> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let unfinished = path.with_file_name(format!("{UNFINISHED}{}-{number}", std::process::id()));
    // Whoever may read the former file may read the new one.
    let permissions = fs::metadata(path).ok().map(|metadata| metadata.permissions());
    let fill = || {
        let mut file = File::options().write(true).create_new(true).open(&unfinished)?;
        file.write_all(contents)?;
        if is_durable {
            file.sync_all()?;
        }
        if let Some(permissions) = permissions {
            file.set_permissions(permissions)?;
        }
        fs::rename(&unfinished, path)
    };
    fill().inspect_err(|_| _ = fs::remove_file(&unfinished))
}

/// An error while writing to a file that could be created.
pub fn failure(action: Action, path: &Path, source: io::Error) -> FileError {
    let help = match source.kind() {
        io::ErrorKind::NotFound => Some("create its folder first".to_owned()),
        io::ErrorKind::PermissionDenied => Some("choose a folder you may write to".to_owned()),
        io::ErrorKind::InvalidFilename => Some("choose a shorter name".to_owned()),
        io::ErrorKind::StorageFull => Some("free some space, or record less: `output_every`".to_owned()),
        _ => None,
    };
    FileError { action, path: path.to_owned(), reason: source.to_string(), help, source }
}

#[cfg(test)]
#[path = "../../tests/unit/files/mod.rs"]
mod tests;
