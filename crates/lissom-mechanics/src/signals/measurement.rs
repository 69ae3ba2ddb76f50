//! Measurement of the motion for signals: one number, with its derivatives with respect to positions and velocities.

use crate::kinematics::{CoordinateId, Kinematics, NodeId};

/// Maximum number of unknowns of a measurement: two nodes and two coordinates.
pub const MAX_TOUCHED: usize = 14;

/// Derivatives of a measurement: six per node on which it depends, by body variations and twists, then one per
/// coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// With respect to positions.
    pub by_place: [f64; MAX_TOUCHED],
    /// With respect to velocities.
    pub by_rate: [f64; MAX_TOUCHED],
}

impl Gradient {
    /// All zero.
    pub fn zero() -> Self {
        Self { by_place: [0.0; MAX_TOUCHED], by_rate: [0.0; MAX_TOUCHED] }
    }
}

/// One number measured from the motion. A new one is a file with a type that implements this.
pub trait Measurement: Send + Sync {
    /// Nodes on which it depends, at most two.
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    /// Coordinates on which it depends, at most two.
    fn coordinates(&self) -> &[CoordinateId] {
        &[]
    }

    /// Its value [SI].
    fn value(&self, at: &Kinematics) -> f64;

    /// Its derivatives.
    fn gradient(&self, at: &Kinematics) -> Gradient;
}
