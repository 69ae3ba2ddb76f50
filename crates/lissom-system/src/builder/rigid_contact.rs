//! Rigid contacts: their constraints, friction, held values and multipliers.

use std::sync::Arc;

use super::Builder;
use lissom_contact::geometry::gap::Pair;
use lissom_contact::rigid::{EQUATIONS, RigidConstraint, RigidContact, RigidLaw, RigidState};
use lissom_contact::rigid_friction::RigidFriction;
use lissom_mechanics::kinematics::{CarriedFrame, Quantity};
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::event::Event;

impl Builder {
    /// Adds a rigid contact between the frames of two solids, base and tip.
    pub fn add_rigid_contact(
        &mut self,
        name: &str,
        frames: [CarriedFrame; 2],
        pair: Arc<dyn Pair>,
        law: RigidLaw,
    ) -> Arc<RigidContact> {
        let mut held = |what: &str| self.add_held(&format!("{name}, {what}"), 0.0);
        let held = RigidState {
            mode: held("mode"),
            offset: held("offset"),
            drawn: held("gap as drawn"),
            scale: held("scale"),
            direction: ["direction 1", "direction 2", "direction 3"].map(&mut held),
        };
        let first = self.multipliers.len();
        let contact = Arc::new(RigidContact::new(name.to_owned(), frames, (pair, law), (held, first)));
        for equation in &EQUATIONS[..contact.multiplier_count()] {
            self.add_velocity_multiplier(name, equation, Quantity::Length);
        }
        let constraint = |sticks| RigidConstraint { contact: Arc::clone(&contact), sticks };
        self.constraints.rigid_contacts.push(constraint(false));
        if contact.has_friction() {
            self.constraints.stickings.push(constraint(true));
            self.add_element(RigidFriction::new(Arc::clone(&contact)));
        }
        contact
    }

    /// Adds an event at which the modes of the contact added last may change.
    ///
    /// # Errors
    /// If it refers to signals or held values that do not exist.
    pub fn add_contact_event(&mut self, event: Event) -> Result<(), ParameterError> {
        let contact = self.constraints.rigid_contacts.len() - 1;
        self.constraints.contact_events.push((self.graph.events.len(), contact));
        self.add_event(event)
    }
}
