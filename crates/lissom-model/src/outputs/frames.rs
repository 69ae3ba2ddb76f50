//! Outputs of frames that nodes carry, and of sections between the nodes of a beam.

use std::sync::Arc;

use lissom_core::elements::beam::line::BeamLine;
use lissom_core::kinematics::{CarriedFrame, GROUND, NodeId};
use lissom_core::signals::frame_quantity::{Formula, FrameQuantity, Of};
use lissom_core::signals::measurement::Measurement;
use lissom_motion::{Motion, Vector3};

use super::Subjects;
use super::location::{BeamSection, Location, ObservedSection};
use crate::channels::{Resolver, Source};
use crate::document::{NodeReference, Output, OutputKind, interface_name};
use crate::report::{Located, Problem};

/// The quantity of a frame that a kind of output is.
fn quantity(kind: OutputKind) -> Of {
    match kind {
        OutputKind::Displacement => Of::Displacement,
        OutputKind::Rotation => Of::Rotation,
        OutputKind::Quaternion => Of::Quaternion,
        OutputKind::CardanAngles => Of::CardanAngles,
        OutputKind::Velocity => Of::Velocity,
        OutputKind::AngularVelocity => Of::AngularVelocity,
        OutputKind::Acceleration => Of::Acceleration,
        _ => Of::Position,
    }
}

/// Source of a quantity of the frame at `location`.
pub(super) fn source(
    output: &Output,
    location: &Location,
    subjects: &Subjects<'_>,
) -> Result<Source, Problem> {
    let frame = |node: &Option<Located<NodeReference>>| {
        node.as_ref().map(|node| carried_frame(node, subjects.names)).transpose()
    };
    let (observer, axes) = (frame(&output.relative_to)?, frame(&output.seen_in)?);
    let start = location.motion(subjects.start).frame;
    let mut start = observer.map_or(start, |observer| start.relative_to(&observer.frame(subjects.start)));
    let of = quantity(output.kind);
    let source = |of: Of, axes: Option<CarriedFrame>, start: Motion| match location {
        Location::Carried(own) => {
            Source::Measured(Arc::new(FrameQuantity::new(of, *own, observer, axes, start)))
        }
        Location::Between(section) => {
            let formula = Formula { of, start, has_axes: axes.is_some() };
            Source::BetweenNodes(ObservedSection { section: section.clone(), formula, observer, axes })
        }
    };
    // By the same formula, so that displacements begin with zero and not with its round-off.
    let position = match source(Of::Position, None, start) {
        Source::Measured(position) => position.values(subjects.start).to_vec(),
        Source::BetweenNodes(position) => position.values(subjects.start),
        _ => Vec::new(),
    };
    if let [x, y, z, ..] = position[..] {
        start.position = Vector3::new(x, y, z);
    }
    Ok(source(of, axes, start))
}

/// Pose of a joint's tip frame in its base frame.
pub(super) fn relative_motion([base, tip]: [CarriedFrame; 2]) -> Arc<dyn Measurement> {
    Arc::new(FrameQuantity::new(Of::Pose, tip, Some(base), None, Motion::identity()))
}

/// Positions of the nodes of a beam on its axis.
pub(super) fn points_of_line(
    name: &Located<String>,
    names: &Resolver<'_>,
) -> Result<Vec<Arc<dyn Measurement>>, Problem> {
    let unknown = || Problem::error(name.span, format!("there is no beam called `{}`", name.value));
    let line = names.lines.get(&name.value).ok_or_else(unknown)?;
    let point = |(&node, offset): (&NodeId, &Motion)| -> Arc<dyn Measurement> {
        // A node may be another part's: the section has its position beside it.
        let own = CarriedFrame { node, offset: Motion::translation(offset.position) };
        Arc::new(FrameQuantity::new(Of::Position, own, None, None, Motion::identity()))
    };
    Ok(line.nodes.iter().zip(&line.offsets).map(point).collect())
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
pub(crate) fn carried_frame(
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

/// Where an output is: at a node, or at a `point` that it carries [m, global axes, at the start].
pub(super) fn location(
    node: &Located<NodeReference>,
    point: Option<&Vector3>,
    subjects: &Subjects<'_>,
) -> Result<Location, Problem> {
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
