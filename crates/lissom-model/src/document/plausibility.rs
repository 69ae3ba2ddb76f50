//! Numbers that are probably in other units, and geometry that is probably a slip: millimetres, megapascals, degrees. Each is a
//! warning, which names the unit that the program reads.

use std::f64::consts::TAU;

use super::connections::{Places, part_of};
use super::{AnalysisKind, Body, Component, Document, NodeReference, SignalEntry};
use lissom_motion::Vector3;

use crate::outputs::entry::{Output, OutputSource};
use crate::parts::context::Context;
use crate::reading::mesh_nodes::nodes_at;
use crate::text::report::{Problem, Span};

/// Gravity above this is that in mm/s² [m/s²].
const MAX_GRAVITY: f64 = 1000.0;
/// Densities below this are those in t/mm³ or kg/mm³; the lightest foams have a few kg/m³ [kg/m³].
const MIN_DENSITY: f64 = 0.01;
/// Radius of gyration above this, of a body with less than this mass, is that of an inertia in kg mm² [m, kg].
const MAX_GYRATION: (f64, f64) = (10.0, 1000.0);
/// Radius of gyration beyond the extent of the whole model by this factor.
const GYRATION_TO_EXTENT: f64 = 10.0;
/// Extent of a model whose parts all have less than this mass, above which it is that in mm [m, kg].
const MAX_EXTENT: (f64, f64) = (200.0, 20.0);
/// Distance of a joint from a part that it holds, beyond the extent of all parts by this factor.
const JOINT_TO_EXTENT: f64 = 5.0;
/// Distance of a point of an output from its body beyond the body's radius of gyration, by this factor.
const POINT_TO_GYRATION: f64 = 5.0;
/// Moving parts of a contact from which on a scheme for many contacts pays.
const MANY_PARTS: usize = 8;
/// Speeds of a drive that are probably in degrees per second.
const DEGREES: [f64; 8] = [45.0, 90.0, 180.0, 360.0, 720.0, 1080.0, 1800.0, 3600.0];

/// Warns of what is improbable.
pub(super) fn check(context: &Context<'_>, document: &Document, places: &Places) {
    let doubts = [
        units,
        inertias,
        joints,
        degrees,
        single_nodes,
        far_sets,
        balanced,
        far_points,
        many_contacts,
        samples,
        ropes,
        slack_ropes,
        jams,
    ]
    .into_iter()
    .flat_map(|find| find(document, places));
    for (span, message, help) in doubts {
        context.report(Problem::warning(span, message).help(help));
    }
    if let Some((gravity, _)) = context.top("gravity")
        && document.gravity.norm() > MAX_GRAVITY
    {
        let message = format!("gravity is {} m/s²", document.gravity.norm());
        context.report(Problem::warning(gravity.span, message).help("write it in m/s², and lengths in m"));
    }
}

/// Clamps and moments at one node of a shell: a moment about the normal meets little resistance there, and less in a finer mesh.
fn single_nodes(document: &Document, _: &Places) -> Vec<Doubt> {
    let turns = |component: &&Component| matches!(component.kind.value.as_str(), "clamp" | "moment");
    let all = document.joints.iter().chain(&document.loads).filter(turns);
    let doubt = |component: &Component| {
        let is_shell = |node: &NodeReference| matches!(node, NodeReference::Mesh { part, .. } if document.shell(part).is_some());
        let nodes = component.attachment.nodes.iter().map(|own| &own.node);
        let own = nodes.clone().find(|own| is_shell(&own.value))?;
        let NodeReference::Mesh { part: shell, place } = &own.value else { return None };
        let is_other = nodes.filter(|own| is_shell(&own.value)).count() == 1;
        let is_single = nodes_at(document.mesh(shell)?, shell, place).is_ok_and(|nodes| nodes.len() == 1);
        (is_other && is_single).then(|| {
            let message = format!(
                "`{}` acts on one node of shell `{shell}`, which hardly resists a moment about its normal there",
                component.name.value
            );
            let help = "name a set of nodes as large as the real part: `sets = { foot = { center = [x, y, z], radius = r } }`";
            (own.span, message, help.to_owned())
        })
    };
    all.filter_map(doubt).collect()
}

