//! Value or rate of a relative coordinate of a joint, or the value of a first-order state.

use super::measurement::{Gradient, MAX_COMPONENTS, Measurement};
use crate::kinematics::{CoordinateId, Kinematics};

/// Measured quantity of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Its value [m, rad].
    Value,
    /// Its rate [m/s, rad/s].
    Rate,
}

/// A coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    coordinate: [CoordinateId; 1],
    of: Of,
}

impl Coordinate {
    /// Value or rate of a coordinate.
    pub fn new(coordinate: CoordinateId, of: Of) -> Self {
        Self { coordinate: [coordinate], of }
    }
}

impl Measurement for Coordinate {
    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinate
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let coordinate = &at.coordinates[self.coordinate[0]];
        let mut values = [0.0; MAX_COMPONENTS];
        values[0] = match self.of {
            Of::Value => coordinate.value,
            Of::Rate => coordinate.rate,
        };
        values
    }

    fn gradient(&self, _: usize, _: &Kinematics) -> Gradient {
        let mut gradient = Gradient::zero();
        match self.of {
            Of::Value => gradient.by_place[0] = 1.0,
            Of::Rate => gradient.by_rate[0] = 1.0,
        }
        gradient
    }
}
