//! Work of a force along a path.

/// ∫ f dx of a force that changes linearly in time along a cubic path of given ends and speeds at them: (f₀ + f₁)/2
/// Δx + (f₁ - f₀)(v₁ - v₀) T/12.
pub fn along(forces: [f64; 2], way: f64, speeds: [f64; 2], elapsed: f64) -> f64 {
    0.5 * (forces[0] + forces[1]) * way + (forces[1] - forces[0]) * (speeds[1] - speeds[0]) * (elapsed / 12.0)
}
