//! Newton's method for the next step with any scaling and solver.

use lissom_solver::{FactorError, SolverKind};

use super::Simulation;
use crate::integrator::equations::StepEquations;
use crate::integrator::workspace::Workspace;
use crate::newton::Equations;
use crate::saddle_point::TangentValues;
use crate::scaling::{ScaleBy, Scaled, ScalingChoice};
use crate::settings::Unwatched;

/// First tangents of a step, and accuracy after the last iteration.
#[derive(Clone, Debug, PartialEq)]
pub struct NewtonTrial {
    /// Tangents of the first iteration, as factored: one for each decoupled system of the stages.
    pub tangents: Vec<TangentValues>,
    /// Values of the unknowns of these tangents that are the same in SI for every scaling.
    pub sizes: Vec<f64>,
    /// Last update relative to the increments of the step [-].
    pub update: f64,
    /// Largest residual of an equation of motion [N, N m].
    pub residual: f64,
    /// Largest violation of a constraint [m, rad].
    pub violation: f64,
}

impl Simulation {
    /// Makes `iterations` of the next step, each with a new tangent, and leaves the simulation unchanged.
    ///
    /// # Errors
    /// If a tangent has no factors.
    pub fn try_newton(
        &self,
        choice: &ScalingChoice,
        kind: &'static SolverKind,
        iterations: usize,
    ) -> Result<NewtonTrial, FactorError> {
        let (system, state, settings) = (self.system(), self.state(), self.settings());
        let (representative, layout) = (self.representative(), system.layout());
        let mut work = Workspace::new(
            (system, state),
            &settings.scheme,
            (representative, self.redundancy().clone()),
            (kind, choice.equilibrates()),
        );
        let scaled = Scaled::new(choice, representative, settings.step_size);
        scaled.to_unit_step(layout, &settings.scheme, state, &mut work.unit);
        system.begin_step(&state.kinematics, &mut work.evaluation.joint_starts);
        let mut equations = StepEquations {
            system,
            scheme: &settings.scheme,
            scaled,
            scaling: (choice, representative),
            start: state,
            work: &mut work,
            watch: &mut Unwatched,
        };
        equations.predict();
        equations.renew_tangent()?;
        let physical = ScalingChoice { by: ScaleBy::Physical, ..*choice };
        let physical = Scaled::new(&physical, representative, settings.step_size);
        let mut sizes = vec![1.0; layout.size()];
        sizes[layout.coordinate_count()..].fill(physical.multiplier_factor() / scaled.multiplier_factor());
        if let Some(factors) = equations.work.tangent.row_factors() {
            sizes.iter_mut().zip(factors).for_each(|(size, factor)| *size /= factor);
        }
        let matrices = &mut equations.work.tangent.matrices;
        let copy = |system| {
            let values = matrices.take_values(system);
            matrices.set_values(system, values.clone());
            values
        };
        let tangents = (0..settings.scheme.coupling.systems.len()).map(copy).collect();
        let mut trial = NewtonTrial { tangents, sizes, update: 0.0, residual: 0.0, violation: 0.0 };
        for iteration in 0..iterations {
            // The tangent of the first iteration is already factored.
            if iteration > 0 {
                equations.renew_tangent()?;
            }
            let correction = equations.correct();
            trial.update =
                correction.size / if correction.reference > 0.0 { correction.reference } else { 1.0 };
            if !correction.size.is_finite() {
                break;
            }
        }
        equations.evaluate();
        for residual in &equations.work.residuals {
            let (motion, violation) = residual.split_at(layout.coordinate_count());
            trial.residual = largest(trial.residual, motion);
            trial.violation = largest(trial.violation, violation);
        }
        Ok(trial)
    }
}

/// Largest magnitude; not a number if a value is none.
fn largest(start: f64, values: &[f64]) -> f64 {
    values.iter().fold(start, |most, value| if value.abs() <= most { most } else { value.abs() })
}
