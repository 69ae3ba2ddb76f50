//! Multifrontal LDLᵀ without pivoting, for symmetric matrices: half the panels and half the products of LU. Shares
//! everything symbolic and all kernels with it.
//!
//! Squares of fronts are factored as LU, whose `U` is `D Lᵀ`; of what a front contributes to its parent only the lower
//! triangle is formed.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::sync::Arc;

use super::factorisation::add_columns;
use super::fronts::{Child, Front, Run, Symbolic, padded};
use super::kernels::{absolute_products, solve_panel, subtract_product};
use super::square::SquareWork;
use super::triangular::{self, FrontVectors};
use crate::entries::largest_entry;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport, Monitor};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

/// Columns of a contribution that are formed together, from their first row on: a multiple of the padding and of the
/// columns of a tile.
const STRIP: usize = 24;

/// Multifrontal LDLᵀ without pivoting. Of each pair of entries the one in the row that is eliminated later is read.
/// Complex matrices are symmetric, not Hermitian.
pub struct Symmetric<S> {
    pattern: Arc<Pattern>,
    processor: pulp::Arch,
    symbolic: Symbolic,
    numeric: Numeric<S>,
    vector: Vec<S>,
    front_vectors: FrontVectors<S>,
}

impl<S: Scalar> Symmetric<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] refuses the structure.
    pub fn new(structure: &Structure) -> Self {
        let symbolic = Symbolic::new(structure, 1);
        let pattern = Arc::clone(&structure.pattern);
        Self {
            processor: pulp::Arch::new(),
            numeric: Numeric::new(&symbolic, &pattern),
            vector: vec![S::zero(); symbolic.unknowns.len()],
            front_vectors: FrontVectors::new(&symbolic),
            symbolic,
            pattern,
        }
    }
}

impl<S: Scalar> LinearSolver<S> for Symmetric<S> {
    fn name(&self) -> &'static str {
        "symmetric"
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        let Self { pattern, symbolic, numeric, .. } = self;
        self.processor.dispatch(Factor { pattern, symbolic, numeric, values })
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        assert_eq!(right_hand_side.len(), self.vector.len(), "one number for each unknown");
        let Self { symbolic, numeric, vector, front_vectors, .. } = self;
        self.processor.dispatch(Solve { symbolic, numeric, right_hand_side, vector, front_vectors });
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        self.solve(right_hand_side);
    }

    fn factor_entries(&self) -> usize {
        self.symbolic.factor_entries
    }
}

/// Numbers of the last factorisation, and room to make the next.
struct Numeric<S> {
    factors: Vec<S>,
    /// D, by step.
    pivots: Vec<S>,
    stacks: [Vec<S>; 2],
    square: SquareWork<S>,
    /// `L21 D` of the front at hand.
    scaled: Vec<S>,
    /// By step, the sum of the magnitudes of what the diagonal has been made of so far.
    terms: Vec<f64>,
    front_terms: Vec<f64>,
    diagonal: Vec<u32>,
}

impl<S: Scalar> Numeric<S> {
    fn new(symbolic: &Symbolic, pattern: &Pattern) -> Self {
        let on_diagonal = |&unknown: &u32| {
            let unknown = unknown as usize;
            pattern.position(unknown, unknown).expect("the diagonal is in the pattern") as u32
        };
        let largest_panel = symbolic.fronts.iter().map(Front::panel_length).max().unwrap_or(0);
        Self {
            factors: vec![S::zero(); symbolic.factor_length],
            pivots: vec![S::zero(); symbolic.unknowns.len()],
            stacks: symbolic.stack_lengths.map(|length| vec![S::zero(); length]),
            square: SquareWork::new(symbolic.largest_pivots),
            scaled: vec![S::zero(); largest_panel],
            terms: vec![0.0; symbolic.unknowns.len()],
            front_terms: vec![0.0; padded(symbolic.largest_boundary)],
            diagonal: symbolic.unknowns.iter().map(on_diagonal).collect(),
        }
    }

    #[inline(always)]
    fn factor<const FUSED: bool, const ROWS: usize>(
        &mut self,
        symbolic: &Symbolic,
        values: &[S],
    ) -> Result<(Monitor, f64), FactorError> {
        for (terms, &entry) in self.terms.iter_mut().zip(&self.diagonal) {
            *terms = values[entry as usize].magnitude();
        }
        let mut monitor = Monitor::new();
        let mut largest = 0.0_f64;
        for front in &symbolic.fronts {
            self.assemble(symbolic, front, values);
            largest = largest.max(self.eliminate::<FUSED, ROWS>(symbolic, front, &mut monitor)?);
        }
        Ok((monitor, largest))
    }

