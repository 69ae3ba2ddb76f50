//! Stresses of a solid element at its nodes, extrapolated from the points where they are most accurate.

use lissom_mesh::kinds::Functions;
use lissom_motion::{Matrix3, Vector3};

use super::Solid;
use super::deformation::Deformation;

/// Cauchy stress in global axes [Pa].
pub type CauchyStress = Matrix3;

/// Von Mises stress [Pa].
pub fn von_mises(stress: &CauchyStress) -> f64 {
    let deviator = stress - Matrix3::from_diagonal_element(stress.trace() / 3.0);
    (1.5 * deviator.norm_squared()).sqrt()
}

/// Largest principal stress [Pa].
pub fn principal(stress: &CauchyStress) -> f64 {
    stress.symmetric_eigenvalues().max()
}

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    /// Stress at a point.
    fn stress_at(
        &self,
        displacements: &[Vector3; NODES],
        mean: f64,
        functions: &Functions<NODES>,
    ) -> CauchyStress {
        let Ok((slopes, _)) = functions.gradients(&self.reference.positions) else {
            return CauchyStress::repeat(f64::NAN);
        };
        let (stretch, shrinking) = self.reference.stretch(functions);
        let point = Deformation::new(displacements, &slopes.map(|slope| slope / stretch), shrinking);
        self.law.first_stress(&point, mean) * point.gradient.transpose() / point.determinant
    }

    /// Stresses at the nodes, which are at these positions: linear between the points where they are most accurate.
    pub fn nodal_stresses(&self, positions: &[Vector3; NODES]) -> [CauchyStress; NODES] {
        let (displacements, mean) = (self.displacements(positions), self.deformed_to(positions).mean);
        let (at, count) = self.kind.stress_points;
        let mut stresses = [CauchyStress::zeros(); NODES];
        for k in 0..count {
            let functions = Functions::at(self.kind.functions, at(k));
            let stress = self.stress_at(&displacements, mean, &functions);
            for (node, sum) in stresses.iter_mut().enumerate() {
                *sum += (self.kind.stress_share)(k, self.kind.node(node)) * stress;
            }
        }
        stresses
    }
}
