//! Unconstrained motions without stiffness, along which no force acts. An equilibrium does not determine the positions
//! of such parts.
//!
//! ```text
//! x ← (K + s² M + constraints)⁻¹ M x,      s² a small fraction of k/m:      the iteration converges to the null space of K
//! ```

use std::collections::BTreeSet;

use super::krylov::Noise;
use super::model::{LinearModel, nothing, point};
use super::shifted::{GeneralShift, small_square};
use crate::errors::MAX_LISTED;
use crate::kinematics::{LOCKED, Quantity, Subject};
use crate::round_off;

/// s² over the small square of the model at first …
const SHIFT: f64 = 1e-4;
/// … and its growth for the next attempt, if constraints under load could not be satisfied with it.
const LARGER: f64 = 100.0;
const ATTEMPTS: usize = 4;
/// Number of solutions: a motion whose squared rate is ten times s² is reduced to 1e-12.
const SOLUTIONS: usize = 12;
/// Corrections of each solution, after which the violation of constraints must be below this [-].
const REFINEMENTS: usize = 4;
const VIOLATED: f64 = 1e-13;
/// A stiffness is zero if its squared rate is below this fraction of the small square, or is round-off of its terms.
const NO_RATE: f64 = 1e-10;

/// Work of forces along a motion.
struct ForcesAlong {
    /// Their work [J].
    work: f64,
    /// Sum of the magnitudes of their contributions [J].
    of_terms: f64,
    /// Their work if all acted along the largest displacement [J].
    possible: f64,
    /// The largest displacement [m].
    way: f64,
}

