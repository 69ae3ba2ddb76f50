//! The texts that a model includes, and its data files: read once and shared by all their uses. Independent of their
//! format.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use crate::files;
use crate::files::matrix_market::full_matrix;
use crate::files::npz;
use crate::files::ready_made;
use crate::files::wind_box::WindBox;
use crate::surface::Surface;

/// Why there is no text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Missing {
    /// One sentence.
    pub message: String,
    /// A remedy.
    pub help: Option<String>,
}

/// A text, or why there is none.
type Found = Result<Arc<str>, Missing>;

/// A surface, or why there is none; no surface where no files are looked for, because it is drawn only.
type FoundSurface = Result<Option<Arc<Surface>>, Missing>;

/// Wind, or why there is none.
type FoundWind = Result<Arc<WindBox>, Missing>;

/// Texts by their paths relative to the folder of the model.
#[derive(Debug, Default)]
pub struct Library {
    /// Where they are looked for; none where all are known.
    folder: Option<PathBuf>,
    found: Mutex<BTreeMap<String, Found>>,
    surfaces: Mutex<BTreeMap<String, FoundSurface>>,
    winds: Mutex<BTreeMap<String, FoundWind>>,
    /// Where units are, also if all texts are known.
    unit_folder: Option<PathBuf>,
    /// Paths of units.
    units: Mutex<BTreeSet<String>>,
}

impl Library {
    /// Texts in the folder of the file `model`.
    pub fn beside(model: &Path) -> Self {
        let folder = model.parent().map(Path::to_owned).unwrap_or_default();
        Self { unit_folder: Some(folder.clone()), folder: Some(folder), ..Self::default() }
    }

    /// Texts in the folder of the file `model`, some of which were read before, by their paths.
    pub fn beside_with(model: &Path, texts: impl IntoIterator<Item = (String, String)>) -> Self {
        let Self { folder, unit_folder, .. } = Self::beside(model);
        Self { folder, unit_folder, ..Self::of_texts(texts) }
    }

    /// These texts, with units in the folder of the file `model`.
    #[must_use]
    pub fn with_units_beside(self, model: &Path) -> Self {
        Self { unit_folder: Self::beside(model).unit_folder, ..self }
    }

    /// Texts that were read before, by their paths; no file is looked for.
    pub fn of_texts(texts: impl IntoIterator<Item = (String, String)>) -> Self {
        let found = texts.into_iter().map(|(path, text)| (path, Ok(Arc::from(text)))).collect();
        Self { found: Mutex::new(found), ..Self::default() }
    }

    /// The text at `path`, which `joined` has made.
    ///
    /// # Errors
    /// If there is none.
    pub fn text(&self, path: &str) -> Found {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = found.get(path) {
            return known.clone();
        }
        let text = match &self.folder {
            _ if path.starts_with(ready_made::PREFIX) => {
                ready_made::find(path).map(|part| Arc::from(part.text))
            }
            None => {
                Err(Missing { message: format!("`{path}` was not among the files of the model"), help: None })
            }
            Some(folder) => files::read_input_text(&folder.join(path))
                .map(Arc::from)
                .map_err(|error| Missing { message: error.to_string(), help: error.help }),
        };
        found.insert(path.to_owned(), text.clone());
        text
    }

    /// The first of these arrays that the NPZ archive at `path` has, as a text in the Matrix Market format; none where it has
    /// none of them. Each is kept as the text `path#name`, so that who has all texts needs no archive.
    pub(crate) fn array(&self, path: &str, names: &[&str]) -> Result<Option<Arc<str>>, Missing> {
        let prefix = format!("{path}#");
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if !found.keys().any(|known| known.starts_with(&prefix)) {
            let help = Some("write it by `numpy.savez`, or by `lissom reduce`".to_owned());
            let Some(folder) = &self.folder else {
                let message = format!("`{path}` was not among the files of the model");
                return Err(Missing { message, help: None });
            };
            let missing = |message: String| Missing { message, help: help.clone() };
            let bytes = files::read_input(&folder.join(path))
                .map_err(|error| missing(format!("`{path}` cannot be read: {error}")))?;
            let arrays = npz::arrays(&bytes).map_err(|error| missing(format!("`{path}`: {error}")))?;
            for (name, array) in arrays {
                let text = array.map(|matrix| {
                    let size = [matrix.nrows(), matrix.ncols()];
                    Arc::from(full_matrix(&name, size, |row, column| matrix[(row, column)]))
                });
                found.insert(
                    format!("{prefix}{name}"),
                    text.map_err(|error| missing(format!("`{path}`: {error}"))),
                );
            }
        }
        let known = names.iter().find_map(|name| found.get(&format!("{prefix}{name}")));
        known.cloned().transpose()
    }

