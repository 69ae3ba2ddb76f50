//! What an impact dissipates.
//!
//! Legend: e restitution, v velocity at which the touch began, a dissipation factor [s/m].

/// Dissipation of a touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Impact {
    /// The factor a of the law of Hunt and Crossley [s/m].
    Dissipation(f64),
    /// A restitution.
    Restitution {
        /// e.
        coefficient: f64,
        /// The product a v.
        relative: f64,
        /// Slower impacts dissipate as those of this velocity, or do not rebound [m/s].
        rest_velocity: f64,
    },
}

impl Impact {
    /// a for a touch that began at `velocity` [m/s]; of a restitution the product with this velocity may be limited.
    pub fn factor(&self, velocity: f64, most: Option<f64>) -> f64 {
        match *self {
            Self::Dissipation(factor) => factor,
            Self::Restitution { relative, rest_velocity, .. } => {
                most.map_or(relative, |most| relative.min(most)) / velocity.max(rest_velocity)
            }
        }
    }

    /// Velocity of slow impacts, which do not rebound [m/s]; none without restitution.
    pub fn rest_velocity(&self) -> Option<f64> {
        match *self {
            Self::Dissipation(_) => None,
            Self::Restitution { rest_velocity, .. } => Some(rest_velocity),
        }
    }
}
