//! Output to and input from a terminal: texts, a progress bar, Ctrl-C. Failing output does not stop the program. It is an error at
//! the end, unless a pipe was closed.

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use lissom::core::interrupt;
use lissom::core::number::written;
use lissom::{CommandError, Progress};

use super::outcome::{Exit, Failure};

/// Refresh interval of the progress bar.
const REFRESH: Duration = Duration::from_millis(50);

/// Why results could not be written to the standard output.
static CUT: OnceLock<String> = OnceLock::new();

/// Writes results. A failure is an error at the end of the program, see [`cut`].
pub(crate) fn print(text: &str) {
    let mut out = stdout().lock();
    let result = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    // The reader of a pipe, such as `head`, may have enough.
    if let Err(error) = result
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = CUT.set(error.to_string());
    }
}

/// Why results could not be written to the standard output, if they could not.
pub(crate) fn cut() -> Option<CommandError> {
    CUT.get().cloned().map(CommandError::Output)
}

/// Writes error messages.
pub(crate) fn complain(text: &str) {
    let _ = stderr().lock().write_all(text.as_bytes());
}

/// Whether error messages are in colour.
pub(crate) fn in_colour() -> bool {
    stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// A progress bar of steps on the terminal; none in a pipe.
pub(crate) struct Bar {
    shown: ProgressBar,
    began: Instant,
    drawn: Instant,
}

impl Bar {
    /// A bar for `steps` planned steps, or none.
    pub(crate) fn new(steps: usize, shown: bool) -> Self {
        let bar = if shown && stderr().is_terminal() {
            ProgressBar::new(steps as u64)
        } else {
            ProgressBar::hidden()
        };
        let style = ProgressStyle::with_template("{bar:30} {msg}, {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("━╸ "));
        let now = Instant::now();
        Self { shown: bar, began: now, drawn: now }
    }

    /// Shows the progress of a session.
    pub(crate) fn show(&mut self, progress: &Progress) {
        if self.drawn.elapsed() < REFRESH || self.shown.is_hidden() {
            return;
        }
        self.drawn = Instant::now();
        self.shown.set_position(progress.done as u64);
        let speed = progress.done as f64 / self.began.elapsed().as_secs_f64();
        self.shown.set_message(format!(
            "t = {} of {} s, {speed:.0} steps/s",
            written(progress.time, 4),
            written(progress.end, 7)
        ));
    }

    /// Removes it.
    pub(crate) fn clear(&self) {
        self.shown.finish_and_clear();
    }
}

/// Whether Ctrl-C was pressed, or the program received another signal to end (SIGTERM, SIGHUP).
#[derive(Clone, Default)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on the first Ctrl-C is recorded and the second ends the program.
    pub(crate) fn listen() -> Self {
        let interrupt = Self::default();
        let noted = interrupt.clone();
        // If no handler can be set, Ctrl-C ends the program as usual.
        let _ = ctrlc::set_handler(move || {
            if noted.0.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(Exit::Interrupted.code()));
            }
        });
        interrupt
    }

    /// The flag that is set when it is pressed.
    pub(crate) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// Calls `work`, which ends soon once it is pressed, also within a step; what then fails was interrupted.
    pub(crate) fn cancel(&self, work: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
        let interrupted = |failure: Failure| match failure.exit {
            Exit::Failed if self.is_noted() => Failure { exit: Exit::Interrupted, ..failure },
            _ => failure,
        };
        interrupt::within(self.flag(), work).map_err(interrupted)
    }

    /// Whether it was pressed.
    pub(crate) fn is_noted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
