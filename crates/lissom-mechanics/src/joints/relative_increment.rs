//! Relative motion of a joint's frames, for one number or several side by side: present rotation, position and own
//! coordinates, and their changes since the start of the step without cancellation.
//!
//! With (E, p_E) and (F, p_F) the changes of base and tip joint frame, (R, x) at the start and P = Rᵀx:
//!
//! ```text
//! R' = EᵀRF,   ΔR = aᵀR + (R + aᵀR) b,           a = E - I,  b = F - I
//! P' = R'ᵀx',  ΔP = D + bᵀ(P + D),               D = p_F - Rᵀ p_E
//! x' = Eᵀ(x + y),  Δx = y + aᵀ(x + y),           y = R p_F - p_E
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Matrix3, Real, Triple, Vector3, Versor};

use super::{JointCoordinates, MAX_COORDINATES, Relative};

/// Three axes: a matrix by its columns.
#[derive(Clone, Copy, Debug)]
pub struct Axes<R>(pub [Triple<R>; 3]);

impl<R: Real> Axes<R> {
    /// The rotation's matrix.
    #[inline(always)]
    pub fn of(rotation: Versor<R>) -> Self {
        let (zero, one) = (rotation.scalar.like(0.0), rotation.scalar.like(1.0));
        Self([
            rotation.apply(Triple::new(one, zero, zero)),
            rotation.apply(Triple::new(zero, one, zero)),
            rotation.apply(Triple::new(zero, zero, one)),
        ])
    }

    /// `A v`.
    #[inline(always)]
    #[must_use]
    pub fn times(self, v: Triple<R>) -> Triple<R> {
        (self.0[0] * v.x).plus_scaled(self.0[1], v.y).plus_scaled(self.0[2], v.z)
    }

    /// `Aᵀ v`.
    #[inline(always)]
    #[must_use]
    pub fn transpose_times(self, v: Triple<R>) -> Triple<R> {
        Triple::new(self.0[0].dot(v), self.0[1].dot(v), self.0[2].dot(v))
    }

    /// `A B`.
    #[inline(always)]
    #[must_use]
    pub fn product(self, other: Self) -> Self {
        Self([self.times(other.0[0]), self.times(other.0[1]), self.times(other.0[2])])
    }

    /// `Aᵀ B`.
    #[inline(always)]
    #[must_use]
    pub(crate) fn transpose_product(self, other: Self) -> Self {
        Self([
            self.transpose_times(other.0[0]),
            self.transpose_times(other.0[1]),
            self.transpose_times(other.0[2]),
        ])
    }

    /// `A + B`.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1], self.0[2] + other.0[2]])
    }

    /// `A - B`.
    #[inline(always)]
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1], self.0[2] - other.0[2]])
    }

    /// Sum of the diagonal.
    #[inline(always)]
    pub fn trace(self) -> R {
        self.0[0].x + self.0[1].y + self.0[2].z
    }

    /// The axial vector of the skew part.
    #[inline(always)]
    pub fn axial(self) -> Triple<R> {
        let [a, b, c] = self.0;
        Triple::new(b.z - c.y, c.x - a.z, a.y - b.x).scaled(0.5)
    }
}

impl From<&Matrix3> for Axes<f64> {
    #[inline(always)]
    fn from(matrix: &Matrix3) -> Self {
        let column = |k: usize| Triple::new(matrix[(0, k)], matrix[(1, k)], matrix[(2, k)]);
        Self([column(0), column(1), column(2)])
    }
}

impl From<Axes<f64>> for Matrix3 {
    #[inline(always)]
    fn from(axes: Axes<f64>) -> Self {
        Self::from_columns(&axes.0.map(Vector3::from))
    }
}

/// Change of a frame, see [`crate::kinematics::MotionChange`].
#[derive(Clone, Copy, Debug)]
pub struct FrameChange<R> {
    /// E - I.
    pub turn: Axes<R>,
    /// p [m].
    pub shift: Triple<R>,
}

impl<R: Real> FrameChange<R> {
    /// Change of a frame fixed at `offset`, with its axes.
    #[inline(always)]
    #[must_use]
    pub(crate) fn carried_at(self, axes: Option<Axes<R>>, offset: Triple<R>) -> Self {
        let shift = self.shift + self.turn.times(offset);
        match axes {
            None => Self { turn: self.turn, shift },
            Some(axes) => Self {
                turn: axes.transpose_product(self.turn.product(axes)),
                shift: axes.transpose_times(shift),
            },
        }
    }
}

