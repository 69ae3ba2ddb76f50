//! A straight line along the third axis.
//!
//! The solid about it is slightly crowned, as a roller is, so that there is one nearest point also above a line or plane to which it
//! is parallel: towards the ends its surface is inclined by up to ε.
//!
//! ```text
//! c(t) = (0, 0, t),      w(t) = ε t²/(2h)
//! ```

use lissom_motion::Vector3;

use super::Curve;

/// ε: inclination of the surface at the ends [rad].
const CROWN: f64 = 1e-3;

/// A straight line between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    ends: [f64; 2],
}

impl Segment {
    /// Segment of this half length h [m].
    pub fn new(half_length: f64) -> Self {
        Self { ends: [-half_length, half_length] }
    }
}

impl Curve for Segment {
    fn point(&self, t: f64) -> [Vector3; 3] {
        [t * Vector3::z(), Vector3::z(), Vector3::zeros()]
    }

    fn crown(&self, t: f64) -> [f64; 3] {
        let bend = CROWN / self.ends[1];
        [0.5 * bend * t * t, bend * t, bend]
    }

    fn samples(&self) -> &[f64] {
        &self.ends
    }

    fn reach(&self) -> f64 {
        self.ends[1]
    }
}
