//! Contacts of solids as elements, and the events at which the velocities of impacts are set.

use std::sync::Arc;

use lissom_contact::elastic::resistance::ContactResistance;
use lissom_contact::elastic::{Contact, ContactMotion, Dissipation};
use lissom_contact::forms::PlacedSolid;
use lissom_contact::law::Impact;
use lissom_contact::point::MovingSurface;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{DiscreteValueId, Subject};
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::measurement::Component;
use lissom_mechanics::signals::{Argument, Function, Signal};
use lissom_system::Builder;

use super::super::names::Names;
use super::super::straight_line::Line;
use super::pairs::{PointOfSolids, points_of_solids};
use crate::document::{CompliantLaw, ContactEntry, Document};
use crate::outputs::contact_point::ContactPoint;
use crate::text::report::Problem;

/// Adds a contact.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, &CompliantLaw),
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
        if let (Some(velocity), Some(side)) = (law.surface_velocity, point.of_first) {
            let velocity = point.frames[side].offset.rotation.apply_inverse(&velocity);
            contact = contact.with_surface(MovingSurface { is_tip: side == 1, velocity });
        }
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
) -> Result<(), ParameterError> {
    let of = Arc::new(ContactMotion::new(contact));
    let mut signal = |component: usize, (text, slope): (&str, f64)| {
        let measured = builder.add_component(Component { of: of.clone(), component });
        builder.add_signal(Signal {
            subject: Subject::new("contact", name).component("touch"),
            text: text.to_owned(),
            function: Function::Own(Arc::new(Line { at_zero: 0.0, slope })),
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
    (entry, law): (&ContactEntry, &CompliantLaw),
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
