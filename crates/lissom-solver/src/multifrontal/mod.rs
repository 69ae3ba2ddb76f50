//! Multifrontal LU without pivoting, the default solver: everything except the numbers is determined once, in the
//! symbolic analysis. Independent of the meaning of groups and patterns.
//!
//! The order of elimination is that of [`crate::minimum_degree_order`]; groups are gathered into dense fronts (Duff &
//! Reid 1983, ACM Trans. Math. Softw. 9, 302), each of which passes the remainder to its parent in the elimination
//! tree. Vector instructions are selected once for every call, by the present processor.

mod contributions;
mod elimination_tree;
mod factorisation;
mod fronts;
mod instances;
mod kernels;
mod several;
mod small;
mod small_solves;
mod square;
mod subtrees;
mod supernodes;
mod sweeps;
mod symmetric;
mod threads;
mod triangular;

use std::sync::Arc;

pub use instances::Kernels;
pub use symmetric::Symmetric;

use factorisation::Numeric;
use fronts::Symbolic;
use instances::Largest;
use several::Several;
use sweeps::{Backward, Factors, Forward, Sweep, Way};
use triangular::FrontVectors;

use crate::entries::first_not_finite;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport};
use crate::scalar::Scalar;
use crate::solver::{LinearSolver, SEVERAL};
use crate::structure::Structure;

pub(crate) const NAME: &str = "sparse";

/// Multifrontal solver without pivoting.
pub struct Multifrontal<S> {
    pattern: Arc<Pattern>,
    processor: pulp::Arch,
    symbolic: Symbolic,
    numeric: Numeric<S>,
    vector: Vec<S>,
    front_vectors: Vec<FrontVectors<S>>,
    /// Vectors of several right-hand sides, with storage for a front; empty until they are requested.
    several: [Vec<[S; SEVERAL]>; 2],
    /// Number of subtrees of each thread; none with a single one.
    crews: Vec<usize>,
}

impl<S: Kernels> Multifrontal<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] rejects the structure.
    pub fn new(structure: &Structure) -> Self {
        Self::of_panels(structure, 2)
    }

    /// For LU, with two panels per front, or for LDLᵀ, with one.
    fn of_panels(structure: &Structure, panels: usize) -> Self {
        Self::on(pulp::Arch::new(), structure, panels)
    }

    /// For that processor.
    fn on(processor: pulp::Arch, structure: &Structure, panels: usize) -> Self {
        let symbolic = Symbolic::new(structure, panels, S::eliminates_small(processor));
        let pattern = Arc::clone(&structure.pattern);
        Multifrontal {
            processor,
            numeric: Numeric::new(&symbolic, &pattern),
            vector: vec![S::zero(); symbolic.unknowns.len()],
            front_vectors: symbolic.parts.iter().map(FrontVectors::new).collect(),
            several: [Vec::new(), Vec::new()],
            crews: Vec::new(),
            symbolic,
            pattern,
        }
    }

    fn factor_values(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        let Self { pattern, processor, symbolic, numeric, crews, .. } = self;
        let largest = if crews.is_empty() {
            let largest = S::largest(*processor, Largest { values });
            if largest.is_some() {
                let (share, diagonal, benches) = numeric.subtrees(symbolic);
                share.factor(*processor, symbolic, (values, diagonal), &mut benches[0]);
            }
            largest
        } else {
            threads::factor(*processor, symbolic, numeric, values, crews)
        };
        let largest = largest.ok_or_else(|| first_not_finite(pattern, values))?;
        let (monitor, largest_upper) = numeric.factor_top(*processor, symbolic, values)?;
        Ok(monitor.report::<S>(largest_upper, largest))
    }

    fn triangular(&mut self, right_hand_side: &mut [S], way: Way) {
        assert_eq!(right_hand_side.len(), self.pattern.size(), "one number for each unknown");
        let Self { processor, symbolic, numeric, vector, front_vectors, crews, .. } = self;
        let factors = Factors { symbolic, numeric, way };
        let crews =
            if threads::pay_in_solves(symbolic.factor_length * size_of::<S>()) { &crews[..] } else { &[] };
        let right_hand_side_of_subtrees = Some(&*right_hand_side);
        threads::sweep(crews, split(symbolic, vector, front_vectors).0, |sweep| {
            S::forward(*processor, Forward { factors, right_hand_side: right_hand_side_of_subtrees, sweep });
        });
        symbolic.hand_up(right_hand_side, vector);
        let sweep = split(symbolic, vector, front_vectors).1;
        S::forward(*processor, Forward { factors, right_hand_side: None, sweep });
        S::backward(*processor, Backward { factors, sweep: split(symbolic, vector, front_vectors).1 });
        symbolic.hand_down(vector);
        threads::sweep(crews, split(symbolic, vector, front_vectors).0, |sweep| {
            S::backward(*processor, Backward { factors, sweep });
        });
        for (value, &step) in right_hand_side.iter_mut().zip(&symbolic.steps) {
            *value = vector[step as usize];
        }
    }
}

/// The subtrees, and the top.
fn split<'a, S: Scalar>(
    symbolic: &'a Symbolic,
    vector: &'a mut [S],
    front_vectors: &'a mut [FrontVectors<S>],
) -> (Sweep<'a, S>, Sweep<'a, S>) {
    Sweep { parts: &symbolic.parts, vector, front_vectors }.split(symbolic.parts.len() - 1)
}

impl<S: Kernels> LinearSolver<S> for Multifrontal<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        self.factor_values(values)
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, Way::Plain);
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, Way::Transposed);
    }

    fn solve_several(&mut self, right_hand_sides: &mut [[S; SEVERAL]]) {
        assert_eq!(right_hand_sides.len(), self.pattern.size(), "one row for each unknown");
        let Self { processor, symbolic, numeric, several, .. } = self;
        let room = symbolic.parts.iter().map(|part| part.largest_pivots + part.largest_boundary);
        let [vector, front] = several;
        vector.resize(symbolic.unknowns.len(), [S::zero(); SEVERAL]);
        front.resize(room.max().unwrap_or(0), [S::zero(); SEVERAL]);
        processor.dispatch(Several { symbolic, numeric, right_hand_sides, vector, front });
    }

    fn factor_entries(&self) -> usize {
        self.symbolic.factor_entries
    }

    fn set_threads(&mut self, threads: usize) {
        let (_, subtrees) = self.symbolic.parts.split_last().expect("there always is a top");
        self.crews = threads::crews(subtrees, threads);
        self.numeric.set_threads(&self.symbolic, self.crews.len());
    }
}

#[cfg(test)]
#[path = "../../tests/unit/multifrontal/mod.rs"]
mod tests;
