//! Rotations as unit quaternions: exponential, logarithm, matrices. Independent of translations and
//! tangent operators.

use std::ops::Mul;

use crate::coefficients::{HalfAngle, exponential_coefficients};
use crate::versor::Versor;
use crate::{Matrix3, Vector3, skew};

/// A rotation, stored as a unit quaternion.
///
/// `q` and `-q` are the same rotation but compare as different; compare `a.inverse() * b` with the identity instead.
/// Products are not renormalised: call [`Rotation::normalized`] after long chains of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    scalar: f64,
    vector: Vector3,
}

/// Smallest sine of the angle between two directions that still span a plane.
const PARALLEL: f64 = 1e-10;

impl Rotation {
    /// The identity.
    pub const IDENTITY: Self = Self { scalar: 1.0, vector: Vector3::new(0.0, 0.0, 0.0) };

    /// The identity.
    #[inline]
    pub fn identity() -> Self {
        Self::IDENTITY
    }

    /// The rotation by `|θ|` \[rad\] about the direction of `θ`.
    #[inline]
    pub fn exponential(theta: &Vector3) -> Self {
        Versor::exponential(theta.into()).into()
    }

    /// The rotation vector `θ` \[rad\] with `|θ| ≤ π`.
    ///
    /// For a half turn, which has two such vectors, the one whose first nonzero component is positive.
    #[inline]
    pub fn logarithm(&self) -> Vector3 {
        Versor::from(self).logarithm().into()
    }

    /// The inverse rotation.
    #[inline]
    pub fn inverse(&self) -> Self {
        Self { scalar: self.scalar, vector: -self.vector }
    }

    /// `R v`.
    #[inline]
    pub fn apply(&self, v: &Vector3) -> Vector3 {
        Versor::from(self).apply(v.into()).into()
    }

    /// `Rᵀ v`.
    #[inline]
    pub fn apply_inverse(&self, v: &Vector3) -> Vector3 {
        Versor::from(self).apply_inverse(v.into()).into()
    }

    /// The rotation matrix.
    #[inline]
    pub fn matrix(&self) -> Matrix3 {
        let (w, x, y, z) = (self.scalar, self.vector.x, self.vector.y, self.vector.z);
        let (x2, y2, z2) = (2.0 * x, 2.0 * y, 2.0 * z);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        let (xx, xy, xz, yy, yz, zz) = (x * x2, x * y2, x * z2, y * y2, y * z2, z * z2);
        Matrix3::new(
            1.0 - yy - zz,
            xy - wz,
            xz + wy,
            xy + wz,
            1.0 - xx - zz,
            yz - wx,
            xz - wy,
            yz + wx,
            1.0 - xx - yy,
        )
    }

