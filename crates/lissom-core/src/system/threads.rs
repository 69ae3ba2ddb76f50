//! Evaluation on several threads: elements and joints compute their local forces side by side, then these are added
//! up in the order in which one thread would. So results do not depend on the number of threads, not by a bit.

use std::ops::Range;

use lissom_motion::WIDTH;

use super::System;
use crate::joints::blocks::JointBatch;

/// With fewer elements or joints than this another thread takes about as long to wake as it helps.
pub const WORTH_WHILE: usize = 4000;

/// Room for local forces, and how many threads share the work. Waking them allocates a little.
#[derive(Clone, Debug)]
pub(crate) struct Threads {
    count: usize,
    locals: Vec<f64>,
}

impl Threads {
    /// None where one thread is all there is, or enough.
    pub(crate) fn new(system: &System, threads: usize) -> Option<Self> {
        let parts = system
            .batches
            .iter()
            .map(|batch| batch.len())
            .chain(system.joint_batches.iter().map(|batch| batch.indices().len()));
        if threads < 2 || parts.max().unwrap_or(0) < WORTH_WHILE {
            return None;
        }
        let batches = system.batches.iter().map(|batch| batch.starts());
        let joints = system.joint_batches.iter().map(JointBatch::starts);
        let longest = batches.chain(joints).filter_map(|starts| starts.last().copied()).max();
        Some(Self { count: threads, locals: vec![0.0; longest.unwrap_or(0)] })
    }

    /// Calls `work` with portions of the parts, whole blocks of eight, and the numbers that belong to them, all zero, side by side; gives
    /// all numbers. Those of part `k` begin at `starts[k]`.
    pub(crate) fn side_by_side(
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
        rayon::in_place_scope(|scope| {
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
