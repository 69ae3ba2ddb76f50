//! Radau IIA with three stages, fifth order, stiffly accurate [Hairer and Wanner 1996, sections IV.5, IV.8].
//!
//! ```text
//! c = ((4 - √6)/10, (4 + √6)/10, 1),   A = [c_i^k/k] [c_j^(k-1)]⁻¹,   k = 1, 2, 3
//! ```
//!
//! In constrained motion positions are of fifth order, velocities of third and multipliers of second order [Hairer,
//! Lubich and Roche 1989].

use nalgebra::{Matrix3, Vector3};

use super::collocation::collocation;
use super::scheme::{Scheme, SchemeKind};

/// As for two stages, from the same estimates: their order is lower than that of the scheme.
const ERROR_CONSTANT: f64 = 0.5;
/// With a constant step size the scheme's error is of higher order than that fraction.
const PLANNED_SHARE: f64 = 0.05;

/// Registry entry.
pub const KIND: SchemeKind = SchemeKind {
    name: "radau-iia-5",
    summary: "Three-stage Radau IIA: fifth order, strongly damping; for smooth motions with small errors.",
    tolerance: None,
    build: |_| Ok(three_stages()),
};

/// The scheme.
///
/// # Panics
/// Never: the abscissae differ.
pub fn three_stages() -> Scheme {
    let root = 6.0_f64.sqrt();
    let abscissae = [(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0];
    // A maps the powers c^(k-1) to their integrals c^k/k.
    let powers = Matrix3::from_columns(&[0, 1, 2].map(|k| Vector3::from(abscissae.map(|c: f64| c.powi(k)))));
    let integrals = Matrix3::from_columns(
        &[1, 2, 3].map(|k| Vector3::from(abscissae.map(|c: f64| c.powi(k) / f64::from(k)))),
    );
    let inverse = powers * integrals.try_inverse().expect("abscissae differ");
    let rate = std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)]));
    Scheme {
        error_constant: ERROR_CONSTANT,
        planned_share: PLANNED_SHARE,
        controlled_order: 3,
        ..collocation("radau-iia-5".to_owned(), abscissae, rate)
    }
}
