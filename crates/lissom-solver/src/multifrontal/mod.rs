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
                let (share, diagonal) = numeric.subtrees(symbolic);
                share.factor(*processor, symbolic, values, diagonal);
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
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{Model, Sample, backward_error, chain, grid, right_hand_side, spherical_chain};
    use num_complex::Complex64;

    /// Every level of vector instructions this processor has, and none.
    fn processors() -> Vec<pulp::Arch> {
        let mut processors = vec![pulp::Arch::Scalar, pulp::Arch::new()];
        #[cfg(target_arch = "x86_64")]
        processors.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
        processors
    }

    fn solves<S: Sample + Kernels>(model: &Model) {
        let structure = model.structure();
        let values: Vec<S> = model.values(&structure.pattern, 1, 1.0);
        let b: Vec<S> = right_hand_side(model.size, 2);
        for processor in processors() {
            let mut solver = Multifrontal::<S>::on(processor, &structure, 2);
            solver.factor(&values).expect("a regular matrix");
            for transposed in [false, true] {
                let mut x = b.clone();
                solver.triangular(&mut x, if transposed { Way::Transposed } else { Way::Plain });
                let error = backward_error(&structure.pattern, &values, &x, &b, transposed);
                assert!(error < 1e-12, "{processor:?}: {error:e}");
            }
            let mut side_by_side: Vec<[S; SEVERAL]> = b
                .iter()
                .map(|&value| std::array::from_fn(|lane| value * S::from_real(lane as f64 - 2.5)))
                .collect();
            let asked = side_by_side.clone();
            solver.solve_several(&mut side_by_side);
            for lane in 0..SEVERAL {
                let [x, b] =
                    [&side_by_side, &asked].map(|of| of.iter().map(|row| row[lane]).collect::<Vec<S>>());
                let error = backward_error(&structure.pattern, &values, &x, &b, false);
                assert!(error < 1e-12, "{processor:?}, lane {lane}: {error:e}");
            }
        }
    }

    /// Textbook elimination in the solver's order: smallest pivot, growth, worst cancellation.
    fn monitor(solver: &Multifrontal<f64>, values: &[f64]) -> (f64, f64, f64) {
        assert_eq!(solver.symbolic.parts.len(), 1);
        let order: Vec<u32> = solver
            .symbolic
            .unknowns
            .iter()
            .copied()
            .filter(|&unknown| unknown != elimination_tree::NONE)
            .collect();
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
    fn large_trees_are_shared_and_small_ones_are_not() {
        for (model, subtrees) in
            [(spherical_chain(2_000), 0..1), (spherical_chain(20_000), 2..3), (grid(20_000), 4..100)]
        {
            let mut solver = Multifrontal::<f64>::new(&model.structure());
            let found = solver.symbolic.parts.len() - 1;
            assert!(subtrees.contains(&found), "{found}");
            for threads in 1..4 {
                solver.set_threads(threads);
                let crews = if threads == 1 || found == 0 { 0 } else { threads.min(found) };
                assert_eq!(solver.crews.len(), crews);
                assert_eq!(solver.crews.iter().sum::<usize>(), if crews == 0 { 0 } else { found });
            }
        }
    }

    /// Each part has memory of its own.
    #[test]
    fn thousands_of_trees_are_few_parts() {
        let mut model = crate::samples::Model::default();
        for _ in 0..6000 {
            let node = model.node();
            model.element(&[node]);
        }
        let solver = Multifrontal::<f64>::new(&model.structure());
        let parts = solver.symbolic.parts.len();
        assert!((5..200).contains(&parts), "{parts}");
        solves::<f64>(&model);
    }

    #[test]
    fn every_level_of_vector_instructions_solves() {
        for model in [chain(300), grid(600)] {
            solves::<f64>(&model);
            solves::<Complex64>(&model);
        }
    }
}
