//! Asks a thread to give up what it computes. Newton's loop, searches for modes and solves at a frequency look whether they are
//! asked, so that every analysis ends soon, however many of them it is made of.
//!
//! This is kept per thread and not handed from function to function: no analysis does anything with it but to pass it on.

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

/// Puts back what was there before, also when the work panics.
struct Former(Option<Arc<AtomicBool>>);

impl Drop for Former {
    fn drop(&mut self) {
        let former = self.0.take();
        ASKED.with_borrow_mut(|asked| *asked = former);
    }
}

/// Does `work` on this thread, and has it end soon, with an error that says so, once `asked` is set.
pub fn within<T>(asked: Arc<AtomicBool>, work: impl FnOnce() -> T) -> T {
    let _former = Former(ASKED.replace(Some(asked)));
    work()
}

/// Whether this thread is asked to give up.
pub fn is_asked() -> bool {
    ASKED.with_borrow(|asked| asked.as_ref().is_some_and(|asked| asked.load(Ordering::Relaxed)))
}

/// An error where this thread is asked to give up.
///
/// # Errors
/// [`Interrupted`], if it is.
pub fn check() -> Result<(), Interrupted> {
    if is_asked() { Err(Interrupted) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_work_within_is_asked() {
        let asked = Arc::new(AtomicBool::new(true));
        assert_eq!(check(), Ok(()));
        within(Arc::clone(&asked), || {
            assert_eq!(check(), Err(Interrupted));
            within(Arc::new(AtomicBool::new(false)), || assert_eq!(check(), Ok(())));
            assert!(is_asked());
            std::thread::scope(|scope| scope.spawn(|| assert!(!is_asked())).join()).unwrap();
        });
        assert_eq!(check(), Ok(()));
        let _ = std::panic::catch_unwind(|| {
            within(Arc::clone(&asked), || std::panic::resume_unwind(Box::new(())))
        });
        assert_eq!(check(), Ok(()));
    }
}
