//! Tangents at the solution of a step, under any scaling. Independent of the scheme, except for its tangent.

use lissom_solver::{Pattern, Structure, condition_estimate};

use crate::saddle_point::equilibration::Equilibration;
use crate::saddle_point::{SolverOf, TangentValues};
use crate::scaling::{Scaled, ScalingChoice, state_rows};
use crate::schemes::StageSystem;
use crate::simulation::Simulation;
use crate::system::{Sum, System, TangentAssembler};

impl TangentValues {
    /// Scales rows and columns to equal magnitude, see [`Equilibration`].
    fn equilibrate(&mut self, pattern: &Pattern, coordinate_count: usize) {
        let mut equilibration = Equilibration::new(pattern.size(), coordinate_count);
        match self {
            Self::Real(values) => equilibration.apply(pattern, values),
            Self::Complex(values) => equilibration.apply(pattern, values),
        }
    }

    /// Assembler of the tangent of the scaled equations; `stiffness`, if it is not empty, receives the diagonal of the derivatives
    /// by position.
    pub(crate) fn receiver<'a>(
        &'a mut self,
        scaled: &Scaled,
        system: &StageSystem,
        stiffness: &'a mut [f64],
    ) -> TangentAssembler<'a> {
        match (self, system) {
            (Self::Real(values), StageSystem::Real(own)) => {
                TangentAssembler::Real(Sum { blend: scaled.blend(own.weights), values, stiffness })
            }
            (Self::Complex(values), StageSystem::Complex(own)) => {
                TangentAssembler::Complex(Sum { blend: scaled.blend(own.weights), values, stiffness })
            }
            _ => unreachable!("a tangent is made for its scheme's coupling"),
        }
    }
}

impl TangentValues {
    /// Condition number of a tangent of `system`, estimated in the 1-norm, with units of states in which it is least; infinite if it is
    /// singular.
    pub fn condition_estimate(&self, system: &System) -> f64 {
        let (structure, states) = (system.structure(), state_rows(system.layout()));
        match self {
            Self::Real(values) => estimate(structure, (values, &states)),
            Self::Complex(values) => estimate(structure, (values, &states)),
        }
    }
}

/// Estimate of a condition number, with the first solver that factors the matrix.
fn estimate<S: SolverOf>(structure: &Structure, (values, states): (&[S], &[usize])) -> f64 {
    let mut solvers = lissom_solver::KINDS.iter().map(|kind| S::solver(kind, structure));
    let factored = solvers.find_map(|mut own| own.factor(values).is_ok().then_some(own));
    factored.map_or(f64::INFINITY, |mut own| {
        condition_estimate(&mut *own, &structure.pattern, values, states).max(1.0)
    })
}

impl Simulation {
    /// The tangent at the solution of the last step, under each of the given scalings; none before the first step. Schemes with
    /// several stages have one for each decoupled system, and the first is returned. The solution itself does not depend on the
    /// scaling.
    pub fn converged_tangents(&mut self, scalings: &[ScalingChoice]) -> Option<Vec<TangentValues>> {
        let (representative, step_size) = (*self.representative(), self.settings().step_size);
        let system = self.settings().scheme.coupling.systems[0];
        let pattern = self.system().pattern();
        let count = self.system().layout().coordinate_count();
        let tangent = |choice: &ScalingChoice| {
            let scaled = Scaled::new(choice, &representative, step_size);
            let mut values = self.last_tangent(scaled, &system)?;
            if choice.equilibrates() {
                values.equilibrate(&pattern, count);
            }
            Some(values)
        };
        scalings.iter().map(tangent).collect()
    }
}
