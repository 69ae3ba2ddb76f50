//! A model as it was written, and the documents it becomes under overrides. Knows no simulation.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_model::files::{self, FileError};
use lissom_model::lower::registry::registry;
use lissom_model::{Document, Library, ModelText, Report};

use crate::builder::IdNames;
use crate::prepared::Prepared;
use crate::session::{Session, SessionError};

/// A path into the model file and the value to put there, such as `("analysis.step", "1e-4")`.
pub type Override = (String, String);

/// The text of a model file and of the files it includes. Each is read once and may be opened many times, with different
/// overrides.
#[derive(Clone, Debug)]
pub struct Model {
    name: String,
    text: String,
    library: Arc<Library>,
    /// Paths to what is omitted from the text.
    left_out: Vec<String>,
    /// What ids mean, where it was built in code.
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

    /// A model from a text; `name` is what complaints call it, and files that it includes are looked for beside a file of
    /// this name.
    pub fn from_text(name: &str, text: &str) -> Self {
        let library = Arc::new(Library::beside(Path::new(name)));
        Self { name: name.to_owned(), text: text.to_owned(), library, left_out: Vec::new(), ids: None }
    }

    /// The same without the values and entries that these paths lead to, such as `analysis.step` or `springs.damper`.
    /// They are omitted before anything is overridden.
    #[must_use]
    pub fn without(self, paths: Vec<String>) -> Self {
        Self { left_out: paths, ..self }
    }

    /// Paths to what is omitted from the text.
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// The same with what ids mean that a builder has given out.
    pub(crate) fn with_ids(self, ids: IdNames) -> Self {
        Self { ids: Some(Arc::new(ids)), ..self }
    }

    /// The same with included files of which the texts are known, by their paths; no other file is read.
    #[must_use]
    pub fn with_included(self, texts: BTreeMap<String, String>) -> Self {
        Self { library: Arc::new(Library::of_texts(texts)), ..self }
    }

    /// The same with texts of files that it may include, by their paths, as [`included`](Self::included) gives them on another
    /// machine; others are looked for where they were before.
    #[must_use]
    pub fn with_known(self, texts: BTreeMap<String, String>) -> Self {
        let library = Arc::new(Library::beside_with(Path::new(&self.name), texts));
        Self { library, ..self }
    }

    /// The texts of the files it includes, by their paths, as far as documents were made of it.
    pub fn included(&self) -> BTreeMap<String, String> {
        self.library.texts()
    }

    /// The files it includes, or would, as far as documents were made of it.
    pub fn included_files(&self) -> Vec<PathBuf> {
        self.library.files()
    }

    /// The text as a tree of values, with `overrides` put in place.
    ///
    /// # Errors
    /// If the text is not TOML, or an override leads nowhere.
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

    /// The checked document, with `overrides` put in place.
    ///
    /// # Errors
    /// All that is wrong with the text or with an override.
    pub fn document(&self, overrides: &[Override]) -> Result<Document, Report> {
        self.model_text(overrides)?.document(&registry(), &[])
    }

    /// A session at its start, with `overrides` put in place.
    ///
    /// # Errors
    /// If the model is wrong, or has no consistent initial values.
    pub fn session(&self, overrides: &[Override]) -> Result<Session, SessionError> {
        Ok(self.prepare(overrides)?.session()?)
    }

    /// The model with `overrides` put in place, ready for many sessions that share it.
    ///
    /// # Errors
    /// If the model is wrong, or nothing in it is computed over time.
    pub fn prepare(&self, overrides: &[Override]) -> Result<Prepared, SessionError> {
        Prepared::new(&self.document(overrides)?, self.ids.clone())
    }
}
