//! Value or rate of a relative coordinate of a joint, or the value of a first-order state.

use super::measurement::{Gradient, MAX_COMPONENTS, Measurement};
use crate::kinematics::{CoordinateId, Kinematics};

/// Measured quantity of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Value of the coordinate [m, rad].
    Value,
    /// Rate of the coordinate [m/s, rad/s].
    Rate,
}

/// A coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinate {
    own: [CoordinateId; 1],
    of: Of,
    factor: f64,
}

impl Coordinate {
    /// Value or rate of a coordinate.
    pub fn new(coordinate: CoordinateId, of: Of) -> Self {
        Self::scaled(coordinate, of, 1.0)
    }

    /// Value or rate times a factor, such as from the scaling of modal coordinates to the units of their matrices.
    pub fn scaled(coordinate: CoordinateId, of: Of, factor: f64) -> Self {
        Self { own: [coordinate], of, factor }
    }
}

impl Measurement for Coordinate {
    fn coordinates(&self) -> &[CoordinateId] {
        &self.own
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let coordinate = &at.coordinates[self.own[0]];
        let mut values = [0.0; MAX_COMPONENTS];
        let own = match self.of {
            Of::Value => coordinate.value,
            Of::Rate => coordinate.rate,
        };
        values[0] = self.factor * own;
        values
    }

    fn gradient(&self, _: usize, _: &Kinematics) -> Gradient {
        let mut gradient = Gradient::zero();
        match self.of {
            Of::Value => gradient.by_place[0] = self.factor,
            Of::Rate => gradient.by_rate[0] = self.factor,
        }
        gradient
    }
}
