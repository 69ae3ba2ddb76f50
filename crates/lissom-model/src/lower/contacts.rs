//! Contacts: the pairs of solids that may touch, and the events at which the velocities of impacts are set.

use std::sync::Arc;

use lissom_mechanics::contact::compliance::Compliance;
use lissom_mechanics::contact::curves::Segment;
use lissom_mechanics::contact::gap::Pair;
use lissom_mechanics::contact::pairs::{CurveOnSurface, EllipsoidOnPlane, PointOnSurface, RimOnPlane};
use lissom_mechanics::contact::surfaces::{Cuboid, HalfSpace, Mesh, MeshError, Ring, Rod, Surface};
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::contact::{Contact, ContactFriction, ContactMotion, Dissipation};
use lissom_mechanics::elements::contact_resistance::ContactResistance;
use lissom_mechanics::kinematics::{CarriedFrame, DiscreteValueId, Kinematics, NodeId, Subject};
use lissom_mechanics::signals::event::{Direction, Event};
use lissom_mechanics::signals::measurement::Component;
use lissom_mechanics::signals::{Argument, Signal};
use lissom_motion::{Motion, Rotation, Vector3};
use lissom_system::Builder;
use nalgebra::Vector2;

use super::names::Names;
use super::straight_line::Line;
use crate::document::{ContactEntry, Document, NodeLocation, Restitution};
use crate::outputs::contact_point::ContactPoint;
use crate::reading::node_reference::NodeReference;
use crate::solids::{Form, PlacedSolid, Solid};
use crate::text::report::Problem;

/// Radius of the edges of boxes where boxes touch each other, of the shortest side: edges that cross then have a direction between
/// them.
const EDGE_ROUNDING: f64 = 0.02;

/// Rotation before the moments against rolling and spinning are full [rad].
const YIELD_ANGLE: f64 = 1e-4;
/// Angular velocity above which their damping saturates [rad/s].
const YIELD_RATE: f64 = 0.1;

/// Two solids that may touch at a point: base and tip, and whether the tip is that of the contact.
pub(super) struct Meeting {
    pub(super) pair: Arc<dyn Pair>,
    pub(super) frames: [Motion; 2],
    pub(super) is_in_order: bool,
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
        let with_friction = document.contacts.iter().filter(|entry| entry.friction.is_some());
        let mut names = with_friction.map(|entry| &entry.name.value).peekable();
        names.peek()?;
        let mut found = FrictionPoints::default();
        for point in names.filter_map(|name| self.contacts.get(name)).flatten() {
            let forces = point.contact.forces_at(at);
            found.sliding += usize::from(forces.is_touching && forces.is_sliding);
            found.sticking += usize::from(forces.is_touching && !forces.is_sliding);
        }
        Some(found)
    }
}

