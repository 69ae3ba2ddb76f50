//! Sweeps: one model solved many times with different values, by all processors; scalars of every history are
//! collected in one table. Members are independent, so that results do not depend on the number of workers.
//!
//! ```
//! use std::num::NonZero;
//! use std::ops::ControlFlow;
//! use lissom::Model;
//! use lissom::sweep::{Sweep, SweepFile};
//!
//! let model = Model::from_text("stone.toml", r#"
//!     lissom = 1
//!     point_masses.stone = { mass = 2, velocity = [3, 0, 0] }
//!     outputs.stone = { kind = "position", of = "stone" }
//!     analysis = { kind = "dynamics", end = 1.0, step = 0.1 }
//! "#);
//! let file = SweepFile::parse(r#"
//!     lissom_sweep = 1
//!     vary."analysis.end" = [1, 2, 3]
//!     collect.distance = "final(stone.x)"
//! "#, "ends.toml")?;
//! let sweep = Sweep::new(&model, file)?;
//! let mut outcomes = Vec::new();
//! let all: Vec<usize> = (0..sweep.len()).collect();
//! let mut keep = |outcome| { outcomes.push(outcome); Ok::<(), std::io::Error>(()) };
//! sweep.run(&all, NonZero::<usize>::MIN, &mut keep, &mut |_| ControlFlow::Continue(()))?;
//! assert!(outcomes.iter().zip([3.0, 6.0, 9.0]).all(|(outcome, x)| (outcome.values[0] - x).abs() < 1e-12));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod collector;
mod folder;
mod member;
mod table;

use lissom_core::diagnostics::Diagnose;
use lissom_core::interrupt;
use std::any::Any;
use std::cell::RefCell;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use crate::start::lower_with_units;
use lissom_model::document::AnalysisKind;
use lissom_model::lower::registry::registry;
use lissom_model::output::Column;
use lissom_model::registry::Registry;
use lissom_model::{ModelText, Report};
use serde_json::json;

use crate::model_text::{Model, Override};
use crate::session::{Progress, columns};

pub use collector::History;
pub use folder::{SweepFolder, SweepFolderError, history_name};
pub use lissom_model::sweep::{Collected, STATISTICS, SweepFile, SweepValue, Varied, sampling};
pub use member::{MemberOutcome, MemberState};
pub use table::{headings, plot, rows, write_parquet, write_table};

/// Interval of calls of the watch while no member ends.
const PATIENCE: Duration = Duration::from_millis(50);

/// Members that end within this time are passed on together: waking the other thread for each takes as long as a tenth of a
/// small member.
const TOGETHER: Duration = Duration::from_millis(10);