/// Motion of the tip's joint frame in the base's joint frame, and its change since the start of the step.
#[derive(Clone, Copy, Debug)]
pub struct RelativeIncrement<R> {
    /// Relative rotation at the start.
    pub start_rotation: Axes<R>,
    /// Change of the relative rotation.
    pub rotation_change: Axes<R>,
    /// P: present relative position in the tip's axes [m].
    pub place: Triple<R>,
    /// Change of P [m].
    pub place_change: Triple<R>,
    /// Change of the relative position in the base's axes [m].
    pub position_change: Triple<R>,
}

impl<R: Real> RelativeIncrement<R> {
    /// From rotation and position at the start and the changes of both joint frames.
    #[inline(always)]
    pub fn new(start: (Axes<R>, Triple<R>), base: FrameChange<R>, tip: FrameChange<R>) -> Self {
        let (rotation, place) = start;
        let turned = base.turn.transpose_product(rotation);
        let shift = tip.shift - rotation.transpose_times(base.shift);
        let place_change = shift + tip.turn.transpose_times(place + shift);
        let position_shift = rotation.times(tip.shift) - base.shift;
        let position = rotation.times(place);
        Self {
            start_rotation: rotation,
            rotation_change: turned.plus(rotation.plus(turned).product(tip.turn)),
            place: place + place_change,
            place_change,
            position_change: position_shift + base.turn.transpose_times(position + position_shift),
        }
    }

    /// Present relative rotation.
    #[inline(always)]
    pub fn rotation(&self) -> Axes<R> {
        self.start_rotation.plus(self.rotation_change)
    }
}

impl From<&Relative> for RelativeIncrement<f64> {
    fn from(relative: &Relative) -> Self {
        let Relative { rotation, position, rotation_change, position_change } = relative;
        let start = position - position_change;
        // Rᵀx - R₀ᵀx₀ = ΔRᵀ x₀ + Rᵀ Δx
        let place_change = rotation_change.tr_mul(&start) + rotation.tr_mul(position_change);
        Self {
            start_rotation: (&relative.start_rotation()).into(),
            rotation_change: rotation_change.into(),
            place: (&rotation.tr_mul(position)).into(),
            place_change: (&place_change).into(),
            position_change: position_change.into(),
        }
    }
}

/// An angle by its sine and cosine, and their changes since the start of the step.
#[derive(Clone, Copy, Debug)]
pub struct Angle<R> {
    /// Present sine.
    pub sine: R,
    /// Present cosine.
    pub cosine: R,
    /// Change of the sine.
    pub sine_change: R,
    /// Change of the cosine.
    pub cosine_change: R,
}

impl<R: Real> Angle<R> {
    /// From sine and cosine at the start and the change δ:
    /// Δ sin φ = sin φ (cos δ - 1) + cos φ sin δ, Δ cos φ = cos φ (cos δ - 1) - sin φ sin δ.
    #[inline(always)]
    pub fn turned([sine, cosine]: [R; 2], change: R) -> Self {
        let zero = change.like(0.0);
        let half = Versor::exponential(Triple::new(zero, zero, change));
        let (half_sine, half_cosine) = (half.vector.z, half.scalar);
        let sine_of_change = (half_sine * half_cosine).scaled(2.0);
        let fall = (half_sine * half_sine).scaled(-2.0);
        let sine_change = (sine * fall).plus_product(cosine, sine_of_change);
        let cosine_change = (cosine * fall).minus_product(sine, sine_of_change);
        Self { sine: sine + sine_change, cosine: cosine + cosine_change, sine_change, cosine_change }
    }
}

/// A joint's own coordinates.
#[derive(Clone, Copy, Debug)]
pub struct CoordinateIncrement<R> {
    /// Changes since the start of the step [rad, m].
    pub change: [R; MAX_COORDINATES],
    /// Coordinates that are angles.
    pub angles: [Angle<R>; MAX_COORDINATES],
}

impl JointCoordinates {
    /// A coordinate as an angle.
    pub fn angle(&self, coordinate: usize) -> Angle<f64> {
        let change = self.change[coordinate];
        let (sine, cosine) = (self.value[coordinate] - change).sin_cos();
        Angle::turned([sine, cosine], change)
    }
}

impl From<&JointCoordinates> for CoordinateIncrement<f64> {
    fn from(own: &JointCoordinates) -> Self {
        Self { change: own.change, angles: [own.angle(0), own.angle(1)] }
    }
}
