//! Kinds of faults of a surface mesh, their severity and remedies.

use std::fmt;

/// How severe a fault is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Results would be wrong.
    Error,
    /// Results may be inaccurate.
    Warning,
    /// It may be intended.
    Note,
}

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeshFaultKind {
    /// An element has a node twice.
    RepeatedNode,
    /// An element has no area, or a side without length.
    ZeroArea,
    /// A quadrilateral has a corner of 180 degrees or more, or crosses itself.
    NotConvex,
    /// Two elements have the same nodes.
    SameElement,
    /// Two nodes on boundaries are at the same position: the mesh is torn there.
    TornMesh,
    /// A node on a boundary lies within an edge of another element that does not use it.
    HangingNode,
    /// Neighbours have opposite normals.
    OppositeOrientation,
    /// No element uses a node.
    UnusedNode,
    /// An element is slender.
    AspectRatio {
        /// Length of the element by its width; 1 of a square and of an equilateral triangle.
        ratio: f64,
    },
    /// The corners of a quadrilateral are not in a plane.
    Warp {
        /// Angle between the two triangles beside a diagonal.
        degrees: f64,
    },
    /// More than two elements share an edge.
    Branch,
}

impl MeshFaultKind {
    /// How severe faults of this kind are.
    pub fn severity(&self) -> Severity {
        match self {
            Self::UnusedNode | Self::AspectRatio { .. } | Self::Warp { .. } => Severity::Warning,
            Self::Branch => Severity::Note,
            _ => Severity::Error,
        }
    }

    /// How large it is, among faults of its kind.
    fn size(&self) -> f64 {
        match self {
            Self::AspectRatio { ratio } => *ratio,
            Self::Warp { degrees } => *degrees,
            _ => 0.0,
        }
    }

    /// What to do against it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::RepeatedNode => "write a triangle instead, or remove the element",
            Self::ZeroArea => "remove the element, or move its nodes",
            Self::NotConvex => "move a node, or divide the element into two triangles",
            Self::SameElement => "remove one of them",
            Self::TornMesh => "merge nodes at equal positions in the mesher",
            Self::HangingNode => "divide the neighbour too, so that both use the node",
            Self::OppositeOrientation => "orient the surface",
            Self::UnusedNode => "read only the part with elements",
            Self::AspectRatio { .. } => "refine the mesh in the long direction",
            Self::Warp { .. } => "refine the mesh, or use triangles",
            Self::Branch => "nothing, if surfaces meet there",
        }
    }
}

impl fmt::Display for MeshFaultKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RepeatedNode => formatter.write_str("an element has a node twice"),
            Self::ZeroArea => formatter.write_str("an element has no area"),
            Self::NotConvex => formatter.write_str("a quadrilateral has a corner of 180 degrees or more"),
            Self::SameElement => formatter.write_str("two elements have the same nodes"),
            Self::TornMesh => formatter.write_str("two nodes of the boundary are at the same position"),
            Self::HangingNode => formatter.write_str("a node lies within an edge of an element without it"),
            Self::OppositeOrientation => formatter.write_str("neighbours have opposite normals"),
            Self::UnusedNode => formatter.write_str("no element uses a node"),
            Self::AspectRatio { ratio } => {
                write!(formatter, "an element is {ratio:.3} times as long as wide")
            }
            Self::Warp { degrees } => write!(formatter, "a quadrilateral is warped by {degrees:.1} degrees"),
            Self::Branch => formatter.write_str("more than two elements share an edge"),
        }
    }
}

/// A fault of a surface mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFault {
    /// What is wrong.
    pub kind: MeshFaultKind,
    /// Numbers of the elements in the file.
    pub elements: Vec<u64>,
    /// Numbers of the nodes in the file: of an edge, or those that are wrong.
    pub nodes: Vec<u64>,
    /// Where it is.
    pub position: [f64; 3],
}

impl MeshFault {
    /// The worst fault of each kind of this severity, with the number of that kind.
    pub fn worst_of_kinds(faults: &[Self], severity: Severity) -> Vec<(&Self, usize)> {
        let mut found: Vec<(&Self, usize)> = Vec::new();
        for fault in faults.iter().filter(|fault| fault.severity() == severity) {
            let is_alike = |(own, _): &&mut (&Self, usize)| {
                std::mem::discriminant(&own.kind) == std::mem::discriminant(&fault.kind)
            };
            match found.iter_mut().find(is_alike) {
                Some((worst, count)) => {
                    *count += 1;
                    if fault.kind.size() > worst.kind.size() {
                        *worst = fault;
                    }
                }
                None => found.push((fault, 1)),
            }
        }
        found
    }

    /// How severe it is.
    pub fn severity(&self) -> Severity {
        self.kind.severity()
    }
}

impl fmt::Display for MeshFault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.kind)?;
        for (word, numbers) in [("element", &self.elements), ("node", &self.nodes)] {
            if let [first, others @ ..] = numbers.as_slice() {
                let plural = if others.is_empty() { "" } else { "s" };
                write!(formatter, ", {word}{plural} {first}")?;
                for number in others {
                    write!(formatter, " {number}")?;
                }
            }
        }
        let [x, y, z] = self.position;
        write!(formatter, ", at ({x}, {y}, {z}); {}", self.kind.remedy())
    }
}
