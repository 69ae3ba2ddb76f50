//! `lissom view`: one HTML file that shows results as an animation with plots.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use clap::Args;
use lissom::model::files;
use lissom::pictures::view::Results;
use lissom::{CommandError, FileError, Override, ResultFolder};

use super::initial_scene::{InitialScene, refuse_what_does_not_move};
use super::outcome::{Exit, Failure};
use super::results::warn_of_incomplete;
use super::run::Run;
use super::terminal;

/// Show results as an animation with plots, in one HTML file for any browser.
///
/// For a folder of results the file shows its run, or its natural modes if `lissom modes` has written the folder. A model is
/// simulated first, as by `lissom run`. The file is self-contained.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom view out/four-bar                     writes out/four-bar/view.html
  lissom view examples/four-bar.toml --open    simulates, writes, opens the browser
  lissom view examples/four-bar.toml --initial --html four-bar.html
                                               the initial state, without simulation

Exit code: 0 success; 2 wrong model or command line; 3 no solution: the file then shows the motion up to the failure.")]
pub(super) struct View {
    /// A folder of results, or a model file.
    #[arg(value_name = "RESULT|MODEL.toml")]
    what: PathBuf,

    /// Destination [default: view.html in the folder of results; initial.html with --initial].
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,

    /// Open it in the browser.
    #[arg(long)]
    open: bool,

    /// Show the initial state of the model, without simulating it.
    #[arg(long)]
    initial: bool,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// Folder for the results of a model [default: out/<name of the model file>].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print neither progress nor a summary.
    #[arg(long, short)]
    quiet: bool,
}

impl View {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        if let Some(target) = &self.html {
            // Before any simulation.
            files::protect(&self.what);
            files::check_target(target).map_err(|error| unwritable(&error))?;
        }
        if self.what.is_dir() {
            return self.view_folder();
        }
        let stem = self.what.file_stem().unwrap_or_default();
        let folder = self.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
        if self.initial {
            return self.view_start(&folder);
        }
        refuse_what_does_not_move(&self.what, &self.set)?;
        let run = Run::of_model(&self.what, &self.set, &folder, self.quiet).run();
        // A failed run has results up to the failure; one that could not start has none to be shown.
        match run {
            Ok(exit) => self.show(&folder).map(|()| exit),
            Err(failure) if failure.exit == Exit::Failed && folder.join("motion.bin").is_file() => {
                self.show(&folder)?;
                Err(failure)
            }
            Err(failure) => Err(failure),
        }
    }

    fn view_folder(&self) -> Result<Exit, Failure> {
        if self.initial || !self.set.is_empty() || self.out.is_some() {
            let message = format!("`{}` is a folder of results", self.what.display());
            return Err(Failure::request(format!("{message}; --initial, --set and --out need a model")));
        }
        self.show(&self.what)?;
        warn_of_incomplete(&self.what);
        Ok(Exit::Done)
    }

    /// Writes the page of a folder of results.
    fn show(&self, folder: &Path) -> Result<(), Failure> {
        let results = ResultFolder::results(folder).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        lissom::protect_results(folder);
        let target = self.html.clone().unwrap_or_else(|| folder.join("view.html"));
        self.write(&target, &results)
    }

    /// Writes the page of a model at its start.
    fn view_start(&self, folder: &Path) -> Result<Exit, Failure> {
        let InitialScene { name, title, scene, motion, warnings } =
            InitialScene::of(&self.what, &self.set, self.quiet)?;
        let results = Results::new(&name)
            .with_title(&title)
            .with_notices(warnings)
            .with_scene(&scene, &motion)
            .map_err(|error| Failure::new(Exit::Failed, &error))?;
        let target = if let Some(file) = &self.html {
            file.clone()
        } else {
            files::create_folder(folder).map_err(|error| unwritable(&error))?;
            folder.join("initial.html")
        };
        self.write(&target, &results)?;
        Ok(Exit::Done)
    }

    fn write(&self, target: &Path, results: &Results) -> Result<(), Failure> {
        files::write(target, results.page().as_bytes()).map_err(|error| unwritable(&error))?;
        if !self.quiet {
            terminal::print(&format!("{}\n", target.display()));
        }
        if self.open && !open(target) {
            let error = CommandError::Browser(target.display().to_string());
            return Err(Failure::new(Exit::Failed, &error));
        }
        Ok(())
    }
}

fn unwritable(error: &FileError) -> Failure {
    Failure::new(Exit::Failed, error)
}

/// Time within which a launcher reports that it has found no program [s]. Some run as long as the browser that they start.
const LAUNCH: Duration = Duration::from_secs(3);

/// Opens a file or address with the default program of the desktop. Returns false if that program cannot be started, or ends
/// at once with an error.
pub(super) fn open(what: impl AsRef<std::ffi::OsStr>) -> bool {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(target_os = "windows") {
        "explorer"
    } else {
        "xdg-open"
    };
    let mut command = Command::new(program);
    command.arg(what).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut launcher) = command.spawn() else {
        return false;
    };
    // The Explorer ends with exit code 1 after success, too.
    if cfg!(target_os = "windows") {
        return true;
    }
    let began = Instant::now();
    while began.elapsed() < LAUNCH {
        match launcher.try_wait() {
            Ok(None) => std::thread::sleep(Duration::from_millis(20)),
            Ok(Some(status)) => return status.success(),
            Err(_) => return false,
        }
    }
    true
}
