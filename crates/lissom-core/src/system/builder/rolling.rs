//! Joints that roll: impulses, and the element with the constraint between velocities.

use super::{Builder, Coordinate};
use crate::contact::wheel_on_plane::Contact;
use crate::elements::rolling::Rolling;
use crate::kinematics::{CarriedFrame, CoordinateId, NodeId, Quantity};
use crate::signals::HeldId;

/// A coordinate whose rate is the force of a constraint between velocities.
pub(super) struct Impulse {
    pub(super) coordinate: CoordinateId,
    /// Nodes and coordinates whose velocities are constrained: they are eliminated before it.
    pub(super) nodes: Vec<NodeId>,
    pub(super) coordinates: Vec<CoordinateId>,
}

impl Builder {
    /// Adds the element that keeps a contact from sliding, and impulses where it does not creep.
    pub(super) fn add_rolling(
        &mut self,
        joint: &str,
        frames: [CarriedFrame; 2],
        contact: Contact,
    ) -> Vec<CoordinateId> {
        let directions: &[&str] = if contact.creep > 0.0 { &[] } else { &["first", "second"] };
        let impulses = directions.iter().map(|direction| {
            self.coordinates.push(Coordinate {
                name: format!("{joint}, rolling along the {direction} axis"),
                value: 0.0,
                rate: 0.0,
                quantity: Quantity::State,
            });
            let coordinate = self.coordinates.len() - 1;
            let nodes = frames.map(|frame| frame.node).to_vec();
            self.impulses.push(Impulse { coordinate, nodes, coordinates: Vec::new() });
            coordinate
        });
        let impulses: Vec<CoordinateId> = impulses.collect();
        self.add_element(Rolling::new(frames, impulses.clone(), contact));
        self.last = None;
        impulses
    }

    /// Adds the impulse of a latch on a coordinate, which an input engages.
    pub(crate) fn add_latch(&mut self, latched: CoordinateId, engaged: HeldId) -> CoordinateId {
        let name = format!("{}, latched", self.coordinates[latched].name);
        self.coordinates.push(Coordinate { name, value: 0.0, rate: 0.0, quantity: Quantity::State });
        let coordinate = self.coordinates.len() - 1;
        self.impulses.push(Impulse { coordinate, nodes: Vec::new(), coordinates: vec![latched] });
        self.latches.push(engaged);
        coordinate
    }
}