/// Why a sweep cannot start.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum SweepError {
    /// The model is invalid, or becomes invalid by the values of the sweep.
    #[error(transparent)]
    Model(#[from] Report),
    /// The analysis has no time history.
    NotInTime(&'static str),
    /// The model has no such column.
    Column {
        /// Name of the collected item.
        name: String,
        /// The given column.
        column: String,
        /// The existing columns, in words.
        known: String,
    },
    /// The cycles of a column are not counted.
    NoExponent {
        /// Name of the collected item.
        name: String,
        /// The column.
        column: String,
    },
    /// The window of a collected item cannot be used.
    Window {
        /// Name of the collected item.
        name: String,
        /// File and line.
        at: String,
        /// What is wrong.
        problem: String,
        /// What to write instead.
        remedy: String,
    },
    /// The model has no such event.
    Event {
        /// Name of the collected item.
        name: String,
        /// The given event.
        event: String,
        /// The existing events, in words.
        known: String,
    },
}

/// A model and its varied values, ready to be solved member by member, in any order and from any thread.
pub struct Sweep {
    name: String,
    text: ModelText,
    registry: Registry,
    file: SweepFile,
    overrides: Vec<Override>,
    /// Units of the collected items.
    units: Vec<String>,
    warnings: Report,
}

impl Sweep {
    /// A sweep over `model` as defined by `file`. The overrides of the model are applied after those of the file. Its text is read
    /// once.
    ///
    /// # Errors
    /// If no member has a valid model (the error is that of the first one), or if the model does not record a
    /// collected column. Single invalid members are reported in their outcomes.
    pub fn new(model: &Model, file: SweepFile) -> Result<Self, SweepError> {
        let text = model.over(&file.set).model_text()?;
        let registry = registry();
        let mut first = None;
        for member in 0..file.len() {
            let document = text.document(&registry, &file.overrides(member));
            let lowered = document.and_then(|document| Ok((lower_with_units(&document)?, document)));
            let (lowered, document) = match lowered {
                Ok(found) => found,
                Err(report) => {
                    first.get_or_insert(report);
                    continue;
                }
            };
            if !matches!(document.analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. })
            {
                return Err(SweepError::NotInTime(document.analysis.kind.name()));
            }
            let columns = columns(&lowered.channels);
            let events = lowered.system.signals().events();
            let events: Vec<&str> = events.iter().map(|event| event.name.as_str()).collect();
            collector::check(&file, &columns, &events)?;
            collector::windows(&file, &document).map_err(|(collected, error)| SweepError::Window {
                name: collected.name.clone(),
                at: collected.position.clone(),
                problem: error.message,
                remedy: error.remedy,
            })?;
            let unit = |collected: &Collected| {
                let column = Column::named(&columns, &collected.column);
                collected.kind().unit(column.map_or("", |index| &columns[index].unit)).to_owned()
            };
            let units = file.collect.iter().map(unit).collect();
            let (name, overrides) = (model.name().to_owned(), model.overrides().to_vec());
            return Ok(Self { name, text, registry, file, overrides, units, warnings: document.warnings });
        }
        let nothing = || Report::new(Vec::new(), &lissom_model::Sources::default());
        Err(first.unwrap_or_else(nothing).into())
    }

    /// Number of members.
    pub fn len(&self) -> usize {
        self.file.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.file.is_empty()
    }

    /// The varied and collected values.
    pub fn file(&self) -> &SweepFile {
        &self.file
    }

    /// Path or name of the model.
    pub fn model_name(&self) -> &str {
        &self.name
    }

    /// Overrides of every member, in addition to those of the sweep file.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// Warnings about the model of the first valid member.
    pub fn warnings(&self) -> &Report {
        &self.warnings
    }

    /// All inputs of the results, as one line of JSON: version of the program, model, varied and collected values.
    /// Sweeps with the same line have the same members and the same table.
    pub fn definition(&self) -> String {
        // Members may include different files than the first one.
        for member in 0..self.len() {
            let overrides = self.file.overrides(member);
            if overrides.iter().any(|(path, _)| path.starts_with("parts.")) {
                let _ = self.text.document(&self.registry, &overrides);
            }
        }
        let definition = json!({
            "lissom_sweep": lissom_model::sweep::VERSION,
            "version": crate::VERSION,
            "model": self.text.to_toml(),
            "inside_parts": self.text.overrides_inside_parts(),
            "included": self.text.library().texts(),
            "sweep": self.file,
            "members": self.len(),
        });
        definition.to_string()
    }

    /// Solves one member. `watch` decides after every step whether to continue; a member has no result if `watch`
    /// stops it.
    ///
    /// # Panics
    /// If there is no such member.
    pub fn run_member(
        &self,
        member: usize,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Option<MemberOutcome> {
        let overrides = self.file.overrides(member);
        match self.text.document(&self.registry, &overrides) {
            Ok(document) => member::run(member, &document, &self.file, watch),
            Err(report) => Some(MemberOutcome::wrong_model(member, &report)),
        }
    }

    /// Solves `members` on `workers` threads. `keep` receives each outcome on the calling thread, in the order in which
    /// members end; `watch` receives there the number of completed ones, after each and every 50 ms, and decides
    /// whether to continue.
    ///
    /// # Errors
    /// The first error of `keep`: then no further member is started.
    pub fn run<E>(
        &self,
        members: &[usize],
        workers: NonZero<usize>,
        keep: &mut dyn FnMut(MemberOutcome) -> Result<(), E>,
        watch: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, E> {
        let next = AtomicUsize::new(0);
        let stopped = Arc::new(AtomicBool::new(false));
        let (sender, receiver) = mpsc::channel();
        let work = |sender: mpsc::Sender<Vec<MemberOutcome>>| {
            let ended = RefCell::new(Ended { sender, outcomes: Vec::new(), since: Instant::now() });
            let mut go_on = |_: &Progress| {
                ended.borrow_mut().hand_over_if_due();
                let is_stopped = stopped.load(Ordering::Relaxed);
                if is_stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            while !stopped.load(Ordering::Relaxed) {
                let Some(&member) = members.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
                // A defect of the program in one member must not affect the others.
                let solve =
                    || interrupt::within(Arc::clone(&stopped), || self.run_member(member, &mut go_on));
                let caught = catch_unwind(AssertUnwindSafe(solve));
                let outcome = caught
                    .unwrap_or_else(|panic| Some(MemberOutcome::defect(member, &words_of(panic.as_ref()))));
                let Some(outcome) = outcome else { return };
                // A start that was cancelled has not failed.
                if outcome.state == MemberState::Failed && stopped.load(Ordering::Relaxed) {
                    return;
                }
                ended.borrow_mut().add(outcome);
            }
        };
        thread::scope(|scope| {
            for _ in 0..workers.get().min(members.len()) {
                let sender = sender.clone();
                scope.spawn(|| work(sender));
            }
            drop(sender);
            let (mut done, mut outcome) = (0, Ok(ControlFlow::Continue(())));
            loop {
                let mut flow = ControlFlow::Continue(());
                match receiver.recv_timeout(PATIENCE) {
                    Ok(members) => {
                        for member in members {
                            done += 1;
                            if outcome.is_ok() {
                                outcome = keep(member).map(|()| ControlFlow::Continue(()));
                            }
                            if flow.is_continue() {
                                flow = watch(done);
                            }
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => flow = watch(done),
                    Err(RecvTimeoutError::Disconnected) => {
                        return match outcome {
                            Ok(_) if done < members.len() => Ok(ControlFlow::Break(())),
                            outcome => outcome,
                        };
                    }
                }
                if flow.is_break() || outcome.is_err() {
                    stopped.store(true, Ordering::Relaxed);
                }
            }
        })
    }
}

/// Outcomes of a worker that have not yet been passed on.
struct Ended {
    sender: mpsc::Sender<Vec<MemberOutcome>>,
    outcomes: Vec<MemberOutcome>,
    since: Instant,
}

impl Ended {
    fn add(&mut self, outcome: MemberOutcome) {
        self.outcomes.push(outcome);
        self.hand_over_if_due();
    }

    /// Passes on outcomes that have waited long enough; also called while a long member follows short ones.
    fn hand_over_if_due(&mut self) {
        if !self.outcomes.is_empty() && self.since.elapsed() >= TOGETHER {
            self.hand_over();
        }
    }

    fn hand_over(&mut self) {
        // If the sweep has ended, nobody receives them.
        let _ = self.sender.send(std::mem::take(&mut self.outcomes));
        self.since = Instant::now();
    }
}

impl Drop for Ended {
    fn drop(&mut self) {
        self.hand_over();
    }
}

/// The message of a panic.
fn words_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}
