//! Numeric factorisation: front by front, children first. All positions are fixed by the symbolic analysis; nothing
//! is searched for and nothing is allocated.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::Range;

use super::contributions::{add_all, add_columns, add_lower, add_transposed};
use super::elimination_tree::NONE;
use super::fronts::{Front, Part, Symbolic};
use super::instances::Kernels;
use super::kernels::{Product, absolute_products, solve_panel};
use super::small::{self, SmallFront};
use super::square::SquareWork;
use crate::interrupt;
use crate::pattern::Pattern;
use crate::report::{FactorError, Monitor};
use crate::scalar::Scalar;

/// Columns of a symmetric contribution that are computed together, from their first row on: a multiple of the padding
/// and of the columns of a tile.
const STRIP: usize = 24;

/// Numbers of the last factorisation, and storage for the next.
pub(super) struct Numeric<S> {
    pub(super) factors: Vec<S>,
    /// D by step: for symmetric matrices only.
    pub(super) pivots: Vec<S>,
    /// By step, the sum of the magnitudes of the terms of the diagonal so far.
    terms: Vec<f64>,
    /// One for each part.
    results: Vec<PartResult<S>>,
    /// One for each thread.
    benches: Vec<Bench<S>>,
    /// By step, the entry on the diagonal.
    diagonal: Vec<u32>,
}

/// What a part hands to the top.
struct PartResult<S> {
    /// The contribution of its root; none if it has no parent.
    contribution: Vec<S>,
    outcome: Result<(Monitor, f64), FactorError>,
}

/// Storage of a thread, in which it factorises one part after the other.
pub(super) struct Bench<S> {
    stacks: [Vec<S>; 2],
    square: SquareWork<S>,
    small: SmallFront<S>,
    /// `L21 D` of the present front: for symmetric matrices only.
    scaled: Vec<S>,
    front_terms: Vec<f64>,
}

impl<S: Kernels> Bench<S> {
    fn new(symbolic: &Symbolic) -> Self {
        let most = |of: fn(&Part) -> usize| symbolic.parts.iter().map(of).max().unwrap_or(0);
        let zeros = |length| vec![S::zero(); length];
        Bench {
            stacks: [zeros(most(|part| part.stack_lengths[0])), zeros(most(|part| part.stack_lengths[1]))],
            square: SquareWork::new(most(|part| part.largest_pivots)),
            small: SmallFront::new(),
            scaled: zeros(if symbolic.is_symmetric { most(|part| part.largest_panel) } else { 0 }),
            front_terms: vec![0.0; super::fronts::padded(most(|part| part.largest_boundary))],
        }
    }
}

/// The numbers of some parts, in order.
pub(super) struct Share<'a, S> {
    pub(super) parts: &'a [Part],
    factors: &'a mut [S],
    pivots: &'a mut [S],
    terms: &'a mut [f64],
    results: &'a mut [PartResult<S>],
}

impl<'a, S> Share<'a, S> {
    /// The first `count` parts, and the others.
    pub(super) fn split(self, count: usize) -> (Share<'a, S>, Share<'a, S>) {
        let (parts, other_parts) = self.parts.split_at(count);
        let factors: usize = parts.iter().map(|part| part.factors.len()).sum();
        let steps: usize = parts.iter().map(|part| part.steps.len()).sum();
        let (factors, other_factors) = self.factors.split_at_mut(factors);
        let (pivots, other_pivots) = self.pivots.split_at_mut(steps.min(self.pivots.len()));
        let (terms, other_terms) = self.terms.split_at_mut(steps);
        let (results, other_results) = self.results.split_at_mut(count);
        (
            Share { parts, factors, pivots, terms, results },
            Share {
                parts: other_parts,
                factors: other_factors,
                pivots: other_pivots,
                terms: other_terms,
                results: other_results,
            },
        )
    }
}