/// Adds a contact.
pub(super) fn add(
    document: &Document,
    entry: &ContactEntry,
    names: &Names,
    builder: &mut Builder,
) -> Result<Vec<ContactPoint>, Problem> {
    let name = &entry.name.value;
    let mut points = Vec::new();
    for SolidPair { solids, nodes, meetings } in solid_pairs(document, entry, names)? {
        let stiffness = stiffness(document, entry, solids)?;
        points.extend(meetings.into_iter().map(|meeting| (meeting, nodes, stiffness)));
    }
    let mut all = Vec::new();
    for (number, (meeting, nodes, stiffness)) in points.into_iter().enumerate() {
        let order = if meeting.is_in_order { [0, 1] } else { [1, 0] };
        let frames =
            [0, 1].map(|side| CarriedFrame { node: nodes[order[side]], offset: meeting.frames[side] });
        let own = if all.is_empty() && number == 0 { name.clone() } else { format!("{name} {}", number + 1) };
        let compliance = Compliance { stiffness, exponent: entry.exponent };
        let (dissipation, velocity) = match entry.restitution {
            Restitution::Dissipation(factor) => (Dissipation::Factor(factor), None),
            Restitution::Coefficient(coefficient, least, law) => {
                let held = builder.add_held(&format!("{own}, impact velocity"), 0.0);
                let relative = law.relative_dissipation(coefficient);
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
        let resistance = resistance(entry, &own, &mut contribution);
        let mut contact =
            Contact::new(frames, meeting.pair, (compliance, dissipation), friction).with_name(name);
        if let Some(resistance) = resistance {
            contact = contact.with_resistance(resistance);
        }
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

/// Resistance to rolling and spinning, if it has any.
fn resistance(
    entry: &ContactEntry,
    name: &str,
    contribution: &mut Contribution,
) -> Option<ContactResistance> {
    let [rolling, spinning] = entry.resistance;
    if rolling == 0.0 && spinning == 0.0 {
        return None;
    }
    let mut state = |k: usize| contribution.add_state(format!("{name}, rotation {k}"), 0.0, YIELD_ANGLE);
    let bristles = ContactFriction {
        bristles: (1..=3).map(&mut state).collect(),
        sliding: 1.0,
        at_rest: 1.0,
        stribeck: YIELD_RATE,
        deflection: YIELD_ANGLE,
    };
    Some(ContactResistance { bristles, rolling, spinning })
}

/// The event at which an impact begins, and sets its velocity.
fn touch(
    name: &str,
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
        curvature += match &solid.form {
            Form::Solid(Solid::Sphere(radius)) => 1.0 / *radius,
            Form::HalfSpace => 0.0,
            _ => {
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
        Form::Outline(_) | Form::Polygon(_) => "an outline",
        Form::Hull(_) => "a hull",
        Form::HeightField(_) => "a height field",
        Form::Mesh(_) => "a mesh",
        Form::Solid(Solid::Ellipsoid(_)) => "an ellipsoid",
        Form::Solid(Solid::Box(_)) => "a box",
        Form::Solid(Solid::Tube { inner, .. }) if *inner > 0.0 => "a tube",
        Form::Solid(Solid::Tube { .. }) => "a cylinder",
        Form::Solid(Solid::Sphere(_)) => "a sphere",
        Form::Solid(Solid::Capsule { .. }) => "a capsule",
    }
}

/// The surface of a solid; none where the distance from it is not known.
pub(super) fn surface(form: &Form) -> Result<Option<Arc<dyn Surface>>, MeshError> {
    let found: Arc<dyn Surface> = match form {
        Form::HalfSpace => Arc::new(HalfSpace),
        Form::Solid(Solid::Box(sides)) => Arc::new(Cuboid { half_sides: sides.map(|side| 0.5 * side) }),
        Form::Solid(Solid::Tube { outer, inner, length, .. }) => {
            Arc::new(Ring { radii: [*inner, *outer], half_length: 0.5 * length })
        }
        Form::Solid(Solid::Sphere(radius)) => Arc::new(Rod { half_length: 0.0, radius: *radius }),
        Form::Solid(Solid::Capsule { radius, length, .. }) => {
            Arc::new(Rod { half_length: 0.5 * length, radius: *radius })
        }
        Form::Solid(Solid::Ellipsoid(_)) => return Ok(None),
        Form::Outline(outline) => outline.clone(),
        Form::Polygon(polygon) => polygon.clone(),
        Form::Hull(mesh) => mesh.clone(),
        Form::HeightField(field) => field.clone(),
        Form::Mesh(surface) => {
            let points = surface.points.iter().map(|point| Vector3::from(point.map(f64::from)));
            Arc::new(Mesh::new(&points.collect::<Vec<_>>(), &surface.triangles)?)
        }
    };
    Ok(Some(found))
}

/// Corners of a hull, or of that of a mesh; none of other forms.
fn hull_corners(form: &Form) -> Result<Option<Vec<Vector3>>, MeshError> {
    match form {
        Form::Hull(mesh) => Ok(Some(mesh.corners().collect())),
        Form::Mesh(surface) => {
            let points = surface.points.iter().map(|point| Vector3::from(point.map(f64::from)));
            Ok(Some(Mesh::hull(&points.collect::<Vec<_>>())?.corners().collect()))
        }
        _ => Ok(None),
    }
}

/// Two solids that may touch.
pub(super) struct SolidPair<'d> {
    /// Those of base and tip.
    solids: [&'d PlacedSolid; 2],
    /// Nodes of base and tip.
    pub(super) nodes: [NodeId; 2],
    /// The points at which they may touch.
    pub(super) meetings: Vec<Meeting>,
}

/// The pairs of solids of a contact.
pub(super) fn solid_pairs<'d>(
    document: &'d Document,
    entry: &ContactEntry,
    names: &Names,
) -> Result<Vec<SolidPair<'d>>, Problem> {
    let name = &entry.name.value;
    let mut all = Vec::new();
    for parts in entry.pairs() {
        if let Some(clamp) = clamp_between(document, parts.map(|part| &part.value)) {
            let message =
                format!("contact `{name}` is between parts that the clamp `{clamp}` makes one rigid part");
            return Err(Problem::error(parts[1].span, message)
                .help("remove the contact, or join the parts by a joint that moves"));
        }
        let nodes = [names.node(parts[0])?, names.node(parts[1])?];
        let [first, second] = parts.map(|part| solids(document, &part.value));
        for solids in first.iter().flat_map(|one| second.iter().map(move |other| [one, other])) {
            let found = meetings(solids[0], solids[1]).map_err(|error| {
                let message = format!("contact `{name}`: a mesh of its parts is no solid: {error}");
                Problem::error(entry.name.span, message)
                    .help("repair the file, or use solids that have its shape")
            })?;
            let meetings = found.ok_or_else(|| {
                let [one, other] = solids.map(|solid| words(&solid.form));
                let message = format!("contact `{name}`: {one} against {other} is not available");
                Problem::error(entry.name.span, message)
                    .help("one of them can be made of spheres, or be a plane")
            })?;
            all.push(SolidPair { solids, nodes, meetings });
        }
    }
    Ok(all)
}

/// The clamp between two parts, if there is one.
fn clamp_between<'d>(document: &'d Document, parts: [&NodeReference; 2]) -> Option<&'d str> {
    let joins =
        |nodes: &[NodeLocation]| parts.iter().all(|part| nodes.iter().any(|at| at.node.value == **part));
    let mut clamps = document.joints.iter().filter(|joint| joint.kind.value == "clamp");
    clamps.find(|clamp| joins(&clamp.attachment.nodes)).map(|clamp| clamp.name.value.as_str())
}

/// The points at which two solids may touch; none if that is not available.
fn meetings(one: &PlacedSolid, other: &PlacedSolid) -> Result<Option<Vec<Meeting>>, MeshError> {
    let mut all = Vec::new();
    for (base, tip, is_in_order) in [(one, other, true), (other, one, false)] {
        let Some((found, is_complete)) = touching(&base.form, &tip.form, is_in_order)? else { continue };
        all.extend(found.into_iter().map(|(pair, location)| Meeting {
            pair,
            frames: [base.frame, tip.frame * location],
            is_in_order,
        }));
        if is_complete {
            return Ok(Some(all));
        }
    }
    // Half of a pair that needs both directions is none.
    Ok(None)
}

/// A part of a solid that may touch: the pair that it is with the base, and its location in the axes of its solid.
type Touching = (Arc<dyn Pair>, Motion);

/// An edge, or a corner, and its location in the axes of its solid.
type Tip = (Option<Segment>, Motion);

fn pair(tip: Option<Segment>, rounding: f64, surface: &Arc<dyn Surface>) -> Arc<dyn Pair> {
    let surface = surface.clone();
    match tip {
        None => Arc::new(PointOnSurface { rounding, surface }),
        Some(segment) => Arc::new(CurveOnSurface { curve: Arc::new(segment), rounding, surface }),
    }
}

/// The parts of a tip that touch a base, and whether they are all: otherwise those of the base that touch the tip, the second
/// direction, are the rest. None if that is not available.
fn touching(base: &Form, tip: &Form, is_first: bool) -> Result<Option<(Vec<Touching>, bool)>, MeshError> {
    let at = |place: Vector3| Motion::translation(place);
    let along = |height: f64| at(height * Vector3::z());
    let one = |pair: Arc<dyn Pair>| vec![(pair, Motion::IDENTITY)];
    let points = |corners: Vec<Vector3>, (rounding, surface): (f64, &Arc<dyn Surface>)| -> Vec<Touching> {
        corners.into_iter().map(|corner| (pair(None, rounding, surface), at(corner))).collect()
    };
    if let Some(found) = of_edges(base, tip, is_first) {
        return Ok(Some(found));
    }
    let flat = |corner: Vector2<f64>| Vector3::new(corner.x, corner.y, 0.0);
    let Some(surface) = surface(base)? else { return Ok(None) };
    let mut is_complete = true;
    let found = match (base, tip) {
        (_, Form::Solid(Solid::Sphere(radius))) => one(pair(None, *radius, &surface)),
        (Form::HalfSpace, Form::Solid(Solid::Capsule { radius, length, .. })) => {
            [-0.5, 0.5].map(|side| (pair(None, *radius, &surface), along(side * length))).into()
        }
        (Form::Solid(_) | Form::Hull(_), Form::Solid(Solid::Capsule { radius, length, .. })) => {
            // A sphere is better seen from the capsule, whose distance is exact.
            let is_available =
                |solid: &Solid| solid.has_convex_surface() && !matches!(solid, Solid::Sphere(_));
            if matches!(base, Form::Solid(solid) if !is_available(solid)) {
                return Ok(None);
            }
            one(pair(Some(Segment::new(0.5 * length)), *radius, &surface))
        }
        (Form::HalfSpace, Form::Solid(Solid::Box(sides))) => {
            corners(sides, 0.0).into_iter().map(|(_, place)| (pair(None, 0.0, &surface), place)).collect()
        }
        (Form::HalfSpace, Form::Solid(Solid::Tube { outer, length, .. })) => {
            let rim: Arc<dyn Pair> = Arc::new(RimOnPlane { radius: *outer, rounding: 0.0 });
            let half = (0.5 * length - RimOnPlane::inset(*outer)).max(0.0);
            [-1.0, 1.0].map(|side| (rim.clone(), along(side * half))).into()
        }
        (Form::HalfSpace, Form::Solid(Solid::Ellipsoid(axes))) => {
            one(Arc::new(EllipsoidOnPlane { semi_axes: *axes }))
        }
        (Form::HalfSpace, Form::Hull(_) | Form::Mesh(_)) => match hull_corners(tip)? {
            Some(corners) => points(corners, (0.0, &surface)),
            None => return Ok(None),
        },
        // A roller, whose axis is parallel to that of the prism.
        (Form::Outline(_) | Form::Polygon(_), Form::Solid(Solid::Tube { outer, .. })) => {
            one(pair(None, *outer, &surface))
        }
        (Form::HalfSpace | Form::Outline(_), Form::Outline(outline)) => {
            one(Arc::new(CurveOnSurface { curve: Arc::new(outline.curve().clone()), rounding: 0.0, surface }))
        }
        (Form::HalfSpace, Form::Polygon(polygon)) => {
            points(polygon.convex_corners().map(flat).collect(), (0.0, &surface))
        }
        (Form::Polygon(_) | Form::Outline(_), Form::Polygon(polygon)) => {
            is_complete = !is_first;
            points(polygon.convex_corners().map(flat).collect(), (0.0, &surface))
        }
        (Form::Polygon(_), Form::Outline(outline)) => {
            is_complete = !is_first;
            one(Arc::new(CurveOnSurface { curve: Arc::new(outline.curve().clone()), rounding: 0.0, surface }))
        }
        _ => return Ok(None),
    };
    Ok(Some((found, is_complete)))
}

/// Edges of a box, and in the other direction corners, where both solids have edges: edges that cross touch once. The box is
/// rounded, so that the distance from its edges is smooth.
fn of_edges(base: &Form, tip: &Form, is_first: bool) -> Option<(Vec<Touching>, bool)> {
    let rounding = |sides: &[f64; 3]| EDGE_ROUNDING * sides.iter().copied().fold(f64::INFINITY, f64::min);
    let core = |sides: &[f64; 3]| -> Arc<dyn Surface> {
        Arc::new(Cuboid { half_sides: sides.map(|side| 0.5 * side - rounding(sides)) })
    };
    let of = |tips: Vec<Tip>, round: f64, surface: Arc<dyn Surface>| -> Vec<Touching> {
        tips.into_iter().map(|(curve, place)| (pair(curve, round, &surface), place)).collect()
    };
    let found = match (base, tip) {
        (Form::Solid(Solid::Box(own)), Form::Solid(Solid::Box(sides))) => {
            let tips = if is_first { edges } else { corners };
            of(tips(sides, rounding(sides)), rounding(own) + rounding(sides), core(own))
        }
        (Form::Hull(mesh), Form::Solid(Solid::Box(sides))) => {
            of(edges(sides, rounding(sides)), rounding(sides), mesh.clone())
        }
        (Form::Solid(Solid::Box(sides)), Form::Hull(mesh)) => {
            let corners = mesh.corners().map(|corner| (None, Motion::translation(corner)));
            of(corners.collect(), rounding(sides), core(sides))
        }
        _ => return None,
    };
    Some((found, !is_first))
}

/// The eight corners of a box whose faces are moved inwards by `rounding`.
fn corners(sides: &[f64; 3], rounding: f64) -> Vec<Tip> {
    let place = |bit: usize| Vector3::from_fn(|k, _| signed(bit >> k, 0.5 * sides[k] - rounding));
    (0..8).map(|bit| (None, Motion::translation(place(bit)))).collect()
}

/// Its twelve edges.
fn edges(sides: &[f64; 3], rounding: f64) -> Vec<Tip> {
    let half = sides.map(|side| 0.5 * side - rounding);
    let quarter = std::f64::consts::FRAC_PI_2;
    // Rotations of the third axis to each of the three.
    let turns = [quarter * Vector3::y(), -quarter * Vector3::x(), Vector3::zeros()];
    let of = |axis: usize, bit: usize| {
        let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
        let mut place = Vector3::zeros();
        (place[next], place[last]) = (signed(bit, half[next]), signed(bit >> 1, half[last]));
        let frame = Motion::new(Rotation::exponential(&turns[axis]), place);
        (Some(Segment::new(half[axis])), frame)
    };
    (0..12).map(|index| of(index / 4, index % 4)).collect()
}

/// A length with the sign of a bit.
fn signed(bit: usize, length: f64) -> f64 {
    if bit & 1 == 1 { length } else { -length }
}
