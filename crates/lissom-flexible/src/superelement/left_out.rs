//! Forces of the modes omitted from a superelement if it is excited faster than its modes can follow: an estimate for a warning.
//!
//! Legend: y displacements relative to the floating frame, M_y their mass, m total mass, G momentum by their rates, V natural
//! modes with the floating frame fixed, z = Vᵀ M_y y, L_i = G V_i. The effective mass of mode i along axis c is L_ci² [Craig and
//! Kurdila 2006, ch. 17].
//!
//! ```text
//! left out     μ_c = m - Σ_i L_ci²
//! last mode    n(c) the highest one with L_ci² > LEAST m
//! error_c = μ_c L_cn z̈_n / |L_n|²
//! ```
//!
//! A mode whose period is short compared with changes of the load responds statically, and z̈ vanishes. A sudden load accelerates
//! all modes alike, z̈_i = -L_i a. This includes omitted modes, whose mass moves with the floating frame in the model, but not in
//! the part. The response of the highest retained mode shows how much of a load is sudden.

use lissom_motion::{Vector3, rotation_part, translation_part};
use nalgebra::{DMatrix, Matrix3xX, SymmetricEigen};

use super::part::Part;
use super::relative::Relative;
use super::vectors::three;
use lissom_mechanics::kinematics::Kinematics;

/// Error of forces, as a fraction of the largest inertial or elastic force of the element, that causes a warning.
pub(super) const MAX_ERROR: f64 = 0.05;
/// Smallest effective mass of a significant mode, as a fraction of the mass.
const MIN_MASS_FRACTION: f64 = 0.01;

/// Maps of accelerations ÿ to errors of forces [kg].
#[derive(Clone, Debug)]
pub(super) struct LeftOut {
    error: Matrix3xX<f64>,
}

impl LeftOut {
    /// For an element; none if nothing moves relative to the floating frame.
    pub(super) fn of(element: &Part) -> Option<Self> {
        let rows: Vec<usize> = (0..element.size()).filter(|row| row / 6 != element.frame).collect();
        if rows.is_empty() {
            return None;
        }
        let carried = element.carried.select_columns(&rows);
        let taken = |matrix: &DMatrix<f64>| matrix.select_rows(&rows).select_columns(&rows);
        let mass = taken(&element.mass) + carried.tr_mul(&carried) / element.total;
        let lower = mass.clone().cholesky()?.l();
        let half = lower.solve_lower_triangular(&taken(&element.stiffness))?;
        let scaled = lower.solve_lower_triangular(&half.transpose())?;
        let SymmetricEigen { eigenvectors, eigenvalues } =
            SymmetricEigen::new(0.5 * (&scaled + scaled.transpose()));
        let shapes = lower.transpose().solve_upper_triangular(&eigenvectors)?;
        let momenta = &carried * &shapes;
        let mut error = Matrix3xX::zeros(element.size());
        for axis in 0..3 {
            let shares = momenta.row(axis).map(|own| own * own / element.total);
            let counts = (0..rows.len()).filter(|&mode| shares[mode] > MIN_MASS_FRACTION);
            let Some(last) = counts.max_by(|&a, &b| eigenvalues[a].total_cmp(&eigenvalues[b])) else {
                continue;
            };
            let missing = element.total * (1.0 - shares.sum()).max(0.0);
            let factor = missing * momenta[(axis, last)] / momenta.column(last).norm_squared();
            let modal = &mass * shapes.column(last);
            for (&row, value) in rows.iter().zip(modal.iter()) {
                error[(axis, row)] = factor * value;
            }
        }
        Some(Self { error })
    }

    /// The error of forces as a fraction of the largest of inertial and elastic forces and weight; none without forces. `stress`
    /// is K u.
    pub(super) fn share(&self, element: &Part, at: &Kinematics, stress: &[f64]) -> Option<f64> {
        let mut error = Vector3::zeros();
        let (mut largest, mut sum) = (0.0_f64, Vector3::zeros());
        for i in 0..element.nodes.len() {
            let Some(seen) = Relative::of(element, i, at) else { continue };
            error += self.error.fixed_columns::<6>(6 * i) * seen.second();
            let force = three(stress, 6 * i);
            largest = largest.max(force.norm());
            sum += force;
        }
        for (k, &coordinate) in element.coordinates.iter().enumerate() {
            error += self.error.column(6 * element.nodes.len() + k) * at.coordinates[coordinate].acceleration;
        }
        let base = &at.nodes[element.nodes[element.frame]];
        let (velocity, spin) = (translation_part(&base.twist), rotation_part(&base.twist));
        let (change, turning) = (translation_part(&base.acceleration), rotation_part(&base.acceleration));
        let centre = element.moment / element.total;
        let gravity = base.frame.rotation.apply_inverse(&element.gravity.at(at.time));
        let rigid =
            change + spin.cross(&velocity) + turning.cross(&centre) + spin.cross(&spin.cross(&centre))
                - gravity;
        // Weight is included: a part in free fall has no other forces.
        let weight = element.total * gravity.norm();
        let largest = largest.max(sum.norm()).max(element.total * rigid.norm()).max(weight);
        (largest > 0.0).then(|| error.norm() / largest)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/superelement/left_out.rs"]
mod tests;
