//! Contacts: what each adds to the system, by its kind and by how contacts are solved.

mod at_nodes;
mod compliant;
mod flexible;
mod of_beams;
mod of_shells;
mod pairs;
mod rigid;
mod set;

use lissom_mechanics::kinematics::Kinematics;
use lissom_system::Builder;
use lissom_system::schemes::ContactSolution;

use flexible::OfFlexible;

use super::names::Names;
use crate::document::{ContactEntry, ContactLaw, Document};
use crate::outputs::contact_point::ContactPoint;
use crate::text::report::Problem;

/// Adds a contact, and its points to `names`.
pub(super) fn add(
    document: &Document,
    entry: &ContactEntry,
    names: &mut Names,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let name = || entry.name.value.clone();
    let points = match &entry.law {
        ContactLaw::Rigid(law) => {
            let points = rigid::add(document, (entry, *law), names, builder)?;
            names.contacts.rigid.insert(name(), points);
            return Ok(());
        }
        ContactLaw::Compliant(law) if document.analysis.contacts == ContactSolution::Set => {
            return set::add(document, (entry, law), names, builder);
        }
        ContactLaw::Compliant(law) => compliant::add(document, (entry, law), names, builder)?,
        ContactLaw::Flexible(law) => OfFlexible { document, entry, law }.add(names, builder)?,
    };
    names.contacts.compliant.insert(name(), points);
    Ok(())
}

/// Sets the velocities of impacts that begin at the start.
pub(super) fn start<'p>(points: impl Iterator<Item = &'p ContactPoint>, at: &mut Kinematics) {
    for point in points {
        let Some(held) = point.velocity else { continue };
        let [gap, rate, _] = point.contact.spring_motion(at);
        if gap <= 0.0 {
            at.held[held.index()] = -rate;
        }
    }
}

/// Points of contact with friction that touch, of all contacts that are not rigid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrictionPoints {
    /// Number of points whose bristles do not slip.
    pub sticking: usize,
    /// Number of points whose bristles slip.
    pub sliding: usize,
}

impl Names {
    /// Points of contact with friction that touch in the state `at` of the model of `document`; none without such contacts.
    pub fn friction_points(&self, document: &Document, at: &Kinematics) -> Option<FrictionPoints> {
        let with_friction = document.contacts.iter().filter(|entry| entry.bristles().is_some());
        let mut names = with_friction.map(|entry| &entry.name.value).peekable();
        names.peek()?;
        let mut found = FrictionPoints::default();
        for point in names.filter_map(|name| self.contacts.compliant.get(name)).flatten() {
            let forces = point.contact.reading(at);
            found.sliding += usize::from(forces.is_touching && forces.is_sliding);
            found.sticking += usize::from(forces.is_touching && !forces.is_sliding);
        }
        Some(found)
    }
}
