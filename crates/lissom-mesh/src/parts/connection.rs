//! Whether the elements of a solid are connected: they meet in whole faces, enclose a volume and use all nodes.

use std::collections::{BTreeSet, HashSet};

use lissom_motion::Vector3;

use crate::parts::meshed_part::MeshedPart;

/// Why the elements of a solid do not form a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConnectionFault {
    /// Two elements have the same corners.
    SameElement {
        /// One of these [m].
        position: Vector3,
    },
    /// A corner of an element is at the middle of an edge of another.
    HangingCorner {
        /// Where [m].
        position: Vector3,
    },
    /// Three corners of a face belong to a face of three corners.
    HalvedFace {
        /// A corner of it [m].
        position: Vector3,
    },
    /// An element is inverted or has no volume.
    Inverted {
        /// Index of the element.
        element: usize,
        /// Where [m].
        position: Vector3,
    },
    /// No element uses a node.
    UnusedNode {
        /// Where it is [m].
        position: Vector3,
    },
}

impl MeshedPart {
    /// The first fault between elements, whose outer faces are known.
    pub fn connection_fault(&self) -> Option<ConnectionFault> {
        let position = |node: usize| self.positions[node];
        let mut known: HashSet<Vec<usize>> = HashSet::new();
        let (mut corners, mut middles) = (BTreeSet::<usize>::new(), BTreeSet::<usize>::new());
        for own in &self.elements {
            let count = own.shape.solid_kind().map_or(own.nodes.len(), |(kind, _)| kind.corners.len());
            let (ends, sides) = own.nodes.split_at(count);
            corners.extend(ends);
            middles.extend(sides);
            let mut ends = ends.to_vec();
            ends.sort_unstable();
            let first = ends[0];
            if !known.insert(ends) {
                return Some(ConnectionFault::SameElement { position: position(first) });
            }
        }
        if let Some(&hanging) = corners.intersection(&middles).next() {
            return Some(ConnectionFault::HangingCorner { position: position(hanging) });
        }
        let sorted = |mut three: [usize; 3]| {
            three.sort_unstable();
            three
        };
        let triangles: HashSet<[usize; 3]> = self
            .faces
            .iter()
            .filter(|face| face.len() == 6)
            .map(|face| sorted([face[0], face[1], face[2]]))
            .collect();
        let mut quadrilaterals = self.faces.iter().filter(|face| face.len() == 8);
        let halved = quadrilaterals
            .find(|face| (0..4).any(|i| triangles.contains(&sorted([0, 1, 2].map(|k| face[(i + k) % 4])))));
        halved.map(|face| ConnectionFault::HalvedFace { position: position(face[0]) })
    }

    /// The first inverted element, or node that no element uses.
    pub fn volume_fault(&self) -> Option<ConnectionFault> {
        let mut is_used = vec![false; self.positions.len()];
        for (element, own) in self.elements.iter().enumerate() {
            own.nodes.iter().for_each(|&node| is_used[node] = true);
            let shares =
                |(kind, _): (&crate::kinds::SolidKind, bool)| kind.shares(&self.positions_of(&own.nodes));
            if let Some(Err(fault)) = own.shape.solid_kind().map(shares) {
                return Some(ConnectionFault::Inverted { element, position: fault.position });
            }
        }
        let unused = is_used.iter().position(|is_used| !is_used)?;
        Some(ConnectionFault::UnusedNode { position: self.positions[unused] })
    }
}
