//! Numbered cases that run at the same time.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// Which random cases are tried.
#[derive(clap::Args)]
pub(crate) struct CaseArguments {
    /// Cases to try
    #[arg(long, default_value_t = 100)]
    pub(crate) count: u64,
    /// Seed of all
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// Number of the first case
    #[arg(long, default_value_t = 0)]
    pub(crate) first: u64,
    /// Cases that run at the same time
    #[arg(long, default_value_t = 2)]
    pub(crate) threads: usize,
    /// Print the model of the first case, and try nothing
    #[arg(long)]
    pub(crate) text: bool,
}

impl CaseArguments {
    /// Numbers of the cases.
    pub(crate) fn range(&self) -> Range<u64> {
        self.first..self.first.saturating_add(self.count)
    }
}

/// Results of the cases of a range by number, from so many `threads`; none of those that would begin after `deadline`.
pub(crate) fn results<T: Send>(
    range: Range<u64>,
    threads: usize,
    deadline: Option<Instant>,
    case: impl Fn(u64) -> T + Sync,
) -> BTreeMap<u64, T> {
    let next = AtomicU64::new(range.start);
    let found = Mutex::new(BTreeMap::new());
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= range.end || deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                        return;
                    }
                    let result = case(index);
                    if let Ok(mut found) = found.lock() {
                        found.insert(index, result);
                    }
                }
            });
        }
    });
    found.into_inner().unwrap_or_default()
}
