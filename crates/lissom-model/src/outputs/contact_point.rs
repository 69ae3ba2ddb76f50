//! A contact of a model at one of its points, for outputs.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_contact::reading::ContactElement;
use lissom_contact::rigid::RigidContact;
use lissom_contact::set::SmallestGap;
use lissom_mechanics::kinematics::DiscreteValueId;
use lissom_system::System;

/// Points of contacts by their names.
#[derive(Clone, Default)]
pub(crate) struct PointsOfContacts {
    /// Points of compliant contacts.
    pub(crate) compliant: BTreeMap<String, Vec<ContactPoint>>,
    /// Points of rigid contacts.
    pub(crate) rigid: BTreeMap<String, Vec<RigidPoint>>,
}

/// One point of a contact.
#[derive(Clone, Debug)]
pub(crate) struct ContactPoint {
    /// The element.
    pub(crate) contact: Arc<dyn ContactElement>,
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

/// The points of a contact whose touches have no elements.
pub(crate) struct PointsOfSet {
    /// Index of the contact.
    pub(crate) rule: usize,
    /// The gap while nothing touches.
    pub(crate) gap: SmallestGap,
}

impl PointsOfSet {
    /// Points of the contact of this index.
    pub(crate) fn new(system: &System, rule: usize) -> Self {
        Self { rule, gap: SmallestGap::new(system.contacts(), rule) }
    }
}
