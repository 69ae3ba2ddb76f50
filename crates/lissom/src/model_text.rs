//! A model as text with overrides, and its documents. Independent of simulations.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lissom_model::files::{self, FileError};
use lissom_model::lower::registry::registry;
use lissom_model::toml_text::quoted;
use lissom_model::{Document, Library, ModelText, Report};

use crate::ids::IdNames;
use crate::session::{Prepared, Session, SessionError};

/// A path into the model file and its new value as TOML, such as `("analysis.step", "1e-4")`.
pub type Override = (String, String);

/// The new value of an override: a number, a boolean, a text or a list of these.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value(String);

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self(if number.is_nan() { "nan".to_owned() } else { format!("{number:?}") })
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self(flag.to_string())
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self(quoted(text))
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl<T: Into<Value>> From<Vec<T>> for Value {
    fn from(list: Vec<T>) -> Self {
        let entries: Vec<String> = list.into_iter().map(|entry| entry.into().0).collect();
        Self(format!("[{}]", entries.join(", ")))
    }
}

impl<T: Into<Value>, const N: usize> From<[T; N]> for Value {
    fn from(list: [T; N]) -> Self {
        Vec::from(list).into()
    }
}

macro_rules! from_integers {
    ($($integer:ty)*) => {
        $(impl From<$integer> for Value {
            fn from(number: $integer) -> Self {
                Self(number.to_string())
            }
        })*
    };
}

from_integers! { i32 i64 u32 u64 usize }

/// The text of a model file and of the files it includes, with overrides. Texts are read once and shared by copies, which may
/// have different overrides.
#[derive(Clone, Debug)]
pub struct Model {
    name: String,
    text: Arc<str>,
    library: Arc<Library>,
    /// Paths that are omitted from the text.
    left_out: Vec<String>,
    /// Values laid over the text.
    overrides: Vec<Override>,
    /// Names of ids, if it was built in code.
    ids: Option<Arc<IdNames>>,
}

impl Model {
    /// A model from a file.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let text = files::read_input_text(path)?;
        Ok(Self::from_text(&path.display().to_string(), &text))
    }

    /// A model from a text; `name` is used in messages, and included files are searched for relative to a file of this
    /// name.
    pub fn from_text(name: &str, text: &str) -> Self {
        let library = Arc::new(Library::beside(Path::new(name)));
        let (left_out, overrides) = (Vec::new(), Vec::new());
        Self { name: name.to_owned(), text: text.into(), library, left_out, overrides, ids: None }
    }

    /// This model with a new value at a path, such as `analysis.step` or `bodies.top.mass`. A text is a name or an expression
    /// of the model file. Errors are reported when the model is used.
    ///
    /// ```
    /// # let model = lissom::Model::from_text("empty.toml", "lissom = 1");
    /// let fine = model.with("analysis.step", 1e-4).with("analysis.scheme", "hht").with("gravity", [0.0, 0.0, -9.81]);
    /// ```
    pub fn with(&self, path: &str, value: impl Into<Value>) -> Self {
        self.with_overrides(&[(path.to_owned(), value.into().0)])
    }

    /// This model with further overrides, whose values are TOML; a value that is no TOML is a text.
    pub fn with_overrides(&self, overrides: &[Override]) -> Self {
        let mut model = self.clone();
        model.overrides.extend_from_slice(overrides);
        model
    }

    /// This model with further overrides, which are applied before its own.
    pub(crate) fn over(&self, overrides: &[Override]) -> Self {
        Self { overrides: [overrides, &self.overrides].concat(), ..self.clone() }
    }

    /// This model without the value or entry at a path, such as `analysis.step` or `springs.damper`. It is omitted before
    /// overrides are applied.
    pub fn without(&self, path: &str) -> Self {
        let mut model = self.clone();
        model.left_out.push(path.to_owned());
        model
    }

    /// Overrides of the model, in the order in which they are applied.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// Paths that are omitted from the text.
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// This model with the names of ids of a builder.
    pub(crate) fn with_ids(self, ids: IdNames) -> Self {
        Self { ids: Some(Arc::new(ids)), ..self }
    }

    /// This model with known texts of included files, by path; no other file is read, except units of other programs.
    #[must_use]
    pub fn with_included(self, texts: BTreeMap<String, String>) -> Self {
        let library = Library::of_texts(texts).with_units_beside(Path::new(&self.name));
        Self { library: Arc::new(library), ..self }
    }

    /// This model with texts of files that it may include, by path, as returned by [`included`](Self::included) on another
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

    /// The text as a tree of values, with the overrides.
    ///
    /// # Errors
    /// If the text is not TOML, or the path of an override does not exist.
    pub fn model_text(&self) -> Result<ModelText, Report> {
        let named = (self.name.as_str(), self.left_out.as_slice());
        ModelText::read_without(&self.text, named, &self.overrides, Arc::clone(&self.library))
    }

    /// Path or name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text, without the overrides.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The checked document.
    ///
    /// # Errors
    /// All errors of the text or of an override.
    pub fn document(&self) -> Result<Document, Report> {
        self.model_text()?.document(&registry(), &[])
    }

    /// A session at its start.
    ///
    /// # Errors
    /// If the model is invalid, or has no consistent initial values.
    pub fn session(&self) -> Result<Session, SessionError> {
        Ok(self.prepare()?.session()?)
    }

    /// The model prepared for many sessions that share it.
    ///
    /// # Errors
    /// If the model is invalid, or its analysis has no time history.
    pub fn prepare(&self) -> Result<Prepared, SessionError> {
        Prepared::new(&self.document()?, self.ids.clone())
    }
}
