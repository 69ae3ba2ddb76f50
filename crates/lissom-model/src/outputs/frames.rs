//! Outputs of frames that nodes carry, and of sections between the nodes of a beam.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_flexible::beam::line::BeamLine;
use lissom_mechanics::kinematics::{CarriedFrame, GROUND, NodeId};
use lissom_mechanics::signals::frame_quantity::{Formula, FrameQuantity, Of};
use lissom_mechanics::signals::measurement::Measurement;
use lissom_motion::{Motion, Vector3};
use lissom_system::System;

use super::location::{BeamSection, Location, ObservedSection};
use super::touched::Touched;
use super::{Build, Evaluation, Found, OutputQuantity, Resolver, SOLUTION, Subjects};
use crate::outputs::entry::{Output, OutputSource};
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::reading::node_reference::{NodeReference, interface_name};
use crate::text::report::{Located, Problem};

/// Registry entry.
pub(crate) const POSITION: Declaration = Declaration {
    word: "position",
    summary: "Position of a node, or of a point fixed to it.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes, Feature::Point],
    components: &[("x", "m"), ("y", "m"), ("z", "m")],
    build: Build::Motion(|output, subjects| quantity(Of::Position, output, subjects)),
};
/// Registry entry.
pub(crate) const DISPLACEMENT: Declaration = Declaration {
    word: "displacement",
    summary: "Displacement from the position in the model file.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes, Feature::Point],
    components: &[("u1", "m"), ("u2", "m"), ("u3", "m")],
    build: Build::Motion(|output, subjects| quantity(Of::Displacement, output, subjects)),
};
/// Registry entry.
pub(crate) const ROTATION: Declaration = Declaration {
    word: "rotation",
    summary: "Rotation vector since the start.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes],
    components: &[("r1", "rad"), ("r2", "rad"), ("r3", "rad")],
    build: Build::Motion(|output, subjects| quantity(Of::Rotation, output, subjects)),
};
/// Registry entry.
pub(crate) const QUATERNION: Declaration = Declaration {
    word: "quaternion",
    summary: "Orientation of a node as a unit quaternion with non-negative q0.",
    subject: Subject::Node,
    features: &[Feature::Observer],
    components: &[("q0", ""), ("q1", ""), ("q2", ""), ("q3", "")],
    build: Build::Motion(|output, subjects| quantity(Of::Quaternion, output, subjects)),
};
/// Registry entry.
pub(crate) const CARDAN_ANGLES: Declaration = Declaration {
    word: "cardan_angles",
    summary: "Orientation of a node as Cardan angles: rotations about x, the rotated y and the twice rotated z.",
    subject: Subject::Node,
    features: &[Feature::Observer],
    components: &[("alpha", "rad"), ("beta", "rad"), ("gamma", "rad")],
    build: Build::Motion(|output, subjects| quantity(Of::CardanAngles, output, subjects)),
};
/// Registry entry.
pub(crate) const VELOCITY: Declaration = Declaration {
    word: "velocity",
    summary: "Velocity of a node, or of a point fixed to it.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes, Feature::Point, Feature::Velocities],
    components: &[("v1", "m/s"), ("v2", "m/s"), ("v3", "m/s")],
    build: Build::Motion(|output, subjects| quantity(Of::Velocity, output, subjects)),
};
/// Registry entry.
pub(crate) const ANGULAR_VELOCITY: Declaration = Declaration {
    word: "angular_velocity",
    summary: "Angular velocity of a node.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes, Feature::Velocities],
    components: &[("w1", "rad/s"), ("w2", "rad/s"), ("w3", "rad/s")],
    build: Build::Motion(|output, subjects| quantity(Of::AngularVelocity, output, subjects)),
};
/// Registry entry.
pub(crate) const ACCELERATION: Declaration = Declaration {
    word: "acceleration",
    summary: "Acceleration of a node, or of a point fixed to it.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Axes, Feature::Point, Feature::Accelerations],
    components: &[("a1", "m/s²"), ("a2", "m/s²"), ("a3", "m/s²")],
    build: Build::System(SOLUTION, |output, _, subjects| quantity(Of::Acceleration, output, subjects)),
};
/// Registry entry.
pub(crate) const RELATIVE_MOTION: Declaration = Declaration {
    word: "relative_motion",
    summary: "Position and rotation vector of a joint's tip frame, in the axes of its base frame.",
    subject: Subject::Joint,
    features: &[],
    components: &[("x", "m"), ("y", "m"), ("z", "m"), ("r1", "rad"), ("r2", "rad"), ("r3", "rad")],
    build: Build::Motion(relative_motion),
};
/// Registry entry.
pub(crate) const DISTANCE: Declaration = Declaration {
    word: "distance",
    summary: "Distance of a node, or of a point fixed to it, from another node, and its rate; without `relative_to`, or with the ground, from the origin: no distance from a surface.",
    subject: Subject::Node,
    features: &[Feature::Observer, Feature::Point, Feature::Velocities],
    components: &[("distance", "m"), ("rate", "m/s")],
    build: Build::Motion(|output, subjects| quantity(Of::Distance, output, subjects)),
};
/// Quantity of a frame that a node carries.
struct OfFrame(Arc<dyn Measurement>);