    /// Entries of the matrix and the children's contributions to the pivots; the square is completed from its lower
    /// triangle.
    #[inline(always)]
    fn assemble(&mut self, symbolic: &Symbolic, front: &Front, values: &[S]) {
        let pieces = &mut self.factors[front.factor_range()];
        pieces.fill(S::zero());
        let sources = &symbolic.sources[front.entries.clone()];
        for (&source, &target) in sources.iter().zip(&symbolic.targets[front.entries.clone()]) {
            pieces[target as usize] = values[source as usize];
        }
        let (square, lower) = pieces.split_at_mut(front.square_length());
        let stack = &self.stacks[1 - front.stack];
        for child in &symbolic.children[front.children.clone()] {
            let contribution = &stack[child.contribution.clone()];
            let pivot_runs = &symbolic.runs[child.to_pivots.clone()];
            let boundary_runs = &symbolic.runs[child.to_boundary.clone()];
            add_lower(square, front.square_stride(), contribution, child, pivot_runs);
            add_columns(lower, front.panel_stride(), contribution, child, boundary_runs, pivot_runs);
        }
        let stride = front.square_stride();
        for column in 1..front.pivots {
            for row in 0..column {
                square[column * stride + row] = square[row * stride + column];
            }
        }
    }

    /// Elimination of the pivots, then the lower triangle of the contribution to the parent, children's included.
    #[inline(always)]
    fn eliminate<const FUSED: bool, const ROWS: usize>(
        &mut self,
        symbolic: &Symbolic,
        front: &Front,
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let (pivots, boundary) = (front.pivots, front.boundary);
        let steps = front.first..front.first + pivots;
        let pieces = &mut self.factors[front.factor_range()];
        let (square, lower) = pieces.split_at_mut(front.square_length());
        self.square.terms[..pivots].copy_from_slice(&self.terms[steps.clone()]);
        let unknowns = &symbolic.unknowns[steps.clone()];
        let mut largest = self.square.factor::<FUSED, ROWS>(square, unknowns, monitor)?;
        for (pivot, &reciprocal) in self.pivots[steps.clone()].iter_mut().zip(&self.square.reciprocals) {
            *pivot = S::one() / reciprocal;
        }
        if boundary == 0 {
            return Ok(largest);
        }

        let (stride, square_stride) = (front.panel_stride(), front.square_stride());
        let reciprocals = Some(&self.square.reciprocals[..pivots]);
        let transposed = (&self.square.transposed[..], square_stride);
        solve_panel::<S, FUSED, ROWS>((lower, stride), transposed, reciprocals, pivots, stride);
        let scaled = &mut self.scaled[..front.panel_length()];
        let columns = scaled.chunks_exact_mut(stride).zip(lower.chunks_exact(stride));
        for ((scaled, lower), &pivot) in columns.zip(&self.pivots[steps]) {
            for (scaled, &lower) in scaled.iter_mut().zip(lower) {
                *scaled = lower * pivot;
            }
        }
        let terms = &mut self.front_terms[..stride];
        terms.fill(0.0);
        largest = largest.max(absolute_products(terms, (lower, scaled), stride, (stride, pivots)));
        for (&step, &term) in symbolic.boundaries[front.rows.clone()].iter().zip(&*terms) {
            self.terms[step as usize] += term;
        }

        let (first, second) = self.stacks.split_at_mut(1);
        let (own, others) =
            if front.stack == 0 { (&mut first[0], &second[0]) } else { (&mut second[0], &first[0]) };
        let contribution = &mut own[front.contribution_range()];
        for begin in (0..boundary).step_by(STRIP) {
            let width = STRIP.min(boundary - begin);
            subtract_product::<S, FUSED, false, ROWS>(
                (&mut contribution[begin * stride + begin..], stride),
                (&lower[begin..], stride),
                (&scaled[begin..], stride),
                (stride - begin, width, pivots),
            );
        }
        for child in &symbolic.children[front.children.clone()] {
            let runs = &symbolic.runs[child.to_boundary.clone()];
            add_lower(contribution, stride, &others[child.contribution.clone()], child, runs);
        }
        Ok(largest)
    }
}