/// Joints between two sets of nodes of shells or solids, of which one node is farther from the nearest of the other than half the set is long.
fn far_sets(document: &Document, _: &Places) -> Vec<Doubt> {
    let positions = |node: &NodeReference| {
        let NodeReference::Mesh { part, place } = node else { return None };
        let mesh = document.mesh(part)?;
        let nodes = nodes_at(mesh, part, place).ok()?;
        Some(nodes.iter().map(|&node| mesh.positions[node]).collect::<Vec<_>>())
    };
    let doubt = |joint: &Component| {
        let [base, tip] = joint.attachment.nodes.as_slice() else { return None };
        let (bases, tips) = (positions(&base.node.value)?, positions(&tip.node.value)?);
        let nearest =
            |tip: &Vector3| bases.iter().map(|base| (base - tip).norm()).fold(f64::INFINITY, f64::min);
        let farthest = tips.iter().map(nearest).fold(0.0, f64::max);
        let long = tips.iter().map(|own| (own - tips[0]).norm()).fold(0.0, f64::max);
        (long > 0.0 && farthest > 0.5 * long).then(|| {
            let message = format!(
                "joint `{}` connects nodes that are {farthest:.3} m apart, by rigid arms",
                joint.name.value
            );
            (tip.node.span, message, "name the sides that lie at each other".to_owned())
        })
    };
    document.joints.iter().filter_map(doubt).collect()
}

/// Contacts in which so many parts may touch each other that following every touch takes long.
fn many_contacts(document: &Document, _: &Places) -> Vec<Doubt> {
    let analysis = &document.analysis;
    if !matches!(analysis.kind, AnalysisKind::Dynamics { .. }) || !analysis.has_default_scheme() {
        return Vec::new();
    }
    let crowds = document.contacts.iter().map(|entry| (&entry.name, entry.moving_parts()));
    let crowds = crowds.filter(|(_, count)| *count >= MANY_PARTS);
    crowds
        .map(|(name, count)| {
            let message = format!(
                "{count} moving parts may touch each other in contact `{}`, and by default every touch is followed by events and \
                 controlled errors, which takes long",
                name.value
            );
            let help = "with `scheme = \"backward-euler\"` and `step = 1e-3` all touches of a step are solved at once: of first order in \
                        the step; name another scheme to keep this way";
            (name.span, message, help.to_owned())
        })
        .collect()
}

/// What is doubtful: where, why, and what is probably meant.
type Doubt = (Span, String, String);

/// Largest distance between two corners of the box around all parts, the ground apart [m].
fn extent(document: &Document, places: &Places) -> f64 {
    let ends = document.beams.iter().flat_map(|beam| [0.0, 1.0].map(|s| beam.line.position(s)));
    let mut all = places.all().chain(ends);
    let Some(first) = all.next() else { return 0.0 };
    let (low, high) = all.fold((first, first), |(low, high), own| (low.inf(&own), high.sup(&own)));
    (high - low).norm()
}

fn units(document: &Document, places: &Places) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    for material in &document.materials {
        let (name, constants) = (&material.name, material.constants);
        if constants.density > 0.0 && constants.density < MIN_DENSITY {
            let message = format!("material `{}` has a density of {:e} kg/m³", name.value, constants.density);
            doubts.push((name.span, message, "write it in kg/m³: steel has 7850".to_owned()));
        }
    }
    let masses = document.bodies.iter().map(|body| (&body.name, body.mass));
    let masses = masses.chain(document.point_masses.iter().map(|mass| (&mass.name, mass.mass)));
    let heaviest = masses.max_by(|a, b| a.1.total_cmp(&b.1));
    let extent = extent(document, places);
    if let Some((name, mass)) = heaviest
        && document.beams.is_empty()
        && mass < MAX_EXTENT.1
        && extent > MAX_EXTENT.0
    {
        let message = format!(
            "the parts are up to {extent:.0} m apart, and the heaviest, `{}`, has {mass} kg",
            name.value
        );
        doubts.push((name.span, message, "write lengths in m, not in mm".to_owned()));
    }
    doubts
}

/// The radius of gyration about the axis of the largest inertia [m].
fn gyration(body: &Body) -> f64 {
    (body.inertia.symmetric_eigenvalues().max() / body.mass).sqrt()
}

fn inertias(document: &Document, places: &Places) -> Vec<Doubt> {
    let extent = extent(document, places);
    let doubt = |body: &Body| {
        let radius = gyration(body);
        let is_large = radius > MAX_GYRATION.0 && body.mass < MAX_GYRATION.1;
        let is_beyond = extent > 0.0 && radius > GYRATION_TO_EXTENT * extent;
        (body.mass > 0.0 && (is_large || is_beyond)).then(|| {
            let message = format!(
                "body `{}` of {} kg has an inertia as if its mass were {radius:.3} m from its centre{}",
                body.name.value,
                body.mass,
                if is_large { String::new() } else { format!(", and all parts are within {extent:.3} m") }
            );
            let help = "write `inertia` in kg m²: 1 kg mm² is 1e-6 kg m²; ignore this for the inertia of a motor behind its gear";
            (body.name.span, message, help.to_owned())
        })
    };
    document.bodies.iter().filter_map(doubt).collect()
}

