//! A contact of a model at one of its points, for outputs.

use std::sync::Arc;

use lissom_core::elements::contact::Contact;
use lissom_core::joints::rigid_contact::RigidContact;
use lissom_core::kinematics::DiscreteValueId;

/// One point of a contact.
#[derive(Clone, Debug)]
pub(crate) struct ContactPoint {
    /// The element.
    pub(crate) contact: Contact,
    /// 1 if the tip of the element is that of the contact, otherwise -1.
    pub(crate) sign: f64,
    /// The discrete value with the velocity of the impact [m/s].
    pub(crate) velocity: Option<DiscreteValueId>,
}

/// One point of a rigid contact.
#[derive(Clone, Debug)]
pub(crate) struct RigidPoint {
    /// The contact at the point.
    pub(crate) contact: Arc<RigidContact>,
    /// 1 if its tip is that of the entry, otherwise -1.
    pub(crate) sign: f64,
}
