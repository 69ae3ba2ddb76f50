//! Attachments to every form of port, for kinds of all tables.

use lissom_mechanics::elements::{Attached, ElementKind, Sheave, rope};
use lissom_mechanics::joints::slider::CarriedPoint;
use lissom_mechanics::joints::{self, JointKind};
use lissom_mechanics::kinematics::{CoordinateId, Freedoms, NodeId, Quantity};
use lissom_mechanics::ports::PortType;
use lissom_mechanics::registry::{Parameters, Value};
use lissom_motion::Vector3;
use lissom_system::{BeamChain, Builder, JointAttachment, Placement};

use super::configuration::Random;

/// An attachment of a spring or load: points of two bodies, a joint between them, or coordinates of their own.
pub(crate) fn attached(
    builder: &mut Builder,
    kind: &ElementKind,
    nodes: [NodeId; 2],
    random: &mut Random,
) -> Attached {
    let mut attached = Attached::default();
    for port in kind.ports.0 {
        match port.holds {
            PortType::Node { .. } => attached.nodes.push((nodes[attached.nodes.len()], random.vector())),
            PortType::Locations => {
                let order = [nodes[0], nodes[1], builder.ground(), nodes[1], nodes[0]];
                attached.nodes = order.map(|node| (node, random.vector())).to_vec();
                if kind.name == OVER_SHEAVES.name {
                    attached.sheaves = sheaves(builder, &attached);
                }
            }
            PortType::Coordinate(wanted) => {
                attached.coordinates.push(coordinate(builder, nodes, wanted, random));
            }
            PortType::Coordinates => attached.coordinates = two_coordinates(builder),
            // The points of the nodes are random.
            PortType::Location { .. } => {}
            other => panic!("no spring or load has a port {other:?}"),
        }
    }
    attached
}

/// A rope over a sheave on the ground, one on a body, and onto a drum, with points between.
pub(crate) static OVER_SHEAVES: ElementKind = ElementKind { name: "rope over sheaves", ..rope::KIND };

/// Sheaves in the planes of their neighbours at the start.
fn sheaves(builder: &Builder, attached: &Attached) -> Vec<(usize, Sheave)> {
    let points: Vec<Vector3> =
        (attached.nodes.iter()).map(|(node, at)| builder.initial_frame(*node).transform_point(at)).collect();
    let span = |from: usize| points[from + 1] - points[from];
    let sheave = |axis: Vector3, is_positive| Sheave { radius: 0.05, axis, is_positive, turns: None };
    vec![
        (1, sheave(span(0).cross(&span(1)), None)),
        (2, sheave(span(1).cross(&span(2)), None)),
        (4, sheave(span(3).cross(&Vector3::x()), Some(false))),
    ]
}

/// Two bodies at random positions.
pub(crate) fn two_bodies(random: &mut Random) -> (Builder, [NodeId; 2]) {
    let mut builder = Builder::new();
    let nodes = ["base", "tip"].map(|name| builder.add_node(name, random.motion(), Freedoms::Full));
    (builder, nodes)
}

/// An attachment of a joint: two bodies as placed, coordinates of a joint between them, or a line along which the second slides.
pub(crate) fn joint_attachment(
    builder: &mut Builder,
    kind: &JointKind,
    placement: &Placement,
    random: &mut Random,
) -> JointAttachment {
    let mut own = JointAttachment::default();
    let mut at = placement.at;
    let directions = [placement.axis, placement.second_axis];
    let join = |builder: &mut Builder, kind: &JointKind| {
        builder.add_joint("joint", kind, placement, &Parameters::new()).expect("valid")
    };
    for port in kind.ports.0 {
        match port.holds {
            PortType::Node { .. } => own.nodes.push((placement.nodes[usize::from(port.key == "tip")], None)),
            // The tip of kinds with two locations is at its own position.
            PortType::Location { .. } => own.nodes[0].1 = Some(at),
            PortType::Direction(_) => own.axes.extend(directions[own.axes.len()]),
            PortType::Coordinate(wanted) => own.coordinates = join(builder, joint_with(wanted)),
            PortType::OnlyCoordinate(_) | PortType::NamedCoordinates if own.coordinates.is_empty() => {
                own.coordinates = join(builder, &joints::cylindrical::KIND);
            }
            PortType::OnlyCoordinate(_) | PortType::NamedCoordinates => {}
            PortType::Set => {
                own.nodes.extend(
                    (0..5).map(|_| (builder.add_node("node", random.motion(), Freedoms::Full), None)),
                );
                // Some are negative, as those of corners of quadratic faces.
                own.shares = vec![-0.02, 0.3, 0.3, 0.2, 0.22];
            }
            PortType::Beams => (own.beams, at) = line(builder, random),
            other => panic!("no joint has a port {other:?}"),
        }
    }
    own
}

/// A line of four nodes that carry their points beside themselves, and a position on it.
fn line(builder: &mut Builder, random: &mut Random) -> (BeamChain, Vector3) {
    let places: [Vector3; 4] =
        std::array::from_fn(|k| Vector3::new(2.0 * k as f64, 0.0, 0.0) + 0.1 * random.vector());
    let nodes = places.map(|place| {
        let frame = random.motion();
        let node = builder.add_node("node", frame, Freedoms::Full);
        CarriedPoint { node, point: frame.inverse_transform_point(&place) }
    });
    // An axis of the sections that is perpendicular to the line except for the deviations of the nodes.
    let section = |own: CarriedPoint| builder.initial_frame(own.node).rotation.apply_inverse(&Vector3::y());
    let sections = nodes.map(section).to_vec();
    // Half way between the middle nodes: away from nodes, where third derivatives jump.
    let on_line = (9.0 * (places[1] + places[2]) - places[0] - places[3]) / 16.0;
    (BeamChain { nodes: nodes.to_vec(), arc_lengths: vec![0.0, 2.0, 4.0, 6.0], sections }, on_line)
}

/// Adds a slider along a line, whose tip rotates as required.
pub(crate) fn add_slider(builder: &mut Builder, tip: NodeId, orientation: &str, random: &mut Random) {
    let (beams, at) = line(builder, random);
    let attachment = JointAttachment { nodes: vec![(tip, Some(at))], beams, ..JointAttachment::default() };
    let parameters = Parameters::new().with("orientation", Value::Text(orientation.to_owned()));
    builder.add_joint_of_kind("slider", &joints::slider::KIND, attachment, &parameters).expect("valid");
}

/// Two coordinates that no joint between nodes has.
pub(crate) fn two_coordinates(builder: &mut Builder) -> Vec<CoordinateId> {
    let kind = &joints::generalized_coordinates::KIND;
    let parameters = Parameters::new().with("start", Value::Numbers(vec![0.3, -0.2]));
    builder.add_free_coordinates("free", kind, &parameters).expect("valid")
}

/// The first coordinate of a joint between two nodes.
pub(crate) fn coordinate(
    builder: &mut Builder,
    nodes: [NodeId; 2],
    wanted: Quantity,
    random: &mut Random,
) -> CoordinateId {
    let (at, axis) = (random.vector(), Some(random.vector()));
    let placement = Placement { nodes, at, at_tip: None, axis, second_axis: None };
    builder.add_joint("joint", joint_with(wanted), &placement, &Parameters::new()).expect("valid")[0]
}

/// A joint whose first coordinate is of this kind.
fn joint_with(wanted: Quantity) -> &'static JointKind {
    match wanted {
        Quantity::Angle => &joints::revolute::KIND,
        Quantity::Length | Quantity::State => &joints::prismatic::KIND,
    }
}
