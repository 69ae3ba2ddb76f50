//! Interface of the quantities of the motion that are recorded and that signals depend on, with their derivatives.

use std::sync::Arc;

use crate::kinematics::{CoordinateId, Kinematics, NodeId};

/// Most components of a measurement.
pub const MAX_COMPONENTS: usize = 6;
/// Most unknowns that a measurement depends on: four nodes.
pub const MAX_TOUCHED: usize = 24;

/// Derivatives of a component: six per node of the measurement, by body variations, twists and their rates, then one per
/// coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// With respect to positions.
    pub by_place: [f64; MAX_TOUCHED],
    /// With respect to velocities.
    pub by_rate: [f64; MAX_TOUCHED],
    /// By accelerations; zero for all measurements that signals depend on between samples.
    pub by_acceleration: [f64; MAX_TOUCHED],
}

impl Gradient {
    /// All zero.
    pub fn zero() -> Self {
        let zero = [0.0; MAX_TOUCHED];
        Self { by_place: zero, by_rate: zero, by_acceleration: zero }
    }
}

/// A quantity of the motion: one to six numbers. A new one is a file with a type that implements this.
pub trait Measurement: Send + Sync {
    /// Nodes that it depends on, at most three; one may be named several times.
    fn nodes(&self) -> &[NodeId] {
        &[]
    }

    /// Coordinates that it depends on, at most two.
    fn coordinates(&self) -> &[CoordinateId] {
        &[]
    }

    /// Number of its components, 1 to 6.
    fn component_count(&self) -> usize {
        1
    }

    /// Its components [SI]; those beyond its number are zero.
    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS];

    /// Derivatives of a component.
    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient;
}

/// A component of a measurement.
#[derive(Clone)]
pub struct Component {
    /// The measurement.
    pub of: Arc<dyn Measurement>,
    /// Position of the component among those of the measurement.
    pub component: usize,
}

impl Component {
    /// Its value [SI].
    pub fn value(&self, at: &Kinematics) -> f64 {
        self.of.values(at)[self.component]
    }

    /// Its derivatives.
    pub fn gradient(&self, at: &Kinematics) -> Gradient {
        self.of.gradient(self.component, at)
    }
}