impl LinearModel<'_> {
    /// Names of parts that can move freely: coordinates of joints, and nodes of parts whose joints have no moving
    /// coordinate. None if everything is constrained, or if the state is not at rest.
    pub(crate) fn free_motion(&self) -> Option<Subject> {
        if !self.is_at_rest() || self.system.layout().state_count() > 0 {
            return None;
        }
        let motion = self.softest_motion()?;
        let forces = self.forces_along(&motion);
        let (stiffness, of_terms) = self.form(&self.parts.stiffness, &motion);
        let (mass, _) = self.form(&self.parts.mass, &motion);
        let is_unresisted = stiffness.abs() <= round_off::MATRIX_ENTRY * of_terms
            || stiffness.abs() <= round_off::EQUILIBRIUM * forces.possible * forces.way / self.length()
            || stiffness.abs() <= NO_RATE * small_square(&self.representative) * mass;
        let is_unforced = forces.work.abs() <= round_off::FORCE * forces.of_terms
            || forces.work.abs() <= round_off::EQUILIBRIUM * forces.possible;
        (is_unresisted && is_unforced).then(|| self.names_of(&motion))
    }

    /// The motion with the smallest squared rate, on the rows of the coordinates; none if it cannot be computed.
    fn softest_motion(&self) -> Option<Vec<f64>> {
        let mut square = SHIFT * small_square(&self.representative);
        (0..ATTEMPTS).find_map(|_| {
            let found = self.softest_motion_at(square);
            square *= LARGER;
            found
        })
    }

    /// Softest motion with s² = `square`; none if it is too small for constraints to be satisfied.
    fn softest_motion_at(&self, square: f64) -> Option<Vec<f64>> {
        let (pattern, count) = (self.pattern(), self.coordinate_count());
        let mut parts = self.parts.clone();
        parts.damping.fill(0.0);
        let mut solver = GeneralShift::<f64>::new(self.system, &self.representative);
        solver.factor(&parts, square.sqrt()).ok()?;
        let whole: Vec<f64> = (0..pattern.entries())
            .map(|k| parts.stiffness[k] + square * parts.mass[k] + parts.constraint[k])
            .collect();
        let mut noise = Noise(1);
        let mut motion: Vec<f64> = (0..pattern.size()).map(|_| noise.number()).collect();
        let (mut forces, mut product) = (vec![0.0; pattern.size()], vec![0.0; pattern.size()]);
        for _ in 0..SOLUTIONS {
            motion[count..].fill(0.0);
            pattern.multiply(&parts.mass, &motion, &mut forces);
            forces[count..].fill(0.0);
            motion.fill(0.0);
            // Refined: constraints are satisfied although they are regularised in the factors.
            for _ in 0..REFINEMENTS {
                pattern.multiply(&whole, &motion, &mut product);
                let mut rest: Vec<f64> =
                    forces.iter().zip(&product).map(|(force, own)| force - own).collect();
                solver.solve(&mut rest);
                rest[count..].iter_mut().for_each(|value| *value *= solver.multiplier_factor());
                motion.iter_mut().zip(&rest).for_each(|(value, change)| *value += change);
            }
            let size = motion[..count].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            if !(size.is_finite() && size > 0.0) {
                return None;
            }
            for value in &mut motion {
                *value /= size;
            }
        }
        motion[count..].fill(0.0);
        (self.violation(&motion) <= VIOLATED).then_some(motion)
    }

    /// Work of the forces at the state along a motion that satisfies the constraints.
    fn forces_along(&self, motion: &[f64]) -> ForcesAlong {
        let count = self.coordinate_count();
        let mut forces = vec![0.0; motion.len()];
        let (still, unchanged) = nothing(&self.at);
        // Multipliers do no work along it.
        let zeros = vec![0.0; self.multipliers().len()];
        self.system.residual(&point(&self.at, (&still, &unchanged), &zeros, &zeros), &mut forces);
        let way = (0..count).map(|row| self.way(motion, row)).fold(0.0, f64::max);
        let mut along = ForcesAlong { work: 0.0, of_terms: 0.0, possible: 0.0, way };
        for (row, &force) in forces.iter().enumerate().take(count) {
            let term = force * motion[row];
            along.work += term;
            along.of_terms += term.abs();
            along.possible += force.abs() * way / self.unit(row);
        }
        along
    }

    /// Factor that converts the coordinate of a row to a length.
    fn unit(&self, row: usize) -> f64 {
        match self.system.layout().quantities()[row] {
            Quantity::Angle => self.length(),
            Quantity::Length | Quantity::State => 1.0,
        }
    }

    /// Displacement of the coordinate of a row, as a length.
    fn way(&self, motion: &[f64], row: usize) -> f64 {
        motion[row].abs() * self.unit(row)
    }

    /// xᵀ A x for the matrix A with these values, and the sum of the magnitudes of its terms.
    fn form(&self, values: &[f64], motion: &[f64]) -> (f64, f64) {
        let pattern = self.pattern();
        let (mut sum, mut sizes) = (0.0, 0.0);
        for (column, factor) in motion.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            for (&row, &value) in pattern.row_indices()[range.clone()].iter().zip(&values[range]) {
                let term = motion[row] * value * factor;
                sum += term;
                sizes += term.abs();
            }
        }
        (sum, sizes)
    }

    /// Coordinates of joints that move; if there are none, the degree of freedom with the largest motion of each
    /// part.
    fn names_of(&self, motion: &[f64]) -> Subject {
        let layout = self.system.layout();
        let size = |row: usize| self.way(motion, row);
        let count = self.coordinate_count();
        let largest = (0..count).map(size).fold(0.0, f64::max);
        let moves = |row: &usize| size(*row) > round_off::NEGLIGIBLE * largest;
        let of_joints = layout.coordinates().map(|coordinate| layout.row_of_coordinate(coordinate));
        let mut rows: Vec<usize> = of_joints.filter(moves).collect();
        if rows.is_empty() {
            let mut named = BTreeSet::new();
            for node in layout.nodes() {
                let own =
                    layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED).map(|&row| row as usize);
                let most = own.filter(moves).max_by(|a, b| size(*a).total_cmp(&size(*b)));
                let part = layout.node_name(node).split(['.', '@']).next().unwrap_or_default();
                if let Some(row) = most
                    && named.insert(part)
                {
                    rows.push(row);
                }
            }
        }
        let more = rows.len().saturating_sub(MAX_LISTED);
        let named = Subject::list(rows.iter().take(MAX_LISTED).map(|&row| layout.subject_of(row)).collect());
        if more > 0 { named.clone().called(format!("{named} and {more} more")) } else { named }
    }
}
