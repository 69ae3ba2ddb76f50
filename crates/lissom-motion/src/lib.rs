//! Rotations and rigid motions: exponential, logarithm, adjoint and tangent operators with their derivatives.
//!
//! Pure geometry: this crate is independent of mass, forces and time steps, and it never allocates.
//!
//! Conventions:
//! - a twist is a [`Vector6`] (translation `u`; rotation `θ`), a wrench is a [`Vector6`] (force `n`; moment `m`),
//!   and their power is the plain dot product;
//! - a motion `H = (R, x)` maps body coordinates `X` to `x + R X`;
//! - increments and variations are in the body frame: `H_new = H exp(ψ)`, `δh = vee(H⁻¹ δH)`;
//! - the tangent operator is the one of the body frame: `vee(exp(d)⁻¹ δexp(d)) = T(d) δd`.
//!
//! Every SE(3) operator is the SO(3) formula over dual numbers (principle of transference: Kotelnikov 1895, Study
//! 1903), so each formula is written once, in the private modules `dual` and `operator`.
//!
//! Frequently evaluated formulas are written over any [`Real`]: a number, or [`Lanes`], several numbers side by side
//! in one vector register. [`Pose`], [`Versor`], [`Screw`] and [`Triple`] are [`Motion`], [`Rotation`], twist or
//! wrench, and vector over them; those of plain numbers call the same formulas.

mod algebra;
mod coefficients;
mod dual;
mod jet;
mod lanes;
mod motion;
mod operator;
mod pose;
mod real;
mod rotation;
mod screw;
mod screw_operators;
mod slopes;
mod square;
mod tangent;
mod triple;
mod versor;
#[cfg(test)]
#[path = "../tests/exactness/wide.rs"]
mod wide;

pub use algebra::{axial, rotation_part, screw, skew, translation_part};
pub use dual::DualMatrix;
pub use jet::Jet;
pub use lanes::{Block, Lanes, WIDTH};
pub use motion::Motion;
pub use pose::Pose;
pub use real::Real;
pub use rotation::{Rotation, rotation_exponential_minus_identity};
pub use screw::Screw;
pub use screw_operators::{
    CurvedTangent, InverseTangent, TangentOperator, coadjoint_matrix, coadjoint_times, lie_bracket,
    lie_bracket_matrix,
};
pub use slopes::Slopes;
pub use square::Square;
pub use tangent::{
    ScrewTangent, inverse_tangent, inverse_tangent_derivative, inverse_tangent_derivative_transpose_times,
    inverse_tangent_hessian, inverse_tangent_times, inverse_tangent_transpose_derivative,
    inverse_tangent_transpose_times, rotation_inverse_tangent, rotation_tangent, tangent, tangent_derivative,
    tangent_derivative_rate, tangent_derivative_transpose_times, tangent_hessian, tangent_rate,
    tangent_rate_times, tangent_times, tangent_transpose_derivative, tangent_transpose_times,
};
pub use triple::Triple;
pub use versor::Versor;

/// A vector of three components.
pub type Vector3 = nalgebra::Vector3<f64>;
/// A twist (translation; rotation) or a wrench (force; moment).
pub type Vector6 = nalgebra::Vector6<f64>;
/// A 3 x 3 matrix.
pub type Matrix3 = nalgebra::Matrix3<f64>;
/// A 6 x 6 matrix, in blocks of (translation; rotation) or (force; moment).
pub type Matrix6 = nalgebra::Matrix6<f64>;
