//! Impulses at rigid contacts, or forces with accelerations in place of velocities.
//!
//! Legend, beside that of [impacts](super): p impulse (or force), w = G p + b velocity (or acceleration) after it, G compliance, b without
//! it, β = s e u_n⁻, d direction of sliding.
//!
//! ```text
//! 0 ≤ p_n ⊥ w_n + β ≥ 0;      p_t = -μ p_n d where it slides
//! ```
//!
//! Solved by Gauss-Seidel iteration with projection on the cones [Moreau 1988, Jean 1999]. Compliances may be singular: forces of
//! contacts that repeat each other are then not unique; their motion is without friction.

use nalgebra::{DMatrix, DVector, Vector2};

/// Iterations, for every relaxation.
const MAX_SWEEPS: usize = 20_000;
/// Relaxations that are tried.
const RELAXATIONS: [f64; 3] = [1.0, 0.5, 0.1];
/// Changes below this fraction of the largest velocity have converged.
const CONVERGED: f64 = 1e-14;
/// Changes below this fraction are accepted after the last iteration.
const ACCEPTED: f64 = 1e-9;
/// Iterations after which a drift is examined.
const SWEEPS_OF_DRIFT: usize = 100;
/// Relative change of a drift that is steady.
const STEADY: f64 = 1e-2;
/// Compliances below this fraction of the normal one are not positive.
const POSITIVE: f64 = 1e-9;

/// One contact of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    /// μ.
    pub(crate) friction: f64,
    /// β.
    pub(crate) rebound: f64,
    /// d along the two tangents; none where it does not slide.
    pub(crate) sliding: Option<Vector2<f64>>,
}

/// Contacts with their compliance.
#[derive(Clone, Debug)]
pub(crate) struct ContactProblem {
    /// G.
    pub(crate) compliance: DMatrix<f64>,
    /// b.
    pub(crate) free: DVector<f64>,
    pub(crate) conditions: Vec<Condition>,
}

impl ContactProblem {
    /// The compliance of the normal direction under the normal force and the friction that it allows.
    fn pressed(&self, contact: usize) -> f64 {
        let first = 3 * contact;
        let normal = self.compliance[(first, first)];
        self.conditions[contact].sliding.map_or(normal, |direction| {
            let of = |k: usize| self.compliance[(first, first + 1 + k)] * direction[k];
            normal - self.conditions[contact].friction * (of(0) + of(1))
        })
    }

    /// A contact that slides at which a larger normal force does not push the solids apart: Painlevé's paradox.
    pub(crate) fn paradox(&self) -> Option<usize> {
        let is_paradox = |k: &usize| {
            self.conditions[*k].sliding.is_some()
                && self.compliance[(3 * k, 3 * k)] > 0.0
                && self.pressed(*k) <= POSITIVE * self.compliance[(3 * k, 3 * k)]
        };
        (0..self.conditions.len()).find(is_paradox)
    }

    /// w.
    pub(crate) fn velocities(&self, impulses: &DVector<f64>) -> DVector<f64> {
        &self.compliance * impulses + &self.free
    }

    /// p; none if the iteration finds no solution.
    pub(crate) fn solve(&self) -> Option<DVector<f64>> {
        let rebounds = self.conditions.iter().map(|condition| condition.rebound.abs());
        let scale = rebounds.fold(self.free.amax(), f64::max);
        if scale == 0.0 {
            return Some(DVector::zeros(self.free.len()));
        }
        if (0..self.conditions.len()).any(|k| self.pressed(k) <= 0.0) {
            return None;
        }
        RELAXATIONS.into_iter().find_map(|relaxation| {
            let mut impulses = DVector::zeros(self.free.len());
            let mut change = f64::INFINITY;
            let (mut earlier, mut drift) = (impulses.clone(), DVector::zeros(self.free.len()));
            for sweep in 1..=MAX_SWEEPS {
                change = self.sweep(relaxation, &mut impulses);
                if !change.is_finite() || change <= CONVERGED * relaxation * scale {
                    break;
                }
                if sweep % SWEEPS_OF_DRIFT == 0 {
                    let latest = &impulses - &earlier;
                    if (&latest - &drift).amax() < STEADY * latest.amax() {
                        self.advance(&latest, &mut impulses);
                    }
                    (earlier, drift) = (impulses.clone(), latest);
                }
            }
            (change <= ACCEPTED * relaxation * scale).then_some(impulses)
        })
    }

    /// Moves impulses along a steady drift until a contact has none: contacts that repeat each other cannot all be closed.
    fn advance(&self, drift: &DVector<f64>, impulses: &mut DVector<f64>) {
        let ends = (0..self.conditions.len()).map(|k| (impulses[3 * k], drift[3 * k]));
        let way = ends.filter(|(_, rate)| *rate < 0.0).map(|(impulse, rate)| -impulse / rate);
        let way = way.fold(f64::INFINITY, f64::min);
        if way.is_finite() {
            *impulses += way * drift;
        }
    }

    /// One iteration over all contacts; returns the largest change of a velocity.
    fn sweep(&self, relaxation: f64, impulses: &mut DVector<f64>) -> f64 {
        let mut largest = 0.0_f64;
        for (contact, condition) in self.conditions.iter().enumerate() {
            let first = 3 * contact;
            let velocity = |row: usize, impulses: &DVector<f64>| {
                self.free[row] + self.compliance.column(row).dot(impulses)
            };
            let before = impulses.fixed_rows::<3>(first).clone_owned();
            let own = self.pressed(contact);
            let departure = velocity(first, impulses) + condition.rebound;
            let normal = (before[0] - relaxation * departure / own).max(0.0);
            impulses[first] = normal;
            let largest_friction = condition.friction * normal;
            let friction = if let Some(direction) = condition.sliding {
                -largest_friction * direction
            } else if condition.friction > 0.0 {
                let block = self.compliance.fixed_view::<2, 2>(first + 1, first + 1);
                // At least the larger eigenvalue.
                let own = block.trace().max(f64::MIN_POSITIVE);
                let sliding = Vector2::from_fn(|k, _| velocity(first + 1 + k, impulses));
                let tangential = Vector2::new(before[1], before[2]) - relaxation * sliding / own;
                let length = tangential.norm();
                if length > largest_friction { tangential * (largest_friction / length) } else { tangential }
            } else {
                Vector2::zeros()
            };
            impulses.fixed_rows_mut::<2>(first + 1).copy_from(&friction);
            for k in 0..3 {
                let change = self.compliance[(first + k, first + k)] * (impulses[first + k] - before[k]);
                largest = largest.max(change.abs());
            }
        }
        largest
    }
}

#[cfg(test)]
#[path = "../../tests/unit/impacts/dense.rs"]
mod tests;
