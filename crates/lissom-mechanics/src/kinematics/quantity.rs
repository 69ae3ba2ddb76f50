//! What a coordinate or an equation measures.

/// What an equation or a coordinate of a joint is.
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
    /// What a joint's relative coordinate of this quantity is called.
    pub fn relative(self) -> &'static str {
        match self {
            Self::Length => "displacement",
            Self::Angle => "rotation",
            Self::State => "state",
        }
    }
}
