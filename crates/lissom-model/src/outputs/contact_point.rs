//! A contact of a model at one of its points, for outputs.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_contact::elastic::{Contact, ContactForces};
use lissom_contact::nearest::NearestContact;
use lissom_contact::of_beams::BeamContact;
use lissom_contact::of_shells::ShellContact;
use lissom_contact::rigid::RigidContact;
use lissom_mechanics::elements::Element;
use lissom_mechanics::kinematics::{DiscreteValueId, Kinematics};

/// Points of contacts by their names.
#[derive(Clone, Default)]
pub(crate) struct PointsOfContacts {
    /// Of compliant ones.
    pub(crate) compliant: BTreeMap<String, Vec<ContactPoint>>,
    /// Of rigid ones.
    pub(crate) rigid: BTreeMap<String, Vec<RigidPoint>>,
}

/// An element of a contact.
pub(crate) trait ContactElement: Element {
    /// What acts on its tip.
    fn forces_at(&self, at: &Kinematics) -> ContactForces;

    /// Gap [m], its rate [m/s] and the normal force [N].
    fn motion(&self, at: &Kinematics) -> [f64; 3];
}

impl ContactElement for Contact {
    fn forces_at(&self, at: &Kinematics) -> ContactForces {
        Self::forces_at(self, at)
    }

    fn motion(&self, at: &Kinematics) -> [f64; 3] {
        Self::motion(self, at)
    }
}

impl ContactElement for BeamContact {
    fn forces_at(&self, at: &Kinematics) -> ContactForces {
        Self::forces_at(self, at)
    }

    fn motion(&self, at: &Kinematics) -> [f64; 3] {
        Self::motion(self, at)
    }
}

impl ContactElement for NearestContact {
    fn forces_at(&self, at: &Kinematics) -> ContactForces {
        Self::forces_at(self, at)
    }

    fn motion(&self, at: &Kinematics) -> [f64; 3] {
        Self::motion(self, at)
    }
}

impl ContactElement for ShellContact {
    fn forces_at(&self, at: &Kinematics) -> ContactForces {
        Self::forces_at(self, at)
    }

    fn motion(&self, at: &Kinematics) -> [f64; 3] {
        Self::motion(self, at)
    }
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