impl<S: Kernels> Numeric<S> {
    pub(super) fn new(symbolic: &Symbolic, pattern: &Pattern) -> Self {
        let on_diagonal = |&unknown: &u32| {
            pattern.position(unknown as usize, unknown as usize).map_or(NONE, |at| at as u32)
        };
        let steps = symbolic.unknowns.len();
        let of_symmetric = |length| vec![S::zero(); if symbolic.is_symmetric { length } else { 0 }];
        let result = |part: &Part| PartResult {
            contribution: vec![S::zero(); symbolic.fronts_of(part).last().map_or(0, Front::passed_up)],
            outcome: Ok((Monitor::new(), 0.0)),
        };
        Numeric {
            factors: vec![S::zero(); symbolic.factor_length],
            pivots: of_symmetric(steps),
            terms: vec![0.0; steps],
            results: symbolic.parts.iter().map(result).collect(),
            benches: vec![Bench::new(symbolic)],
            diagonal: symbolic.unknowns.iter().map(on_diagonal).collect(),
        }
    }

    /// Storage for this many threads.
    pub(super) fn set_threads(&mut self, symbolic: &Symbolic, threads: usize) {
        self.benches.resize_with(threads.max(1), || Bench::new(symbolic));
    }

    /// The subtrees, the entries on the diagonal, and the storage of every thread.
    pub(super) fn subtrees<'a>(
        &'a mut self,
        symbolic: &'a Symbolic,
    ) -> (Share<'a, S>, &'a [u32], &'a mut [Bench<S>]) {
        let all = Share {
            parts: &symbolic.parts,
            factors: &mut self.factors,
            pivots: &mut self.pivots,
            terms: &mut self.terms,
            results: &mut self.results,
        };
        (all.split(symbolic.parts.len() - 1).0, &self.diagonal, &mut self.benches)
    }

    /// Factorises the top, after all subtrees; returns the monitor and the largest magnitude in U.
    pub(super) fn factor_top(
        &mut self,
        processor: pulp::Arch,
        symbolic: &Symbolic,
        values: &[S],
    ) -> Result<(Monitor, f64), FactorError> {
        let (top, subtrees) = symbolic.parts.split_last().expect("there always is a top");
        let (terms_below, terms) = self.terms.split_at_mut(top.steps.start);
        let (below, of_top) = self.results.split_at_mut(subtrees.len());
        begin_terms(terms, &self.diagonal[top.steps.clone()], values);
        let (mut monitor, mut largest) = (Monitor::new(), 0.0);
        for (part, result) in subtrees.iter().zip(&*below) {
            for (&step, &term) in part.outside.iter().zip(&terms_below[part.places.clone()]) {
                terms[step as usize - top.steps.start] += term;
            }
            let (of_part, largest_of_part) = result.outcome?;
            monitor.join(&of_part);
            largest = f64::max(largest, largest_of_part);
        }
        let work = Work {
            part: top,
            factors: &mut self.factors[top.factors.clone()],
            pivots: if symbolic.is_symmetric { &mut self.pivots[top.steps.clone()] } else { &mut [] },
            terms,
            bench: &mut self.benches[0],
            passed_up: &mut of_top[0].contribution,
            below,
        };
        let (of_top, largest_of_top) = S::factor_part(processor, FactorPart { symbolic, values, work })?;
        monitor.join(&of_top);
        Ok((monitor, f64::max(largest, largest_of_top)))
    }
}

/// Initial terms of the diagonal.
fn begin_terms<S: Scalar>(terms: &mut [f64], diagonal: &[u32], values: &[S]) {
    for (terms, &entry) in terms.iter_mut().zip(diagonal) {
        *terms = values.get(entry as usize).map_or(0.0, |value| value.magnitude());
    }
}

