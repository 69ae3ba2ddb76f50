//! Elements that may be stiff, in the matrix of a recovery.

use super::matrix::Run;
use crate::kinematics::Kinematics;
use crate::system::{Linearization, Scratch, System, TangentAssembler};

/// Derivatives of their forces, and whether these matter.
pub(super) struct StiffParts {
    pub(super) derivatives: Linearization,
    /// Entries of the diagonal, by row.
    diagonal: Vec<usize>,
    /// Inertias by row: constant ones, and those of coordinates at the last positions, infinite before; inertias in use.
    known_inertias: Vec<f64>,
    inertias: Vec<f64>,
    /// Whether τ² K is not negligible at these positions.
    pub(super) has_effect: bool,
    /// The run of entries at which a column that is not negligible was found last.
    found_at: usize,
}

impl StiffParts {
    pub(super) fn new((system, at): (&System, &Kinematics)) -> Self {
        let pattern = &system.structure().pattern;
        let rows = 0..system.layout().coordinate_count();
        let mass = system.linearization_at(at).mass;
        let inertia = |row| pattern.position(row, row).map_or(0.0, |position| mass[position]);
        let known_inertias = rows.clone().map(inertia).map(|own| if own > 0.0 { own } else { f64::INFINITY });
        Self {
            known_inertias: known_inertias.collect(),
            inertias: Vec::new(),
            derivatives: system.empty_linearization(),
            diagonal: rows.filter_map(|row| pattern.position(row, row)).collect(),
            has_effect: false,
            found_at: 0,
        }
    }

    pub(super) fn linearize(&mut self, (system, at): (&System, &Kinematics), scratch: &mut Scratch) {
        self.has_effect = false;
        let stiff = &mut self.derivatives;
        // The remaining derivatives are not used.
        for values in [&mut stiff.mass, &mut stiff.damping, &mut stiff.stiffness] {
            values.fill(0.0);
        }
        system.linearize_elements(true, at, scratch, &mut TangentAssembler::Separate(stiff));
    }

    /// Adds M, and τ D + τ² K unless τ² ω² is below `limit` for all frequencies ω. `values` contains the inertias of all other
    /// elements.
    pub(super) fn add(&mut self, between_motions: &[Run], (time, limit): (f64, f64), values: &mut [f64]) {
        values.iter_mut().zip(&self.derivatives.mass).for_each(|(value, mass)| *value += mass);
        if !self.has_effect {
            self.inertias.clear();
            self.inertias.extend(self.diagonal.iter().map(|&position| values[position]));
            self.find_effect(between_motions, (time, limit));
        }
        let stiff = &self.derivatives;
        for run in between_motions.iter().filter(|_| self.has_effect) {
            let own = run.position..run.position + run.length;
            let derivatives = stiff.damping[own.clone()].iter().zip(&stiff.stiffness[own.clone()]);
            for (value, (damping, stiffness)) in values[own].iter_mut().zip(derivatives) {
                *value += time * (damping + time * stiffness);
            }
        }
    }

    /// Whether τ² K has an effect where coordinates without inertia have the inertias of these rows, or those known last.
    pub(super) fn has_effect_with(
        &mut self,
        between_motions: &[Run],
        limit: (f64, f64),
        coordinates: impl Iterator<Item = (usize, f64)>,
    ) -> bool {
        coordinates.for_each(|(row, inertia)| self.known_inertias[row] = inertia);
        self.inertias.clone_from(&self.known_inertias);
        self.find_effect(between_motions, limit)
    }

    fn find_effect(&mut self, between_motions: &[Run], limit: (f64, f64)) -> bool {
        let found = self.exceeding(between_motions, limit);
        (self.has_effect, self.found_at) = (found.is_some(), found.unwrap_or(0));
        self.has_effect
    }

    /// Whether the matrix contains damping.
    pub(super) fn has_damping(&self) -> bool {
        self.has_effect && self.derivatives.damping.iter().any(|value| *value != 0.0)
    }

    /// First run of a column because of which τ² ω² may exceed `limit`: by columns j of τ D + τ² K relative to the inertias M,
    ///
    /// ```text
    /// τ² ω² ≤ max Σ_i |τ D + τ² K|_ij / √(M_ii M_jj)
    /// ```
    ///
    /// The search begins with the column that was found last.
    fn exceeding(&self, runs: &[Run], (time, limit): (f64, f64)) -> Option<usize> {
        let stiff = &self.derivatives;
        let inertia = |row: usize| self.inertias[row];
        let of_run = |run: &Run| {
            let terms = (0..run.length).map(|k| {
                let entry = run.position + k;
                let change = time * (stiff.damping[entry] + time * stiff.stiffness[entry]);
                if change == 0.0 { 0.0 } else { change.abs() / inertia(run.row + k).sqrt() }
            });
            terms.sum::<f64>()
        };
        let (before, after) = runs.split_at(self.found_at);
        for (mut start, runs) in [(self.found_at, after), (0, before)] {
            for column in runs.chunk_by(|run, next| run.column == next.column) {
                let sum: f64 = column.iter().map(of_run).sum();
                if sum > 0.0 && sum > limit * inertia(column[0].column).sqrt() {
                    return Some(start);
                }
                start += column.len();
            }
        }
        None
    }
}
