//! What earlier corrections tell of the error of a kept tangent: secants. A tangent that is old leaves something of each
//! correction to the next ones, in a few directions that are the same from iteration to iteration and from step to
//! step. Those are seen and taken away [Anderson 1965; Fang and Saad 2009, type II].
//!
//! ```text
//! d_k  correction by the kept tangent,   s_k  correction made,   Δ_i = d_{i+1} - d_i,   P_i = s_i + Δ_i
//! s_k = d_k - Σ γ_i P_i,   γ = argmin |d_k - Σ γ_i Δ_i|
//! ```
//!
//! Where the tangent is exact, P = 0 and nothing changes.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::corrections::{processor, product};

/// Most secants in use.
const MOST: usize = 5;
/// Secants that are less independent of newer ones are left out.
const DEPENDENT: f64 = 1e-6;
/// A secant is used for corrections up to so many times as large: beyond, its round-off would tell.
const REACH: f64 = 10.0;
/// A secant is kept if |P| is below this part of |Δ|: where a tangent is worse it is to be renewed, and corrections that
/// are round-off have nothing to tell.
const CREDIBLE: f64 = 0.7;

/// The last corrections, of all stages.
#[derive(Debug)]
pub(crate) struct Secants {
    /// Weights of the coordinates.
    sizes: Vec<f64>,
    /// Δ, weighted, by stage and coordinate.
    changes: [Vec<f64>; MOST],
    /// P, by stage and row.
    departures: [Vec<f64>; MOST],
    /// Products of the changes.
    products: [[f64; MOST]; MOST],
    /// Most secants in use: fewer than there are directions.
    most: usize,
    /// Secants known, and where the next one goes.
    known: usize,
    next: usize,
    /// Whether the last correction is known.
    goes_on: bool,
    /// d, and d weighted, and s of that one.
    last: Vec<f64>,
    last_weighted: Vec<f64>,
    last_made: Vec<f64>,
    weighted: Vec<f64>,
    processor: pulp::Arch,
}

impl Secants {
    /// None yet, for `stages` stages of `size` rows, of which the first are coordinates of these `sizes`.
    pub(crate) fn new(stages: usize, size: usize, sizes: &[f64]) -> Self {
        let (rows, coordinates) = (stages * size, stages * sizes.len());
        Self {
            sizes: sizes.to_vec(),
            changes: std::array::from_fn(|_| vec![0.0; coordinates]),
            departures: std::array::from_fn(|_| vec![0.0; rows]),
            products: [[0.0; MOST]; MOST],
            most: MOST.min(2 + sizes.len() / 4),
            known: 0,
            next: 0,
            goes_on: false,
            last: vec![0.0; rows],
            last_weighted: vec![0.0; coordinates],
            last_made: vec![0.0; rows],
            weighted: vec![0.0; coordinates],
            processor: processor(size),
        }
    }

    /// Forgets everything: the tangent is another one.
    pub(crate) fn forget(&mut self) {
        self.known = 0;
        self.next = 0;
        self.goes_on = false;
    }

    /// The next correction does not follow on the last one.
    pub(crate) fn interrupt(&mut self) {
        self.goes_on = false;
    }

    /// Improves the corrections of all stages.
    pub(crate) fn improve(&mut self, corrections: &mut [Vec<f64>]) {
        self.processor.dispatch(Improve { secants: self, corrections });
    }

    #[inline(always)]
    fn run(&mut self, corrections: &mut [Vec<f64>]) {
        self.weigh(corrections);
        if self.goes_on {
            self.note(corrections);
        }
        self.goes_on = true;
        std::mem::swap(&mut self.last_weighted, &mut self.weighted);
        gather(corrections, &mut self.last);
        let shares = self.shares();
        for (k, share) in shares.into_iter().enumerate().filter(|&(_, share)| share != 0.0) {
            let mut departures = &self.departures[k][..];
            for stage in corrections.iter_mut() {
                let (own, others) = departures.split_at(stage.len());
                departures = others;
                for (value, departure) in stage.iter_mut().zip(own) {
                    *value -= share * departure;
                }
            }
        }
        gather(corrections, &mut self.last_made);
    }

    #[inline(always)]
    fn weigh(&mut self, corrections: &[Vec<f64>]) {
        let count = self.sizes.len();
        for (stage, corrections) in corrections.iter().enumerate() {
            let weighted = &mut self.weighted[stage * count..(stage + 1) * count];
            for ((weighted, value), size) in weighted.iter_mut().zip(corrections).zip(&self.sizes) {
                *weighted = size * value;
            }
        }
    }

    /// Takes note of the secant from the last correction to this one.
    #[inline(always)]
    fn note(&mut self, corrections: &[Vec<f64>]) {
        let slot = self.next;
        let change = &mut self.changes[slot];
        for ((change, value), last) in change.iter_mut().zip(&self.weighted).zip(&self.last_weighted) {
            *change = value - last;
        }
        let mut departure = 0.0;
        let (count, rows) = (self.sizes.len(), corrections[0].len());
        for (stage, corrections) in corrections.iter().enumerate() {
            let own = stage * rows..(stage + 1) * rows;
            let into = &mut self.departures[slot][own.clone()];
            let before = self.last_made[own.clone()].iter().zip(&self.last[own]);
            for ((departure, (made, last)), value) in into.iter_mut().zip(before).zip(corrections) {
                *departure = made + (value - last);
            }
            // The weights are used up: room for the departure's own.
            let weighted = &mut self.last_weighted[stage * count..(stage + 1) * count];
            for ((weighted, value), size) in weighted.iter_mut().zip(&*into).zip(&self.sizes) {
                *weighted = size * value;
            }
            departure += product(weighted, weighted);
        }
        for other in 0..self.most {
            let product = product(&self.changes[slot], &self.changes[other]);
            self.products[slot][other] = product;
            self.products[other][slot] = product;
        }
        if departure < CREDIBLE * CREDIBLE * self.products[slot][slot] {
            self.next = (slot + 1) % self.most;
            self.known = (self.known + 1).min(self.most);
        } else if self.known == self.most {
            // The oldest one has been written over.
            self.known = self.most - 1;
        }
    }

