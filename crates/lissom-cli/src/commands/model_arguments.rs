//! A model file and its overrides on the command line.

use std::path::{Path, PathBuf};

use clap::Args;
use lissom::{Document, Model, Override};

use super::outcome::{Exit, Failure};

/// A model file and its overrides, for every command that reads a model.
#[derive(Args)]
pub(super) struct ModelArguments {
    /// The model file.
    #[arg(value_name = "MODEL.toml")]
    pub(super) model: PathBuf,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = parse_override)]
    pub(super) set: Vec<Override>,

    /// Remove a value or an entry from the model, such as `analysis.step` or `springs.damper`; may be repeated.
    #[arg(long, value_name = "PATH")]
    pub(super) unset: Vec<String>,
}

impl ModelArguments {
    /// The model, with its overrides.
    pub(super) fn text(&self) -> Result<Model, Failure> {
        read(&self.model, &self.set, &self.unset)
    }

    /// The model and the checked document.
    pub(super) fn read(&self) -> Result<(Model, Document), Failure> {
        let model = self.text()?;
        let document = model.document()?;
        Ok((model, document))
    }

    /// The folder for results: the given one, or out/<name of the model file>-`of`.
    pub(super) fn folder(&self, given: Option<PathBuf>, of: &str) -> PathBuf {
        let stem = self.model.file_stem().unwrap_or_default().to_string_lossy();
        given.unwrap_or_else(|| Path::new("out").join(format!("{stem}-{of}")))
    }
}

/// The model in a file, with overrides and without what is removed from it.
pub(super) fn read(path: &Path, set: &[Override], unset: &[String]) -> Result<Model, Failure> {
    let model = Model::read(path).map_err(|error| Failure::new(Exit::BadModel, &error))?;
    let model = unset.iter().fold(model, |model, path| model.without(path));
    Ok(model.with_overrides(set))
}

pub(super) fn parse_override(text: &str) -> Result<Override, String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => {
            Ok((path.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("it must be PATH=VALUE, such as `analysis.step=1e-4`".to_owned()),
    }
}
