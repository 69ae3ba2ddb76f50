//! Accumulation of quantities that depend on the history of the motion: work, angles beyond half a turn. They are
//! part of the state, so that snapshots and subdivided steps include them, and do not affect the motion.

use std::sync::Arc;

use crate::elements::quadrature::gauss_legendre;
use crate::errors::Warning;
use crate::errors::warn;
use crate::integrator::dense::DenseOutput;
use crate::integrator::{Attempt, Integrator};
use crate::settings::Problem;
use crate::simulation::Recovery;
use crate::simulation::Simulation;
use crate::system::State;
use crate::system::accumulated::{AcceptedStep, Accumulated, Need};

/// Accumulated quantities of a simulation.
#[derive(Default)]
pub(crate) struct Accumulation {
    pub(crate) numbers: Vec<Arc<dyn Accumulated>>,
    /// Storage for the states at the Gauss points of a step.
    within: Vec<State>,
    /// Makes velocities, accelerations and multipliers there consistent with the positions, if quantities depend on them.
    rates: Option<Box<Recovery>>,
    /// Values after a step.
    after: Vec<f64>,
}

impl Accumulation {
    /// Starts these quantities at zero at the present state of a simulation.
    pub(crate) fn new(numbers: Vec<Arc<dyn Accumulated>>, simulation: &Simulation) -> Self {
        let state = simulation.state();
        let points = gauss_legendre(simulation.settings().scheme.stages.len().max(2)).len();
        let within = if numbers.is_empty() { Vec::new() } else { vec![state.clone(); points] };
        let depends = numbers.iter().any(|number| number.depends_on_multipliers());
        let rates = depends.then(|| Recovery::of(simulation)).flatten();
        Self { within, rates, after: Vec::with_capacity(numbers.len()), numbers }
    }

    /// Accumulates over a step that is being accepted.
    pub(crate) fn follow(
        &mut self,
        problem: Problem<'_>,
        integrator: &Integrator,
        attempt: &mut Attempt,
        state: &State,
        warnings: &mut Vec<Warning>,
    ) {
        if self.numbers.is_empty() {
            return;
        }
        let (start, end) = (attempt.start(state), &attempt.end);
        self.integrate(problem, &integrator.dense(problem, (start, end)), end);
        for ((number, before), value) in self.numbers.iter().zip(&start.accumulated).zip(&self.after) {
            if before.is_finite() && !value.is_finite() {
                let (time, output) = (end.kinematics.time, number.name().to_owned());
                warn(warnings, Warning::AccumulationLost { time, output });
            }
        }
        attempt.end.accumulated.copy_from_slice(&self.after);
    }

    /// Computes the quantities at `end`, an instant of a `step`, and stores them in `after`.
    fn integrate(&mut self, problem: Problem<'_>, step: &DenseOutput<'_>, end: &State) {
        let Problem { system, settings } = problem;
        let Self { numbers, within, rates, after } = self;
        let start = step.from;
        let duration = end.kinematics.time - start.kinematics.time;
        let is_motion = settings.scheme.dynamic;
        let mut has_consistent_rates = is_motion && rates.is_some();
        if is_motion {
            let points = gauss_legendre(within.len());
            for (state, (xi, _)) in within.iter_mut().zip(points) {
                step.interpolate(start.kinematics.time + 0.5 * (1.0 + xi) * duration, state);
                let whole = step.to.kinematics.time - start.kinematics.time;
                let recovered =
                    rates.as_mut().and_then(|rates| rates.recover(Need::Forces, (system, state), whole));
                match recovered {
                    Some(recovered) => state.clone_from(&recovered.rates),
                    None => has_consistent_rates = false,
                }
            }
        }
        let within = is_motion.then_some(&within[..]);
        let step = AcceptedStep { system, start, within, end, has_consistent_rates };
        after.clear();
        after.extend(
            numbers.iter().zip(&start.accumulated).map(|(number, &before)| number.after(&step, before)),
        );
    }
}

impl Simulation {
    /// The state at `time` [s] within the last step, as by [`interpolate`](Self::interpolate), with the accumulated quantities there;
    /// `out` must be a state of this system.
    pub fn state_within(&mut self, time: f64, out: &mut State) {
        self.interpolate(time, out);
        if self.accumulation.numbers.is_empty() {
            return;
        }
        let problem = Problem { system: &self.system, settings: &self.settings };
        let ends = (&self.previous, &self.state);
        let step = self.integrator.dense(problem, ends).known(self.integrator.has_last_step);
        self.accumulation.integrate(problem, &step, out);
        out.accumulated.copy_from_slice(&self.accumulation.after);
    }
}
