//! Evaluation on several threads: elements and joints compute their local forces in parallel, then these are added
//! in the order of a single thread. Results are therefore bitwise independent of the number of threads.

use std::ops::Range;

use lissom_motion::WIDTH;

/// With fewer elements or joints than this, waking another thread costs about as much as it saves.
pub const WORTH_WHILE: usize = 4000;

/// Memory for local forces, and the number of threads. Waking them allocates slightly.
#[derive(Clone, Debug)]
pub struct Threads {
    count: usize,
    locals: Vec<f64>,
}

impl Threads {
    /// For batches of items with offsets `starts`; none if there is only one thread, or one is sufficient.
    pub fn new<'a>(starts: impl Iterator<Item = &'a [usize]>, threads: usize) -> Option<Self> {
        let (mut parts, mut longest) = (0, 0);
        for own in starts {
            parts = parts.max(own.len().saturating_sub(1));
            longest = longest.max(own.last().copied().unwrap_or(0));
        }
        (threads >= 2 && parts >= WORTH_WHILE).then(|| Self { count: threads, locals: vec![0.0; longest] })
    }

    /// Calls `work` in parallel with portions of the items, whole blocks of eight, and their values, initially zero. Returns all
    /// values. Those of item `k` begin at `starts[k]`.
    pub fn side_by_side(
        &mut self,
        starts: &[usize],
        work: &(impl Fn(Range<usize>, &mut [f64]) + Sync),
    ) -> &[f64] {
        let parts = starts.len() - 1;
        let threads = if parts < WORTH_WHILE { 1 } else { self.count };
        let numbers = &mut self.locals[..starts[parts]];
        let run = |range: Range<usize>, own: &mut [f64]| {
            own.fill(0.0);
            work(range, own);
        };
        lissom_solver::in_parallel(|scope| {
            let (mut rest, mut from) = (&mut *numbers, 0);
            for thread in 1..=threads {
                let to = if thread == threads { parts } else { parts * thread / threads / WIDTH * WIDTH };
                let (own, further) = rest.split_at_mut(starts[to] - starts[from]);
                let range = from..to;
                (rest, from) = (further, to);
                if thread == threads {
                    run(range, own);
                } else {
                    scope.spawn(move |_| run(range, own));
                }
            }
        });
        numbers
    }
}
