//! `lissom fmu`: a model as a functional mock-up unit.

use std::path::PathBuf;

use clap::Args;
use lissom::exchange::fmu::{FmuError, LIBRARY, export, platform};
use lissom::model::files;

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings};
use super::terminal;

/// Export a model as a functional mock-up unit (FMI 3.0, co-simulation), for Simulink, Modelica tools and others.
///
/// The inputs of the model are inputs of the unit, the numbers in [parameters] are parameters, and all recorded columns are
/// outputs. The unit contains the model, the files it includes and a shared library; it has no other dependencies.
#[derive(Args)]
#[command(after_help = "\
Example:
  lissom fmu examples/controlled-arm.toml --out controlled-arm.fmu

The shared library is expected in the folder of the program, in ../lib beside it, or at the path given by --library. To build it from source:
  cargo build --release --manifest-path crates/lissom-fmi/Cargo.toml
Exit code: 0 success; 2 wrong model or command line, or no shared library; 3 the file cannot be written.")]
pub(super) struct Fmu {
    #[command(flatten)]
    model: ModelArguments,

    /// File of the unit [default: <name of the model file>.fmu].
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,

    /// The shared library that simulates the model [default: the one in the folder of the program].
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Fmu {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let library = self.library()?;
        let bytes = lissom::model::files::read_input(&library).map_err(|error| {
            Failure::new(Exit::BadModel, &files::failure(files::Action::Read, &library, error))
        })?;
        let unit = export(&model, &bytes).map_err(|error| match error {
            FmuError::Model(report) => report.into(),
            FmuError::Archive(_) => Failure::new(Exit::Failed, &error),
            other => Failure::new(Exit::BadModel, &other),
        })?;
        let stem = self.model.model.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let target = self.out.unwrap_or_else(|| PathBuf::from(format!("{stem}.fmu")));
        files::write(&target, &unit).map_err(|error| Failure::new(Exit::Failed, &error))?;
        if !self.quiet {
            terminal::print(&format!("{} for {}\n", target.display(), platform()));
        }
        Ok(Exit::Done)
    }

    /// The shared library: the given one, that beside the program, or that of a cargo build.
    fn library(&self) -> Result<PathBuf, Failure> {
        if let Some(library) = &self.library {
            return Ok(library.clone());
        }
        let name = format!("{}{LIBRARY}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        let program = std::env::current_exe().unwrap_or_default();
        let folder = program.parent().map(ToOwned::to_owned).unwrap_or_default();
        let places =
            [folder.join(&name), folder.join("../lib").join(&name), folder.join("../lib/lissom").join(&name)];
        places.into_iter().find(|place| place.is_file()).ok_or_else(|| {
            let message = format!(
                "the shared library `{name}` is neither in the folder of the program, `{}`, nor in `../lib` beside it; build it with \
                 `cargo build --release --manifest-path crates/lissom-fmi/Cargo.toml` in a copy of the sources, and copy it there \
                 or name it by `--library`",
                folder.display()
            );
            Failure::request(message)
        })
    }
}
