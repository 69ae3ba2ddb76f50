//! Constraints between velocities: rolling and latches, and the element that opposes sliding instead.

use super::Builder;
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::rolling::RollingCreep;
use lissom_mechanics::joints::latch::Latch;
use lissom_mechanics::joints::no_slip::{self, NoSlip};
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, DiscreteValueId, Quantity};
use lissom_mechanics::wheels::wheel_on_plane::Contact;

impl Builder {
    /// Adds what prevents or opposes sliding of a contact, after the joint's own multipliers.
    pub(super) fn add_rolling(&mut self, joint: &str, frames: [CarriedFrame; 2], contact: Contact) {
        if contact.creep > 0.0 {
            self.add(Contribution::of(&self.model, RollingCreep::new(frames, contact)));
            return;
        }
        let first = self.multipliers.len();
        self.constraints.wheels.push(NoSlip::new(joint.to_owned(), frames, contact, first));
        for equation in no_slip::EQUATIONS {
            self.add_velocity_multiplier(joint, equation, Quantity::Length);
        }
    }

    /// Adds a latch on a coordinate.
    pub(super) fn add_latch(&mut self, coordinate: CoordinateId, engaged: DiscreteValueId) {
        let (name, quantity) =
            (self.coordinate_name(coordinate).to_owned(), self.coordinate_quantity(coordinate));
        let multiplier = self.multipliers.len();
        self.add_velocity_multiplier(&name, "latched", quantity);
        self.constraints.latches.push(Latch { name, coordinate, quantity, engaged, multiplier });
    }

    pub(super) fn add_velocity_multiplier(&mut self, name: &str, equation: &'static str, quantity: Quantity) {
        self.of_velocities.push(self.multipliers.len());
        self.multipliers.push((name.to_owned(), equation));
        self.multiplier_quantities.push(quantity);
    }
}