/// Adds the lower triangle of the part of a contribution in the given runs. Runs ascend in child and parent alike, so
/// that the lower triangle goes to the lower triangle.
#[inline(always)]
fn add_lower<S: Scalar>(target: &mut [S], stride: usize, contribution: &[S], child: &Child, runs: &[Run]) {
    for (index, columns) in runs.iter().enumerate() {
        for column in 0..columns.length as usize {
            let to = &mut target[(columns.to as usize + column) * stride..][..stride];
            let from = &contribution[(columns.from as usize + column) * child.stride..][..child.stride];
            for (further, rows) in runs[index..].iter().enumerate() {
                // Of the run that holds the column only what lies below the diagonal.
                let skip = if further == 0 { column } else { 0 };
                let length = rows.length as usize - skip;
                let to = &mut to[rows.to as usize + skip..][..length];
                let from = &from[rows.from as usize + skip..][..length];
                for (to, &from) in to.iter_mut().zip(from) {
                    *to += from;
                }
            }
        }
    }
}

struct Factor<'a, S> {
    pattern: &'a Pattern,
    symbolic: &'a Symbolic,
    numeric: &'a mut Numeric<S>,
    values: &'a [S],
}

impl<S: Scalar> Factor<'_, S> {
    #[inline(always)]
    fn run<const FUSED: bool, const ROWS: usize>(self) -> Result<FactorReport, FactorError> {
        let largest = largest_entry(self.pattern, self.values)?;
        let (monitor, largest_upper) = self.numeric.factor::<FUSED, ROWS>(self.symbolic, self.values)?;
        Ok(monitor.report(largest_upper, largest))
    }
}

impl<S: Scalar> pulp::WithSimd for Factor<'_, S> {
    type Output = Result<FactorReport, FactorError>;

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        // As for LU.
        if V::F64_LANES == 8 {
            if S::COMPLEX { self.run::<true, 4>() } else { self.run::<true, 16>() }
        } else if V::F64_LANES == 4 {
            if S::COMPLEX { self.run::<true, 4>() } else { self.run::<true, 8>() }
        } else {
            self.run::<false, 4>()
        }
    }
}

struct Solve<'a, S> {
    symbolic: &'a Symbolic,
    numeric: &'a Numeric<S>,
    right_hand_side: &'a mut [S],
    vector: &'a mut [S],
    front_vectors: &'a mut FrontVectors<S>,
}

impl<S: Scalar> Solve<'_, S> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let unknowns = &self.symbolic.unknowns;
        for (value, &unknown) in self.vector.iter_mut().zip(unknowns) {
            *value = self.right_hand_side[unknown as usize];
        }
        forward::<S, FUSED>(self.symbolic, self.numeric, self.vector, self.front_vectors);
        backward::<S, FUSED>(self.symbolic, self.numeric, self.vector, self.front_vectors);
        for (&value, &unknown) in self.vector.iter().zip(unknowns) {
            self.right_hand_side[unknown as usize] = value;
        }
    }
}

impl<S: Scalar> pulp::WithSimd for Solve<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        if V::F64_LANES >= 4 { self.run::<true>() } else { self.run::<false>() }
    }
}

/// `x = L⁻¹ x`.
#[inline(always)]
fn forward<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    numeric: &Numeric<S>,
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in &symbolic.fronts {
        let (square, lower) = numeric.factors[front.factor_range()].split_at(front.square_length());
        let pivots = &mut vectors.pivots[..front.square_stride()];
        let place = &mut x[front.first..front.first + front.pivots];
        pivots[..front.pivots].copy_from_slice(place);
        triangular::solve_lower::<S, FUSED>(pivots, square, front.pivots);
        place.copy_from_slice(&pivots[..front.pivots]);
        let sums = &mut vectors.boundary[..front.panel_stride()];
        sums.fill(S::zero());
        triangular::add_columns::<S, FUSED>(sums, lower, place);
        for (&row, &sum) in symbolic.boundaries[front.rows.clone()].iter().zip(&*sums) {
            x[row as usize] -= sum;
        }
    }
}

/// `x = (D Lᵀ)⁻¹ x`.
#[inline(always)]
fn backward<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    numeric: &Numeric<S>,
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in symbolic.fronts.iter().rev() {
        let (square, lower) = numeric.factors[front.factor_range()].split_at(front.square_length());
        triangular::gather(symbolic, front, x, &mut vectors.boundary);
        let steps = front.first..front.first + front.pivots;
        let pivots = &mut vectors.pivots[..front.square_stride()];
        pivots.fill(S::zero());
        let known = &vectors.boundary[..front.panel_stride()];
        triangular::subtract_dots::<S, FUSED>(&mut pivots[..front.pivots], lower, known);
        for ((value, &right), &pivot) in
            pivots.iter_mut().zip(&x[steps.clone()]).zip(&numeric.pivots[steps.clone()])
        {
            *value = S::multiply_add::<FUSED>(*value, pivot, right);
        }
        triangular::solve_upper::<S, FUSED>(pivots, square, front.pivots);
        x[steps].copy_from_slice(&pivots[..front.pivots]);
    }
}
