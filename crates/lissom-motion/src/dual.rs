//! Dual numbers `a + ε b` with `ε² = 0`, and vectors and matrices of them.
//! A twist `(u; θ)` is the dual vector `θ + ε u`, a wrench `(n; m)` the dual vector `n + ε m`.
//! Knows no rotation and no exponential.

use std::ops::{Add, Mul, Neg, Sub};

use crate::{Matrix3, Matrix6, Vector3, Vector6, rotation_part, screw, skew, translation_part};

/// The scalar `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual {
    pub(crate) real: f64,
    pub(crate) dual: f64,
}

/// The vector `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DualVector {
    pub(crate) real: Vector3,
    pub(crate) dual: Vector3,
}

/// The matrix `real + ε dual`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DualMatrix {
    pub(crate) real: Matrix3,
    pub(crate) dual: Matrix3,
}

impl Dual {
    #[inline]
    pub(crate) fn new(real: f64, dual: f64) -> Self {
        Self { real, dual }
    }
}

impl DualVector {
    /// `θ + ε u` of the twist `(u; θ)`.
    #[inline]
    pub(crate) fn from_twist(v: &Vector6) -> Self {
        Self { real: rotation_part(v), dual: translation_part(v) }
    }

    /// `n + ε m` of the wrench `(n; m)`.
    #[inline]
    pub(crate) fn from_wrench(w: &Vector6) -> Self {
        Self { real: translation_part(w), dual: rotation_part(w) }
    }

    #[inline]
    pub(crate) fn to_twist(self) -> Vector6 {
        screw(&self.dual, &self.real)
    }

    #[inline]
    pub(crate) fn to_wrench(self) -> Vector6 {
        screw(&self.real, &self.dual)
    }

    #[inline]
    pub(crate) fn dot(self, other: Self) -> Dual {
        Dual::new(self.real.dot(&other.real), self.real.dot(&other.dual) + self.dual.dot(&other.real))
    }

    #[inline]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            real: self.real.cross(&other.real),
            dual: self.real.cross(&other.dual) + self.dual.cross(&other.real),
        }
    }
}

impl DualMatrix {
    #[inline]
    pub(crate) fn diagonal(value: Dual) -> Self {
        Self {
            real: Matrix3::from_diagonal_element(value.real),
            dual: Matrix3::from_diagonal_element(value.dual),
        }
    }

    #[inline]
    pub(crate) fn skew(v: DualVector) -> Self {
        Self { real: skew(&v.real), dual: skew(&v.dual) }
    }

    /// `a bᵀ`.
    #[inline]
    pub(crate) fn outer(a: DualVector, b: DualVector) -> Self {
        Self {
            real: a.real * b.real.transpose(),
            dual: a.real * b.dual.transpose() + a.dual * b.real.transpose(),
        }
    }

    /// The 6 x 6 matrix from twists to twists: `[[A, B], [0, A]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_twist_matrix(self) -> Matrix6 {
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.dual);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.real);
        matrix
    }

    /// The 6 x 6 matrix from twists to wrenches: `[[0, A], [A, B]]` of `A + ε B`.
    #[inline]
    pub(crate) fn to_wrench_matrix(self) -> Matrix6 {
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.real);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.dual);
        matrix
    }
}

macro_rules! linear_operations {
    ($kind:ident) => {
        impl Add for $kind {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self { real: self.real + other.real, dual: self.dual + other.dual }
            }
        }
        impl Sub for $kind {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self { real: self.real - other.real, dual: self.dual - other.dual }
            }
        }
        impl Neg for $kind {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self { real: -self.real, dual: -self.dual }
            }
        }
        impl Mul<f64> for $kind {
            type Output = Self;
            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self { real: self.real * factor, dual: self.dual * factor }
            }
        }
        impl Mul<Dual> for $kind {
            type Output = Self;
            #[inline]
            fn mul(self, factor: Dual) -> Self {
                Self {
                    real: self.real * factor.real,
                    dual: self.dual * factor.real + self.real * factor.dual,
                }
            }
        }
    };
}

linear_operations!(Dual);
linear_operations!(DualVector);
linear_operations!(DualMatrix);