/// Joints far from what they hold.
fn joints(document: &Document, places: &Places) -> Vec<Doubt> {
    let extent = extent(document, places);
    let far = |joint: &Component| {
        joint.attachment.nodes.iter().find_map(|own| {
            let at = own.at?;
            let is_body = matches!(own.node.value, NodeReference::Body(_) | NodeReference::PointMass(_));
            let distance = (places.of(&own.node.value)? - at).norm();
            let reach = JOINT_TO_EXTENT * extent;
            (is_body && extent > 0.0 && distance > reach).then(|| {
                let message = format!(
                    "`{}` is {distance:.3} m from `{}`, which it holds, and all parts are within {extent:.3} m",
                    joint.name.value,
                    part_of(&own.node.value)
                );
                (joint.name.span, message, "correct its position `at`, which is in m, global axes".to_owned())
            })
        })
    };
    document.joints.iter().filter_map(far).collect()
}

/// Drives whose speed is a round number of degrees per second.
fn degrees(document: &Document, _: &Places) -> Vec<Doubt> {
    let time = document.analysis.start + 1e-3 * (document.analysis.end - document.analysis.start);
    let doubt = |joint: &Component| {
        if joint.kind.value != "prescribed_rotation" {
            return None;
        }
        let speed = joint.parameters.function("rotation").ok()?.first_derivative(time);
        DEGREES.iter().any(|own| (speed.abs() - own).abs() < 1e-9 * own).then(|| {
            let message = format!(
                "the drive `{}` turns by {:.1} revolutions per second: angles are in radians",
                joint.name.value,
                speed.abs() / TAU
            );
            let help = format!("write `{}*pi/180*t` for {} degrees per second", speed.abs(), speed.abs());
            (joint.span_of("rotation"), message, help)
        })
    };
    document.joints.iter().filter_map(doubt).collect()
}

/// Joints at the centre of mass of a body on which nothing but its weight acts: nothing moves.
fn balanced(document: &Document, _: &Places) -> Vec<Doubt> {
    let acts = |other: &Component, joint: &Component, body: &str| {
        other.name.value != joint.name.value
            && (other.attachment.nodes.iter().any(|own| part_of(&own.node.value) == body)
                || other.attachment.joints().contains(&joint.name.value.as_str()))
    };
    let doubt = |joint: &Component| {
        let [base, tip] = joint.attachment.nodes.as_slice() else { return None };
        let turns = matches!(joint.kind.value.as_str(), "revolute" | "spherical" | "universal");
        let (NodeReference::Ground, NodeReference::Body(name)) = (&base.node.value, &tip.node.value) else {
            return None;
        };
        let body = document.bodies.iter().find(|body| body.name.value == *name)?;
        let center = body.position + body.axes * body.center_of_mass;
        let is_at_center = (tip.at? - center).norm() <= 1e-9 * gyration(body);
        let starts =
            joint.parameters.has("rate") || body.angular_velocity.is_some() || body.velocity.is_some();
        let starts = starts || document.initial.is_some() || !document.initial_of_parts.is_empty();
        let mut others = document.joints.iter().chain(&document.springs).chain(&document.loads);
        let is_alone = !others.any(|other| acts(other, joint, name)) && body.solids.is_empty();
        let is_alone = is_alone && document.local_loads.is_empty() && document.superelements.is_empty();
        (turns && is_at_center && !starts && is_alone && document.gravity != Vector3::zeros()).then(|| {
            let message = format!(
                "joint `{}` is at the centre of mass of `{name}`: its weight has no moment there, so that nothing moves",
                joint.name.value
            );
            (joint.name.span, message, "write the position of the joint, `at`, in global axes".to_owned())
        })
    };
    document.joints.iter().filter_map(doubt).collect()
}

/// Signals that are sampled once in the whole motion.
fn samples(document: &Document, _: &Places) -> Vec<Doubt> {
    let analysis = &document.analysis;
    let doubt = |entry: &SignalEntry| {
        let (interval, _) = entry.sampling.filter(|(interval, _)| *interval > analysis.end)?;
        let message = format!(
            "signal `{}` is sampled every {interval} s, and the motion ends at {} s",
            entry.name.value, analysis.end
        );
        Some((
            entry.name.span,
            message,
            "write `sample` in seconds: is it in milliseconds or hertz?".to_owned(),
        ))
    };
    document.signals.iter().filter_map(doubt).collect()
}