impl<S: Kernels> Share<'_, S> {
    /// Factorises subtrees, one after the other, in the storage of a thread.
    pub(super) fn factor(
        self,
        processor: pulp::Arch,
        symbolic: &Symbolic,
        (values, diagonal): (&[S], &[u32]),
        bench: &mut Bench<S>,
    ) {
        let mut rest = self;
        while let Some(part) = rest.parts.first() {
            let own;
            (own, rest) = rest.split(1);
            let Share { factors, pivots, terms, results, .. } = own;
            let PartResult { contribution, outcome } = &mut results[0];
            begin_terms(terms, &diagonal[part.steps.clone()], values);
            let work = Work { part, factors, pivots, terms, bench, passed_up: contribution, below: &[] };
            *outcome = S::factor_part(processor, FactorPart { symbolic, values, work });
        }
    }
}

/// Factorises a part by LU or LDLᵀ; returns the monitor and the largest magnitude in U.
pub struct FactorPart<'a, S> {
    symbolic: &'a Symbolic,
    values: &'a [S],
    work: Work<'a, S>,
}

impl<S: Scalar> pulp::WithSimd for FactorPart<'_, S> {
    type Output = Result<(Monitor, f64), FactorError>;

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, simd: V) -> Self::Output {
        let FactorPart { symbolic, values, mut work } = self;
        // Two vectors of rows, real, or complex with two sums each: twelve sums for six columns. With four
        // lanes or more the processor multiplies and adds in one instruction.
        if V::F64_LANES == 8 && !S::COMPLEX {
            work.factor::<V, true, 16>(simd, symbolic, values)
        } else if V::F64_LANES == 4 && !S::COMPLEX {
            work.factor::<V, true, 8>(simd, symbolic, values)
        } else if V::F64_LANES >= 4 {
            work.factor::<V, true, 4>(simd, symbolic, values)
        } else {
            work.factor::<V, false, 4>(simd, symbolic, values)
        }
    }
}

/// The numbers of a part during its factorisation.
struct Work<'a, S> {
    part: &'a Part,
    factors: &'a mut [S],
    pivots: &'a mut [S],
    terms: &'a mut [f64],
    bench: &'a mut Bench<S>,
    /// Contribution of the root to the top.
    passed_up: &'a mut [S],
    below: &'a [PartResult<S>],
}

