//! Looks after Python while the interpreter lock is released: Ctrl-C, and a function that receives the progress.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use lissom::core::interrupt;
use pyo3::prelude::*;

/// How often Python is asked.
const EVERY: Duration = Duration::from_millis(50);

/// Stack of a thread that works for Python, as large as that of a main thread.
const STACK: usize = 8 << 20;

/// Does work that asks nothing on its way, with the interpreter lock released. It is done in another thread, so that this one can
/// look for Ctrl-C, which raises at once. The work is then asked to end, which it does within a moment.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        let asked_of_work = Arc::clone(&given_up);
        // Where nobody waits any more, there is no receiver.
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
        // The sender is gone without a word: the work met a defect of the program.
        match worker.join() {
            Err(defect) => resume_unwind(defect),
            Ok(()) => Err(crate::errors::SolutionError::new_err("the work ended without a result")),
        }
    })
}

/// Raises what Python has to raise, as for Ctrl-C.
fn asked() -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        Ok(())
    })
}

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

    /// Raises what was raised.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}
