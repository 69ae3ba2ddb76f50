//! References to nodes by name.

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
    /// An interface of a superelement.
    Interface {
        /// Name of the superelement.
        superelement: String,
        /// Name of the interface within it.
        interface: String,
    },
}
