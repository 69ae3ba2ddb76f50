//! Approach to a step that Newton's method does not reach from the first guess: smaller steps from the same
//! start are solved on the way, each from the extrapolated increments of the one before. Nothing of them is
//! kept but the guess.

use crate::newton::{self, Equations, Failure, Limits, Memory, Outcome};

/// Most solutions on the way.
const MOST_ATTEMPTS: usize = 40;
/// Share of the step that is tried first after the whole has failed.
const FIRST_SHARE: f64 = 0.25;
/// Shares that differ by less are not told apart.
const SMALLEST_SHARE: f64 = 1e-3;

/// Equations of a step whose size can be a share of the whole.
pub(crate) trait Approachable: Equations {
    /// Makes these the equations of `share` of the step.
    fn set_share(&mut self, share: f64);

    /// Goes over to a tangent that knows more, and says whether there is one.
    fn couple(&mut self) -> bool {
        false
    }

    /// Keeps the present increments and multipliers as a solution.
    fn save(&mut self);

    /// Makes the saved solution, extrapolated to a step `factor` times as large, the present guess.
    fn extrapolate(&mut self, factor: f64);
}

/// Solves the equations of the whole step.
///
/// # Errors
/// If even small parts of the step have no solution.
pub(crate) fn solve<E: Approachable>(
    equations: &mut E,
    limits: &Limits,
    memory: &mut Memory,
) -> Result<Outcome, Failure> {
    equations.restart();
    let failure = match newton::solve(equations, limits, memory) {
        Ok(outcome) => return Ok(outcome),
        Err(failure @ Failure::Factor(_)) => return Err(failure),
        Err(failure) => failure,
    };
    let mut total = Outcome::default();
    if equations.couple() {
        *memory = Memory::default();
        equations.restart();
        match newton::solve(equations, limits, memory) {
            Ok(outcome) => return Ok(outcome),
            Err(failure @ Failure::Factor(_)) => return Err(failure),
            Err(_) => {}
        }
    }
    let mut solved = 0.0;
    let mut share = FIRST_SHARE;
    for _ in 0..MOST_ATTEMPTS {
        *memory = Memory::default();
        equations.set_share(share);
        if solved > 0.0 {
            equations.extrapolate(share / solved);
        } else {
            equations.restart();
        }
        match newton::solve(equations, limits, memory) {
            Ok(outcome) => {
                total = Outcome {
                    iterations: total.iterations + outcome.iterations,
                    factorizations: total.factorizations + outcome.factorizations,
                    ..outcome
                };
                if share >= 1.0 {
                    return Ok(total);
                }
                equations.save();
                let reach = if solved > 0.0 { share + 1.5 * (share - solved) } else { 2.0 * share };
                solved = share;
                share = reach.min(1.0);
            }
            Err(_) if share - solved > SMALLEST_SHARE => share = 0.5 * (solved + share),
            Err(_) => break,
        }
    }
    *memory = Memory::default();
    equations.set_share(1.0);
    Err(failure)
}
