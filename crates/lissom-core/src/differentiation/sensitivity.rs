//! Steps of a perturbed model: a model with slightly different parameters takes the same steps as the base model. Its equations are
//! solved with the base model's tangent, factored at the base solution. Differences of two such models, perturbed in opposite
//! directions, are derivatives by the parameter.
//!
//! Legend: z solution of a step, x state at its start, θ a model parameter, r residual, J tangent.
//!
//! ```text
//! J δz = -r(z; x ± δx, θ ± δθ)
//! ```
//!
//! is the linear equation of direct differentiation, with the derivatives of r by x and θ as finite differences. It is iterated with
//! the same J, which is not exact for every scheme, until the remaining correction is below the round-off of the derivative: three
//! corrections if J is exact.

use crate::errors::StepError;
use crate::integrator::{Start, step_equations};
use crate::newton::Equations;
use crate::round_off;
use crate::settings::Problem;
use crate::settings::Unwatched;
use crate::simulation::Simulation;

/// Maximum number of corrections of a perturbed model's step.
const MAX_CORRECTIONS: usize = 12;
/// Remaining correction, estimated from the contraction rate, relative to the first one. The derivatives of reactions have larger
/// errors: across a constraint a small displacement is a large force.
const REMAINING_CORRECTION: f64 = 1e-11;
/// Largest contraction rate from which the next correction is estimated.
const CONTRACTS: f64 = 0.1;

impl Simulation {
    /// Factors the tangent of the last step again, at its solution, and keeps it in use. Returns false if there is no such step:
    /// before the first one, after a failure, or after a step that was subdivided.
    ///
    /// # Errors
    /// If the tangent is singular.
    pub fn renew_at_solution(&mut self) -> Result<bool, StepError> {
        if !self.integrator.has_last_step {
            return Ok(false);
        }
        let Self { system, settings, integrator, previous, .. } = self;
        let result = integrator.renew_at_solution(Problem { system, settings }, previous);
        let time = self.state.kinematics.time;
        result.map_err(|error| self.describe_factor(&error, time))?;
        Ok(true)
    }

    /// Takes the last step of `base` from the state of this simulation and with its own system: corrects the solution of `base` with
    /// the tangent of `base`. Returns the number of corrections.
    ///
    /// # Errors
    /// If the corrections do not converge: the models differ too much.
    ///
    /// # Panics
    /// If the two systems have different numbers of unknowns.
    pub fn follow(&mut self, base: &mut Self) -> Result<usize, StepError> {
        let size = base.integrator.scaled.step_size();
        let problem = Problem { system: &self.system, settings: &self.settings };
        let from = Start { previous: &self.previous, state: &self.state };
        let integrator = &mut self.integrator;
        integrator.begin(problem, from, size, &mut self.attempt)?;
        integrator.scaled = base.integrator.scaled;
        let start = self.attempt.start(&self.state);
        let (work, leading) = (&mut *integrator.work, &mut *base.integrator.work);
        integrator.scaled.to_unit_step(self.system.layout(), &self.settings.scheme, start, &mut work.unit);
        work.increments.clone_from(&leading.increments);
        work.multipliers.clone_from(&leading.multipliers);
        work.newton.anderson.forget();
        work.tangent.borrow_factors(&mut leading.tangent);
        work.note_scales(self.system.layout(), &integrator.scaled);
        let scaled = integrator.scaled;
        let watch = &mut Unwatched;
        let mut equations = step_equations(problem, start, &integrator.representative, scaled, work, watch);
        equations.update_motions();
        let (mut made, mut first) = (0, 0.0);
        let (mut last, mut size_of_last) = (f64::INFINITY, f64::INFINITY);
        while made < MAX_CORRECTIONS {
            let correction = equations.correct();
            made += 1;
            let relative = correction.size / correction.reference.max(f64::MIN_POSITIVE);
            let is_found = relative <= round_off::STEP || correction.size <= round_off::CORRECTION;
            let contraction = correction.size / size_of_last;
            if made == 1 {
                first = correction.size;
            }
            let is_exact = made > 1
                && is_found
                && contraction <= CONTRACTS
                && contraction * correction.size <= REMAINING_CORRECTION * first;
            // A correction that no longer contracts is round-off.
            let is_done = is_exact
                || relative <= round_off::CORRECTION
                || correction.size == 0.0
                || (is_found && relative >= last);
            (last, size_of_last) = (relative, correction.size);
            if is_done || !relative.is_finite() {
                break;
            }
        }
        let worst = equations.worst_unknown();
        let correction = equations.work.newton.correction;
        work.tangent.exchange_factors(&mut leading.tangent);
        if !(last <= round_off::STEP || size_of_last <= round_off::CORRECTION) {
            let time = self.state.kinematics.time + size;
            let hint = "the neighbouring model has no solution near this one";
            return Err(StepError::NotConverged { time, iterations: made, correction, worst, hint });
        }
        integrator.finish(problem, &self.state, &mut self.attempt)?;
        self.judge_attempt()?;
        self.commit_attempt();
        Ok(made)
    }
}
