//! References to nodes by name.

/// Which nodes of a shell or solid a reference means.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshPlace {
    /// u and v of a patch, or u, v and w of a block.
    Fractions(Vec<f64>),
    /// A set of nodes.
    Set(String),
}

impl std::fmt::Display for MeshPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fractions(all) => {
                let all: Vec<String> = all.iter().map(ToString::to_string).collect();
                write!(formatter, "@{}", all.join(","))
            }
            Self::Set(set) => write!(formatter, ".{set}"),
        }
    }
}

/// Name of an interface's node in the whole model.
pub fn interface_name(superelement: &str, interface: &str) -> String {
    format!("{superelement}.{interface}")
}

/// A node of the model, by name.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeReference {
    /// The fixed frame.
    Ground,
    /// The reference frame of a body.
    Body(String),
    /// A point mass.
    PointMass(String),
    /// A position along a beam.
    Beam {
        /// Name of the beam.
        beam: String,
        /// Fraction: 0 for its start, 1 for its end.
        fraction: f64,
    },
    /// A node of a shell or solid, or a set of its nodes.
    Mesh {
        /// Name of the shell or solid.
        part: String,
        /// Which of its nodes.
        place: MeshPlace,
    },
    /// An interface of a superelement.
    Interface {
        /// Name of the superelement.
        superelement: String,
        /// Name of the interface within it.
        interface: String,
    },
}
