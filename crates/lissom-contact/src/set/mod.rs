//! Parts that may touch at many points, as one set: which of them are near, and the points and laws of their touches. Parts that are far
//! from each other cost nothing.

mod near_pairs;
mod smallest_gap;

use lissom_motion::{Motion, Vector3};

pub use near_pairs::{NearPair, NearPairs};
pub use smallest_gap::SmallestGap;

use crate::forms::{Meeting, PlacedSolid, meetings};
use crate::geometry::surfaces::MeshError;
use crate::law::{Coulomb, Impact};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::kinematics::{Kinematics, NodeId};

/// A part of the set.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchingPart {
    /// Node of the part.
    pub node: NodeId,
    /// What touches.
    pub solids: Vec<PlacedSolid>,
    /// Radius of a sphere about the node that contains the part [m]; infinite for planes and prisms.
    pub radius: f64,
}

impl TouchingPart {
    /// These solids of a node.
    pub fn new(node: NodeId, solids: Vec<PlacedSolid>) -> Self {
        let of = |solid: &PlacedSolid| solid.frame.position.norm() + solid.form.radius();
        let radius = solids.iter().map(of).fold(0.0, f64::max);
        Self { node, solids, radius }
    }
}

/// Law of all touches of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchLaw {
    /// Elastic normal force.
    pub compliance: Compliance,
    /// What an impact dissipates.
    pub impact: Impact,
    /// Coefficients of friction, if there is any.
    pub friction: Option<Coulomb>,
    /// Surface of a part that moves along itself: of two parts which, and its velocity in the axes of the part's node [m/s].
    pub surface: Option<(usize, Vector3)>,
}

/// A contact: every two of its parts may touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactRule {
    /// Name of the contact.
    pub name: String,
    /// Parts of the contact among those of the set, each once; of two parts the earlier one is the base.
    pub parts: Vec<usize>,
    /// Groups to which each part belongs, ascending: parts of a common group do not touch each other. Empty without groups.
    pub groups: Vec<Vec<u32>>,
    /// Law of its touches; a moving surface is that of the first part.
    pub law: TouchLaw,
    /// Young's modulus [Pa] and Poisson's ratio of both materials, if the elastic force follows from them and the curvatures.
    pub materials: Option<[[f64; 2]; 2]>,
}

impl ContactRule {
    /// Whether two of [`parts`](Self::parts), by their positions in it, may touch.
    pub fn may_touch(&self, places: [usize; 2]) -> bool {
        let [one, other] = places.map(|place| self.groups.get(place).map_or(&[][..], Vec::as_slice));
        !one.iter().any(|group| other.binary_search(group).is_ok())
    }
}

/// A point at which two parts may touch, with its law.
pub type PlacedMeeting = (Meeting, TouchLaw);

/// All contacts of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactSet {
    /// The parts.
    pub parts: Vec<TouchingPart>,
    /// The contacts.
    pub rules: Vec<ContactRule>,
}

impl ContactSet {
    /// Whether nothing may touch.
    pub fn is_empty(&self) -> bool {
        self.rules.is_empty()
    }

    /// The points at which two parts of a contact may touch, each with its law; none if two of their solids cannot touch.
    ///
    /// # Errors
    /// If a mesh encloses no solid.
    pub fn meetings_of(
        &self,
        rule: usize,
        parts: [usize; 2],
    ) -> Result<Option<Vec<PlacedMeeting>>, MeshError> {
        let [one, other] = parts.map(|part| &self.parts[part].solids);
        let rule = &self.rules[rule];
        let surface = rule.law.surface.and_then(|(_, velocity)| {
            let side = parts.iter().position(|part| *part == rule.parts[0])?;
            Some((side, velocity))
        });
        let mut all = Vec::new();
        for solids in one.iter().flat_map(|one| other.iter().map(move |other| [one, other])) {
            let Some(found) = meetings(solids, true)? else { return Ok(None) };
            let mut law = TouchLaw { surface, ..rule.law };
            if let Some(materials) = rule.materials {
                let curvature = solids.map(|solid| solid.form.curvature());
                let [Some(one), Some(other)] = curvature else { return Ok(None) };
                law.compliance = Compliance::hertz(one + other, materials);
            }
            all.extend(found.into_iter().map(|meeting| (meeting, law)));
        }
        Ok(Some(all))
    }

    /// The tip, the gap and the penetration at which the solids are within each other of all points that touch at a configuration.
    pub fn touching(&self, at: &Kinematics) -> Vec<(NodeId, [f64; 2])> {
        let mut near = NearPairs::new(self);
        let mut found = Vec::new();
        for pair in near.find(self, at, &vec![0.0; self.parts.len()]) {
            let parts = pair.parts.map(|part| part as usize);
            let nodes = parts.map(|part| self.parts[part].node);
            // Forms that cannot touch are rejected with the model.
            let meetings = self.meetings_of(pair.rule as usize, parts).ok().flatten().unwrap_or_default();
            for (meeting, _) in meetings {
                let gap = gap_of(&meeting, nodes, at);
                if gap < 0.0 {
                    found.push((nodes[1], [gap, meeting.pair.deepest()]));
                }
            }
        }
        found
    }
}

/// The axes of a meeting's base, and its tip in them, for the frames of both parts.
pub fn placed(meeting: &Meeting, frames: [Motion; 2]) -> (Motion, Motion) {
    let frame = |side: usize| frames[meeting.sides[side]] * meeting.frames[side];
    let base = frame(0);
    (base, frame(1).relative_to(&base))
}

/// The gap of a meeting [m].
pub(crate) fn gap_of(meeting: &Meeting, nodes: [NodeId; 2], at: &Kinematics) -> f64 {
    let (_, tip) = placed(meeting, nodes.map(|node| at.nodes[node].frame));
    meeting.pair.value(&tip.position, &tip.rotation.matrix())
}
