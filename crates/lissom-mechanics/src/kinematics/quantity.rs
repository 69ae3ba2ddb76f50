//! Quantity of a coordinate or an equation.

/// Quantity of an equation or of a coordinate of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// [m]
    Length,
    /// [rad]
    Angle,
    /// A first-order state, in units of its own.
    State,
}

impl Quantity {
    /// Name of a joint's relative coordinate of this quantity.
    pub fn relative(self) -> &'static str {
        match self {
            Self::Length => "displacement",
            Self::Angle => "rotation",
            Self::State => "state",
        }
    }
}
