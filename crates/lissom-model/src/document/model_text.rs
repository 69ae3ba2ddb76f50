//! The text of a model, read once, and the documents it becomes under overrides.

use std::path::Path;
use std::sync::Arc;

use crate::Document;
use crate::document::decode::from_tree;
use crate::files::library::Library;
use crate::registry::Registry;
use crate::text::report::Report;
use crate::text::toml_text;
use crate::text::{self, Patch, Tree};

/// A model's text as a tree of values. It is read once and opened many times, with different overrides.
#[derive(Clone, Debug)]
pub struct ModelText(Tree);

impl ModelText {
    /// Reads `text` and lays `overrides` over it, as [`Document::parse_with`] does. `file_name` is for messages, and the
    /// files that the model includes are looked for beside it.
    ///
    /// # Errors
    /// If the text is not TOML, or the path of an override does not exist.
    pub fn read(text: &str, file_name: &str, overrides: &[(String, String)]) -> Result<Self, Report> {
        Self::read_with(text, file_name, overrides, Arc::new(Library::beside(Path::new(file_name))))
    }

    /// Reads `text` with included files from `library`.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with(
        text: &str,
        file_name: &str,
        overrides: &[(String, String)],
        library: Arc<Library>,
    ) -> Result<Self, Report> {
        Self::read_without(text, (file_name, &[]), overrides, library)
    }

    /// Reads `text` without the values and entries that the paths `left_out` lead to.
    ///
    /// # Errors
    /// As [`read`](Self::read); also if there is nothing to leave out at a path.
    pub fn read_without(
        text: &str,
        (file_name, left_out): (&str, &[String]),
        overrides: &[(String, String)],
        library: Arc<Library>,
    ) -> Result<Self, Report> {
        let mut tree = text::read(text, file_name, &[], library);
        tree.leave_out(left_out);
        tree.lay(overrides);
        if tree.problems.is_empty() { Ok(Self(tree)) } else { Err(Report::new(tree.problems, &tree.sources)) }
    }

    /// The checked document, with further `overrides` put in place.
    ///
    /// # Errors
    /// All that is wrong with the model or with an override.
    pub fn document(&self, registry: &Registry, overrides: &[(String, String)]) -> Result<Document, Report> {
        let mut tree = self.0.clone();
        tree.lay(overrides);
        from_tree(tree, registry)
    }

    /// The included files, as far as they have been read.
    pub fn library(&self) -> &Library {
        &self.0.library
    }

    /// Overrides inside parts, each as `path = value`; [`to_toml`](Self::to_toml) cannot express them.
    pub fn overrides_inside_parts(&self) -> Vec<String> {
        let line = |patch: &Patch| {
            let path: Vec<String> = patch.path.iter().map(|(name, _)| toml_text::key(name)).collect();
            format!("{} = {}", path.join("."), toml_text::inline(&patch.value))
        };
        self.0.deferred.iter().map(line).collect()
    }

    /// The model as TOML, overrides in place except those inside of parts, without comments. Files stay included. Every
    /// number is reproduced to the last bit.
    pub fn to_toml(&self) -> String {
        toml_text::file(&self.0.root)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/document/model_text.rs"]
mod tests;