impl OutputQuantity for OfFrame {
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.0)
    }
}

impl OutputQuantity for ObservedSection {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.extend_from_slice(&self.values(at.motion()));
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        Some(Touched { nodes: self.nodes().collect(), ..Touched::default() })
    }
}

/// A quantity of the frame at the node of an output.
fn quantity(of: Of, output: &Output, subjects: &Subjects<'_>) -> Found {
    let location = location_of(output, subjects)?;
    let frame = |node: &Option<Located<NodeReference>>| {
        node.as_ref().map(|node| carried_frame(node, subjects.names)).transpose()
    };
    let (observer, axes) = (frame(&output.relative_to)?, frame(&output.seen_in)?);
    let start = location.motion(subjects.start).frame;
    let mut start = observer.map_or(start, |observer| start.relative_to(&observer.frame(subjects.start)));
    // By the same formula, so that displacements begin with zero and not with its round-off.
    let position = match &location {
        Location::Carried(own) => {
            FrameQuantity::new(Of::Position, *own, observer, None, start).values(subjects.start).to_vec()
        }
        Location::Between(section) => {
            let formula = Formula { of: Of::Position, start, has_axes: false };
            ObservedSection { section: section.clone(), formula, observer, axes: None }.values(subjects.start)
        }
    };
    start.position = Vector3::new(position[0], position[1], position[2]);
    Ok(match location {
        Location::Carried(own) => {
            Arc::new(OfFrame(Arc::new(FrameQuantity::new(of, own, observer, axes, start))))
        }
        Location::Between(section) => {
            let formula = Formula { of, start, has_axes: axes.is_some() };
            Arc::new(ObservedSection { section, formula, observer, axes })
        }
    })
}

/// Pose of a joint's tip frame in its base frame.
fn relative_motion(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let [base, tip] = (subjects.joint_frames)(&name.value).ok_or_else(|| {
        let message = format!("`{}` stands between no two nodes", name.value);
        Problem::error(name.span, message).help("name the joint that it acts on")
    })?;
    Ok(Arc::new(OfFrame(Arc::new(FrameQuantity::new(Of::Pose, tip, Some(base), None, Motion::identity())))))
}

/// What the output is of, by name.
pub(super) fn name_of(output: &Output) -> Result<&Located<String>, Problem> {
    match &output.source {
        OutputSource::Joint(name)
        | OutputSource::Spring(name)
        | OutputSource::Contact(name)
        | OutputSource::LocalLoad(name)
        | OutputSource::Actor(name)
        | OutputSource::Beam(name)
        | OutputSource::Superelement(name)
        | OutputSource::Signal(name) => Ok(name),
        OutputSource::Node { .. } | OutputSource::Model | OutputSource::Expression(_) => {
            let message = format!("output `{}` names nothing", output.name.value);
            Err(Problem::error(output.name.span, message))
        }
    }
}

/// The node of an output, and the point that it carries.
pub(super) fn node_of(output: &Output) -> Result<(&Located<NodeReference>, Option<&Vector3>), Problem> {
    if let OutputSource::Node { node, point } = &output.source {
        return Ok((node, point.as_ref()));
    }
    let message = format!("output `{}` names no node", output.name.value);
    Err(Problem::error(output.name.span, message))
}