/// Ropes that carry nothing however long they become.
fn ropes(document: &Document, _: &Places) -> Vec<Doubt> {
    let is_loose = |own: &&Component| {
        own.kind.value == "rope" && !["stiffness", "force"].iter().any(|key| own.parameters.has(key))
    };
    let doubt = |own: &Component| {
        let message = format!("rope `{}` has no `stiffness`: it carries nothing", own.name.value);
        (own.name.span, message, "add `stiffness`, E A over the length for a steel rope [N/m]".to_owned())
    };
    document.springs.iter().filter(is_loose).map(doubt).collect()
}

/// Ropes that are slack where the search for an equilibrium starts, so that they have no stiffness there.
fn slack_ropes(document: &Document, _: &Places) -> Vec<Doubt> {
    let doubt = |rope: &Component| {
        // The way over sheaves with a radius is longer than that between their centres.
        let points: Option<Vec<Vector3>> =
            rope.attachment.nodes.iter().map(|node| node.at.filter(|_| node.sheave.is_none())).collect();
        let way: f64 = points?.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let length = rope.parameters.function("length").ok()?.value(document.analysis.start);
        (rope.kind.value == "rope" && length > way && document.starts_in_equilibrium()).then(|| {
            let message = format!(
                "rope `{}` of {length:.3} m is slack at the start, where its points are {way:.3} m apart: the search for an equilibrium \
                 finds no resistance there",
                rope.name.value
            );
            (rope.name.span, message, "write positions at which the rope is tight".to_owned())
        })
    };
    document.springs.iter().filter_map(doubt).collect()
}

/// Gears that lock against the wheel whose inertia drives them, so that no motion satisfies their law: I₁ + (2 - 1/η) I₂ r² < 0. The
/// inertias are those of the bodies that hinges on the ground hold, without what else moves with them.
fn jams(document: &Document, _: &Places) -> Vec<Doubt> {
    let inertia = |name: &str| {
        let joint = document.joints.iter().find(|joint| joint.name.value == name)?;
        let [base, tip] = joint.attachment.nodes.as_slice() else { return None };
        let (NodeReference::Ground, NodeReference::Body(body)) = (&base.node.value, &tip.node.value) else {
            return None;
        };
        let body = document.bodies.iter().find(|candidate| candidate.name.value == *body)?;
        let axis = joint.attachment.axes.first()?.value.try_normalize(0.0)?;
        let arm = (body.position + body.axes * body.center_of_mass - tip.at?).cross(&axis);
        let in_body = body.axes.transpose() * axis;
        (joint.kind.value == "revolute")
            .then(|| in_body.dot(&(body.inertia * in_body)) + body.mass * arm.norm_squared())
    };
    let doubt = |gear: &Component| {
        let efficiency = gear.parameters.number("efficiency").ok().filter(|_| gear.kind.value == "gear")?;
        let ratio = gear.parameters.number("ratio").ok()?;
        let [joint, other] = gear.attachment.joints()[..] else { return None };
        let behind = inertia(other)? * ratio * ratio;
        let least = 1.0 / (2.0 + inertia(joint)? / behind);
        (efficiency < least).then(|| {
            let message = format!(
                "gear `{}` jams: it locks where `{other}` drives it, and the inertia behind `{other}` is more than it can stop",
                gear.name.value
            );
            let help = format!(
                "raise `efficiency` above {least:.3}, or the inertia at `{joint}`; elasticity of the shaft between them avoids it, too"
            );
            (gear.name.span, message, help)
        })
    };
    document.joints.iter().filter_map(doubt).collect()
}

/// Points of outputs that are far from their body, and would be near it in body axes.
fn far_points(document: &Document, _: &Places) -> Vec<Doubt> {
    let doubt = |output: &Output| {
        let OutputSource::Node { node, point: Some(point) } = &output.source else { return None };
        let NodeReference::Body(name) = &node.value else { return None };
        let body = document.bodies.iter().find(|body| body.name.value == *name)?;
        let reach = POINT_TO_GYRATION * gyration(body);
        let distance = (point - body.position).norm();
        (distance > reach && point.norm() <= reach).then(|| {
            let meant = body.position + body.axes * point;
            let message = format!(
                "the point of output `{}` is {distance:.3} m from `{name}`, whose mass is much nearer: it is in global axes",
                output.name.value
            );
            let help = format!(
                "if body axes are meant, write `point = [{:.6}, {:.6}, {:.6}]`",
                meant.x, meant.y, meant.z
            );
            (node.span, message, help)
        })
    };
    document.outputs.iter().filter_map(doubt).collect()
}