impl<S: Scalar> Work<'_, S> {
    /// Factorises; returns the monitor and the largest magnitude in U.
    #[inline(always)]
    fn factor<V: pulp::Simd, const FUSED: bool, const ROWS: usize>(
        &mut self,
        simd: V,
        symbolic: &Symbolic,
        values: &[S],
    ) -> Result<(Monitor, f64), FactorError> {
        let mut monitor = Monitor::new();
        let mut largest = 0.0_f64;
        for front in &symbolic.fronts[self.part.fronts.clone()] {
            let of_front = if const { small::is_for::<S>(FUSED) } && front.is_small() {
                self.factor_small::<V>(simd, (symbolic, front), values, &mut monitor)?
            } else {
                if interrupt::is_asked() {
                    return Err(FactorError::Interrupted);
                }
                self.assemble(symbolic, front, values);
                self.eliminate::<V, FUSED, ROWS>(simd, (symbolic, front), &mut monitor)?
            };
            largest = if of_front > largest { of_front } else { largest };
        }
        Ok((monitor, largest))
    }

    /// Positions of the pieces of a front among the factors of its part.
    #[inline(always)]
    fn range(&self, front: &Front) -> Range<usize> {
        let range = front.factor_range();
        range.start - self.part.factors.start..range.end - self.part.factors.start
    }

    /// A small front, from its assembly to its contribution.
    #[inline(always)]
    fn factor_small<V: pulp::Simd>(
        &mut self,
        simd: V,
        (symbolic, front): (&Symbolic, &Front),
        values: &[S],
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let pieces = &mut self.factors[front.factors - self.part.factors.start..];
        let Bench { stacks: [even, odd], small, .. } = &mut *self.bench;
        let (own, others) = if front.stack == 0 { (even, &*odd) } else { (odd, &*even) };
        let own = if front.passes_up { &mut *self.passed_up } else { &mut own[..] };
        let (pivots, stride) = (front.pivots, front.small_stride());
        let matrix = &mut small.matrix.0[..];
        matrix[..(pivots + front.boundary) * stride].fill(S::zero());
        let sources = &symbolic.sources[front.entries.clone()];
        for (&source, &target) in sources.iter().zip(&symbolic.targets[front.entries.clone()]) {
            matrix[target as usize] = values[source as usize];
        }
        for child in &symbolic.children[front.children.clone()] {
            let stack = self.below.get(child.part).map_or(others, |other| &other.contribution);
            let of_child = &stack[child.contribution.clone()];
            let to_pivots = &symbolic.runs[child.to_pivots.clone()];
            let to_boundary = &symbolic.runs[child.to_boundary.clone()];
            if symbolic.is_symmetric {
                let (of_pivots, of_boundary) = matrix.split_at_mut(pivots * stride);
                add_lower(of_pivots, stride, of_child, child, to_pivots);
                add_columns(&mut of_pivots[pivots..], stride, of_child, child, to_boundary, to_pivots);
                add_lower(&mut of_boundary[pivots..], stride, of_child, child, to_boundary);
            } else {
                add_all(matrix, stride, of_child, child, [(to_pivots, 0), (to_boundary, pivots)]);
            }
        }
        if symbolic.is_symmetric {
            small.complete(front);
        }
        let steps = self.part.steps_of(front);
        small.terms[..pivots].copy_from_slice(&self.terms[steps]);
        small.terms[pivots..].fill(0.0);
        let unknowns = &symbolic.unknowns[front.first..front.first + pivots];
        let results = (pieces, &mut own[front.contribution_range()]);
        let largest = small.eliminate(simd, (front, unknowns), results, monitor)?;
        for (&place, &term) in symbolic.places[front.rows.clone()].iter().zip(&small.terms[pivots..]) {
            self.terms[place as usize] += term;
        }
        Ok(largest)
    }

    /// Entries of the matrix and the children's contributions to the pivots. The square of a symmetric matrix is
    /// completed from its lower triangle.
    #[inline(always)]
    fn assemble(&mut self, symbolic: &Symbolic, front: &Front, values: &[S]) {
        let range = self.range(front);
        let pieces = &mut self.factors[range];
        pieces.fill(S::zero());
        let sources = &symbolic.sources[front.entries.clone()];
        for (&source, &target) in sources.iter().zip(&symbolic.targets[front.entries.clone()]) {
            pieces[target as usize] = values[source as usize];
        }
        let (square, panels) = pieces.split_at_mut(front.square_length());
        let (lower, upper) = panels.split_at_mut(front.panel_length());
        let stride = front.square_stride();
        for child in &symbolic.children[front.children.clone()] {
            let own = &self.bench.stacks[1 - front.stack];
            let stack = self.below.get(child.part).map_or(own, |other| &other.contribution);
            let contribution = &stack[child.contribution.clone()];
            let pivot_runs = &symbolic.runs[child.to_pivots.clone()];
            let boundary_runs = &symbolic.runs[child.to_boundary.clone()];
            add_columns(lower, front.panel_stride(), contribution, child, boundary_runs, pivot_runs);
            if symbolic.is_symmetric {
                add_lower(square, stride, contribution, child, pivot_runs);
            } else {
                add_columns(square, stride, contribution, child, pivot_runs, pivot_runs);
                add_transposed(upper, front.panel_stride(), contribution, child, pivot_runs, boundary_runs);
            }
        }
        for column in if symbolic.is_symmetric { 1..front.pivots } else { 0..0 } {
            for row in 0..column {
                square[column * stride + row] = square[row * stride + column];
            }
        }
    }

    /// Elimination of the pivots, then the contribution to the parent, children's included: of symmetric matrices
    /// its lower triangle.
    #[inline(always)]
    fn eliminate<V: pulp::Simd, const FUSED: bool, const ROWS: usize>(
        &mut self,
        simd: V,
        (symbolic, front): (&Symbolic, &Front),
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let (pivots, boundary) = (front.pivots, front.boundary);
        let first = front.first - self.part.steps.start;
        let steps = first..first + pivots;
        let unknowns = &symbolic.unknowns[front.first..front.first + pivots];
        let range = self.range(front);
        let bench = &mut *self.bench;
        let pieces = &mut self.factors[range];
        let (square, panels) = pieces.split_at_mut(front.square_length());
        let (lower, upper) = panels.split_at_mut(front.panel_length());
        bench.square.terms[..pivots].copy_from_slice(&self.terms[steps.clone()]);
        let mut largest = bench.square.factor::<V, FUSED, ROWS>(simd, square, unknowns, monitor)?;
        if symbolic.is_symmetric {
            for (pivot, &reciprocal) in self.pivots[steps.clone()].iter_mut().zip(&bench.square.reciprocals) {
                *pivot = S::one() / reciprocal;
            }
        }
        if boundary == 0 {
            return Ok(largest);
        }

        let (stride, square_stride) = (front.panel_stride(), front.square_stride());
        let reciprocals = Some(&bench.square.reciprocals[..pivots]);
        let transposed = (&bench.square.transposed[..], square_stride);
        solve_panel::<S, V, FUSED, ROWS>(simd, (lower, stride), transposed, reciprocals, pivots, stride);
        let upper: &[S] = if symbolic.is_symmetric {
            let scaled = &mut bench.scaled[..front.panel_length()];
            scale_columns(scaled, lower, stride, &self.pivots[steps]);
            scaled
        } else {
            let square = (&*square, square_stride);
            solve_panel::<S, V, FUSED, ROWS>(simd, (upper, stride), square, None, pivots, stride);
            upper
        };
        let terms = &mut bench.front_terms[..stride];
        terms.fill(0.0);
        largest = largest.max(absolute_products(terms, (lower, upper), stride, (stride, pivots)));
        for (&place, &term) in symbolic.places[front.rows.clone()].iter().zip(&*terms) {
            self.terms[place as usize] += term;
        }

        let (even, odd) = bench.stacks.split_at_mut(1);
        let (own, others) = if front.stack == 0 { (&mut even[0], &odd[0]) } else { (&mut odd[0], &even[0]) };
        let own = if front.passes_up { &mut *self.passed_up } else { &mut own[..] };
        let contribution = &mut own[front.contribution_range()];
        let strip = if symbolic.is_symmetric { STRIP } else { boundary };
        for begin in (0..boundary).step_by(strip) {
            simd.vectorize(Product::<S, FUSED, false, ROWS> {
                c: (&mut contribution[begin * stride + begin..], stride),
                a: (&lower[begin..], stride),
                b: (&upper[begin..], stride),
                shape: (stride - begin, strip.min(boundary - begin), pivots),
            });
        }
        for child in &symbolic.children[front.children.clone()] {
            let runs = &symbolic.runs[child.to_boundary.clone()];
            let stack = self.below.get(child.part).map_or(others, |other| &other.contribution);
            let of_child = &stack[child.contribution.clone()];
            if symbolic.is_symmetric {
                add_lower(contribution, stride, of_child, child, runs);
            } else {
                add_columns(contribution, stride, of_child, child, runs, runs);
            }
        }
        Ok(largest)
    }
}

/// Multiplies each column by a number.
#[inline(always)]
fn scale_columns<S: Scalar>(to: &mut [S], from: &[S], stride: usize, factors: &[S]) {
    for ((to, from), &factor) in to.chunks_exact_mut(stride).zip(from.chunks_exact(stride)).zip(factors) {
        for (to, &from) in to.iter_mut().zip(from) {
            *to = from * factor;
        }
    }
}