    /// γ by slot: least squares through a Cholesky factorisation of the products, newest first.
    #[inline(always)]
    fn shares(&self) -> [f64; MOST] {
        let mut shares = [0.0; MOST];
        let mut lower = [[0.0; MOST]; MOST];
        let mut forward = [0.0; MOST];
        let mut slots = [0; MOST];
        let mut used = 0;
        let smallest = product(&self.last_weighted, &self.last_weighted) / (REACH * REACH);
        for back in 1..=self.known {
            let slot = (self.next + self.most - back) % self.most;
            if self.products[slot][slot] < smallest {
                continue;
            }
            let mut row = [0.0; MOST];
            let mut pivot = self.products[slot][slot];
            for k in 0..used {
                let sum: f64 = (0..k).map(|j| row[j] * lower[k][j]).sum();
                row[k] = (self.products[slot][slots[k]] - sum) / lower[k][k];
                pivot -= row[k] * row[k];
            }
            let is_independent = pivot > DEPENDENT * self.products[slot][slot];
            if !is_independent {
                continue;
            }
            row[used] = pivot.sqrt();
            let sum: f64 = (0..used).map(|j| row[j] * forward[j]).sum();
            forward[used] = (product(&self.changes[slot], &self.last_weighted) - sum) / row[used];
            lower[used] = row;
            slots[used] = slot;
            used += 1;
        }
        for k in (0..used).rev() {
            let sum: f64 = (k + 1..used).map(|j| lower[j][k] * shares[slots[j]]).sum();
            shares[slots[k]] = (forward[k] - sum) / lower[k][k];
        }
        if shares.iter().all(|share| share.is_finite()) { shares } else { [0.0; MOST] }
    }
}

struct Improve<'a> {
    secants: &'a mut Secants,
    corrections: &'a mut [Vec<f64>],
}

impl pulp::WithSimd for Improve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        self.secants.run(self.corrections);
    }
}

#[inline(always)]
fn gather(stages: &[Vec<f64>], into: &mut [f64]) {
    let mut into = into;
    for stage in stages {
        let (own, others) = into.split_at_mut(stage.len());
        own.copy_from_slice(stage);
        into = others;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corrections of A x = b by the tangent 1, A = 1 + two directions that it does not know; how many until `|d|` is below
    /// a millionth of a millionth, for right-hand sides that change from step to step.
    fn iterations(improves: bool) -> Vec<usize> {
        let count = 12;
        let direction = |k: usize, row: usize| (1.0 + (k * 7 + row * (3 + k)) as f64).sin() / 2.0;
        let product = |x: &[f64]| -> Vec<f64> {
            let shares: Vec<f64> =
                (0..2).map(|k| (0..count).map(|row| 0.1 * direction(k, row) * x[row]).sum()).collect();
            (0..count)
                .map(|row| x[row] + (0..2).map(|k| shares[k] * direction(k, row)).sum::<f64>())
                .collect()
        };
        let mut secants = Secants::new(1, count + 1, &vec![1.0; count]);
        (0..6)
            .map(|step| {
                let wanted: Vec<f64> = (0..count).map(|row| ((row + step) as f64).cos()).collect();
                let mut x = vec![0.0; count];
                secants.interrupt();
                for iteration in 1..50 {
                    let mut correction: Vec<f64> =
                        product(&x).iter().zip(product(&wanted)).map(|(have, want)| have - want).collect();
                    // A multiplier, which has no weight.
                    correction.push(1.0);
                    let mut stages = [correction];
                    if improves {
                        secants.improve(&mut stages);
                    }
                    for (x, correction) in x.iter_mut().zip(&stages[0]) {
                        *x -= correction;
                    }
                    if stages[0][..count].iter().all(|value| value.abs() < 1e-12) {
                        return iteration;
                    }
                }
                50
            })
            .collect()
    }

    #[test]
    fn what_a_tangent_does_not_know_is_learned_and_remembered() {
        let (plain, improved) = (iterations(false), iterations(true));
        assert!(plain.iter().all(|&count| count >= 12), "{plain:?}");
        assert!(improved[0] <= 5, "{improved:?}");
        assert!(improved[1..].iter().all(|&count| count <= 3), "{improved:?}");
    }

    #[test]
    fn an_exact_tangent_is_left_alone() {
        let mut secants = Secants::new(1, 2, &[1.0, 1.0]);
        for (first, second) in [(1.0, 2.0), (0.0, 0.0), (3.0, 1.0)] {
            let mut stages = [vec![first, second]];
            secants.improve(&mut stages);
            assert_eq!(stages[0], [first, second]);
        }
    }
}
