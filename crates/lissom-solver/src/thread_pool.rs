//! The worker threads of parallel work. A process has one pool: the child of a fork, such as a worker of Python's `multiprocessing`, has
//! none of the threads of its parent, and starts its own.

use std::sync::{Mutex, PoisonError};

use rayon::{Scope, ThreadPool, ThreadPoolBuilder};

/// The pool, and the process whose threads it has.
static POOL: Mutex<Option<(u32, &ThreadPool)>> = Mutex::new(None);

/// The pool of this process. A pool of a parent process is never dropped, since its threads cannot be stopped.
fn pool() -> Option<&'static ThreadPool> {
    let process = std::process::id();
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, pool)) = known.filter(|(owner, _)| *owner == process) {
        return Some(pool);
    }
    let pool: &ThreadPool = Box::leak(Box::new(ThreadPoolBuilder::new().build().ok()?));
    *known = Some((process, pool));
    Some(pool)
}

/// Calls `work` on this thread with a scope, in which it starts tasks of other threads, and waits for the end of all.
pub fn in_parallel<'scope, R>(work: impl FnOnce(&Scope<'scope>) -> R) -> R {
    match pool() {
        Some(pool) => pool.in_place_scope(work),
        None => rayon::in_place_scope(work),
    }
}
