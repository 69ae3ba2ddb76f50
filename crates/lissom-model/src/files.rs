//! The one place where this crate touches the file system. Knows paths and texts, no formats.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::suggest;

/// What was tried with a file.
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
#[error("cannot {} `{}`: {reason}", words(*.action), .path.display())]
pub struct FileError {
    /// What was tried.
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

fn words(action: Action) -> &'static str {
    match action {
        Action::Read => "read",
        Action::Write => "write",
        Action::CreateFolder => "create the folder",
    }
}

/// Memory that programs can have [bytes], where the system tells it.
pub(crate) fn available_memory() -> Option<f64> {
    let told = fs::read_to_string("/proc/meminfo").ok()?;
    let line = told.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The text of a file.
///
/// # Errors
/// If the file is not there, is no text, or may not be read; with the name of a similar file.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    fs::read_to_string(path).map_err(|source| {
        let (reason, help) = match source.kind() {
            io::ErrorKind::NotFound => ("there is no such file".to_owned(), similar_file(path)),
            io::ErrorKind::InvalidData => {
                let help = "a model file is a text in UTF-8; save it as such in your editor";
                ("it is no text".to_owned(), Some(help.to_owned()))
            }
            _ if path.is_dir() => ("it is a folder".to_owned(), Some("name a file in it".to_owned())),
            _ => (source.to_string(), None),
        };
        FileError { action: Action::Read, path: path.to_owned(), reason, help, source }
    })
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

/// Creates a folder and those above it; one that is there already is fine.
///
/// # Errors
/// If it cannot be created.
pub fn create_folder(path: &Path) -> Result<(), FileError> {
    fs::create_dir_all(path).map_err(|source| failure(Action::CreateFolder, path, source))
}

/// Creates a file to be written bit by bit; one that is there already is emptied.
///
/// # Errors
/// If it cannot be created.
pub fn create_file(path: &Path) -> Result<BufWriter<File>, FileError> {
    File::create(path).map(BufWriter::new).map_err(|source| failure(Action::Write, path, source))
}

/// Writes a whole file.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    fs::write(path, contents).map_err(|source| failure(Action::Write, path, source))
}

/// Replaces a whole file at once: whoever reads it finds the former contents or the new ones.
///
/// # Errors
/// If it cannot be written; the former file is then as it was.
pub fn replace(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    let unfinished = path.with_file_name(name);
    fs::write(&unfinished, contents).and_then(|()| fs::rename(&unfinished, path)).map_err(|source| {
        // A part of a file helps nobody.
        let _ = fs::remove_file(&unfinished);
        failure(Action::Write, path, source)
    })
}

/// An error while writing to a file that could be created.
pub fn failure(action: Action, path: &Path, source: io::Error) -> FileError {
    let help = match source.kind() {
        io::ErrorKind::NotFound => Some("create its folder first".to_owned()),
        io::ErrorKind::PermissionDenied => Some("choose a folder you may write to".to_owned()),
        io::ErrorKind::StorageFull => Some("free some space, or record less: `output_every`".to_owned()),
        _ => None,
    };
    FileError { action, path: path.to_owned(), reason: source.to_string(), help, source }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder of its own for each test, gone afterwards.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("lissom-{name}-{}", std::process::id()));
            create_folder(&path).unwrap();
            Self(path)
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_similar_file_is_named() {
        let folder = Folder::new("similar");
        write(&folder.0.join("pendulum.toml"), b"lissom = 1\n").unwrap();
        let error = read_text(&folder.0.join("pendulun.toml")).unwrap_err();
        assert!(error.to_string().contains("there is no such file"), "{error}");
        assert_eq!(error.help.as_deref(), Some("did you mean `pendulum.toml`?"));
        assert_eq!(read_text(&folder.0.join("pendulum.toml")).unwrap(), "lissom = 1\n");
        let error = read_text(&folder.0.join("none/a.toml")).unwrap_err();
        assert!(error.help.unwrap().contains("does not exist either"));
    }

    #[test]
    fn what_is_no_text_is_refused() {
        let folder = Folder::new("binary");
        let path = folder.0.join("a.toml");
        write(&path, &[0xff, 0xfe, 0x00]).unwrap();
        assert!(read_text(&path).unwrap_err().to_string().contains("it is no text"));
        assert!(read_text(&folder.0).is_err());
        assert!(write(&folder.0.join("none/b.csv"), b"").unwrap_err().help.unwrap().contains("folder"));
        assert!(create_file(&folder.0.join("none/b.csv")).is_err());
    }
}
