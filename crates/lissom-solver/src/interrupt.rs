//! Cancels the computation of a thread. Factorisations, Newton's loop, searches for modes and solves at a frequency check whether it is
//! requested, so that every analysis ends soon, regardless of the number of its parts.
//!
//! The request is stored per thread instead of being passed from function to function, because analyses would only pass
//! it on.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static ASKED: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// It was interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// Restores the earlier request, also when the work panics.
struct Former(Option<Arc<AtomicBool>>);

impl Drop for Former {
    fn drop(&mut self) {
        let former = self.0.take();
        ASKED.with_borrow_mut(|asked| *asked = former);
    }
}

/// Calls `work` on this thread, and ends it soon with an error once `asked` is set.
pub fn within<T>(asked: Arc<AtomicBool>, work: impl FnOnce() -> T) -> T {
    let _former = Former(ASKED.replace(Some(asked)));
    work()
}

/// The request of this thread, to be passed on to threads that work for it.
pub fn request() -> Arc<AtomicBool> {
    ASKED.with_borrow(|asked| asked.clone().unwrap_or_default())
}

/// Whether cancellation of this thread is requested.
pub fn is_asked() -> bool {
    ASKED.with_borrow(|asked| asked.as_ref().is_some_and(|asked| asked.load(Ordering::Relaxed)))
}

/// An error if cancellation of this thread is requested.
///
/// # Errors
/// [`Interrupted`], if it is.
pub fn check() -> Result<(), Interrupted> {
    if is_asked() { Err(Interrupted) } else { Ok(()) }
}

#[cfg(test)]
#[path = "../tests/unit/interrupt.rs"]
mod tests;
