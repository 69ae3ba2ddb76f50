//! The Newton loop of steps and paths. It has no notion of time or mechanics: it corrects, monitors the contraction,
//! keeps the tangent while that converges, and renews it otherwise. It stops at a scaled tolerance, or when
//! corrections stall at round-off.

use lissom_solver::FactorError;
use serde::{Deserialize, Serialize};

use crate::interrupt;
use crate::round_off;
use crate::solver_features::SolverFeature;
pub use crate::system::settings::Limits;
use crate::tuning::{MAX_HALVINGS, TuningParameter};

/// A nonlinear system, as Newton's method solves it.
pub trait Equations {
    /// Evaluates the residual at the current iterate, solves with the current tangent and applies the correction.
    fn correct(&mut self) -> Correction;

    /// Linearises at the current iterate and factorises.
    ///
    /// # Errors
    /// If a pivot vanishes.
    fn renew_tangent(&mut self) -> Result<(), FactorError>;

    /// Returns to the initial guess.
    fn restart(&mut self);

    /// Undoes the last correction, and half of what remains of the one before.
    fn back_off(&mut self);

    /// Whether the properties of the solution hold to round-off only if the equations are solved to round-off. Slow
    /// corrections are then considered round-off only after new tangents have failed to accelerate them.
    fn is_wanted_exactly(&self) -> bool {
        false
    }

    /// Whether the tangent at the iterate differs so much from the one in use that a correction with it may be wasted, although
    /// corrections with a new tangent need not decrease at once: it has the stresses to which the iterations lead, not those of the
    /// iterate.
    fn leads_elsewhere(&self) -> bool {
        false
    }

    /// Size of the corrections caused by rounding of the equations [-]: a new tangent does not reduce them.
    fn round_off(&self) -> f64 {
        0.0
    }
}

/// A nonlinear system whose residual is nearly the gradient of a convex function with kinks, so that the tangent changes with every
/// iterate and a correction is followed as far as the function falls.
pub trait Descent {
    /// Norm of the residual at the current iterate, over its tolerance.
    fn residual(&mut self) -> f64;

    /// Moves along a correction to the least value of the function. Whether a tangent was factored for it.
    ///
    /// # Errors
    /// If a pivot vanishes.
    fn descend(&mut self) -> Result<bool, FactorError>;

    /// Updates what was fixed while the iterations converged. Whether nothing has changed.
    fn settle(&mut self) -> bool;
}

/// Size of a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Largest scaled correction [-].
    pub size: f64,
    /// Size of the increment that the step determines, with which the correction is compared.
    pub reference: f64,
}

/// State of the Jacobian's factorization, retained from one solution to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JacobianState {
    /// Whether there is a factorised tangent that may be reused.
    pub has_tangent: bool,
    /// Slowest contraction in the last solution with this tangent in which it could be measured.
    contraction: Option<f64>,
    /// Number of solutions since then.
    unseen: u32,
    /// Size at which corrections have stalled at round-off [-].
    round_off: f64,
    /// Cost of the tangent and its solutions.
    cost: JacobianCost,
}

impl JacobianState {
    /// Discards the tangent and its measured contraction.
    fn forget_tangent(&mut self) {
        self.has_tangent = false;
        (self.contraction, self.unseen) = (None, 0);
    }

    /// Adds the cost of a solution, and discards the tangent if a new one is cheaper.
    fn update_cost(&mut self, outcome: &Outcome, limits: &Limits) {
        if !limits.disabled.allows(SolverFeature::JacobianCost) {
            return;
        }
        if outcome.factorizations > 0 {
            self.cost = JacobianCost {
                spent: limits.tuning.of(TuningParameter::TangentCost),
                ..JacobianCost::default()
            };
        } else if self.cost.should_refactor(outcome.iterations as f64, NOVELTY) {
            self.forget_tangent();
        }
    }
}

/// Cost of a tangent and of the solutions found with it, in iterations. Older tangents need more of them: a tangent is
/// best renewed when a solution costs more than the average of all since its assembly, the assembly included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct JacobianCost {
    spent: f64,
    solutions: f64,
    /// Moving average of the cost of a solution.
    recent: f64,
}

impl JacobianCost {
    fn should_refactor(&mut self, iterations: f64, novelty: f64) -> bool {
        self.spent += iterations;
        self.solutions += 1.0;
        let weight = (1.0 / self.solutions).max(novelty);
        self.recent += weight * (iterations - self.recent);
        self.recent * self.solutions > self.spent
    }
}

