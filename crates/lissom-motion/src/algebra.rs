//! Vectors, skew matrices, twists and wrenches. Independent of rotations and the exponential.

use crate::{Matrix3, Vector3, Vector6};

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
