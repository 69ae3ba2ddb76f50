//! Quantities that depend on the history of the motion.

use lissom_mechanics::elements::quadrature::gauss_legendre;
use lissom_mechanics::joints::Constraint as _;

use crate::{ElementId, State, System};

/// Quantities that have to be recovered for output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// Positions only: nothing is recovered.
    #[default]
    Positions,
    /// Velocities.
    Velocities,
    /// Accelerations, multipliers or internal forces.
    Forces,
}

/// A quantity that is accumulated from step to step; zero at the start.
pub trait Accumulated: Send + Sync {
    /// Name of the quantity in the model.
    fn name(&self) -> &str;

    /// Whether it depends on multipliers. Default: it does not.
    fn depends_on_multipliers(&self) -> bool {
        false
    }

    /// Value of the quantity at the end of a step, from the one at its start; not finite if it cannot be determined.
    fn after(&self, step: &AcceptedStep<'_>, before: f64) -> f64;
}

/// An accepted step.
pub struct AcceptedStep<'s> {
    /// The model.
    pub system: &'s System,
    /// State at its start.
    pub start: &'s State,
    /// States at its Gauss points; none for a load step.
    pub within: Option<&'s [State]>,
    /// State at its end.
    pub end: &'s State,
    /// Whether velocities, accelerations and multipliers at the Gauss points are consistent with the positions there.
    pub has_consistent_rates: bool,
}

impl AcceptedStep<'_> {
    /// Work of an element's forces on the rest of the model [J]. In motion by Gaussian quadrature of the power, in load steps by the
    /// trapezoidal rule along the displacement:
    ///
    /// ```text
    /// W = h/2 Σ wᵢ P(τᵢ)
    /// ```
    ///
    /// Steps end at jumps of forces, and Gauss points do not include the ends, where a force would have two values.
    pub fn work_of_element(&self, element: ElementId) -> f64 {
        let (start, end) = (&self.start.kinematics, &self.end.kinematics);
        let Some(within) = self.within else { return self.system.work_of(element, start, end) };
        let bristle = self.system.element(element).and_then(|element| element.capabilities().bristle);
        bristle
            .and_then(|bristle| bristle.unresolved_work(start, end))
            .unwrap_or_else(|| self.integral(within, |state| self.system.power(element, &state.kinematics)))
    }

    /// Work of a drive of a coordinate [J]: by Gaussian quadrature if multipliers within the step are available, otherwise for a force
    /// that is linear in time.
    pub fn work_of_drive(&self, drive: usize) -> f64 {
        let drive = &self.system.drives()[drive];
        if let Some(within) = self.within.filter(|_| self.has_consistent_rates) {
            let rate = |state: &State| state.kinematics.coordinates[drive.prescribed.coordinate].rate;
            return self.integral(within, |state| -state.multipliers[drive.multiplier] * rate(state));
        }
        let [start, end] = [self.start, self.end].map(|state| (&state.kinematics, &state.multipliers[..]));
        drive.work(start, end)
    }

    fn integral(&self, within: &[State], power: impl Fn(&State) -> f64) -> f64 {
        let weights = gauss_legendre(within.len());
        let sum: f64 = within.iter().zip(weights).map(|(state, (_, weight))| weight * power(state)).sum();
        0.5 * self.duration() * sum
    }

    /// Duration of the step [s].
    pub fn duration(&self) -> f64 {
        self.end.kinematics.time - self.start.kinematics.time
    }
}
