//! Condition number of the tangent, under any scaling.
//!
//! The 2-norm condition number of small tangents is computed from singular values, far beyond 1e16; that of large ones is estimated in
//! the 1-norm. Independent of the scheme, except for its tangent.

use lissom_solver::{Pattern, Structure, condition_estimate, condition_number, kind};

use crate::saddle_point::equilibration::Equilibration;
use crate::saddle_point::{Matrix, SaddlePoint, SolverOf, TangentValues};
use crate::scaling::{Scaled, ScalingChoice};
use crate::schemes::StageSystem;
use crate::simulation::Simulation;
use crate::system::{Sum, TangentAssembler};

/// Maximum number of real unknowns for which singular values are computed; a complex unknown counts twice.
pub const MAX_MEASURED: usize = 120;

/// Method by which a condition number was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConditionMethod {
    /// Largest over smallest singular value, in extended precision.
    SingularValues,
    /// A lower bound of ‖J‖₁ ‖J⁻¹‖₁, nearly always within a factor of three.
    OneNormEstimate,
}

impl ConditionMethod {
    /// Name of the method in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::SingularValues => "2-norm",
            Self::OneNormEstimate => "1-norm estimate",
        }
    }
}

/// A condition number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// κ(J), at least 1; infinite for a singular tangent.
    pub value: f64,
    /// Method by which it was computed.
    pub method: ConditionMethod,
}

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

    /// Condition number of the tangent: computed if it is small, estimated if it is large.
    pub fn condition(&self, structure: &Structure) -> Condition {
        let real_size = match self {
            Self::Real(_) => structure.pattern.size(),
            Self::Complex(_) => 2 * structure.pattern.size(),
        };
        if real_size > MAX_MEASURED {
            return self.condition_estimate(structure);
        }
        let value = match self {
            Self::Real(values) => condition_number(&structure.pattern, values),
            Self::Complex(values) => condition_number(&structure.pattern, values),
        };
        Condition { value, method: ConditionMethod::SingularValues }
    }

    /// Condition number of the tangent in the 1-norm, estimated from a few solves.
    pub fn condition_estimate(&self, structure: &Structure) -> Condition {
        let value = match self {
            Self::Real(values) => estimate(structure, values),
            Self::Complex(values) => estimate(structure, values),
        };
        Condition { value, method: ConditionMethod::OneNormEstimate }
    }
}

/// Estimate for the matrix as it is: neither equilibrated nor without equations, which requires multipliers.
fn estimate<S: SolverOf>(structure: &Structure, values: &[S]) -> f64 {
    let Some(kind) = kind("sparse") else { return f64::INFINITY };
    let mut matrix = Matrix::new(S::solver(kind, structure), structure);
    matrix.values.copy_from_slice(values);
    let mut saddle =
        SaddlePoint::new(matrix, structure.pattern.size()).with_all_equations().falling_back(kind.name);
    if saddle.factor(structure, 1.0).is_err() {
        return f64::INFINITY;
    }
    let value = condition_estimate(&mut *saddle.matrices.solver, &structure.pattern, values);
    // Rounded results of an ill-conditioned solve may be slightly too small: κ is never below 1.
    if value.is_nan() { f64::INFINITY } else { value.max(1.0) }
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

    /// Estimates the condition number of the tangent factored last from a few solves with it; none if there
    /// is no factored tangent in use.
    pub fn condition_estimate(&mut self) -> Option<Condition> {
        let value = self.factored_condition()?;
        Some(Condition { value, method: ConditionMethod::OneNormEstimate })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use num_complex::Complex64;

    use super::*;

    /// A mass at the end of a massless arm in the plane, at rest: x, y, angle, two multipliers. The augmented term depends on the
    /// direction of the arm through the angle.
    fn tangent(mass: f64) -> (Structure, TangentValues) {
        let pattern = Pattern::from_cliques(5, [&[0, 1, 2, 3, 4][..]]);
        let mut dense = [[0.0; 5]; 5];
        let rows = [[1.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
        for (k, row) in rows.iter().enumerate() {
            for i in 0..3 {
                dense[i][3 + k] = row[i];
                dense[3 + k][i] = row[i];
                for j in 0..3 {
                    dense[i][j] += row[i] * row[j];
                }
            }
        }
        dense[0][0] += mass;
        dense[1][1] += mass;
        let values = dense.iter().flatten().copied().collect();
        (Structure::ungrouped(Arc::new(pattern)), TangentValues::Real(values))
    }

    #[test]
    fn without_scaling_it_grows_with_the_square_of_the_mass_over_h2() {
        let condition = |mass: f64| {
            let (structure, values) = tangent(mass);
            values.condition(&structure).value
        };
        for mass in [1e6, 1e8, 1e10] {
            let ratio = condition(10.0 * mass) / condition(mass);
            assert!((ratio - 100.0).abs() < 0.1, "{ratio}");
        }
        assert!(condition(1e10) > 1e19);
    }

    #[test]
    fn the_estimate_is_near_the_truth_in_its_own_norm() {
        let (structure, values) = tangent(1e3);
        let measured = values.condition(&structure);
        let estimated = values.condition_estimate(&structure);
        assert_eq!(measured.method.name(), "2-norm");
        assert_eq!(estimated.method.name(), "1-norm estimate");
        let ratio = estimated.value / measured.value;
        assert!((0.2..5.0).contains(&ratio), "{ratio}");
        let TangentValues::Real(real) = &values else { unreachable!("it is real") };
        let complex = TangentValues::Complex(real.iter().map(|&value| Complex64::new(0.0, value)).collect());
        assert!((complex.condition(&structure).value / measured.value - 1.0).abs() < 1e-9);
        assert!((complex.condition_estimate(&structure).value / estimated.value - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_singular_tangent_is_infinitely_bad() {
        let (structure, _) = tangent(1.0);
        let values = TangentValues::Real(vec![0.0; 25]);
        assert_eq!(values.condition(&structure).value, f64::INFINITY);
        assert_eq!(values.condition_estimate(&structure).value, f64::INFINITY);
    }
}
