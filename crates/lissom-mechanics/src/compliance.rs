//! The normal force of a compliant contact, by the law of Hunt and Crossley [1975].
//!
//! Legend: δ penetration, k stiffness, n exponent, a dissipation factor, c damping, e restitution, v velocity of impact.
//!
//! ```text
//! f = max(0, k δⁿ max(0, 1 + a δ̇) + c δ̇),      P = k δⁿ⁺¹/(n + 1)
//! A (1 + e) = ln((1 + A)/(1 - e A)),      a = A/v
//! ```
//!
//! The second line is exact for a body that meets the contact at v under no other force: m δ̇ dδ̇/(1 + a δ̇) = -k δⁿ dδ over
//! the whole contact, for any m, k and n, and c = 0. The force never pulls. Without damping it is continuous at touch, with damping it
//! jumps there by c δ̇.

/// Smallest restitution of a contact.
pub const MIN_RESTITUTION: f64 = 0.01;

/// Force over penetration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    /// k [N/mⁿ or N m/radⁿ].
    pub stiffness: f64,
    /// n, at least 1.
    pub exponent: f64,
}

impl Compliance {
    /// Compliance of two balls, or of a ball on a plane, by the theory of Hertz: from the sum of the curvatures [1/m], and from Young's
    /// modulus [Pa] and Poisson's ratio of both materials.
    ///
    /// ```text
    /// k = 4/3 E √R,      1/E = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂,      1/R = 1/R₁ + 1/R₂
    /// ```
    pub fn hertz(curvature: f64, materials: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let compliance: f64 = materials.into_iter().map(|[young, nu]| (1.0 - nu * nu) / young).sum();
        Self { stiffness: 4.0 / 3.0 / compliance / f64::sqrt(curvature), exponent: 1.5 }
    }

    /// Stiffness of a linear force; zero of others [N/m].
    pub fn linear_stiffness(&self) -> f64 {
        if self.exponent == 1.0 { self.stiffness } else { 0.0 }
    }

    /// Force at a penetration and its rate with the factor a, and its derivatives with respect to both.
    pub fn force(&self, depth: f64, rate: f64, dissipation: f64) -> [f64; 3] {
        let factor = 1.0 + dissipation * rate;
        if factor <= 0.0 {
            return [0.0; 3];
        }
        let (elastic, slope) = if self.exponent == 1.0 {
            (self.stiffness * depth, self.stiffness)
        } else {
            let depth = depth.max(0.0);
            let slope = self.stiffness * self.exponent * depth.powf(self.exponent - 1.0);
            (self.stiffness * depth.powf(self.exponent), slope)
        };
        [elastic * factor, slope * factor, elastic * dissipation]
    }

    /// Force with a damping c and its derivatives: the sum never pulls.
    pub fn damped_force(&self, depth: f64, rate: f64, [dissipation, damping]: [f64; 2]) -> [f64; 3] {
        let [force, stiffness, slope] = self.force(depth, rate, dissipation);
        if damping == 0.0 {
            return [force, stiffness, slope];
        }
        let sum = force + damping * rate;
        if sum > 0.0 { [sum, stiffness, slope + damping] } else { [0.0; 3] }
    }

    /// Duration of the touch of a mass [kg] that arrives at a velocity [m/s], from the stiffness k δⁿ⁻¹ at its largest penetration: exact
    /// for a linear force [s].
    pub fn duration(&self, mass: f64, velocity: f64) -> f64 {
        let n = self.exponent;
        let deepest = (0.5 * (n + 1.0) * mass * velocity * velocity / self.stiffness).powf(1.0 / (n + 1.0));
        std::f64::consts::PI * (mass / (self.stiffness * deepest.powf(n - 1.0))).sqrt()
    }

    /// Energy at a penetration.
    pub fn energy(&self, depth: f64) -> f64 {
        self.stiffness * self.continued(depth).powf(self.exponent + 1.0) / (self.exponent + 1.0)
    }

    /// A contact that lasts until the end of a step may end within it: its force is continued along a straight line, if it is
    /// linear.
    fn continued(&self, depth: f64) -> f64 {
        if self.exponent == 1.0 { depth } else { depth.max(0.0) }
    }
}

/// A of a restitution e, by bisection between 0 and 1/e: A (1 + e) is below the logarithm only near 1/e.
pub fn relative_dissipation(restitution: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let is_below = |a: f64| a * (1.0 + restitution) > (a.ln_1p() - (-restitution * a).ln_1p());
    let (mut low, mut high) = (0.0, 1.0 / restitution);
    // To the last digit of a value up to 100.
    for _ in 0..70 {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
#[path = "../tests/unit/compliance.rs"]
mod tests;
