//! Quantities of springs and loads as measurements: elongation, rate and force, and the power of their forces.

use std::sync::{Arc, OnceLock};

use lissom_mechanics::elements::Element;
use lissom_mechanics::evaluation::batch::{AnyBatch, ElementId};
use lissom_mechanics::evaluation::work::{power, power_gradient};
use lissom_mechanics::evaluation::wrench::{WrenchAxes, wrench, wrench_gradient};
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, NodeId, USUAL_UNKNOWNS};
use lissom_mechanics::signals::measurement::{Gradient, MAX_COMPONENTS, Measurement};

use super::System;

/// A quantity of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Elongation, rate and force of a spring [m, m/s, N or rad, rad/s, N m].
    Spring,
    /// What the element reports under these words and units.
    Reported(&'static [(&'static str, &'static str)]),
    /// Power that the element supplies to the rest of the model [W].
    Power,
    /// Force [N] and moment [N m] on the tip of an element between two frames.
    Wrench(WrenchAxes),
}

impl Of {
    /// Whether an element has this quantity.
    pub(crate) fn is_of(self, element: &dyn Element) -> bool {
        match self {
            Self::Spring => element.capabilities().spring.is_some(),
            Self::Reported(words) => element.capabilities().report.is_some_and(|own| own.words() == words),
            Self::Power => true,
            Self::Wrench(_) => element.capabilities().frames.is_some(),
        }
    }
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
    /// A quantity of an item of a batch; none if the item has no such quantity, or more unknowns than a gradient.
    pub(crate) fn new(of: Of, batch: &dyn AnyBatch, item: usize) -> Option<Self> {
        let element = batch.element(item)?;
        let unknowns = element.unknowns();
        let is_small = unknowns.force_count() <= USUAL_UNKNOWNS;
        (of.is_of(element) && is_small && !batch.sees_multipliers()).then(|| Self {
            of,
            nodes: unknowns.nodes.to_vec(),
            coordinates: unknowns.coordinates.to_vec(),
            item,
            batch: OnceLock::new(),
        })
    }

    fn element(&self) -> Option<&dyn Element> {
        self.batch.get()?.element(self.item)
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
            Of::Reported(words) => words.len(),
            Of::Wrench(_) => 6,
        }
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        let mut values = [f64::NAN; MAX_COMPONENTS];
        let Some(element) = self.element() else { return values };
        match self.of {
            Of::Spring => {
                if let Some(spring) = element.capabilities().spring {
                    values[..3].copy_from_slice(&spring.spring_motion(at));
                }
            }
            Of::Reported(_) => {
                if let Some(report) = element.capabilities().report {
                    values = report.numbers(at);
                }
            }
            Of::Power => values[0] = power(element, at),
            Of::Wrench(axes) => {
                if let Some(frames) = element.capabilities().frames {
                    values = wrench(element, &frames, axes, at);
                }
            }
        }
        values
    }

    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient {
        let gradient = self.element().and_then(|element| match self.of {
            Of::Spring => Some(element.capabilities().spring?.spring_gradients(at)?[component]),
            Of::Reported(_) => Some(element.capabilities().report?.gradients(at)[component]),
            Of::Power => power_gradient(element, at),
            Of::Wrench(axes) => {
                let frames = element.capabilities().frames?;
                Some(wrench_gradient(element, &frames, axes, component, at))
            }
        });
        gradient.unwrap_or_else(Gradient::zero)
    }
}

impl System {
    /// A quantity of an element as a measurement; none for elements without it, for loads scaled by signals, and for elements with more unknowns than a
    /// gradient.
    pub fn element_quantity(&self, element: ElementId, of: Of) -> Option<Arc<dyn Measurement>> {
        let batch = &self.batches[element.batch?];
        let quantity = ElementQuantity::new(of, &**batch, element.item)?;
        quantity.find_in(batch);
        Some(Arc::new(quantity))
    }
}