    /// The surface in the STL or glTF file at `path`, which `joined` has made.
    pub(crate) fn surface(&self, path: &str) -> FoundSurface {
        let Some(folder) = &self.folder else { return Ok(None) };
        let mut found = self.surfaces.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = found.get(path) {
            return known.clone();
        }
        let help = "export the part as STL or glTF, in metres";
        let beside = |name: &str| {
            files::read_input(&folder.join(joined(path, name))).map_err(|error| error.to_string())
        };
        let surface = files::read_input(&folder.join(path))
            .map_err(|error| format!("`{path}` cannot be read: {error}"))
            .and_then(|bytes| {
                Surface::of_file(&bytes, &beside)
                    .map_err(|error| format!("`{path}` cannot be drawn: {error}"))
            })
            .map(|surface| Some(Arc::new(surface)))
            .map_err(|message| Missing { message, help: Some(help.to_owned()) });
        found.insert(path.to_owned(), surface.clone());
        surface
    }

    /// The wind in the file at `path`, which `joined` has made. Its bytes are kept as the text `path#` in hexadecimal digits, so that
    /// who has all texts needs no file.
    pub(crate) fn wind(&self, path: &str) -> FoundWind {
        let mut winds = self.winds.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = winds.get(path) {
            return known.clone();
        }
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let help = Some("specify a binary full-field file of TurbSim, `.bts`".to_owned());
        let missing = |words: String| Missing { message: format!("`{path}` {words}"), help: help.clone() };
        let name = format!("{path}#");
        let bytes = match (found.get(&name), &self.folder) {
            (Some(Ok(text)), _) => of_digits(text).ok_or_else(|| missing("is damaged".to_owned())),
            (_, Some(folder)) => files::read_input(&folder.join(path))
                .map_err(|error| missing(format!("cannot be read: {error}"))),
            (_, None) => Err(missing("was not among the files of the model".to_owned())),
        };
        let wind = bytes.and_then(|bytes| {
            let text = digits(&bytes);
            let wind = WindBox::of_file(bytes).map_err(|error| missing(format!("has no wind: {error}")))?;
            found.insert(name, Ok(text.into()));
            Ok(Arc::new(wind))
        });
        winds.insert(path.to_owned(), wind.clone());
        wind
    }

    /// Where the unit at `path` is, which `joined` has made.
    pub(crate) fn unit(&self, path: &str) -> Result<PathBuf, Missing> {
        let Some(folder) = &self.unit_folder else {
            let message = format!("`{path}` was not among the files of the model");
            let help = "models with units are run beside their files".to_owned();
            return Err(Missing { message, help: Some(help) });
        };
        self.units.lock().unwrap_or_else(PoisonError::into_inner).insert(path.to_owned());
        Ok(folder.join(path))
    }

    /// All texts that were read so far, by their paths.
    pub fn texts(&self) -> BTreeMap<String, String> {
        let found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let text = |(path, text): (&String, &Found)| Some((path.clone(), text.as_ref().ok()?.to_string()));
        found.iter().filter_map(text).collect()
    }

    /// The files requested so far, whether they exist or not.
    pub fn files(&self) -> Vec<PathBuf> {
        let winds = self.winds.lock().unwrap_or_else(PoisonError::into_inner);
        let found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = self.folder.clone().unwrap_or_default();
        let surfaces = self.surfaces.lock().unwrap_or_else(PoisonError::into_inner);
        // Arrays of an archive are of its file.
        let file = |path: &String| {
            path.split_once(".npz#").map_or_else(|| path.clone(), |(own, _)| format!("{own}.npz"))
        };
        let units = self.units.lock().unwrap_or_else(PoisonError::into_inner);
        let drawn = surfaces.keys().chain(winds.keys()).chain(units.iter());
        let is_file = |path: &&String| !path.starts_with(ready_made::PREFIX) && !path.ends_with('#');
        let mut files: Vec<PathBuf> =
            found.keys().chain(drawn).filter(is_file).map(|path| folder.join(file(path))).collect();
        files.dedup();
        files
    }
}

/// Bytes as hexadecimal digits.
fn digits(bytes: &[u8]) -> String {
    let digit = |half: u8| char::from_digit(u32::from(half), 16).unwrap_or_default();
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

/// Bytes of hexadecimal digits.
fn of_digits(text: &str) -> Option<Vec<u8>> {
    let (pairs, rest) = text.as_bytes().as_chunks::<2>();
    let pair = |pair: &[u8; 2]| u8::from_str_radix(str::from_utf8(pair).ok()?, 16).ok();
    rest.is_empty().then(|| pairs.iter().map(pair).collect())?
}

/// The path that `path`, written in the file `from`, leads to, without detours.
pub(crate) fn joined(from: &str, path: &str) -> String {
    if path.starts_with(ready_made::PREFIX) {
        return path.to_owned();
    }
    let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
    let is_absolute = path.starts_with('/');
    let mut parts: Vec<&str> = if is_absolute { Vec::new() } else { folder.split('/').collect() };
    for part in path.split('/') {
        match part {
            ".." if parts.last().is_some_and(|last| !last.is_empty() && *last != "..") => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.retain(|part| !part.is_empty() && *part != ".");
    format!("{}{}", if is_absolute { "/" } else { "" }, parts.join("/"))
}

#[cfg(test)]
#[path = "../../tests/unit/files/library.rs"]
mod tests;