/// A converged solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Iterations made.
    pub iterations: usize,
    /// Number of tangents factorised.
    pub factorizations: usize,
    /// Size of the first correction: the error of the initial guess.
    pub first_correction: f64,
    /// Size of the last correction.
    pub correction: f64,
    /// Whether it stopped at round-off before the tolerance was reached.
    pub stagnated: bool,
}

/// Why no solution was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// Too many iterations, or corrections that grow.
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Size of the last correction.
        correction: f64,
    },
    /// A number is not finite.
    NotFinite {
        /// Iterations made.
        iterations: usize,
    },
    /// The tangent cannot be factorised without pivoting.
    Factor(FactorError),
    /// It was interrupted.
    Interrupted,
}

impl From<FactorError> for Failure {
    fn from(error: FactorError) -> Self {
        if error == FactorError::Interrupted { Self::Interrupted } else { Self::Factor(error) }
    }
}

/// Weight of the last solution in the moving average of the cost.
const NOVELTY: f64 = 0.05;
/// A stalled correction below this fraction of the step's increment is round-off [-].
const STALLS_BELOW: f64 = 1e-6;
/// If an exact solution is required, stalled corrections above this are slow convergence [-].
const EXACT_STALLED: f64 = 1e-11;
/// Largest number of tangents in a solution that follow iterates far away: most need three to eight.
const MAX_ELSEWHERE: usize = 20;
/// If an exact solution is required, maximum number of new tangents for corrections that stall.
const MAX_STALLS: usize = 2;

/// Solves `equations`.
///
/// # Errors
/// If it does not converge within the limits.
pub fn solve<E: Equations>(
    equations: &mut E,
    limits: &Limits,
    jacobian: &mut JacobianState,
) -> Result<Outcome, Failure> {
    let mut outcome = Outcome::default();
    let mut previous: Option<f64> = None;
    // Whether corrections led so far that tangents had to follow.
    let mut elsewhere = 0;
    // Whether the tangent was assembled in this solution.
    let mut fresh = false;
    // Corrections made with the tangent since its assembly, and halvings of the last one.
    let mut age = 0;
    let mut halvings = 0;
    let mut stalls = if equations.is_wanted_exactly() { MAX_STALLS } else { 0 };
    while outcome.iterations < limits.max_iterations {
        if interrupt::is_asked() {
            jacobian.forget_tangent();
            return Err(Failure::Interrupted);
        }
        if !jacobian.has_tangent {
            equations.renew_tangent().map_err(Failure::from)?;
            jacobian.has_tangent = true;
            (jacobian.contraction, jacobian.unseen) = (None, 0);
            outcome.factorizations += 1;
            fresh = true;
            age = 0;
            previous = None;
        }
        let correction = equations.correct();
        outcome.iterations += 1;
        outcome.correction = correction.size;
        if outcome.iterations == 1 {
            outcome.first_correction = correction.size;
        }
        age += 1;
        let verdict = match test_convergence(&correction, previous, fresh, limits, jacobian) {
            Verdict::Renew | Verdict::BackOff if fresh && correction.size <= equations.round_off() => {
                Verdict::Converged
            }
            Verdict::Continue | Verdict::BackOff | Verdict::Restart
                if correction.size.is_finite() && equations.leads_elsewhere() =>
            {
                elsewhere += 1;
                if elsewhere > MAX_ELSEWHERE {
                    break;
                }
                Verdict::Renew
            }
            verdict => verdict,
        };
        match verdict {
            Verdict::Converged => {
                jacobian.update_cost(&outcome, limits);
                // The next solution will begin as far away.
                if elsewhere > 0 {
                    jacobian.forget_tangent();
                }
                return Ok(outcome);
            }
            Verdict::Stalled if stalls > 0 && correction.size > round_off::CORRECTION => {
                stalls -= 1;
                halvings = 0;
                jacobian.forget_tangent();
                previous = Some(correction.size);
            }
            Verdict::Stalled if equations.is_wanted_exactly() && correction.size > EXACT_STALLED => {
                jacobian.forget_tangent();
                break;
            }
            Verdict::Stalled => {
                if equations.is_wanted_exactly() {
                    jacobian.round_off = 0.0;
                }
                outcome.stagnated = true;
                jacobian.update_cost(&outcome, limits);
                return Ok(outcome);
            }
            // With the same tangent the next correction must be smaller (natural monotonicity [Deuflhard 2011,
            // section 3.3]); otherwise the last one overshot.
            Verdict::BackOff
                if age == 2 && halvings < MAX_HALVINGS && limits.disabled.allows(SolverFeature::BackOff) =>
            {
                halvings += 1;
                age = 1;
                equations.back_off();
            }
            Verdict::Continue => {
                halvings = 0;
                previous = Some(correction.size);
            }
            // The tangent was assembled at an earlier iterate.
            Verdict::Renew | Verdict::BackOff => {
                halvings = 0;
                jacobian.forget_tangent();
                previous = Some(correction.size);
            }
            Verdict::Restart if fresh => {
                jacobian.forget_tangent();
                return Err(Failure::NotFinite { iterations: outcome.iterations });
            }
            Verdict::Restart => {
                jacobian.forget_tangent();
                equations.restart();
            }
        }
    }
    jacobian.forget_tangent();
    Err(Failure::NotConverged { iterations: outcome.iterations, correction: outcome.correction })
}

