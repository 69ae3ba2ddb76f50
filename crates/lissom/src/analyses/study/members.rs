//! The members of a family, solved in parallel by a few threads with one thread each, and their progress.

use std::num::NonZero;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use lissom_core::interrupt;

/// Number of steps between two calls of the watch.
const OFTEN: usize = 64;

/// Receives the numbers of steps done and planned over all members, from any thread, and decides whether to continue.
pub type Watch<'a> = &'a (dyn Fn(usize, usize) -> ControlFlow<()> + Sync);

/// Progress of a family.
pub(super) struct Effort<'a> {
    watch: Watch<'a>,
    planned: usize,
    done: AtomicUsize,
    stopped: AtomicBool,
}

impl<'a> Effort<'a> {
    pub(super) fn new(watch: Watch<'a>, planned: usize) -> Self {
        Self { watch, planned, done: AtomicUsize::new(0), stopped: AtomicBool::new(false) }
    }

    /// Records that a member has completed its step number `step`, from one. Whether to continue.
    pub(super) fn note(&self, step: usize) -> ControlFlow<()> {
        if !step.is_multiple_of(OFTEN) {
            return ControlFlow::Continue(());
        }
        let done = self.done.fetch_add(OFTEN, Ordering::Relaxed) + OFTEN;
        if self.stopped.load(Ordering::Relaxed) || (self.watch)(done, self.planned).is_break() {
            self.stopped.store(true, Ordering::Relaxed);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Calls `work` with every index below `count`, in parallel; results are in order.
pub(super) fn in_parallel<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let results: Mutex<Vec<Option<T>>> = Mutex::new((0..count).map(|_| None).collect());
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(count);
    let request = interrupt::request();
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        return;
                    }
                    let result = interrupt::within(request.clone(), || work(index));
                    results.lock().unwrap_or_else(PoisonError::into_inner)[index] = Some(result);
                }
            });
        }
    });
    let results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().map(|result| result.expect("every index was worked on")).collect()
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/study/members.rs"]
mod tests;
