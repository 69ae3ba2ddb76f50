//! Looks after Python while the interpreter lock is released: Ctrl-C, and a function that is told how far things are.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// How often Python is asked.
const EVERY: Duration = Duration::from_millis(50);

/// What is asked now and then.
pub(crate) struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    asked: Instant,
    raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    /// `progress` is called with two numbers: how much is done, and of how much.
    pub(crate) fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        Self { progress, asked: Instant::now(), raised: None }
    }

    /// Whether to go on. Where Python raises an exception, as for Ctrl-C, it is kept for [`finish`](Self::finish).
    pub(crate) fn ask(&mut self, done: f64, all: f64) -> ControlFlow<()> {
        if self.raised.is_some() {
            return ControlFlow::Break(());
        }
        if self.asked.elapsed() < EVERY {
            return ControlFlow::Continue(());
        }
        let told = Python::attach(|py| {
            py.check_signals()?;
            self.progress.map_or(Ok(()), |progress| progress.call1(py, (done, all)).map(|_| ()))
        });
        self.asked = Instant::now();
        match told {
            Ok(()) => ControlFlow::Continue(()),
            Err(raised) => {
                self.raised = Some(raised);
                ControlFlow::Break(())
            }
        }
    }

    /// Raises what was raised.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}
