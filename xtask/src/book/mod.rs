//! `cargo xtask figures`: makes the tables and figures of the book in docs/ anew, between the markers of its
//! chapters, and checks markers and links. Independent of the studies.

mod check;
mod claims;
mod comparison;
mod conditioning;
mod convergence;
mod efficiency;
mod extended;
mod factorization;
mod fragment;
mod generators;
mod numbers;
mod published;
mod refinement;
mod regions;
mod roundoff;
mod simulation;
mod singular_values;
mod work;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use lissom::analyses::study::StudyError;
use lissom::{FileError, Model};
use lissom_model::output::FigureError;

use crate::FiguresArguments;
use crate::verify::root;
use generators::{GENERATORS, Generator};

/// A book that cannot be made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum BookError {
    /// A model file cannot be read.
    #[error(transparent)]
    Model(#[from] FileError),
    /// A study has no result.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A figure cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A run has no result.
    #[error("{example}: {reason}")]
    Run {
        /// The example.
        example: &'static str,
        /// Why.
        reason: String,
    },
    /// A claim of the source agrees that did not, or does not agree that did.
    #[error("the comparison with the claim `{claim}` has changed: {measured}")]
    Claim {
        /// The claim.
        claim: &'static str,
        /// The measurement.
        measured: String,
    },
    /// There is no such figure.
    #[error("there is no figure `{0}`: they are {1}")]
    Unknown(String, String),
    /// No chapter has room for a figure.
    #[error("no chapter of docs/ has the marker `<!-- figures: {0} -->` and, after it, `<!-- end -->`")]
    NoMarker(&'static str),
    /// A file cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        error: std::io::Error,
    },
}

impl BookError {
    /// An error about a run.
    fn run<E: std::fmt::Display>(example: &'static str) -> impl FnOnce(E) -> Self {
        move |error| Self::Run { example, reason: error.to_string() }
    }

    /// An error about a file.
    fn file(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |error| Self::File { path, error }
    }
}

/// Where generators find models and report their progress.
struct Studio {
    root: PathBuf,
    bar: ProgressBar,
}

impl Studio {
    /// For tests: without a bar.
    #[cfg(test)]
    fn silent() -> Self {
        Self { root: root(), bar: ProgressBar::hidden() }
    }

    /// A model of the folder of examples.
    fn example(&self, name: &str) -> Result<Model, BookError> {
        Ok(Model::read(&self.root.join(format!("examples/{name}.toml")))?)
    }

    /// How far a table is.
    fn show(&self, done: usize, planned: usize) {
        self.bar.set_length(planned as u64);
        self.bar.set_position(done as u64);
    }

    /// For studies.
    fn watch(&self) -> impl Fn(usize, usize) -> ControlFlow<()> + Sync + '_ {
        |done, planned| {
            self.show(done, planned);
            ControlFlow::Continue(())
        }
    }
}

/// Measures the claims of the source and writes them to docs/claims.md.
pub(crate) fn claims() -> Result<bool, BookError> {
    let names = ["claims", "claims-penalty"].map(str::to_owned).to_vec();
    figures(&FiguresArguments { names, long: false, check: false })
}

/// Generates or checks what is requested; whether it succeeded.
pub(crate) fn figures(arguments: &FiguresArguments) -> Result<bool, BookError> {
    let root = root();
    if arguments.check {
        let complaints = check::complaints(&root)?;
        for complaint in &complaints {
            println!("{complaint}");
        }
        println!("{} complaints about docs/", complaints.len());
        return Ok(complaints.is_empty());
    }
    let bar = ProgressBar::new(1);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg} ({elapsed})") {
        bar.set_style(style);
    }
    let studio = Studio { root, bar };
    let docs = studio.root.join("docs");
    for generator in chosen(arguments)? {
        studio.bar.reset();
        studio.bar.set_message(generator.name);
        let fragment = (generator.make)(&studio)?;
        regions::write(&docs, generator.name, &fragment)?;
        studio.bar.suspend(|| println!("{}", generator.name));
    }
    studio.bar.finish_and_clear();
    Ok(true)
}

/// The generators requested by name; otherwise all, the slow ones only for `--long`.
fn chosen(arguments: &FiguresArguments) -> Result<Vec<&'static Generator>, BookError> {
    let of_name = |name: &String| {
        GENERATORS.iter().find(|generator| generator.name == name).ok_or_else(|| {
            let known: Vec<_> = GENERATORS.iter().map(|generator| generator.name).collect();
            BookError::Unknown(name.clone(), known.join(", "))
        })
    };
    if arguments.names.is_empty() {
        Ok(GENERATORS.iter().filter(|generator| arguments.long || !generator.is_long).collect())
    } else {
        arguments.names.iter().map(of_name).collect()
    }
}
