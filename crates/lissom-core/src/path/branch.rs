//! Branch switching at a bifurcation [Riks 1979; Keller 1977].
//!
//! Legend: φ null vector of the stiffness there, orthogonal to the path and of length 1, W metric of the path. The first equilibrium
//! of the branch is solved for with φᵀW²(q - q_b) = ε, a condition that the primary path does not satisfy.

use super::equations::Condition;
use super::{CriticalKind, CriticalPoint, EquilibriumPath, PathError, PathStep, Solution, Tangent};
use crate::errors::StepError;
use crate::kinematics::Subject;
use crate::system::State;

/// Distances ε of the first equilibrium on a branch, in the order of the attempts [-].
const DISTANCES: [f64; 6] = [0.02, 0.05, 0.01, 0.1, 0.005, 0.2];
/// Offsets from the bifurcation at which the mode is computed, as step fractions.
const ASIDE: [f64; 8] = [0.0, -1e-7, 1e-7, -1e-6, 1e-6, -1e-5, -1e-4, -1e-3];
/// Largest component of the first step along the primary path, relative to its length.
const MAX_STRAIGHT_ON: f64 = 0.9;

/// Branch to follow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BranchChoice {
    /// Number of the bifurcation at which the path is left, counted from 1; 0 to stay on the primary path.
    pub number: usize,
    /// Whether the branch is followed in the opposite direction, in which the largest component of the mode is negative.
    pub is_reversed: bool,
}

/// Bifurcation at which the path is to be left.
pub(super) struct BranchPoint {
    /// Direction of the branch; the load factor is constant along it.
    pub(super) tangent: Tangent,
    /// Direction of the primary path.
    along: Vec<f64>,
}

impl EquilibriumPath {
    /// Counts the bifurcations among the `critical` points of a step of `length`. If the requested one is among them, the step ends
    /// there, and later points are removed. Returns false otherwise.
    ///
    /// # Errors
    /// If there is no equilibrium near the bifurcation with a regular stiffness.
    pub(super) fn stop_at_bifurcation(
        &mut self,
        start: &State,
        length: f64,
        critical: &mut Vec<CriticalPoint>,
    ) -> Result<bool, StepError> {
        let wanted = self.settings.branch.number;
        let mut met = self.bifurcations;
        for k in 0..critical.len() {
            if critical[k].kind != CriticalKind::Bifurcation {
                continue;
            }
            met += 1;
            if met != wanted {
                continue;
            }
            let place = critical[k].arc - self.arc;
            let (distance, found, mode) = self.beside(start, place, length)?;
            let along = found.tangent.direction.clone();
            let share = self.work.inner(&mode, &along);
            let mut direction: Vec<f64> =
                mode.iter().zip(&along).map(|(mode, along)| mode - share * along).collect();
            let length = self.work.inner(&direction, &direction).sqrt();
            let sense = if self.settings.branch.is_reversed { -1.0 } else { 1.0 };
            let factor = sense * self.work.sense_of_largest(&direction) / length;
            for value in &mut direction {
                *value *= factor;
            }
            let tangent = Tangent { direction, load_rate: 0.0, turn: 0.0, unstable: 0, signature: 0.0 };
            self.branch_point = Some(BranchPoint { tangent, along });
            self.take(found, distance);
            critical.truncate(k + 1);
            self.bifurcations = met;
            return Ok(true);
        }
        self.bifurcations = met;
        Ok(false)
    }

    /// The equilibrium at the distance `place`, or close to it, and the softest direction of its stiffness, which is singular at the
    /// bifurcation itself.
    fn beside(
        &mut self,
        start: &State,
        place: f64,
        length: f64,
    ) -> Result<(f64, Solution, Vec<f64>), StepError> {
        let mut last = None;
        for aside in ASIDE {
            let distance = (place + aside * length).clamp(0.0, length);
            match self.solve_for_mode(start, distance) {
                Ok((found, mode)) if mode.iter().all(|value| value.is_finite()) => {
                    return Ok((distance, found, mode));
                }
                Ok(_) => {}
                Err(error) => last = Some(error),
            }
        }
        Err(last.unwrap_or(StepError::NotConverged {
            time: start.kinematics.time,
            iterations: 0,
            correction: 0.0,
            worst: Subject::nameless("the mode of the bifurcation"),
            hint: "use a smaller `step`",
        }))
    }

    /// Steps to the first equilibrium of the branch.
    pub(super) fn switch_branch(
        &mut self,
        branch_point: &BranchPoint,
        report: &mut PathStep,
    ) -> Result<(), PathError> {
        let start = self.state.clone();
        let mut last = None;
        for distance in DISTANCES {
            let along = Condition::Along(distance);
            match self.solve(&start, self.load_factor, Some(&branch_point.tangent), along) {
                Ok(found) => {
                    report.iterations += found.iterations;
                    let length = self.work.length_of_last();
                    let straight_on = self.work.inner(self.work.total(), &branch_point.along).abs();
                    if straight_on > MAX_STRAIGHT_ON * length {
                        report.rejected += 1;
                        continue;
                    }
                    self.control.restart(length);
                    self.take(found, length);
                    self.steps += 1;
                    return Ok(());
                }
                Err(error) => {
                    report.rejected += 1;
                    last = Some(error);
                }
            }
        }
        let load_factor = self.load_factor;
        Err(PathError::NoBranchThere {
            name: self.name().to_owned(),
            load_factor,
            reason: last.map_or("all lead back to the path".to_owned(), |error| error.to_string()),
        })
    }
}
