//! Vectors, skew matrices, twists and wrenches, and the Lie bracket of twists. Independent of rotations and the
//! exponential.

use crate::dual::{DualMatrix, DualVector};
use crate::screw::Screw;
use crate::{Matrix3, Matrix6, Vector3, Vector6};

/// The skew matrix `ṽ` with `ṽ w = v × w`.
#[inline]
pub fn skew(v: &Vector3) -> Matrix3 {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// The axial vector `v` of the skew part of `m`: `ṽ = (m - mᵀ)/2`.
#[inline]
pub fn axial(m: &Matrix3) -> Vector3 {
    Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]) * 0.5
}

/// The twist (translation; rotation), or the wrench (force; moment).
#[inline]
pub fn screw(translation: &Vector3, rotation: &Vector3) -> Vector6 {
    Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z)
}

/// The translation of a twist, or the force of a wrench: components 0, 1, 2.
#[inline]
pub fn translation_part(v: &Vector6) -> Vector3 {
    Vector3::new(v[0], v[1], v[2])
}

/// The rotation of a twist, or the moment of a wrench: components 3, 4, 5.
#[inline]
pub fn rotation_part(v: &Vector6) -> Vector3 {
    Vector3::new(v[3], v[4], v[5])
}

/// The matrix `ad_V = [[θ̃, ũ], [0, θ̃]]` of the twist `V = (u; θ)`.
#[inline]
pub fn lie_bracket_matrix(v: &Vector6) -> Matrix6 {
    DualMatrix::skew(DualVector::from_twist(v.into())).to_twist_matrix()
}

/// The Lie bracket of two twists, `ad_V W = (θ_v × u_w + u_v × θ_w; θ_v × θ_w)`.
#[inline]
pub fn lie_bracket(v: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(v).lie_bracket(w.into()).into()
}

/// The coadjoint action `ad_Vᵀ W` of the twist `v` on the wrench `w = (n; m)`: `(n × θ; n × u + m × θ)`.
#[inline]
pub fn coadjoint_times(v: &Vector6, w: &Vector6) -> Vector6 {
    Screw::from(v).coadjoint_times(w.into()).into()
}

/// The matrix `X(W) = [[0, ñ], [ñ, m̃]]` of the wrench `w = (n; m)` with `ad_Vᵀ W = X(W) V`.
#[inline]
pub fn coadjoint_matrix(w: &Vector6) -> Matrix6 {
    DualMatrix::skew(DualVector::from_wrench(w.into())).to_wrench_matrix()
}
