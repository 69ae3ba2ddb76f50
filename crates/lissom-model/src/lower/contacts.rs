//! Contacts: the pairs of solids that may touch, and the events at which the velocities of impacts are set.

use std::sync::Arc;

use lissom_contact::elastic::resistance::ContactResistance;
use lissom_contact::elastic::{Contact, ContactMotion, Dissipation};
use lissom_contact::forms::{Meeting, PlacedSolid, meetings};
use lissom_contact::geometry::gap::Pair;
use lissom_contact::law::Impact;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{CarriedFrame, DiscreteValueId, Kinematics, Subject};
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::measurement::Component;
use lissom_mechanics::signals::{Argument, Signal};
use lissom_system::Builder;

use super::names::Names;
use super::straight_line::Line;
use crate::document::{CompliantEntry, ContactEntry, ContactLaw, Document, NodeLocation};
use crate::outputs::contact_point::ContactPoint;
use crate::reading::node_reference::NodeReference;
use crate::text::report::{Located, Problem};

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

pub(super) fn solids<'d>(document: &'d Document, part: &NodeReference) -> &'d [PlacedSolid] {
    let found = match part {
        NodeReference::Body(name) => {
            document.bodies.iter().find(|body| body.name.value == *name).map(|body| &body.solids)
        }
        NodeReference::PointMass(name) => {
            document.point_masses.iter().find(|mass| mass.name.value == *name).map(|mass| &mass.solids)
        }
        _ => Some(&document.ground.solids),
    };
    found.map_or(&[], Vec::as_slice)
}

/// Points of contact with friction that touch, of all contacts that are not rigid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrictionPoints {
    /// Those whose bristles do not slip.
    pub sticking: usize,
    /// Those whose bristles slip.
    pub sliding: usize,
}

impl Names {
    /// Points of contact with friction that touch in the state `at` of the model of `document`; none without such contacts.
    pub fn friction_points(&self, document: &Document, at: &Kinematics) -> Option<FrictionPoints> {
        let with_friction = document.contacts.iter().filter(|entry| match &entry.law {
            ContactLaw::Rigid(_) => false,
            ContactLaw::OfBeam(law) => law.friction.is_some(),
            ContactLaw::OfShell(law) => law.friction.is_some(),
            ContactLaw::Compliant(law) => law.friction.is_some(),
        });
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

/// Adds a contact.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, &CompliantEntry),
    names: &Names,
    builder: &mut Builder,
) -> Result<Vec<ContactPoint>, Problem> {
    let name = &entry.name.value;
    let mut all = Vec::new();
    for (number, point) in points_of_solids(document, entry, names)?.into_iter().enumerate() {
        let own = if number == 0 { name.clone() } else { format!("{name} {}", number + 1) };
        let event = touch_name(entry, &own, &point);
        let compliance = compliance(document, (entry, law), point.solids)?;
        let (dissipation, velocity) = match law.impact {
            Impact::Dissipation(factor) => (Dissipation::Factor(factor), None),
            Impact::Restitution { relative, rest_velocity: least, .. } => {
                let held = builder.add_held(&format!("{own}, impact velocity"), 0.0);
                (Dissipation::AtTouch { relative, velocity: held, least }, Some(held))
            }
        };
        let mut contribution = Contribution::to(builder.model());
        let friction = law.friction.as_ref();
        let friction = friction.map(|law| law.with_bristles(&format!("{own}, friction"), &mut contribution));
        let resistance = ContactResistance::new(law.resistance, &own, &mut contribution);
        let mut contact = Contact::new(point.frames, point.pair, (compliance, dissipation), friction);
        contact = contact.with_name(name);
        if let Some(resistance) = resistance {
            contact = contact.with_resistance(resistance);
        }
        builder.add(contribution.with(contact.clone()));
        if let Some(held) = velocity {
            touch((&own, event), &contact, held, builder)
                .map_err(|error| Problem::error(entry.name.span, format!("contact `{name}`: {error}")))?;
        }
        all.push(ContactPoint { contact: Arc::new(contact), sign: point.sign, velocity });
    }
    Ok(all)
}

/// Name of the event at which two parts touch: of more than two parts it names them.
fn touch_name(entry: &ContactEntry, own: &str, point: &PointOfSolids<'_>) -> String {
    if entry.others.is_empty() {
        return format!("{own}, touch");
    }
    let name = &entry.name.value;
    let number = if point.number == 0 { String::new() } else { format!(" {}", point.number + 1) };
    format!("{name}, touch{number} of {}", point.parts)
}

/// The event at which an impact begins, and sets its velocity.
fn touch(
    (name, event): (&str, String),
    contact: &Contact,
    held: DiscreteValueId,
    builder: &mut Builder,
) -> Result<(), lissom_mechanics::registry::ParameterError> {
    let of = Arc::new(ContactMotion::new(contact));
    let mut signal = |component: usize, (text, slope): (&str, f64)| {
        let measured = builder.add_component(Component { of: of.clone(), component });
        builder.add_signal(Signal {
            subject: Subject::new("contact", name).component("touch"),
            text: text.to_owned(),
            function: Arc::new(Line { at_zero: 0.0, slope }),
            arguments: vec![Argument::Measured(measured)],
            sampling: None,
        })
    };
    let root = signal(0, ("gap", 1.0))?;
    let velocity = signal(1, ("-(rate of the gap)", -1.0))?;
    builder.add_event(Event {
        name: event,
        root,
        direction: Direction::Falling,
        stops: false,
        sets: vec![(held, velocity)],
    })
}

/// The law of two solids: that of the entry, or of Hertz's theory for two balls or a ball on a plane.
pub(super) fn compliance(
    document: &Document,
    (entry, law): (&ContactEntry, &CompliantEntry),
    solids: [&PlacedSolid; 2],
) -> Result<Compliance, Problem> {
    let materials = match &law.compliance {
        Ok(compliance) => return Ok(*compliance),
        Err(materials) => materials,
    };
    let mut curvature = 0.0;
    for solid in solids {
        curvature += solid.form.curvature().ok_or_else(|| {
            let message = format!(
                "contact `{}`: the theory of Hertz is available for balls and planes, not for {}",
                entry.name.value,
                solid.form.kind().words()
            );
            Problem::error(entry.name.span, message).help("give `stiffness` instead")
        })?;
    }
    let constants = materials.iter().filter_map(|name| {
        let material = document.materials.iter().find(|material| material.name.value == name.value)?;
        Some([material.constants.young, material.constants.poisson()])
    });
    Ok(Compliance::hertz(curvature, constants))
}

/// A point at which two solids may touch.
pub(super) struct PointOfSolids<'d> {
    /// Those of the parts of the contact.
    solids: [&'d PlacedSolid; 2],
    pub(super) pair: Arc<dyn Pair>,
    /// Base and tip.
    pub(super) frames: [CarriedFrame; 2],
    /// 1 if the tip is that of the contact, otherwise -1.
    pub(super) sign: f64,
    /// The parts in words, and the number of the point among theirs.
    parts: String,
    number: usize,
}

/// The points at which the solids of a contact may touch.
pub(super) fn points_of_solids<'d>(
    document: &'d Document,
    entry: &ContactEntry,
    names: &Names,
) -> Result<Vec<PointOfSolids<'d>>, Problem> {
    let name = &entry.name.value;
    let mut all = Vec::new();
    for parts in entry.pairs() {
        check_clamp(document, name, parts)?;
        let nodes = [names.node(parts[0])?, names.node(parts[1])?];
        let words = parts.map(|part| match &part.value {
            NodeReference::Body(name) | NodeReference::PointMass(name) => name.as_str(),
            _ => "ground",
        });
        let [first, second] = parts.map(|part| solids(document, &part.value));
        let mut number = 0;
        for solids in first.iter().flat_map(|one| second.iter().map(move |other| [one, other])) {
            for Meeting { pair, sides, frames } in meetings_of(entry, solids)? {
                let carried = |k: usize| CarriedFrame { node: nodes[sides[k]], offset: frames[k] };
                let sign = if sides == [0, 1] { 1.0 } else { -1.0 };
                let (frames, parts) = ([0, 1].map(carried), words.join(" and "));
                all.push(PointOfSolids { solids, pair, frames, sign, parts, number });
                number += 1;
            }
        }
    }
    Ok(all)
}

