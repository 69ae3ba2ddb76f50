//! Derivatives of a solid element's forces.
//!
//! ```text
//! K_IJ e_k = Σ w δP(e_k ⊗ G_J) G_I  +  (K - K₀)/V₀ v_I (v_J·e_k),      v_I = Σ w J F⁻ᵀ G_I
//! ```
//!
//! The geometric part of St. Venant-Kirchhoff has stresses that are predicted linearly from the iterate before,
//! S* = S(E + sym Fᵀ ΔF), as in shells [Magisano, Leonetti and Garcea 2017]. That of rubber has such a pressure of the mean dilatation,
//! m* = m + (K - K₀)/V₀ Σ v_I·Δx_I: as if the pressure were an unknown of the element, whose equation is solved in every iteration.

use lissom_motion::{Matrix3, Vector3};

use super::deformation::Deformation;
use super::law::SolidModel;
use super::stage_forces::strain_change;
use super::{Deformed, Solid};
use lissom_mechanics::elements::Tangents;
use lissom_mechanics::kinematics::{Kinematics, Stressed};

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    pub(super) fn add_tangent(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents) {
        let points = self.deformed(at).points;
        let mean = self.predicted_mean(at, stressed);
        let geometric = self.geometric_stresses(&points, stressed);
        let size = 6 * NODES;
        let volume_slopes = self.volume_slopes(&points);
        let mut blocks = [[Matrix3::zeros(); NODES]; NODES];
        for (p, point) in points.iter().enumerate() {
            let (slopes, volume) = (&self.reference.gradients[p], self.reference.volumes[p]);
            // Derivatives of the stress by the entries of the deformation gradient, of which those by G are combinations.
            let moduli: [[Matrix3; 3]; 3] = std::array::from_fn(|k| {
                std::array::from_fn(|along| {
                    let slope = Vector3::ith(along, volume);
                    self.law.stress_change(point, (&geometric[p], mean), (k, &slope))
                })
            });
            for (j, slope) in slopes.iter().enumerate() {
                let changes = moduli.each_ref().map(|[x, y, z]| x * slope.x + y * slope.y + z * slope.z);
                // The tangent is symmetric: rows from the diagonal block on.
                for (block, other) in blocks[j].iter_mut().zip(slopes).skip(j) {
                    for (k, change) in changes.iter().enumerate() {
                        let force = change * other;
                        (0..3).for_each(|row| block[(row, k)] += force[row]);
                    }
                }
            }
        }
        let factor = self.law.bulk_of_mean() / self.reference.volume;
        for j in 0..NODES {
            for i in j..NODES {
                let block = blocks[j][i] + factor * volume_slopes[i] * volume_slopes[j].transpose();
                for row in 0..3 {
                    for k in 0..3 {
                        out.stiffness[(6 * i + row) * size + 6 * j + k] += block[(row, k)];
                    }
                }
                for row in (0..3).filter(|_| i > j) {
                    for k in 0..3 {
                        out.stiffness[(6 * j + k) * size + 6 * i + row] =
                            out.stiffness[(6 * i + row) * size + 6 * j + k];
                    }
                }
            }
        }
    }

    /// Pressure of the mean dilatation in the geometric part [Pa].
    fn predicted_mean(&self, at: &Kinematics, stressed: Stressed<'_>) -> f64 {
        let Some(previous) = stressed.previous else { return self.deformed(stressed.at).mean };
        let Deformed { points, mean } = self.deformed(previous);
        let shifts = self.positions(at).into_iter().zip(self.positions(previous));
        let change: f64 = shifts.zip(self.volume_slopes(&points)).map(|((x, y), v)| v.dot(&(x - y))).sum();
        mean + self.law.bulk_of_mean() / self.reference.volume * change
    }

    /// Second stresses of the geometric part at all points; zero where the law does not use them.
    fn geometric_stresses(
        &self,
        points: &[Deformation; POINTS],
        stressed: Stressed<'_>,
    ) -> [Matrix3; POINTS] {
        if self.law.model == SolidModel::Rubber {
            return [Matrix3::zeros(); POINTS];
        }
        let from = self.deformed(stressed.previous.unwrap_or(stressed.at)).points;
        std::array::from_fn(|p| {
            let mut strain = from[p].strain();
            if stressed.previous.is_some() {
                strain += strain_change(&from[p].gradient, &(points[p].gradient - from[p].gradient));
            }
            self.law.second_stress(&strain)
        })
    }
}
