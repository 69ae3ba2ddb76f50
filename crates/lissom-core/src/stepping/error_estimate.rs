//! The error of a step: what the scheme's prediction from the start of the step has missed at its end, filtered once
//! through the tangent, so that motions faster than the step count as little as the scheme lets them through.
//!
//! ```text
//! e = κ (z - z_predicted),   J ẽ = w₂ M e,   ε = max_i |ẽ_i| size_i / (tolerance · reference)
//! ```
//!
//! z departure from going straight on at the end of the step, z_predicted = ½ h² times the acceleration (or the
//! scheme's memory of it) at the start: both are of order h² and differ in order h³. J is the tangent in use with its
//! constraints, so that what cannot move has no error; w₂ M its part from inertia [cf. Hairer and Wanner 1996, IV.8].
//! Sizes are 1 for rotations and 1/ℓ_r for translations. The reference is how far any node has moved or turned since
//! the start, at most 1.

use crate::system::{Kinematics, LOCKED, System};

/// Motions smaller than this part of the model's size are not resolved for their own sake.
pub(crate) const SMALLEST_REFERENCE: f64 = 1e-6;

/// Errors of a step below this part of the model's size are round-off, which no smaller step lowers.
pub(crate) const SMALLEST_ERROR: f64 = 3e-13;

/// Largest scaled displacement or turn of a node between two instants, at most 1.
pub(crate) fn excursion(from: &Kinematics, to: &Kinematics, length: f64) -> f64 {
    let mut most = 0.0_f64;
    for (a, b) in from.nodes.iter().zip(&to.nodes) {
        let shift = (b.frame.position - a.frame.position).norm() / length;
        let [p, q] = [a, b].map(|node| node.frame.rotation.quaternion());
        // |sin(φ/2)| of the relative turn, from the chord between the two unit quaternions.
        let chord = |sign: f64| p.iter().zip(&q).map(|(p, q)| (p - sign * q).powi(2)).sum::<f64>();
        let turn = 2.0 * chord(1.0).min(chord(-1.0)).sqrt();
        most = most.max(shift).max(turn);
        if most >= 1.0 {
            return 1.0;
        }
    }
    most
}

/// `out = M e` over the coordinate rows; zero where there is no mass.
pub(crate) fn inertial_part(system: &System, error: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for inertia in system.inertias() {
        let rows = system.layout().rows_of_node(inertia.node());
        for (i, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            let mut sum = 0.0;
            for (k, &column) in rows.iter().enumerate().filter(|&(_, &column)| column != LOCKED) {
                sum += inertia.mass()[(i, k)] * error[column as usize];
            }
            out[row as usize] += sum;
        }
    }
}
