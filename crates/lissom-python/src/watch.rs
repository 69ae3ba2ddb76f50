//! Handles Python while the interpreter lock is released: Ctrl-C, and a function that receives the progress.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use lissom::core::interrupt;
use pyo3::prelude::*;

/// Interval of calls of Python.
pub(crate) const EVERY: Duration = Duration::from_millis(50);

/// Stack of a worker thread, as large as that of a main thread.
const STACK: usize = 8 << 20;

/// Runs non-interactive work with the interpreter lock released, in another thread, so that this one can check for Ctrl-C, which
/// raises at once. The work is then cancelled, and ends within a moment.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        let asked_of_work = Arc::clone(&given_up);
        // If the caller no longer waits, there is no receiver.
        let begun = thread::Builder::new().name("lissom".to_owned()).stack_size(STACK).spawn(move || {
            let _ = sender.send(interrupt::within(asked_of_work, work));
        });
        let worker = begun?;
        loop {
            match receiver.recv_timeout(EVERY) {
                Ok(outcome) => return outcome,
                Err(RecvTimeoutError::Timeout) => {
                    asked().inspect_err(|_| given_up.store(true, Ordering::Relaxed))?;
                }
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // The sender was dropped without a result: the work met a defect of the program.
        match worker.join() {
            Err(defect) => resume_unwind(defect),
            Ok(()) => Err(crate::errors::SolutionError::new_err("the work ended without a result")),
        }
    })
}

/// Raises pending Python exceptions, such as that of Ctrl-C.
pub(crate) fn asked() -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        Ok(())
    })
}

/// Calls Python at intervals.
pub(crate) struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    asked: Instant,
    raised: Option<PyErr>,
}

impl<'a> Watch<'a> {
    /// `progress` is called with two numbers: the work done, and the total.
    pub(crate) fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        Self { progress, asked: Instant::now(), raised: None }
    }

    /// Whether to continue. If Python raises an exception, such as that of Ctrl-C, it is stored for
    /// [`finish`](Self::finish).
    pub(crate) fn ask(&mut self, done: f64, all: f64) -> ControlFlow<()> {
        if self.raised.is_some() {
            return ControlFlow::Break(());
        }
        if self.asked.elapsed() < EVERY {
            return ControlFlow::Continue(());
        }
        let result = Python::attach(|py| {
            py.check_signals()?;
            self.progress.map_or(Ok(()), |progress| progress.call1(py, (done, all)).map(|_| ()))
        });
        self.asked = Instant::now();
        match result {
            Ok(()) => ControlFlow::Continue(()),
            Err(raised) => {
                self.raised = Some(raised);
                ControlFlow::Break(())
            }
        }
    }

    /// Raises the stored exception.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}
