//! The reference line of a beam: straight, circular arc, or a curve given by expressions, and the frames along it.
//! Independent of elements and sections.

use lissom_motion::{Matrix3, Motion, Vector3};

use crate::expression::Expression;

/// A line, run through by a fraction `s` from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    /// From one point to another.
    Straight {
        /// Position at `s = 0` [m].
        from: Vector3,
        /// Position at `s = 1` [m].
        to: Vector3,
    },
    /// A circular arc; `s` is proportional to the arc length.
    Arc {
        /// Centre [m].
        center: Vector3,
        /// From the centre to the start [m].
        radius: Vector3,
        /// Perpendicular to `radius`, of the same length, towards the end [m].
        side: Vector3,
        /// Opening angle [rad].
        angle: f64,
    },
    /// Three expressions of `s` [m].
    Curve(Box<[Expression; 3]>),
    /// Three expressions of `s` in a frame of their own [m].
    PlacedCurve(Box<[Expression; 3]>, Motion),
}

/// Points that have no circle through them, or no distance from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the three points lie on one line")]
pub struct NoCircle;

/// Sine of the angle below which two directions count as parallel.
const PARALLEL: f64 = 1e-6;
/// Points at which directions along a line are compared.
const SAMPLES: u32 = 64;

impl Line {
    /// The arc from `from` through `through` to `to`.
    ///
    /// # Errors
    /// If there is no circle through the points.
    pub fn arc(from: Vector3, through: Vector3, to: Vector3) -> Result<Self, NoCircle> {
        let (a, b) = (through - from, to - from);
        let normal = a.cross(&b);
        let smallest = a.norm().min(b.norm()).min((b - a).norm());
        let largest = a.norm().max(b.norm());
        let n2 = normal.norm_squared();
        if !(smallest > 1e-9 * largest && n2.sqrt() > 1e-9 * largest * smallest) {
            return Err(NoCircle);
        }
        // Circumcentre of the triangle 0, a, b: (|a|² b - |b|² a) × (a × b) / (2 |a × b|²).
        let centre = (b * a.norm_squared() - a * b.norm_squared()).cross(&normal) / (2.0 * n2);
        let radius = -centre;
        let side = normal.normalize().cross(&radius);
        let end = b - centre;
        // The normal is chosen so that the way from start over `through` to the end turns positively about it.
        let angle = end.dot(&side).atan2(end.dot(&radius)).rem_euclid(std::f64::consts::TAU);
        Ok(Self::Arc { center: from + centre, radius, side, angle })
    }

    /// The line turned and shifted as `frame` is.
    #[must_use]
    pub fn moved(self, frame: &Motion) -> Self {
        if *frame == Motion::IDENTITY {
            return self;
        }
        let (place, turn) = (|p: &Vector3| frame.transform_point(p), |v: &Vector3| frame.rotation.apply(v));
        match self {
            Self::Straight { from, to } => Self::Straight { from: place(&from), to: place(&to) },
            Self::Arc { center, radius, side, angle } => {
                Self::Arc { center: place(&center), radius: turn(&radius), side: turn(&side), angle }
            }
            Self::Curve(curve) => Self::PlacedCurve(curve, *frame),
            Self::PlacedCurve(curve, own) => Self::PlacedCurve(curve, *frame * own),
        }
    }

    /// Position at the fraction `s` [m].
    pub fn position(&self, s: f64) -> Vector3 {
        match self {
            Self::Straight { from, to } => from + (to - from) * s,
            Self::Arc { center, radius, side, angle } => {
                center + radius * (angle * s).cos() + side * (angle * s).sin()
            }
            Self::Curve(curve) => Vector3::from_fn(|i, _| curve[i].jet(s).value),
            Self::PlacedCurve(curve, frame) => {
                frame.transform_point(&Vector3::from_fn(|i, _| curve[i].jet(s).value))
            }
        }
    }

    /// Derivative of the position with respect to the fraction [m].
    pub fn derivative(&self, s: f64) -> Vector3 {
        match self {
            Self::Straight { from, to } => to - from,
            Self::Arc { radius, side, angle, .. } => {
                (side * (angle * s).cos() - radius * (angle * s).sin()) * *angle
            }
            Self::Curve(curve) => Vector3::from_fn(|i, _| curve[i].jet(s).first),
            Self::PlacedCurve(curve, frame) => {
                frame.rotation.apply(&Vector3::from_fn(|i, _| curve[i].jet(s).first))
            }
        }
    }

    /// Arc length [m].
    pub fn length(&self) -> f64 {
        match self {
            Self::Straight { from, to } => (to - from).norm(),
            Self::Arc { radius, angle, .. } => radius.norm() * angle,
            // Simpson's rule on 200 intervals.
            Self::Curve(_) | Self::PlacedCurve(..) => {
                let speed = |i: u32| self.derivative(f64::from(i) / 400.0).norm();
                let interval = |i: u32| speed(2 * i) + 4.0 * speed(2 * i + 1) + speed(2 * i + 2);
                (0..200).map(interval).sum::<f64>() / 1200.0
            }
        }
    }

    /// The frame at `s`: columns are the axes 1 (along), 2 and 3, with axis 3 leaning to `up`, all turned by
    /// `twist` [rad] about axis 1. `up` must not be parallel to the line.
    pub fn frame(&self, s: f64, up: &Vector3, twist: f64) -> Matrix3 {
        let along = self.derivative(s).normalize();
        let third = (up - along * along.dot(up)).normalize();
        let second = third.cross(&along);
        let (sine, cosine) = twist.sin_cos();
        Matrix3::from_columns(&[along, second * cosine + third * sine, third * cosine - second * sine])
    }

    /// Where the line runs along `up`, if anywhere. There axis 3, which leans to `up`, changes to the other side.
    pub(crate) fn parallel_at(&self, up: &Vector3) -> Option<f64> {
        let mut before: Option<Vector3> = None;
        (0..=SAMPLES).map(|i| f64::from(i) / f64::from(SAMPLES)).find(|&s| {
            let tangent = self.derivative(s);
            let along = tangent.normalize();
            let across = up - along * along.dot(up);
            let turns = before.replace(across).is_some_and(|before| before.dot(&across) <= 0.0);
            turns || are_parallel(&tangent, up)
        })
    }

    /// Whether the line runs along `up` somewhere.
    pub(crate) fn is_parallel_somewhere(&self, up: &Vector3) -> bool {
        self.parallel_at(up).is_some()
    }

    /// Position at which the line has no direction or is not finite, if any.
    pub fn fault(&self) -> Option<f64> {
        let bad = |s: &f64| {
            let speed = self.derivative(*s).norm();
            !(speed.is_finite() && speed > 0.0 && self.position(*s).norm().is_finite())
        };
        (0..=SAMPLES).map(|i| f64::from(i) / f64::from(SAMPLES)).find(bad)
    }

    /// Global z where the line does not run along it, else global y, else global x.
    pub(crate) fn default_up(&self) -> Vector3 {
        let choices = [Vector3::z(), Vector3::y(), Vector3::x()];
        choices.into_iter().find(|up| !self.is_parallel_somewhere(up)).unwrap_or_else(Vector3::z)
    }
}

/// Whether two directions are parallel; also if one of them is none.
pub(crate) fn are_parallel(a: &Vector3, b: &Vector3) -> bool {
    let sine = a.normalize().cross(&b.normalize()).norm();
    sine.is_nan() || sine <= PARALLEL
}

#[cfg(test)]
#[path = "../tests/unit/line.rs"]
mod tests;
