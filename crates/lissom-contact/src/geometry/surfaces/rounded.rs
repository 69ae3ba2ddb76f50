//! A surface at a distance outside of another one: its edges and corners are round.

use std::sync::Arc;

use lissom_motion::Vector3;

use super::{Distance, Surface};

/// A surface about that of a convex solid.
#[derive(Clone, Debug)]
pub struct Rounded {
    /// Surface of the solid within.
    pub inner: Arc<dyn Surface>,
    /// Radius of the edges [m].
    pub radius: f64,
}

impl Surface for Rounded {
    fn distance(&self, y: &Vector3) -> Distance {
        let inner = self.inner.distance(y);
        Distance { value: inner.value - self.radius, ..inner }
    }

    fn value(&self, y: &Vector3) -> f64 {
        self.inner.value(y) - self.radius
    }

    fn depth(&self) -> f64 {
        self.inner.depth() + self.radius
    }
}
