//! Multifrontal LU without pivoting, the default solver: everything but the numbers is settled once, in the
//! symbolic analysis. Knows groups and patterns, nothing of what they stand for.
//!
//! The order of elimination comes from [`crate::minimum_degree_order`]; groups are gathered into dense fronts
//! (Duff & Reid 1983, ACM Trans. Math. Softw. 9, 302), each of which hands what is left to its parent in the
//! elimination tree. Vector instructions are chosen once for every call, by the processor at hand.

mod elimination_tree;
mod factorisation;
mod fronts;
mod kernels;
mod square;
mod supernodes;
mod symmetric;
mod triangular;

use std::sync::Arc;

pub use symmetric::Symmetric;

use factorisation::Numeric;
use fronts::Symbolic;
use triangular::FrontVectors;

use crate::entries::largest_entry;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

pub(crate) const NAME: &str = "sparse";

/// Multifrontal solver without pivoting.
pub struct Multifrontal<S> {
    pattern: Arc<Pattern>,
    processor: pulp::Arch,
    symbolic: Symbolic,
    numeric: Numeric<S>,
    vector: Vec<S>,
    front_vectors: FrontVectors<S>,
}

impl<S: Scalar> Multifrontal<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] refuses the structure.
    pub fn new(structure: &Structure) -> Self {
        Self::of_panels::<false>(structure)
    }

    /// For LU, with two panels to a front, or for LDLᵀ, with one.
    fn of_panels<const SYMMETRIC: bool>(structure: &Structure) -> Self {
        let symbolic = Symbolic::new(structure, if SYMMETRIC { 1 } else { 2 });
        let pattern = Arc::clone(&structure.pattern);
        Multifrontal {
            processor: pulp::Arch::new(),
            numeric: Numeric::new::<SYMMETRIC>(&symbolic, &pattern),
            vector: vec![S::zero(); symbolic.unknowns.len()],
            front_vectors: FrontVectors::new(&symbolic),
            symbolic,
            pattern,
        }
    }

    fn factor_as<const SYMMETRIC: bool>(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        let Self { pattern, symbolic, numeric, .. } = self;
        self.processor.dispatch(Factor::<_, SYMMETRIC> { pattern, symbolic, numeric, values })
    }

    fn triangular(&mut self, right_hand_side: &mut [S], way: Way) {
        assert_eq!(right_hand_side.len(), self.vector.len(), "one number for each unknown");
        self.processor.dispatch(Solve {
            symbolic: &self.symbolic,
            numeric: &self.numeric,
            right_hand_side,
            vector: &mut self.vector,
            front_vectors: &mut self.front_vectors,
            way,
        });
    }
}

impl<S: Scalar> LinearSolver<S> for Multifrontal<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        self.factor_as::<false>(values)
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, Way::Plain);
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, Way::Transposed);
    }

    fn factor_entries(&self) -> usize {
        self.symbolic.factor_entries
    }
}

/// LU, or LDLᵀ.
struct Factor<'a, S, const SYMMETRIC: bool> {
    pattern: &'a Pattern,
    symbolic: &'a Symbolic,
    numeric: &'a mut Numeric<S>,
    values: &'a [S],
}

impl<S: Scalar, const SYMMETRIC: bool> Factor<'_, S, SYMMETRIC> {
    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn run<const FUSED: bool, const ROWS: usize>(self) -> Result<FactorReport, FactorError> {
        let largest = largest_entry(self.pattern, self.values)?;
        let (monitor, largest_upper) =
            self.numeric.factor::<FUSED, ROWS, SYMMETRIC>(self.symbolic, self.values)?;
        Ok(monitor.report(largest_upper, largest))
    }
}

impl<S: Scalar, const SYMMETRIC: bool> pulp::WithSimd for Factor<'_, S, SYMMETRIC> {
    type Output = Result<FactorReport, FactorError>;

    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) -> Self::Output {
        // Two vectors of rows, of real or of complex numbers summed twice: twelve sums for six columns. With four
        // lanes or more the processor multiplies and adds in one instruction.
        if V::F64_LANES == 8 {
            if S::COMPLEX { self.run::<true, 4>() } else { self.run::<true, 16>() }
        } else if V::F64_LANES == 4 {
            if S::COMPLEX { self.run::<true, 4>() } else { self.run::<true, 8>() }
        } else {
            self.run::<false, 4>()
        }
    }
}

/// What is solved with.
#[derive(Clone, Copy)]
enum Way {
    /// L U.
    Plain,
    /// (L U)ᵀ.
    Transposed,
    /// L D Lᵀ.
    Symmetric,
}

struct Solve<'a, S> {
    symbolic: &'a Symbolic,
    numeric: &'a Numeric<S>,
    right_hand_side: &'a mut [S],
    vector: &'a mut [S],
    front_vectors: &'a mut FrontVectors<S>,
    way: Way,
}

