//! Contacts: the pairs of solids that may touch, and the events at which the velocities of impacts are set.

use std::sync::Arc;

use lissom_core::contact::compliance::{Compliance, relative_dissipation};
use lissom_core::contact::gap::Pair;
use lissom_core::contact::pairs::{PointOnSurface, RimOnPlane};
use lissom_core::contact::surfaces::{Cuboid, HalfSpace, Ring, Rod, Surface};
use lissom_core::elements::Contribution;
use lissom_core::elements::contact::{Contact, ContactFriction, ContactMotion, Dissipation};
use lissom_core::kinematics::{CarriedFrame, DiscreteValueId, Kinematics, NodeId, Subject};
use lissom_core::signals::event::{Direction, Event};
use lissom_core::signals::measurement::Component;
use lissom_core::signals::{Argument, Signal};
use lissom_core::system::Builder;
use lissom_motion::{Motion, Vector3};

use super::straight_line::Line;
use crate::contact_point::ContactPoint;
use crate::document::{ContactEntry, Document, NodeReference, Restitution};
use crate::report::Problem;
use crate::solid::{Form, PlacedSolid, Solid};

/// Two solids that may touch at a point: base and tip, and whether the tip is that of the contact.
struct Meeting {
    pair: Arc<dyn Pair>,
    frames: [Motion; 2],
    is_in_order: bool,
}

