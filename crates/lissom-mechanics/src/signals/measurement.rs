//! What a signal may know of the motion: one number, with its derivatives by positions and velocities.

use crate::kinematics::{CoordinateId, Kinematics, NodeId};

/// Most unknowns a measurement may touch: two nodes and two coordinates.
pub const MAX_TOUCHED: usize = 14;

/// Derivatives of a measurement: six per node it touches, by body variations and twists, then one per coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// By positions.
    pub by_place: [f64; MAX_TOUCHED],
    /// By velocities.
    pub by_rate: [f64; MAX_TOUCHED],
}

impl Gradient {
    /// All zero.
    pub fn zero() -> Self {
        Self { by_place: [0.0; MAX_TOUCHED], by_rate: [0.0; MAX_TOUCHED] }
    }
}

/// One number measured of the motion. A new one is a file with a type that implements this.
pub trait Measurement: Send + Sync {
    /// Nodes it touches, at most two.
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    /// Coordinates it touches, at most two.
    fn coordinates(&self) -> &[CoordinateId] {
        &[]
    }

    /// Its value [SI].
    fn value(&self, at: &Kinematics) -> f64;

    /// Its derivatives.
    fn gradient(&self, at: &Kinematics) -> Gradient;
}
