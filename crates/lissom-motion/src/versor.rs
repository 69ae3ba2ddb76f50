//! Unit quaternions over any [`Real`]: product, action on vectors, exponential and logarithm. Independent of
//! translations.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::Mul;

use crate::coefficients::HalfAngle;
use crate::real::Real;
use crate::square::Square;
use crate::triple::Triple;

/// A rotation as a unit quaternion.
#[derive(Clone, Copy, Debug)]
pub struct Versor<R> {
    /// Cosine of half the angle.
    pub scalar: R,
    /// Sine of half the angle times the axis.
    pub vector: Triple<R>,
}

/// Series of `atan(x)/x` in `-x²`.
const ARC_TANGENT: [f64; 14] = {
    let mut series = [0.0; 14];
    let mut k = 0;
    while k < 14 {
        series[k] = 1.0 / (2 * k + 1) as f64;
        k += 1;
    }
    series
};
/// Below these squares of the tangent of half the angle this number of terms is sufficient;
const SHORT: (f64, usize) = (1.0 / 1024.0, 6);
const LONG: (f64, usize) = (1.0 / 64.0, 9);
/// and below this one all of them, for a quarter of the angle.
const QUARTER_UP_TO: f64 = 0.3;

impl<R: Real> Versor<R> {
    /// The rotation by `|θ|` \[rad\] about the direction of `θ`.
    #[inline(always)]
    pub fn exponential(theta: Triple<R>) -> Self {
        Self::from_half_angle(theta, HalfAngle::from_square(theta.norm_squared()))
    }

    #[inline(always)]
    pub(crate) fn from_half_angle(theta: Triple<R>, half: HalfAngle<R>) -> Self {
        Self { scalar: half.cosine, vector: theta * half.sine_by_angle }
    }

    /// The rotation vector `θ` \[rad\] with `|θ| ≤ π`, see [`crate::Rotation::logarithm`].
    #[inline(always)]
    pub fn logarithm(self) -> Triple<R> {
        let Self { scalar, vector } = self;
        let square = vector.norm_squared();
        if !(-scalar).all_below(0.0) {
            return self.any_logarithm();
        }
        let scalar_square = scalar * scalar;
        if square.minus_product(scalar_square, square.like(LONG.0)).all_below(0.0) {
            let inverse = scalar.like(1.0) / scalar;
            let x = -(square * inverse * inverse);
            let quotient = if (-x).all_below(SHORT.0) {
                polynomial(&ARC_TANGENT[..SHORT.1], x)
            } else {
                polynomial(&ARC_TANGENT[..LONG.1], x)
            };
            vector * (quotient * inverse).scaled(2.0)
        } else if square.minus_product(scalar_square, square.like(QUARTER_UP_TO)).all_below(0.0) {
            // tan(θ/4) = sin(θ/2)/(1 + cos(θ/2))
            let inverse = scalar.like(1.0) / (scalar + (scalar_square + square).square_root());
            let quotient = polynomial(&ARC_TANGENT, -(square * inverse * inverse));
            vector * (quotient * inverse).scaled(4.0)
        } else {
            self.any_logarithm()
        }
    }

    #[inline(always)]
    fn any_logarithm(self) -> Triple<R> {
        let Self { scalar, vector } = self;
        let [[x, y, z]] = R::one_by_one([scalar, vector.x, vector.y, vector.z], logarithm_of_any);
        Triple::new(x, y, z)
    }

    /// The inverse rotation.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Self { scalar: self.scalar, vector: -self.vector }
    }

    /// `R v`.
    #[inline(always)]
    pub fn apply(self, v: Triple<R>) -> Triple<R> {
        let t = self.vector.cross(v).scaled(2.0);
        v.plus_scaled(t, self.scalar).plus_cross(self.vector, t)
    }

    /// `Rᵀ v`.
    #[inline(always)]
    pub fn apply_inverse(self, v: Triple<R>) -> Triple<R> {
        let t = v.cross(self.vector).scaled(2.0);
        v.plus_scaled(t, self.scalar).plus_cross(t, self.vector)
    }

    /// `Rᵀ v - v`, without cancellation for small angles.
    #[inline(always)]
    pub fn apply_inverse_gain(self, v: Triple<R>) -> Triple<R> {
        let t = v.cross(self.vector).scaled(2.0);
        (t * self.scalar).plus_cross(t, self.vector)
    }

    /// The rows of [`Self::minus_identity`].
    #[inline(always)]
    pub(crate) fn minus_identity_rows(self) -> [Triple<R>; 3] {
        let [a, b, c, d, e, f, g, h, i] = self.minus_identity();
        [Triple::new(a, b, c), Triple::new(d, e, f), Triple::new(g, h, i)]
    }

    /// The matrix `R`.
    #[inline(always)]
    pub fn matrix(self) -> Square<R> {
        Square { rows: self.minus_identity_rows() } + Square::diagonal(self.scalar.like(1.0))
    }

    /// The matrix `R - I`, row by row, without cancellation for small angles: with the quaternion `(w, v)` it is `2
    /// (w ṽ + ṽ²)`.
    #[inline(always)]
    pub fn minus_identity(self) -> [R; 9] {
        let double = self.vector.scaled(2.0);
        let Triple { x, y, z } = self.vector;
        let (wx, wy, wz) = (self.scalar * double.x, self.scalar * double.y, self.scalar * double.z);
        let (xx, yy, zz) = (x * double.x, y * double.y, z * double.z);
        let (xy, xz, yz) = (x * double.y, x * double.z, y * double.z);
        [-(yy + zz), xy - wz, xz + wy, xy + wz, -(xx + zz), yz - wx, xz - wy, yz + wx, -(xx + yy)]
    }
}

impl<R: Real> Mul for Versor<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (v, w) = (self.vector, other.vector);
        Self {
            scalar: (self.scalar * other.scalar)
                .minus_product(v.x, w.x)
                .minus_product(v.y, w.y)
                .minus_product(v.z, w.z),
            vector: (w * self.scalar).plus_scaled(v, other.scalar).plus_cross(v, w),
        }
    }
}

/// With any sign, and for any angle.
fn logarithm_of_any([w, x, y, z]: [f64; 4]) -> [[f64; 3]; 1] {
    let negative = w < 0.0 || (w == 0.0 && first_nonzero([x, y, z]) < 0.0);
    let (scalar, sign) = (w.abs(), if negative { -1.0 } else { 1.0 });
    let square = x * x + y * y + z * z;
    let factor = if square < LONG.0 * scalar * scalar {
        2.0 * polynomial(&ARC_TANGENT[..LONG.1], -square / (scalar * scalar)) / scalar
    } else {
        let sine = square.sqrt();
        2.0 * sine.atan2(scalar) / sine
    };
    [[x, y, z].map(|component| sign * component * factor)]
}

fn first_nonzero(values: [f64; 3]) -> f64 {
    values.into_iter().find(|&value| value != 0.0).unwrap_or(0.0)
}

#[inline(always)]
fn polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    let mut sum = x.like(coefficients[coefficients.len() - 1]);
    for k in (0..coefficients.len() - 1).rev() {
        sum = x.like(coefficients[k]).plus_product(sum, x);
    }
    sum
}
