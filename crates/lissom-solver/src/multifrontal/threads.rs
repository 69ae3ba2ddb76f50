//! Parallel work on subtrees. The result of a subtree depends neither on the thread nor on the time, so results are
//! the same for any number of threads.

use std::sync::Arc;

use super::factorisation::Numeric;
use super::fronts::{Part, Symbolic};
use super::instances::{Kernels, Largest};
use super::sweeps::Sweep;
use crate::interrupt;
use crate::scalar::Scalar;

/// Size of the factors [bytes] from which on parallel solves are efficient: a solve takes as long as reading them.
const WORTH_WHILE: usize = 4 << 20;

/// Whether parallel solves are efficient.
pub(super) fn pay_in_solves(bytes: usize) -> bool {
    bytes >= WORTH_WHILE
}

/// Number of subtrees for each of these threads, in order, so that all take about the same time. None if parallel work is not
/// efficient.
pub(super) fn crews(subtrees: &[Part], threads: usize) -> Vec<usize> {
    let threads = threads.min(subtrees.len());
    if threads < 2 {
        return Vec::new();
    }
    let total: f64 = subtrees.iter().map(|part| part.time).sum();
    let (mut crews, mut done, mut begin) = (Vec::with_capacity(threads), 0.0, 0);
    for (index, part) in subtrees.iter().enumerate() {
        done += part.time;
        let others = threads - crews.len() - 1;
        let is_full = done >= total * (crews.len() + 1) as f64 / threads as f64;
        if others > 0 && (is_full || subtrees.len() - index - 1 == others) {
            crews.push(index + 1 - begin);
            begin = index + 1;
        }
    }
    crews.push(subtrees.len() - begin);
    crews
}

/// Factorises all subtrees; returns the largest magnitude of the values, if they are finite.
pub(super) fn factor<S: Kernels>(
    processor: pulp::Arch,
    symbolic: &Symbolic,
    numeric: &mut Numeric<S>,
    values: &[S],
    crews: &[usize],
) -> Option<f64> {
    let (mut rest, diagonal, benches) = numeric.subtrees(symbolic);
    let mut largest = vec![Some(0.0_f64); crews.len()];
    let portion = values.len().div_ceil(crews.len()).max(1);
    let request = interrupt::request();
    crate::in_parallel(|scope| {
        let mut portions = values.chunks(portion);
        let benches = benches.iter_mut();
        for (index, ((&crew, largest), bench)) in crews.iter().zip(&mut largest).zip(benches).enumerate() {
            let share;
            (share, rest) = rest.split(crew);
            let portion = portions.next().unwrap_or_default();
            let work = move || {
                *largest = S::largest(processor, Largest { values: portion });
                share.factor(processor, symbolic, (values, diagonal), bench);
            };
            if index + 1 < crews.len() {
                let request = Arc::clone(&request);
                scope.spawn(move |_| interrupt::within(request, work));
            } else {
                work();
            }
        }
    });
    largest.into_iter().try_fold(0.0, |most, largest| Some(f64::max(most, largest?)))
}

/// Applies `work` to every crew's subtrees, or to all of them if there are no crews.
pub(super) fn sweep<S: Scalar>(crews: &[usize], all: Sweep<S>, work: impl Fn(Sweep<S>) + Sync) {
    let Some((&last, others)) = crews.split_last() else { return work(all) };
    crate::in_parallel(|scope| {
        let mut rest = all;
        for &crew in others {
            let own;
            (own, rest) = rest.split(crew);
            let work = &work;
            scope.spawn(move |_| work(own));
        }
        debug_assert_eq!(rest.parts.len(), last);
        work(rest);
    });
}
