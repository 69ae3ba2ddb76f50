//! Rolling joints: impulses, and the element with the velocity constraint.

use super::Builder;
use lissom_mechanics::contact::wheel_on_plane::Contact;
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::rolling::Rolling;
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId};

impl Builder {
    /// Adds the element that prevents sliding of a contact, and impulses if it does not creep.
    pub(super) fn add_rolling(
        &mut self,
        joint: &str,
        frames: [CarriedFrame; 2],
        contact: Contact,
    ) -> Vec<CoordinateId> {
        let directions: &[&str] = if contact.creep > 0.0 { &[] } else { &["first", "second"] };
        let mut contribution = Contribution::to(&self.model);
        let impulses: Vec<CoordinateId> = directions
            .iter()
            .map(|direction| {
                let name = format!("{joint}, rolling along the {direction} axis");
                contribution.add_impulse(name, frames.map(|frame| frame.node).to_vec(), Vec::new())
            })
            .collect();
        self.add(contribution.with(Rolling::new(frames, impulses.clone(), contact)));
        impulses
    }
}
