//! Quantities of springs and loads as measurements: elongation, rate and force, and the power of their forces.

use std::sync::{Arc, OnceLock};

use lissom_mechanics::evaluation::batch::{AnyBatch, ElementId};
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, NodeId, USUAL_UNKNOWNS};
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};

use super::System;

/// A quantity of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Elongation, rate and force of a spring [m, m/s, N or rad, rad/s, N m].
    Spring,
    /// Power that the element supplies to the rest of the model [W].
    Power,
}

/// A quantity of an element in a batch, which the signals of the same system may depend on: it receives the batch when the system
/// is built.
pub(crate) struct ElementQuantity {
    of: Of,
    nodes: Vec<NodeId>,
    coordinates: Vec<CoordinateId>,
    item: usize,
    batch: OnceLock<Arc<dyn AnyBatch>>,
}

impl ElementQuantity {
    /// A quantity of an item of a batch; none if it has more unknowns than a gradient.
    pub(crate) fn new(of: Of, batch: &dyn AnyBatch, item: usize) -> Option<Self> {
        let (nodes, coordinates) = batch.unknowns(item);
        let is_small = 6 * nodes.len() + coordinates.len() <= USUAL_UNKNOWNS;
        (is_small && !batch.sees_multipliers()).then(|| Self {
            of,
            nodes: nodes.to_vec(),
            coordinates: coordinates.to_vec(),
            item,
            batch: OnceLock::new(),
        })
    }

    /// Sets the batch, which does not change any more.
    pub(crate) fn find_in(&self, batch: &Arc<dyn AnyBatch>) {
        self.batch.get_or_init(|| Arc::clone(batch));
    }
}

impl Measurement for ElementQuantity {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinates
    }

    fn component_count(&self) -> usize {
        match self.of {
            Of::Spring => 3,
            Of::Power => 1,
        }
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let mut values = [f64::NAN; MAX_COMPONENTS];
        let Some(batch) = self.batch.get() else { return values };
        match self.of {
            Of::Spring => {
                if let Some(motion) = batch.spring_motion(self.item, at) {
                    values[..3].copy_from_slice(&motion);
                }
            }
            Of::Power => values[0] = batch.power(self.item, at),
        }
        values
    }

    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient {
        let gradient = self.batch.get().and_then(|batch| match self.of {
            Of::Spring => Some(batch.spring_gradients(self.item, at)[component]),
            Of::Power => batch.power_gradient(self.item, at),
        });
        gradient.unwrap_or_else(Gradient::zero)
    }
}

impl System {
    /// A quantity of an element as a measurement; none for loads scaled by signals, and for elements with more unknowns than a
    /// gradient.
    pub fn element_quantity(&self, element: ElementId, of: Of) -> Option<Arc<dyn Measurement>> {
        let batch = &self.batches[element.batch?];
        let quantity = ElementQuantity::new(of, &**batch, element.item)?;
        quantity.find_in(batch);
        Some(Arc::new(quantity))
    }
}
