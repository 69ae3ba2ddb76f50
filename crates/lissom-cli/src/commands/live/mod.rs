//! `lissom live`: a local page that shows a model and simulates it again whenever its file is saved.

mod address_word;
mod http;
mod parameter_order;
mod server;
mod simulation;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use lissom::{CommandError, Model, Override};

use super::outcome::{Exit, Failure, warn};
use super::terminal::{self, Interrupt};
use super::view::open;
use simulation::Shared;

/// Interval of checks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(100);

/// Show a model in the browser and simulate it again whenever its file is saved.
///
/// The page has a slider for every number in `[parameters]`. While the model has errors the page shows them together with the
/// last picture. The page is accessible only from this machine and at the printed address, which contains a random word. No
/// file is written, except that the word of a port is kept in the user's runtime folder, so that open pages find a restarted
/// program.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom live examples/tip-crank.toml --open
  lissom live press.toml --port 8123 --set analysis.end=1

Ctrl-C ends it.")]
pub(super) struct Live {
    /// The model file.
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// Port of the page; 0 for any free one [default: one that follows from the path of the model, or any if that is not free].
    #[arg(long, value_name = "N")]
    port: Option<u16>,

    /// Open it in the browser.
    #[arg(long)]
    open: bool,
}

impl Live {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        // A missing file is an error of the command; an invalid model may be corrected while the page is open.
        Model::read(&self.model).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        let shared = Arc::new(Shared::default());
        let address = server::start(self.port, &self.model, &shared).map_err(|error| {
            let error = CommandError::Port { port: self.port.unwrap_or(0).into(), reason: error.to_string() };
            Failure::new(Exit::Failed, &error)
        })?;
        simulation::start(self.model, self.set, &shared);
        terminal::print(&format!("{address}\n"));
        if self.open && !open(&address) {
            warn(&CommandError::Browser(address.clone()));
        }
        while !interrupt.is_noted() {
            std::thread::sleep(PATIENCE);
        }
        Ok(Exit::Done)
    }
}
