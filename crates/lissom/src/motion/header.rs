//! Header of a motion file.

use crate::start::Lowered;
use lissom_core::kinematics::{Layout, NodeMotion};
use serde::{Deserialize, Serialize};

use super::{CHECKSUM, MAGIC, PREFIX, UNSEALED, VERSION, checksum};

/// Points of a beam at which section forces are recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcePoints {
    /// Name of the beam.
    pub beam: String,
    /// Fractions of the beam, ascending.
    pub at: Vec<f64>,
}

/// Description of the frames of a motion file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Name of every node; the first is the ground.
    pub nodes: Vec<String>,
    /// Points at which section forces are recorded, beam by beam.
    pub force_points: Vec<ForcePoints>,
    /// Length of a frame.
    pub frame_bytes: usize,
}

/// Gauss points of an element, ±1/√3: strains of low-order elements are most accurate there.
pub(super) const POINTS: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

impl Header {
    /// For the nodes and beams of a model.
    pub(super) fn of(lowered: &Lowered) -> Self {
        let layout: &Layout = lowered.system.layout();
        let nodes: Vec<String> = layout.nodes().map(|node| layout.node_name(node).to_owned()).collect();
        let points = |(beam, line): (&String, &lissom_core::flexible::beam::line::BeamLine)| {
            let count = line.elements.len();
            let place = |element: usize, xi: f64| (element as f64 + 0.5 * (1.0 + xi)) / count as f64;
            let at = (0..count).flat_map(|element| POINTS.map(|xi| place(element, xi))).collect();
            ForcePoints { beam: beam.clone(), at }
        };
        let force_points: Vec<ForcePoints> = lowered.names.lines.iter().map(points).collect();
        let mut header = Self { nodes, force_points, frame_bytes: 0 };
        header.frame_bytes = header.needed_bytes(VERSION);
        header
    }

    /// Number of points with section forces.
    pub fn point_count(&self) -> usize {
        self.force_points.iter().map(|beam| beam.at.len()).sum()
    }

    /// Length of a frame with all these data.
    pub(super) fn needed_bytes(&self, version: u32) -> usize {
        8 + 4 * 6 * (self.nodes.len() + self.point_count()) + checksum_bytes(version)
    }

    /// All bytes before the first frame.
    pub(super) fn to_bytes(&self, reference: &[NodeMotion]) -> Vec<u8> {
        let mut text = serde_json::to_vec(self).expect("names and numbers can always be written as JSON");
        text.resize(text.len().next_multiple_of(8), b' ');
        let mut bytes = Vec::with_capacity(PREFIX + text.len() + 56 * reference.len() + CHECKSUM);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(text.len() as u32).to_le_bytes());
        bytes.extend_from_slice(&text);
        for node in reference {
            let numbers = node.frame.position.iter().copied().chain(node.frame.rotation.quaternion());
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
        bytes.extend(checksum(&bytes));
        bytes
    }
}

/// Length of a checksum in files of a version.
pub(super) fn checksum_bytes(version: u32) -> usize {
    if version == UNSEALED { 0 } else { CHECKSUM }
}
