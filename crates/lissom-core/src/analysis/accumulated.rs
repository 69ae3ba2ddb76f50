//! Numbers that depend on the whole way of a model and not on where it is: work, angles that go on beyond half a turn.
//! They are carried in the state, so that snapshots and steps in parts have them, and change nothing of the motion.

use std::sync::Arc;

use super::recovery::Recovery;
use super::settings::Problem;
use super::simulation::Simulation;
use crate::elements::quadrature::gauss_legendre;
use crate::integrator::{Attempt, Integrator};
use crate::joints::Constraint as _;
use crate::judge::Warning;
use crate::judge::warn;
use crate::system::{ElementId, State, System};

/// A number that grows from step to step; zero at the start.
pub trait Accumulated: Send + Sync {
    /// Its name in the model.
    fn name(&self) -> &str;

    /// Whether it depends on multipliers. Default: it does not.
    fn depends_on_multipliers(&self) -> bool {
        false
    }

    /// Its value at the end of a step, from the one at its start; not finite where that cannot be determined.
    fn after(&self, step: &AcceptedStep<'_>, before: f64) -> f64;
}

/// A step that was accepted.
pub struct AcceptedStep<'s> {
    /// The model.
    pub system: &'s System,
    /// Its start.
    pub start: &'s State,
    /// Its Gauss points, of a motion in time; none of a load step.
    pub within: Option<&'s [State; 2]>,
    /// Its end.
    pub end: &'s State,
    /// Whether velocities, accelerations and multipliers at the Gauss points follow from the positions there.
    pub has_consistent_rates: bool,
}

impl AcceptedStep<'_> {
    /// Work of an element's forces on the rest of the model [J]. In motion by Gauss's rule of two points over the power, in
    /// load steps by the trapezoidal rule along the way:
    ///
    /// ```text
    /// W = h/2 (P(τ₁) + P(τ₂)),     τ = (1 ∓ 1/√3)/2
    /// ```
    ///
    /// Steps end where forces jump. There a force has two values, and the rule asks for neither.
    pub fn work_of_element(&self, element: ElementId) -> f64 {
        let (start, end) = (&self.start.kinematics, &self.end.kinematics);
        let Some(within) = self.within else { return self.system.work_of(element, start, end) };
        let power = |state: &State| self.system.power(element, &state.kinematics);
        0.5 * self.duration() * within.iter().map(power).sum::<f64>()
    }

    /// Work of a drive of a coordinate [J]: by Gauss's rule as above if multipliers within the step are known, otherwise as if its force
    /// changed linearly in time.
    pub fn work_of_drive(&self, drive: usize) -> f64 {
        let drive = &self.system.drives()[drive];
        if let Some(within) = self.within.filter(|_| self.has_consistent_rates) {
            let rate = |state: &State| state.kinematics.coordinates[drive.prescribed.coordinate].rate;
            let power = |state: &State| -state.multipliers[drive.multiplier] * rate(state);
            return 0.5 * self.duration() * within.iter().map(power).sum::<f64>();
        }
        let [start, end] = [self.start, self.end].map(|state| (&state.kinematics, &state.multipliers[..]));
        drive.work(start, end)
    }

    /// How long it is [s].
    pub fn duration(&self) -> f64 {
        self.end.kinematics.time - self.start.kinematics.time
    }
}

/// What a simulation accumulates.
#[derive(Default)]
pub(crate) struct Accumulation {
    pub(crate) numbers: Vec<Arc<dyn Accumulated>>,
    /// Room for the Gauss points of a step, where there are any.
    within: Option<Box<[State; 2]>>,
    /// Makes velocities, accelerations and multipliers there consistent with the positions, if numbers depend on them.
    rates: Option<Recovery>,
    /// Room for the values after a step.
    after: Vec<f64>,
}

impl Accumulation {
    /// Of these numbers, from zero, from the present state of a simulation on.
    pub(crate) fn new(numbers: Vec<Arc<dyn Accumulated>>, simulation: &Simulation) -> Self {
        let state = simulation.state();
        let within = (!numbers.is_empty()).then(|| Box::new([state.clone(), state.clone()]));
        let depends = numbers.iter().any(|number| number.depends_on_multipliers());
        let rates = depends.then(|| Recovery::of(simulation)).flatten();
        Self { within, rates, after: Vec::with_capacity(numbers.len()), numbers }
    }

    /// Takes a step into account that is being accepted.
    pub(crate) fn follow(
        &mut self,
        problem: Problem<'_>,
        integrator: &Integrator,
        attempt: &mut Attempt,
        state: &State,
        warnings: &mut Vec<Warning>,
    ) {
        let Problem { system, settings } = problem;
        let Self { numbers, within, rates, after } = self;
        let Some(within) = within else { return };
        let is_motion = settings.scheme.dynamic;
        let (start, end) = (attempt.start(state), &attempt.end);
        let time = end.kinematics.time;
        let mut has_consistent_rates = is_motion && rates.is_some();
        if is_motion {
            let duration = time - start.kinematics.time;
            let step = integrator.dense(problem, (start, end));
            for (state, (xi, _)) in within.iter_mut().zip(gauss_legendre(2)) {
                step.interpolate(start.kinematics.time + 0.5 * (1.0 + xi) * duration, state);
                let recovered = rates.as_mut().and_then(|rates| rates.recover(system, state, duration));
                match recovered {
                    Some(recovered) => *state = recovered.rates,
                    None => has_consistent_rates = false,
                }
            }
        }
        let within = is_motion.then_some(&**within);
        let step = AcceptedStep { system, start, within, end, has_consistent_rates };
        after.clear();
        for (number, &before) in numbers.iter().zip(&start.accumulated) {
            let value = number.after(&step, before);
            if before.is_finite() && !value.is_finite() {
                let output = number.name().to_owned();
                warn(warnings, Warning::AccumulationLost { time, output });
            }
            after.push(value);
        }
        attempt.end.accumulated.copy_from_slice(after);
    }
}
