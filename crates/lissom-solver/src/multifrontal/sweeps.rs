//! Solves in the parts of the tree: forward through the subtrees and the top, then backward. Determines the data passed
//! between parts, not the solution of a part.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::factorisation::Numeric;
use super::fronts::{Part, Symbolic};
use super::triangular::{self, FrontVectors};
use crate::scalar::Scalar;

/// The numbers of some parts, in order.
pub(super) struct Sweep<'a, S> {
    pub(super) parts: &'a [Part],
    pub(super) vector: &'a mut [S],
    pub(super) front_vectors: &'a mut [FrontVectors<S>],
}

impl<'a, S: Scalar> Sweep<'a, S> {
    /// The first `count` parts, and the others.
    pub(super) fn split(self, count: usize) -> (Sweep<'a, S>, Sweep<'a, S>) {
        let (parts, other_parts) = self.parts.split_at(count);
        let steps = parts.iter().map(|part| part.steps.len()).sum();
        let (vector, other_vector) = self.vector.split_at_mut(steps);
        let (front_vectors, other_front_vectors) = self.front_vectors.split_at_mut(count);
        (
            Sweep { parts, vector, front_vectors },
            Sweep { parts: other_parts, vector: other_vector, front_vectors: other_front_vectors },
        )
    }

    /// Each part with its numbers.
    #[inline(always)]
    fn each(self) -> impl Iterator<Item = (&'a Part, &'a mut [S], &'a mut FrontVectors<S>)> {
        let mut rest = self.vector;
        self.parts.iter().zip(self.front_vectors).map(move |(part, front_vectors)| {
            let own;
            (own, rest) = std::mem::take(&mut rest).split_at_mut(part.steps.len());
            (part, own, front_vectors)
        })
    }
}

/// The system that is solved.
#[derive(Clone, Copy)]
pub(super) enum Way {
    /// L U.
    Plain,
    /// (L U)ᵀ.
    Transposed,
    /// L D Lᵀ.
    Symmetric,
}

/// The factors, and the system that is solved.
#[derive(Clone, Copy)]
pub(super) struct Factors<'a, S> {
    pub(super) symbolic: &'a Symbolic,
    pub(super) numeric: &'a Numeric<S>,
    pub(super) way: Way,
}

impl<S: Scalar> Factors<'_, S> {
    /// Forward substitution; copies the right-hand side first, if there is one.
    #[inline(always)]
    pub(super) fn forward<const FUSED: bool>(self, right_hand_side: Option<&[S]>, sweep: Sweep<S>) {
        for (part, vector, front_vectors) in sweep.each() {
            if let Some(right_hand_side) = right_hand_side {
                self.symbolic.take(part, right_hand_side, vector);
            }
            self.forward_part::<FUSED>(part, vector, front_vectors);
        }
    }

    /// Backward substitution.
    #[inline(always)]
    pub(super) fn backward<const FUSED: bool>(self, sweep: Sweep<S>) {
        for (part, vector, front_vectors) in sweep.each() {
            self.backward_part::<FUSED>(part, vector, front_vectors);
        }
    }

    #[inline(always)]
    fn forward_part<const FUSED: bool>(self, part: &Part, x: &mut [S], vectors: &mut FrontVectors<S>) {
        let (tree, factors) = ((self.symbolic, part), &self.numeric.factors[..]);
        match self.way {
            Way::Transposed => triangular::forward_transposed::<S, FUSED>(tree, factors, x, vectors),
            Way::Plain | Way::Symmetric => triangular::forward::<S, FUSED>(tree, factors, x, vectors),
        }
    }

    #[inline(always)]
    fn backward_part<const FUSED: bool>(self, part: &Part, x: &mut [S], vectors: &mut FrontVectors<S>) {
        let (tree, factors) = ((self.symbolic, part), &self.numeric.factors[..]);
        match self.way {
            Way::Plain => triangular::backward::<S, FUSED>(tree, factors, x, vectors),
            Way::Transposed => triangular::backward_transposed::<S, FUSED>(tree, factors, x, vectors),
            Way::Symmetric => {
                triangular::backward_symmetric::<S, FUSED>(tree, (factors, &self.numeric.pivots), x, vectors);
            }
        }
    }
}

impl Symbolic {
    /// Copies the right-hand side of a part.
    fn take<S: Scalar>(&self, part: &Part, right_hand_side: &[S], vector: &mut [S]) {
        let (unknowns, places) = vector.split_at_mut(part.places.start - part.steps.start);
        for (value, &unknown) in unknowns.iter_mut().zip(&self.unknowns[part.steps.clone()]) {
            *value = right_hand_side.get(unknown as usize).copied().unwrap_or_default();
        }
        places.fill(S::zero());
    }

    /// The right-hand side of the top, with the contributions of the subtrees.
    pub(super) fn hand_up<S: Scalar>(&self, right_hand_side: &[S], vector: &mut [S]) {
        let Some((top, subtrees)) = self.parts.split_last() else { return };
        let (below, vector) = vector.split_at_mut(top.steps.start);
        self.take(top, right_hand_side, vector);
        for part in subtrees {
            for (&step, &value) in part.outside.iter().zip(&below[part.places.clone()]) {
                vector[step as usize - top.steps.start] += value;
            }
        }
    }

    /// Passes the values of the top to the subtrees.
    pub(super) fn hand_down<S: Scalar>(&self, vector: &mut [S]) {
        let Some((top, subtrees)) = self.parts.split_last() else { return };
        let (below, vector) = vector.split_at_mut(top.steps.start);
        for part in subtrees {
            for (&step, value) in part.outside.iter().zip(&mut below[part.places.clone()]) {
                *value = vector[step as usize - top.steps.start];
            }
        }
    }
}

pub struct Forward<'a, S> {
    pub(super) factors: Factors<'a, S>,
    pub(super) right_hand_side: Option<&'a [S]>,
    pub(super) sweep: Sweep<'a, S>,
}

impl<S: Scalar> pulp::WithSimd for Forward<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Forward { factors, right_hand_side, sweep } = self;
        if V::F64_LANES >= 4 {
            factors.forward::<true>(right_hand_side, sweep);
        } else {
            factors.forward::<false>(right_hand_side, sweep);
        }
    }
}

pub struct Backward<'a, S> {
    pub(super) factors: Factors<'a, S>,
    pub(super) sweep: Sweep<'a, S>,
}

impl<S: Scalar> pulp::WithSimd for Backward<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        if V::F64_LANES >= 4 {
            self.factors.backward::<true>(self.sweep);
        } else {
            self.factors.backward::<false>(self.sweep);
        }
    }
}
