//! Interface of the quantities of the motion that are recorded and that signals depend on, with their derivatives.

use std::sync::Arc;

use crate::kinematics::{CoordinateId, Kinematics, NodeId, USUAL_UNKNOWNS};

/// Most components of a measurement.
pub const MAX_COMPONENTS: usize = 6;

/// Derivatives of a component: six per node of the measurement, by body variations, twists and their rates, then one per
/// coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// With respect to positions.
    pub by_place: [f64; USUAL_UNKNOWNS],
    /// With respect to velocities.
    pub by_rate: [f64; USUAL_UNKNOWNS],
    /// By accelerations; zero for all measurements that signals depend on between samples.
    pub by_acceleration: [f64; USUAL_UNKNOWNS],
}

impl Gradient {
    /// All zero.
    pub fn zero() -> Self {
        let zero = [0.0; USUAL_UNKNOWNS];
        Self { by_place: zero, by_rate: zero, by_acceleration: zero }
    }

    /// That of the value of the unknown number `slot`, and that of its rate.
    pub fn of_unknown(slot: usize) -> [Self; 2] {
        let (mut value, mut rate) = (Self::zero(), Self::zero());
        (value.by_place[slot], rate.by_rate[slot]) = (1.0, 1.0);
        [value, rate]
    }

    /// This gradient plus `factor` times another one.
    #[must_use]
    pub fn plus(mut self, factor: f64, other: &Self) -> Self {
        for (own, other) in [
            (&mut self.by_place, &other.by_place),
            (&mut self.by_rate, &other.by_rate),
            (&mut self.by_acceleration, &other.by_acceleration),
        ] {
            own.iter_mut().zip(other).for_each(|(own, other)| *own += factor * other);
        }
        self
    }
}

/// A quantity of the motion: one to six numbers. A new one is a file with a type that implements this.
pub trait Measurement: Send + Sync {
    /// Nodes that it depends on, at most four; one may be named several times.
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

    /// Components of the measurement [SI]; those beyond its number are zero.
    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS];

    /// One of its components [SI]. Default: all of them are computed.
    fn value(&self, component: usize, at: &Kinematics) -> f64 {
        self.values(at)[component]
    }

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
    /// Value of the component [SI].
    pub fn value(&self, at: &Kinematics) -> f64 {
        self.of.value(self.component, at)
    }

    /// Derivatives of the component.
    pub fn gradient(&self, at: &Kinematics) -> Gradient {
        self.of.gradient(self.component, at)
    }
}
