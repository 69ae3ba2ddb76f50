//! A model as text, and its documents with overrides. Independent of simulations.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_model::files::{self, FileError};
use lissom_model::lower::registry::registry;
use lissom_model::{Document, Library, ModelText, Report};

use crate::ids::IdNames;
use crate::session::{Prepared, Session, SessionError};

/// A path into the model file and its new value, such as `("analysis.step", "1e-4")`.
pub type Override = (String, String);

/// The text of a model file and of the files it includes. Each is read once and may be decoded many times, with
/// different overrides.
#[derive(Clone, Debug)]
pub struct Model {
    name: String,
    text: String,
    library: Arc<Library>,
    /// Paths that are omitted from the text.
    left_out: Vec<String>,
    /// Names of ids, if it was built in code.
    ids: Option<Arc<IdNames>>,
}

impl Model {
    /// A model from a file.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Ok(Self {
            name: path.display().to_string(),
            text: files::read_input_text(path)?,
            library: Arc::new(Library::beside(path)),
            left_out: Vec::new(),
            ids: None,
        })
    }

    /// A model from a text; `name` is used in messages, and included files are searched for relative to a file of this
    /// name.
    pub fn from_text(name: &str, text: &str) -> Self {
        let library = Arc::new(Library::beside(Path::new(name)));
        Self { name: name.to_owned(), text: text.to_owned(), library, left_out: Vec::new(), ids: None }
    }

    /// The same without the values and entries at these paths, such as `analysis.step` or `springs.damper`. They are
    /// omitted before overrides are applied.
    #[must_use]
    pub fn without(self, paths: Vec<String>) -> Self {
        Self { left_out: paths, ..self }
    }

    /// Paths that are omitted from the text.
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// The same with the names of ids of a builder.
    pub(crate) fn with_ids(self, ids: IdNames) -> Self {
        Self { ids: Some(Arc::new(ids)), ..self }
    }

    /// The same with known texts of included files, by path; no other file is read.
    #[must_use]
    pub fn with_included(self, texts: BTreeMap<String, String>) -> Self {
        Self { library: Arc::new(Library::of_texts(texts)), ..self }
    }

    /// The same with texts of files that it may include, by path, as returned by [`included`](Self::included) on another
    /// machine; others are searched for as before.
    #[must_use]
    pub fn with_known(self, texts: BTreeMap<String, String>) -> Self {
        let library = Arc::new(Library::beside_with(Path::new(&self.name), texts));
        Self { library, ..self }
    }

    /// The texts of the files it includes, by path, as far as documents were built.
    pub fn included(&self) -> BTreeMap<String, String> {
        self.library.texts()
    }

    /// The files it includes, or would include, as far as documents were built.
    pub fn included_files(&self) -> Vec<PathBuf> {
        self.library.files()
    }

    /// The text as a tree of values, with `overrides`.
    ///
    /// # Errors
    /// If the text is not TOML, or the path of an override does not exist.
    pub fn model_text(&self, overrides: &[Override]) -> Result<ModelText, Report> {
        let named = (self.name.as_str(), self.left_out.as_slice());
        ModelText::read_without(&self.text, named, overrides, Arc::clone(&self.library))
    }

    /// Path or name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The checked document, with `overrides`.
    ///
    /// # Errors
    /// All errors of the text or of an override.
    pub fn document(&self, overrides: &[Override]) -> Result<Document, Report> {
        self.model_text(overrides)?.document(&registry(), &[])
    }

    /// A session at its start, with `overrides`.
    ///
    /// # Errors
    /// If the model is invalid, or has no consistent initial values.
    pub fn session(&self, overrides: &[Override]) -> Result<Session, SessionError> {
        Ok(self.prepare(overrides)?.session()?)
    }

    /// The model with `overrides`, prepared for many sessions that share it.
    ///
    /// # Errors
    /// If the model is invalid, or its analysis has no time history.
    pub fn prepare(&self, overrides: &[Override]) -> Result<Prepared, SessionError> {
        Prepared::new(&self.document(overrides)?, self.ids.clone())
    }
}
