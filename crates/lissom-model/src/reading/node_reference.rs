//! References to nodes by name.

/// Which nodes of a shell a reference means.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellPlace {
    /// u and v of a patch.
    Fractions([f64; 2]),
    /// A set of nodes.
    Set(String),
}

impl std::fmt::Display for ShellPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fractions([u, v]) => write!(formatter, "@{u},{v}"),
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
    /// A node of a shell, or a set of its nodes.
    Shell {
        /// Name of the shell.
        shell: String,
        /// Which of its nodes.
        place: ShellPlace,
    },
    /// An interface of a superelement.
    Interface {
        /// Name of the superelement.
        superelement: String,
        /// Name of the interface within it.
        interface: String,
    },
}
