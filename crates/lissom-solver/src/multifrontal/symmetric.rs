//! Multifrontal LDLᵀ without pivoting, for symmetric matrices: half the panels and half the products of LU. Shares
//! everything symbolic and all kernels with it.
//!
//! Squares of fronts are factored as LU, whose `U` is `D Lᵀ`; of what a front contributes to its parent only the lower
//! triangle is formed.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::sync::Arc;

use super::Factor;
use super::factorisation::Numeric;
use super::fronts::Symbolic;
use super::triangular::{self, FrontVectors};
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

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
            numeric: Numeric::new::<true>(&symbolic, &pattern),
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
        self.processor.dispatch(Factor::<_, true> { pattern, symbolic, numeric, values })
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