/// Sets the velocities of impacts that begin at the start.
pub(super) fn start<'p>(points: impl Iterator<Item = &'p ContactPoint>, at: &mut Kinematics) {
    for point in points {
        let Some(held) = point.velocity else { continue };
        let [gap, rate, _] = point.contact.motion(at);
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

/// Adds a contact between two nodes.
pub(super) fn add(
    document: &Document,
    entry: &ContactEntry,
    nodes: [NodeId; 2],
    builder: &mut Builder,
) -> Result<Vec<ContactPoint>, Problem> {
    let name = &entry.name.value;
    let [first, second] = entry.between.each_ref().map(|part| solids(document, &part.value));
    let mut points = Vec::new();
    for one in first {
        for other in second {
            let meetings = meetings(one, other).ok_or_else(|| {
                let message = format!(
                    "contact `{name}`: {} against {} is not available",
                    words(&one.form),
                    words(&other.form)
                );
                Problem::error(entry.name.span, message)
                    .help("one of them can be made of spheres, or be a plane")
            })?;
            let stiffness = stiffness(document, entry, [one, other])?;
            points.extend(meetings.into_iter().map(|meeting| (meeting, stiffness)));
        }
    }
    let mut all = Vec::new();
    for (number, (meeting, stiffness)) in points.into_iter().enumerate() {
        let order = if meeting.is_in_order { [0, 1] } else { [1, 0] };
        let frames =
            [0, 1].map(|side| CarriedFrame { node: nodes[order[side]], offset: meeting.frames[side] });
        let own = if all.is_empty() && number == 0 { name.clone() } else { format!("{name} {}", number + 1) };
        let compliance = Compliance { stiffness, exponent: entry.exponent };
        let (dissipation, velocity) = match entry.restitution {
            Restitution::Dissipation(factor) => (Dissipation::Factor(factor), None),
            Restitution::Coefficient(coefficient, least) => {
                let held = builder.add_held(&format!("{own}, impact velocity"), 0.0);
                let relative = relative_dissipation(coefficient);
                (Dissipation::AtTouch { relative, velocity: held, least }, Some(held))
            }
        };
        let mut contribution = Contribution::to(builder.model());
        let friction = entry.friction.map(|[sliding, at_rest]| ContactFriction {
            bristles: (1..=3)
                .map(|k| contribution.add_state(format!("{own}, friction {k}"), 0.0, entry.deflection))
                .collect(),
            sliding,
            at_rest,
            stribeck: entry.stribeck,
            deflection: entry.deflection,
        });
        let contact = Contact::new(frames, meeting.pair, (compliance, dissipation), friction);
        builder.add(contribution.with(contact.clone()));
        if let Some(held) = velocity {
            touch(&own, &contact, held, builder)
                .map_err(|error| Problem::error(entry.name.span, format!("contact `{name}`: {error}")))?;
        }
        all.push(ContactPoint {
            contact: Arc::new(contact),
            sign: if meeting.is_in_order { 1.0 } else { -1.0 },
            velocity,
        });
    }
    Ok(all)
}

/// The event at which an impact begins, and sets its velocity.
fn touch(
    name: &str,
    contact: &Contact,
    held: DiscreteValueId,
    builder: &mut Builder,
) -> Result<(), lissom_core::registry::ParameterError> {
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
    let name = format!("{name}, touch");
    builder.add_event(Event {
        name,
        root,
        direction: Direction::Falling,
        stops: false,
        sets: vec![(held, velocity)],
    })
}

/// The stiffness of two solids: that of the entry, or of Hertz's theory for two balls or a ball on a plane.
///
/// ```text
/// k = 4/3 E √R,      1/E = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂,      1/R = 1/R₁ + 1/R₂
/// ```
fn stiffness(document: &Document, entry: &ContactEntry, solids: [&PlacedSolid; 2]) -> Result<f64, Problem> {
    let materials = match &entry.stiffness {
        Ok(stiffness) => return Ok(*stiffness),
        Err(materials) => materials,
    };
    let mut curvature = 0.0;
    for solid in solids {
        curvature += match solid.form {
            Form::Solid(Solid::Sphere(radius)) => 1.0 / radius,
            Form::HalfSpace => 0.0,
            Form::Solid(_) => {
                let message = format!(
                    "contact `{}`: the theory of Hertz is available for balls and planes, not for {}",
                    entry.name.value,
                    words(&solid.form)
                );
                return Err(Problem::error(entry.name.span, message).help("give `stiffness` instead"));
            }
        };
    }
    let compliance = materials.iter().filter_map(|name| {
        let material = document.materials.iter().find(|material| material.name.value == name.value)?;
        let nu = material.constants.poisson();
        Some((1.0 - nu * nu) / material.constants.young)
    });
    Ok(4.0 / 3.0 / compliance.sum::<f64>() / f64::sqrt(curvature))
}

/// A solid in words.
pub(super) fn words(form: &Form) -> &'static str {
    match form {
        Form::HalfSpace => "a plane",
        Form::Solid(Solid::Box(_)) => "a box",
        Form::Solid(Solid::Tube { inner, .. }) if *inner > 0.0 => "a tube",
        Form::Solid(Solid::Tube { .. }) => "a cylinder",
        Form::Solid(Solid::Sphere(_)) => "a sphere",
        Form::Solid(Solid::Capsule { .. }) => "a capsule",
    }
}

pub(super) fn surface(form: &Form) -> Arc<dyn Surface> {
    match *form {
        Form::HalfSpace => Arc::new(HalfSpace),
        Form::Solid(Solid::Box(sides)) => Arc::new(Cuboid { half_sides: sides.map(|side| 0.5 * side) }),
        Form::Solid(Solid::Tube { outer, inner, length, .. }) => {
            Arc::new(Ring { radii: [inner, outer], half_length: 0.5 * length })
        }
        Form::Solid(Solid::Sphere(radius)) => Arc::new(Rod { half_length: 0.0, radius }),
        Form::Solid(Solid::Capsule { radius, length, .. }) => {
            Arc::new(Rod { half_length: 0.5 * length, radius })
        }
    }
}

/// The points at which two solids may touch; none if that is not available.
fn meetings(one: &PlacedSolid, other: &PlacedSolid) -> Option<Vec<Meeting>> {
    let found = |base: &PlacedSolid, tip: &PlacedSolid, is_in_order: bool| {
        let meeting = |pair: Arc<dyn Pair>, place: Vector3| Meeting {
            pair,
            frames: [base.frame, tip.frame * Motion::translation(place)],
            is_in_order,
        };
        let on_surface = |rounding: f64, place: Vector3| {
            meeting(Arc::new(PointOnSurface { rounding, surface: surface(&base.form) }), place)
        };
        match (&base.form, &tip.form) {
            (_, Form::Solid(Solid::Sphere(radius))) => Some(vec![on_surface(*radius, Vector3::zeros())]),
            (Form::HalfSpace, Form::Solid(Solid::Capsule { radius, length, .. })) => {
                let end = |side: f64| on_surface(*radius, Vector3::new(0.0, 0.0, 0.5 * side * length));
                Some([-1.0, 1.0].map(end).into())
            }
            (Form::HalfSpace, Form::Solid(Solid::Box(sides))) => {
                let half = |bit: usize, k: usize| if bit >> k & 1 == 1 { 0.5 } else { -0.5 } * sides[k];
                let corner = |bit: usize| on_surface(0.0, Vector3::from_fn(|k, _| half(bit, k)));
                Some((0..8).map(corner).collect())
            }
            (Form::HalfSpace, Form::Solid(Solid::Tube { outer, length, .. })) => {
                let rim = |side: f64| {
                    let pair = RimOnPlane { radius: *outer, rounding: 0.0 };
                    meeting(Arc::new(pair), Vector3::new(0.0, 0.0, 0.5 * side * length))
                };
                Some([-1.0, 1.0].map(rim).into())
            }
            _ => None,
        }
    };
    found(one, other, true).or_else(|| found(other, one, false))
}
