//! Laws of a touch that do not depend on how it is solved: what an impact dissipates, and dry friction.
//!
//! Legend: e restitution, v velocity at which the touch began, a dissipation factor [s/m]; s sliding velocity.

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

/// Dry friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb {
    /// Coefficient of sliding friction, μ.
    pub sliding: f64,
    /// Coefficient of friction at rest, μ_s.
    pub at_rest: f64,
    /// Sliding velocity at which the difference has fallen to 1/e, v_s [m/s].
    pub stribeck: f64,
}

impl Coulomb {
    /// (μ_s - μ) exp(-(s/v_s)²) by the square of s [m²/s²].
    pub(crate) fn excess(&self, squared: f64) -> f64 {
        (self.at_rest - self.sliding) * (-(squared / (self.stribeck * self.stribeck))).exp()
    }

    /// μ + (μ_s - μ) exp(-(s/v_s)²) at the sliding velocity s [m/s].
    pub fn coefficient(&self, velocity: f64) -> f64 {
        if self.at_rest == self.sliding {
            return self.sliding;
        }
        self.sliding + self.excess(velocity * velocity)
    }
}