impl<S: Scalar> Solve<'_, S> {
    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let unknowns = &self.symbolic.unknowns;
        for (value, &unknown) in self.vector.iter_mut().zip(unknowns) {
            *value = self.right_hand_side[unknown as usize];
        }
        let Solve { symbolic, numeric, vector, front_vectors, way, .. } = self;
        let factors = &numeric.factors;
        match way {
            Way::Plain => triangular::solve::<S, FUSED>(symbolic, factors, vector, front_vectors),
            Way::Transposed => {
                triangular::solve_transposed::<S, FUSED>(symbolic, factors, vector, front_vectors);
            }
            Way::Symmetric => symmetric::solve::<S, FUSED>(symbolic, numeric, vector, front_vectors),
        }
        for (&value, &unknown) in vector.iter().zip(unknowns) {
            self.right_hand_side[unknown as usize] = value;
        }
    }
}

impl<S: Scalar> pulp::WithSimd for Solve<'_, S> {
    type Output = ();

    #[expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]
    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        if V::F64_LANES >= 4 { self.run::<true>() } else { self.run::<false>() }
    }
}

#[cfg(all(test, feature = "samples"))]
mod tests {
    use super::*;
    use crate::samples::{Model, Sample, backward_error, chain, grid, right_hand_side};
    use num_complex::Complex64;

    /// Every level of vector instructions this processor has, and none.
    fn processors() -> Vec<pulp::Arch> {
        let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
        #[cfg(target_arch = "x86_64")]
        processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
        processors
    }

    fn solves<S: Sample>(model: &Model) {
        let structure = model.structure();
        let values: Vec<S> = model.values(&structure.pattern, 1, 1.0);
        let b: Vec<S> = right_hand_side(model.size, 2);
        for processor in processors() {
            let mut solver = Multifrontal::<S>::new(&structure);
            solver.processor = processor;
            solver.factor(&values).expect("a regular matrix");
            for transposed in [false, true] {
                let mut x = b.clone();
                solver.triangular(&mut x, if transposed { Way::Transposed } else { Way::Plain });
                let error = backward_error(&structure.pattern, &values, &x, &b, transposed);
                assert!(error < 1e-12, "{processor:?}: {error:e}");
            }
        }
    }

    /// Elimination by the book, in the solver's order: smallest pivot, growth, worst cancellation.
    fn monitor(solver: &Multifrontal<f64>, values: &[f64]) -> (f64, f64, f64) {
        let order = &solver.symbolic.unknowns;
        let entry = |row: u32, column: u32| solver.pattern.position(row as usize, column as usize);
        let mut matrix: Vec<Vec<f64>> = order
            .iter()
            .map(|&row| order.iter().map(|&column| entry(row, column).map_or(0.0, |at| values[at])).collect())
            .collect();
        let mut terms: Vec<f64> = (0..order.len()).map(|step| matrix[step][step].abs()).collect();
        let (mut smallest, mut largest, mut cancellation) = (f64::INFINITY, 0.0_f64, f64::INFINITY);
        for step in 0..order.len() {
            let pivot_row = matrix[step].clone();
            smallest = smallest.min(pivot_row[step].abs());
            cancellation = cancellation.min(pivot_row[step].abs() / terms[step]);
            largest = pivot_row[step..].iter().fold(largest, |largest, value| largest.max(value.abs()));
            for row in step + 1..order.len() {
                let factor = matrix[row][step] / pivot_row[step];
                terms[row] += (factor * pivot_row[row]).abs();
                for column in step..order.len() {
                    matrix[row][column] -= factor * pivot_row[column];
                }
            }
        }
        (
            smallest,
            largest / values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs())),
            cancellation,
        )
    }

    #[test]
    fn the_report_is_that_of_plain_elimination() {
        for model in [chain(200), grid(400)] {
            let structure = model.structure();
            let values: Vec<f64> = model.values(&structure.pattern, 3, 1.0);
            let mut solver = Multifrontal::<f64>::new(&structure);
            assert!(solver.symbolic.fronts.len() > 3);
            let report = solver.factor(&values).expect("a regular matrix");
            let (smallest, growth, cancellation) = monitor(&solver, &values);
            let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
            assert!(close(report.smallest_pivot, smallest), "{report:?}: {smallest}");
            assert!(close(report.growth, growth), "{report:?}: {growth}");
            assert!(close(report.worst_cancellation, cancellation), "{report:?}: {cancellation}");
        }
    }

    #[test]
    fn every_level_of_vector_instructions_solves() {
        for model in [chain(300), grid(600)] {
            solves::<f64>(&model);
            solves::<Complex64>(&model);
        }
    }
}
