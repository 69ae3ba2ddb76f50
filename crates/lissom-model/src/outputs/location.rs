//! Where on the model an output is: at a frame that a node carries, or at a section between the nodes of a beam.

use std::sync::Arc;

use lissom_flexible::beam::line::BeamProbe;
use lissom_mechanics::elements::shape::lagrange;
use lissom_mechanics::kinematics::{CarriedFrame, Kinematics, NodeId, NodeMotion};
use lissom_mechanics::signals::MovingFrame;
use lissom_mechanics::signals::frame_quantity::Formula;
use lissom_motion::{Motion, Vector3, rotation_part, screw, translation_part};

/// A position that moves with the model.
#[derive(Clone)]
pub(crate) enum Location {
    Carried(CarriedFrame),
    Between(BeamSection),
}

/// A point fixed to a section of a beam element.
#[derive(Clone)]
pub(crate) struct BeamSection {
    pub(crate) probe: Arc<dyn BeamProbe>,
    /// Coordinate along the element, from -1 to 1.
    pub(crate) xi: f64,
    /// In the axes of the section [m].
    pub(crate) point: Vector3,
    /// The element's nodes, and the line of sections in the axes of each [m].
    pub(crate) nodes: Vec<(NodeId, Vector3)>,
}

impl Location {
    /// Motion of the location as that of a node.
    pub(crate) fn motion(&self, at: &Kinematics) -> NodeMotion {
        match self {
            Self::Carried(CarriedFrame { node, offset }) => {
                let NodeMotion { frame, twist, acceleration } = &at.nodes[*node];
                NodeMotion {
                    frame: *frame * *offset,
                    twist: offset.adjoint_inverse_times(twist),
                    acceleration: offset.adjoint_inverse_times(acceleration),
                }
            }
            Self::Between(section) => section.motion(at),
        }
    }
}

impl BeamSection {
    /// Motion of the point with the axes of the section. The acceleration is that of the line plus that of its turning, both
    /// interpolated from those of the nodes.
    pub(crate) fn motion(&self, at: &Kinematics) -> NodeMotion {
        let frame = self.probe.frame_at(at, self.xi) * Motion::translation(self.point);
        let of_line = self.probe.twist_at(at, self.xi);
        let spin = rotation_part(&of_line);
        let velocity = translation_part(&of_line) + spin.cross(&self.point);
        let weights: Vec<f64> = match self.nodes.len() {
            2 => lagrange::<2>(self.xi).0.to_vec(),
            3 => lagrange::<3>(self.xi).0.to_vec(),
            _ => lagrange::<4>(self.xi).0.to_vec(),
        };
        let (mut line, mut turning) = (Vector3::zeros(), Vector3::zeros());
        for ((node, offset), weight) in self.nodes.iter().zip(weights) {
            let node = &at.nodes[*node];
            line += weight * node.acceleration_at(offset);
            turning += weight * node.frame.rotation.apply(&rotation_part(&node.acceleration));
        }
        let turning = frame.rotation.apply_inverse(&turning);
        let absolute = frame.rotation.apply_inverse(&line)
            + turning.cross(&self.point)
            + spin.cross(&spin.cross(&self.point));
        // The rate of the twist's components lacks ω × v.
        let acceleration = screw(&(absolute - spin.cross(&velocity)), &turning);
        NodeMotion { frame, twist: screw(&velocity, &spin), acceleration }
    }

    /// Nodes that it depends on.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.nodes.iter().map(|(node, _)| *node)
    }
}

/// A quantity of the frame of a section, with those who observe it.
#[derive(Clone)]
pub(crate) struct ObservedSection {
    pub(crate) section: BeamSection,
    pub(crate) formula: Formula,
    pub(crate) observer: Option<CarriedFrame>,
    pub(crate) axes: Option<CarriedFrame>,
}

impl ObservedSection {
    /// Components of the section.
    pub(crate) fn values(&self, at: &Kinematics) -> Vec<f64> {
        let carried = |frame: &Option<CarriedFrame>| {
            frame.map_or_else(MovingFrame::<f64>::global, |frame| {
                MovingFrame::of_node(&at.nodes[frame.node]).carried(&frame.offset)
            })
        };
        let own = MovingFrame::of_node(&self.section.motion(at));
        let values = self.formula.values(&own, &carried(&self.observer), &carried(&self.axes));
        values[..self.formula.of.component_count()].to_vec()
    }

    /// Nodes that it depends on.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        let observers = self.observer.iter().chain(&self.axes).map(|frame| frame.node);
        self.section.nodes().chain(observers)
    }
}
