//! Bodies, point masses and beams as nodes with mass and elements.

use lissom_flexible::beam::SectionLaw;
use lissom_flexible::beam::line::{BeamLineDescription, beam_line};
use lissom_mechanics::elements::inertia::Inertia;
use lissom_mechanics::kinematics::{Freedoms, Kinematics, LOCKED, NodeId};
use lissom_motion::{Matrix3, Matrix6, Motion, Rotation, Vector3, Vector6, screw};
use lissom_system::{Builder, System};

use super::names::Names;
use super::order::by_name;
use crate::document::{Beam, Document, InitialMotion, Plane};
use crate::reading::node_reference::NodeReference;
use crate::text::report::{Located, Problem};

/// Adds all parts to the system.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    bodies(document, builder, names);
    point_masses(document, builder, names);
    super::superelements::add(document, builder, names, problems);
    super::shells::add(document, builder, names, problems);
    super::elastic_solids::add(document, builder, names, problems);
    beams(document, builder, names, problems);
}

fn bodies(document: &Document, builder: &mut Builder, names: &mut Names) {
    for body in by_name(&document.bodies, |body| &body.name.value) {
        let frame = Motion::new(Rotation::from_matrix(&body.axes), body.position);
        let node = builder.add_node(&body.name.value, frame, Freedoms::Full);
        // A body without mass is a frame between joints.
        if body.mass > 0.0 {
            let inertia = Inertia::of_rigid_body(body.mass, &body.center_of_mass, &body.inertia);
            builder.add_inertia(node, &inertia);
        }
        if body.velocity.is_some() || body.angular_velocity.is_some() {
            builder.give_velocity(node);
        }
        names.nodes.insert(body.name.value.clone(), node);
    }
}

fn point_masses(document: &Document, builder: &mut Builder, names: &mut Names) {
    for mass in by_name(&document.point_masses, |mass| &mass.name.value) {
        let frame = Motion::translation(mass.position);
        let freedoms = match mass.plane {
            None => Freedoms::Translations,
            Some(Plane::Xy) => Freedoms::Planar(0, 1),
            Some(Plane::Yz) => Freedoms::Planar(1, 2),
            Some(Plane::Zx) => Freedoms::Planar(2, 0),
        };
        let node = builder.add_node(&mass.name.value, frame, freedoms);
        builder.add_inertia(node, &Inertia::of_rigid_body(mass.mass, &Vector3::zeros(), &Matrix3::zeros()));
        if mass.velocity.is_some() {
            builder.give_velocity(node);
        }
        names.nodes.insert(mass.name.value.clone(), node);
    }
}

/// Gives all nodes the velocities at the start that belong to their positions in `at`.
pub(super) fn velocities(document: &Document, names: &Names, system: &System, at: &mut Kinematics) {
    let mut set = |node: NodeId, velocities: &dyn Fn(&Motion) -> (Vector3, Vector3)| {
        let (velocity, angular) = velocities(&at.nodes[node].frame);
        let (rows, twist) = (system.layout().rows_of_node(node), screw(&velocity, &angular));
        at.nodes[node].twist = Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { twist[k] });
    };
    for body in &document.bodies {
        let Some(&node) = names.nodes.get(&body.name.value) else { continue };
        set(node, &|frame| {
            let (velocity, angular) = initial_motion(document.initial_motion(&body.name.value), frame);
            let given = body.velocity.as_ref().map(|given| frame.rotation.apply_inverse(&given.value));
            let turning = body.angular_velocity.as_ref().map(|given| given.value);
            (given.unwrap_or(velocity), turning.unwrap_or(angular))
        });
    }
    for mass in &document.point_masses {
        let Some(&node) = names.nodes.get(&mass.name.value) else { continue };
        set(node, &|frame| {
            let (velocity, angular) = initial_motion(document.initial_motion(&mass.name.value), frame);
            (mass.velocity.as_ref().map_or(velocity, |given| given.value), angular)
        });
    }
    for element in &document.superelements {
        let name = &element.name.value;
        for &node in names.superelements.get(name).into_iter().flatten() {
            set(node, &|frame| initial_motion(document.initial_motion(name), frame));
        }
    }
    for (name, own) in names.meshes.all() {
        for &node in &own.nodes {
            set(node, &|frame| initial_motion(document.initial_motion(name), frame));
        }
    }
    for beam in &document.beams {
        let Some(line) = names.lines.get(&beam.name.value) else { continue };
        let (shares_start, shares_end) = (beam.shared_start.is_some(), beam.shared_end.is_some());
        for (k, &node) in line.nodes.iter().enumerate() {
            if (k > 0 || !shares_start) && (k + 1 < line.nodes.len() || !shares_end) {
                set(node, &|frame| initial_motion(document.initial_motion(&beam.name.value), frame));
            }
        }
    }
}

