//! A model as it was written, and the documents it becomes under overrides. Knows no simulation.

use std::path::Path;

use lissom_model::files::{self, FileError};
use lissom_model::lower::registry::registry;
use lissom_model::{Document, Report};

use crate::session::{Session, SessionError};

/// A path into the model file and the value to put there, as `("analysis.step", "1e-4")`.
pub type Override = (String, String);

/// The text of a model file. It is read once and may be opened many times, with different overrides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Model {
    name: String,
    text: String,
}

impl Model {
    /// A model from a file.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Ok(Self { name: path.display().to_string(), text: files::read_text(path)? })
    }

    /// A model from a text; `name` is what complaints call it.
    pub fn from_text(name: &str, text: &str) -> Self {
        Self { name: name.to_owned(), text: text.to_owned() }
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
        Document::parse_with(&self.text, &self.name, &registry(), overrides)
    }

    /// A session at its start, with `overrides` put in place.
    ///
    /// # Errors
    /// If the model is wrong, or has no consistent initial values.
    pub fn session(&self, overrides: &[Override]) -> Result<Session, SessionError> {
        Session::new(&self.document(overrides)?)
    }
}