    /// The rotation nearest (in the Frobenius norm) to a nearly orthonormal, right-handed matrix.
    ///
    /// It is the dominant eigenvector of a symmetric 4 x 4 matrix (Bar-Itzhack 2000). For a rotation matrix all
    /// columns of that matrix are multiples of the quaternion; the largest (Shepperd 1978) starts a power iteration
    /// whose rate is the distance from orthonormality.
    #[inline]
    pub fn from_matrix(m: &Matrix3) -> Self {
        let (xx, yy, zz) = (m[(0, 0)], m[(1, 1)], m[(2, 2)]);
        let (wx, wy, wz) = (m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]);
        let (xy, xz, yz) = (m[(0, 1)] + m[(1, 0)], m[(0, 2)] + m[(2, 0)], m[(1, 2)] + m[(2, 1)]);
        let form = nalgebra::Matrix4::new(
            1.0 + xx + yy + zz,
            wx,
            wy,
            wz,
            wx,
            1.0 + xx - yy - zz,
            xy,
            xz,
            wy,
            xy,
            1.0 - xx + yy - zz,
            yz,
            wz,
            xz,
            yz,
            1.0 - xx - yy + zz,
        );
        let mut q = form.column(form.diagonal().imax()).normalize();
        for _ in 0..40 {
            let next = (form * q).normalize();
            let change = (next - q).amax();
            q = next;
            if change <= f64::EPSILON {
                break;
            }
        }
        Self { scalar: q[0], vector: Vector3::new(q[1], q[2], q[3]) }
    }

    /// The rotation nearest to the one whose matrix has these columns; `None` if they are not a right-handed,
    /// nearly orthonormal triad (volume and lengths within 10 % of one).
    #[inline]
    pub fn from_columns(first: &Vector3, second: &Vector3, third: &Vector3) -> Option<Self> {
        let near_one = |value: f64| (value - 1.0).abs() < 0.1;
        let lengths = [first, second, third].iter().all(|column| near_one(column.norm()));
        (lengths && near_one(first.cross(second).dot(third)))
            .then(|| Self::from_matrix(&Matrix3::from_columns(&[*first, *second, *third])))
    }

    /// The rotation whose first axis points along `axis`, and whose second axis is in the plane of `axis` and
    /// `reference`, on the side of `reference`. Lengths have no effect; `None` if one is zero or both are parallel.
    #[inline]
    pub fn from_axis_and_reference(axis: &Vector3, reference: &Vector3) -> Option<Self> {
        let first = direction(axis)?;
        let normal = first.cross(&direction(reference)?);
        let length = normal.norm();
        if length.is_nan() || length <= PARALLEL {
            return None;
        }
        // If the reference is nearly along the axis, the normal is not quite perpendicular; two further products
        // correct that.
        let second = normal.cross(&first).normalize();
        Self::from_columns(&first, &second, &first.cross(&second))
    }

    /// The rotation by `angle` \[rad\] about the unit vector `axis`.
    #[inline]
    pub fn about_axis(axis: &Vector3, angle: f64) -> Self {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        Self { scalar: cosine, vector: axis * sine }
    }

    /// This rotation with the quaternion normalised.
    #[inline]
    pub fn normalized(&self) -> Self {
        let factor = 1.0 / (self.scalar * self.scalar + self.vector.norm_squared()).sqrt();
        Self { scalar: self.scalar * factor, vector: self.vector * factor }
    }

    /// The quaternion `[w, x, y, z]`, scalar part first.
    #[inline]
    pub fn quaternion(&self) -> [f64; 4] {
        [self.scalar, self.vector.x, self.vector.y, self.vector.z]
    }

    /// From a quaternion `[w, x, y, z]` of any length; `None` if it is zero or not finite.
    #[inline]
    pub fn from_quaternion(quaternion: [f64; 4]) -> Option<Self> {
        let largest = quaternion.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        let finite = quaternion.iter().all(|component| component.is_finite());
        (finite && largest > 0.0).then(|| {
            let [w, x, y, z] = quaternion.map(|component| component / largest);
            Self { scalar: w, vector: Vector3::new(x, y, z) }.normalized()
        })
    }
}

impl From<&Rotation> for Versor<f64> {
    #[inline]
    fn from(rotation: &Rotation) -> Self {
        Self { scalar: rotation.scalar, vector: (&rotation.vector).into() }
    }
}

impl From<Versor<f64>> for Rotation {
    #[inline]
    fn from(versor: Versor<f64>) -> Self {
        Self { scalar: versor.scalar, vector: versor.vector.into() }
    }
}

/// The unit vector along `v`; `None` if `v` is zero or not finite.
#[inline]
fn direction(v: &Vector3) -> Option<Vector3> {
    let largest = v.amax();
    (largest > 0.0 && v.iter().all(|component| component.is_finite())).then(|| (v / largest).normalize())
}

impl Default for Rotation {
    #[inline]
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Mul for Rotation {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        (Versor::from(&self) * Versor::from(&other)).into()
    }
}

/// `exp(θ̃) - I`, accurate relative to its own size for the smallest `θ` \[rad\].
#[inline]
pub fn rotation_exponential_minus_identity(theta: &Vector3) -> Matrix3 {
    let q = theta.norm_squared();
    let half = HalfAngle::from_square(q);
    let [[b, _]] = exponential_coefficients::<f64, 1>(q);
    skew(theta) * (2.0 * half.sine_by_angle * half.cosine)
        + (theta * theta.transpose() - Matrix3::from_diagonal_element(q)) * b
}