/// Velocity and angular velocity, in body axes, of a frame in the rigid motion of the start.
fn initial_motion(initial: Option<&InitialMotion>, frame: &Motion) -> (Vector3, Vector3) {
    let Some(initial) = initial else { return (Vector3::zeros(), Vector3::zeros()) };
    let velocity = initial.velocity + initial.angular_velocity.cross(&(frame.position - initial.about));
    (frame.rotation.apply_inverse(&velocity), frame.rotation.apply_inverse(&initial.angular_velocity))
}

/// Adds the beams, each after those whose nodes it shares.
fn beams(document: &Document, builder: &mut Builder, names: &mut Names, problems: &mut Vec<Problem>) {
    let mut waiting: Vec<&Beam> = by_name(&document.beams, |beam| &beam.name.value);
    while !waiting.is_empty() {
        let before = waiting.len();
        let mut later = Vec::new();
        for beam in waiting {
            if [&beam.shared_start, &beam.shared_end].into_iter().flatten().all(|end| is_there(names, end)) {
                add_beam(document, beam, builder, names, problems);
            } else {
                later.push(beam);
            }
        }
        if later.len() == before {
            for beam in later {
                problems.push(
                    Problem::error(
                        beam.name.span,
                        format!(
                            "beam `{}` shares a node of a beam that shares one of its own",
                            beam.name.value
                        ),
                    )
                    .help("let one of them start at a point, and join them with a clamp"),
                );
            }
            return;
        }
        waiting = later;
    }
}

/// Whether the part of a shared node exists already.
fn is_there(names: &Names, end: &Located<NodeReference>) -> bool {
    match &end.value {
        NodeReference::Beam { beam, .. } => names.lines.contains_key(beam),
        _ => true,
    }
}

fn add_beam(
    document: &Document,
    beam: &Beam,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    let mut end = |shared: &Option<Located<NodeReference>>| -> Option<NodeId> {
        match names.node(shared.as_ref()?) {
            Ok(node) => Some(node),
            Err(problem) => {
                problems.push(problem);
                None
            }
        }
    };
    let ends = [end(&beam.shared_start), end(&beam.shared_end)];
    let properties = |s: f64, towards: f64| beam.properties(document, s, towards);
    let (contribution, line) = beam_line(
        builder.model(),
        &BeamLineDescription {
            name: &beam.name.value,
            elements: beam.elements.value,
            order: beam.order,
            frame: &|s| Motion::new(Rotation::from_matrix(&beam.frame(s)), beam.line.position(s)),
            law: &|s| {
                properties(s, s).map_or(SectionLaw::elastic(Matrix6::zeros()), |section| SectionLaw {
                    stiffness: section.stiffness,
                    damping: section.damping,
                    free: beam.free_strains(s, section.expansion),
                })
            },
            mass: &|s, towards| properties(s, towards).map_or_else(Matrix6::zeros, |section| section.mass),
            ends,
        },
    );
    builder.add(contribution);
    if let Err(problem) = super::distributed::add(document, beam, &line, builder) {
        problems.push(problem);
    }
    names.lines.insert(beam.name.value.clone(), line);
}