/// Largest number of corrections of a [`Descent`], and of times that it settles.
const MAX_DESCENTS: usize = 100;

/// Solves a system by corrections that are followed as far as a function falls.
///
/// # Errors
/// If it does not converge.
pub fn descend<D: Descent>(system: &mut D) -> Result<Outcome, Failure> {
    let mut outcome = Outcome::default();
    let mut settled = 0;
    loop {
        if interrupt::is_asked() {
            return Err(Failure::Interrupted);
        }
        outcome.correction = system.residual();
        if !outcome.correction.is_finite() {
            return Err(Failure::NotFinite { iterations: outcome.iterations });
        }
        if outcome.correction <= 1.0 {
            if system.settle() {
                return Ok(outcome);
            }
            settled += 1;
        }
        if outcome.iterations.max(settled) >= MAX_DESCENTS {
            let Outcome { iterations, correction, .. } = outcome;
            return Err(Failure::NotConverged { iterations, correction });
        }
        if outcome.correction > 1.0 {
            outcome.factorizations += usize::from(system.descend().map_err(Failure::from)?);
            outcome.iterations += 1;
        }
    }
}

/// Action after a correction.
enum Verdict {
    Converged,
    /// Round-off is reached.
    Stalled,
    /// Continue with the same tangent.
    Continue,
    /// Continue with a new tangent.
    Renew,
    /// The previous correction overshot.
    BackOff,
    /// Return to the initial guess with a new tangent.
    Restart,
}

fn test_convergence(
    correction: &Correction,
    previous: Option<f64>,
    fresh: bool,
    limits: &Limits,
    jacobian: &mut JacobianState,
) -> Verdict {
    let Correction { size, reference } = *correction;
    if !(size.is_finite() && reference.is_finite()) {
        return if fresh && previous.is_some() { Verdict::BackOff } else { Verdict::Restart };
    }
    let least = limits.tuning.of(TuningParameter::Contraction);
    let goal = (limits.tolerance * reference).max(jacobian.round_off);
    let Some(previous) = previous else {
        // The first correction is judged by the contraction of earlier solutions: after n solutions in which it was not
        // measured it may be n + 1 times as slow.
        if size == 0.0 {
            return Verdict::Converged;
        }
        if let Some(contraction) = jacobian.contraction
            && limits.disabled.allows(SolverFeature::SingleCorrection)
            && remaining(contraction.max(least) * f64::from(jacobian.unseen + 1)) * size
                <= limits.tuning.of(TuningParameter::Unseen) * goal
        {
            jacobian.unseen += 1;
            return Verdict::Converged;
        }
        // It will be measured again.
        (jacobian.contraction, jacobian.unseen) = (None, 0);
        return Verdict::Continue;
    };
    let contraction = size / previous;
    jacobian.contraction = Some(jacobian.contraction.map_or(contraction, |known| known.max(contraction)));
    let credible = if fresh { contraction } else { contraction.max(least) };
    if remaining(credible) * size <= goal {
        return Verdict::Converged;
    }
    // Round-off is larger in models with stiff members or large positions.
    let near_round_off = size <= 10.0 * round_off::CORRECTION || size <= STALLS_BELOW * reference;
    if contraction > limits.tuning.of(TuningParameter::Stalled) && near_round_off && fresh {
        if size <= round_off::CORRECTION {
            jacobian.round_off = jacobian.round_off.max(size);
        }
        return Verdict::Stalled;
    }
    if contraction > 1.0 {
        // An old tangent may diverge.
        return if fresh { Verdict::BackOff } else { Verdict::Restart };
    }
    let needed = if contraction < 1.0 { (goal / size).ln() / contraction.ln() } else { f64::INFINITY };
    if needed > limits.tuning.of(TuningParameter::TangentCost) { Verdict::Renew } else { Verdict::Continue }
}

/// Sum of the remaining corrections, relative to the last one: a geometric series.
fn remaining(contraction: f64) -> f64 {
    if contraction < 1.0 { contraction / (1.0 - contraction) } else { f64::INFINITY }
}

#[cfg(test)]
#[path = "../tests/unit/newton.rs"]
mod tests;