/// The points at which two solids of a contact may touch.
pub(super) fn meetings_of(entry: &ContactEntry, solids: [&PlacedSolid; 2]) -> Result<Vec<Meeting>, Problem> {
    let name = &entry.name.value;
    let found = meetings(solids).map_err(|error| {
        let message = format!("contact `{name}`: a mesh of its parts is no solid: {error}");
        Problem::error(entry.name.span, message).help("repair the file, or use solids that have its shape")
    })?;
    found.ok_or_else(|| {
        let [one, other] = solids.map(|solid| solid.form.kind().words());
        let message = format!("contact `{name}`: {one} against {other} is not available");
        Problem::error(entry.name.span, message).help("one of them can be made of spheres, or be a plane")
    })
}

/// Rejects a contact of two parts that a clamp makes one.
pub(super) fn check_clamp(
    document: &Document,
    name: &str,
    parts: [&Located<NodeReference>; 2],
) -> Result<(), Problem> {
    let Some(clamp) = clamp_between(document, parts.map(|part| &part.value)) else { return Ok(()) };
    let message = format!("contact `{name}` is between parts that the clamp `{clamp}` makes one rigid part");
    Err(Problem::error(parts[1].span, message)
        .help("remove the contact, or join the parts by a joint that moves"))
}

/// The clamp between two parts, if there is one.
fn clamp_between<'d>(document: &'d Document, parts: [&NodeReference; 2]) -> Option<&'d str> {
    let joins =
        |nodes: &[NodeLocation]| parts.iter().all(|part| nodes.iter().any(|at| at.node.value == **part));
    let mut clamps = document.joints.iter().filter(|joint| joint.kind.value == "clamp");
    clamps.find(|clamp| joins(&clamp.attachment.nodes)).map(|clamp| clamp.name.value.as_str())
}