fn unknown(node: &Located<NodeReference>, name: &str) -> Problem {
    Problem::error(node.span, format!("there is no part called `{name}`"))
}

/// The node of a part that is not a beam.
fn node_of_part(node: &Located<NodeReference>, names: &Resolver<'_>) -> Result<Option<NodeId>, Problem> {
    let known = |name: &str| names.nodes.get(name).copied().ok_or_else(|| unknown(node, name));
    Ok(Some(match &node.value {
        NodeReference::Ground => GROUND,
        NodeReference::Body(name) | NodeReference::PointMass(name) => known(name)?,
        NodeReference::Interface { superelement, interface } => {
            known(&interface_name(superelement, interface))?
        }
        NodeReference::Mesh { part, .. } => {
            names.meshes.nodes_of(part).ok_or_else(|| unknown(node, part))?.one(node)?
        }
        NodeReference::Beam { .. } => return Ok(None),
    }))
}

fn line<'n>(
    node: &Located<NodeReference>,
    beam: &str,
    names: &Resolver<'n>,
) -> Result<&'n BeamLine, Problem> {
    names.lines.get(beam).ok_or_else(|| unknown(node, beam))
}

/// The frame of a node that has axes: that of the section, of a beam.
pub(super) fn carried_frame(
    node: &Located<NodeReference>,
    names: &Resolver<'_>,
) -> Result<CarriedFrame, Problem> {
    if let Some(node) = node_of_part(node, names)? {
        return Ok(CarriedFrame::of_node(node));
    }
    let NodeReference::Beam { beam, fraction } = &node.value else { return Err(unknown(node, "")) };
    let line = line(node, beam, names)?;
    let found = line.node_at(*fraction).ok_or_else(|| {
        Problem::error(node.span, format!("beam `{beam}` has no node at {fraction}"))
            .help("name a node of the beam, such as its start or end, or change the number of elements")
    })?;
    let index = line.nodes.iter().position(|&other| other == found).unwrap_or(0);
    Ok(CarriedFrame { node: found, offset: line.offsets[index] })
}

/// Where an output is: at a node, or at a point that it carries [m, global axes, at the start].
pub(super) fn location_of(output: &Output, subjects: &Subjects<'_>) -> Result<Location, Problem> {
    let (node, point) = node_of(output)?;
    let carried = |node: NodeId| {
        let frame = subjects.drawn.nodes[node].frame;
        let offset = point.map_or_else(Vector3::zeros, |point| frame.inverse_transform_point(point));
        CarriedFrame { node, offset: Motion::translation(offset) }
    };
    if let Some(node) = node_of_part(node, subjects.names)? {
        return Ok(Location::Carried(carried(node)));
    }
    let NodeReference::Beam { beam, fraction } = &node.value else { return Err(unknown(node, "")) };
    let line = line(node, beam, subjects.names)?;
    let Some(found) = line.node_at(*fraction) else {
        return Ok(Location::Between(section(node, point, subjects)?));
    };
    // The node may be another part's: the position is that of the section.
    let index = line.nodes.iter().position(|&other| other == found).unwrap_or(0);
    let own = CarriedFrame { node: found, offset: Motion::translation(line.offsets[index].position) };
    Ok(Location::Carried(if point.is_some() { carried(found) } else { own }))
}

/// A section of a beam, which may be at a node.
pub(super) fn section(
    node: &Located<NodeReference>,
    point: Option<&Vector3>,
    subjects: &Subjects<'_>,
) -> Result<BeamSection, Problem> {
    let NodeReference::Beam { beam, fraction } = &node.value else {
        return Err(Problem::error(node.span, "sections are on beams".to_owned()));
    };
    let line = line(node, beam, subjects.names)?;
    let (probe, xi) = line.locate(*fraction);
    let element = line.elements.iter().position(|other| Arc::ptr_eq(other, probe)).unwrap_or(0);
    let nodes = element * line.order..=element * line.order + line.order;
    let mut section = BeamSection {
        probe: Arc::clone(probe),
        xi,
        point: Vector3::zeros(),
        nodes: nodes.map(|index| (line.nodes[index], line.offsets[index].position)).collect(),
    };
    if let Some(point) = point {
        section.point = section.motion(subjects.drawn).frame.inverse_transform_point(point);
    }
    Ok(section)
}
