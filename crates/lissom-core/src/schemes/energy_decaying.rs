//! Energy-decaying scheme: time-discontinuous, with a jump at the start of each step [Bauchau and Theron
//! 1996; Bauchau and Bottasso 1999; Bauchau, Bottasso and Trainelli 2003].
//!
//! Legend: i end of the last step, j after the jump, f end of this one; k jump i-j, g glide j-f; d increments
//! and v rates (unit step), F mean forces, F* with the dissipative part α/2:
//!
//! ```text
//! v_g = d_k + d_g,   d_k = -⅓ (v_g - v_k*),   v_k* = v_k + (α/2)(v_j - v_i)
//! M (v_f - v_i) = -F_g,   M (v_j - v_i) = ⅓ (F_g - F_k*)
//! ```
//!
//! so that the energy changes by -(α/2) [(v_j - v_i)ᵀ M (v_j - v_i) + F_d·d_k] ≤ 0 in a step. The proof, also
//! for frames that turn and for constraints, stands in `docs/theory/energy-decaying.md`.

use super::{Combination, Coupling, Increments, Scheme, SchemeError, SchemeKind, Stage, within};

/// Registry entry.
pub const KIND: SchemeKind = SchemeKind {
    name: "energy-decaying",
    summary: "Energy decaying: second order, energy never increases, damping set by the spectral radius.",
    build: |parameters| with_spectral_radius(parameters.spectral_radius.unwrap_or(0.0)),
};

/// The scheme with spectral radius `rho` at infinite frequency: 1 preserves energy, 0 annihilates.
///
/// # Errors
/// If `rho` is outside 0 … 1.
pub fn with_spectral_radius(rho: f64) -> Result<Scheme, SchemeError> {
    let rho = within("spectral_radius", rho, (0.0, 1.0))?;
    let alpha = (1.0 - rho) / (1.0 + rho);
    let end = Stage {
        abscissa: 1.0,
        rate: Combination::default(),
        curvature: Combination::default(),
        prediction: Combination { rate: 1.0, curvature: 0.5, ..Combination::default() },
    };
    Ok(Scheme {
        name: format!("energy-decaying (spectral radius {rho})"),
        stages: vec![end],
        algorithmic: Combination::default(),
        increments: Increments::FromStart,
        coupling: Coupling::Jump(TimeDiscontinuous { alpha }),
        memory_delay: 0.0,
        dynamic: true,
    })
}

/// The scheme's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeDiscontinuous {
    /// Dissipation α, 0 … 1.
    pub alpha: f64,
}

/// Derivatives of the rates after the jump and at the end, with respect to jump and glide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateWeights {
    /// ∂v_j/∂(d_k, d_g).
    pub after: [f64; 2],
    /// ∂v_f/∂(d_k, d_g).
    pub end: [f64; 2],
}

impl TimeDiscontinuous {
    /// Rates after the jump and at the end.
    pub fn rates(&self, jump: f64, glide: f64, start: f64) -> (f64, f64) {
        let after = (8.0 * jump + 2.0 * glide - (1.0 - self.alpha) * start) / (1.0 + self.alpha);
        (after, 2.0 * (jump + glide) - after)
    }

    /// Derivatives of [`Self::rates`].
    pub fn weights(&self) -> RateWeights {
        let after = [8.0, 2.0].map(|weight| weight / (1.0 + self.alpha));
        RateWeights { after, end: after.map(|weight| 2.0 - weight) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear oscillator with unit mass and stiffness k: amplification over a step.
    fn amplification(alpha: f64, k: f64) -> f64 {
        let scheme = TimeDiscontinuous { alpha };
        let step = |u: f64, v: f64| {
            // Residuals are linear in (d_k, d_g): solve 2 x 2 by evaluating them.
            let residual = |x: f64, y: f64| {
                let (vj, vf) = scheme.rates(x, y, v);
                let (uj, uf) = (u + x, u + x + y);
                let glide = k * 0.5 * (uj + uf);
                let jump = k * (0.5 * (u + uj) + 0.5 * alpha * (uj - u));
                [vj - v - (glide - jump) / 3.0, vf - v + glide]
            };
            let zero = residual(0.0, 0.0);
            let [a, b] = [residual(1.0, 0.0), residual(0.0, 1.0)];
            let m = [[a[0] - zero[0], b[0] - zero[0]], [a[1] - zero[1], b[1] - zero[1]]];
            let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
            let x = (-zero[0] * m[1][1] + zero[1] * m[0][1]) / det;
            let y = (-zero[1] * m[0][0] + zero[0] * m[1][0]) / det;
            let (_, vf) = scheme.rates(x, y, v);
            (u + x + y, vf)
        };
        // Spectral radius by the power method on (u √k, v).
        let (mut u, mut v) = (1.0 / k.sqrt(), 0.3);
        let mut ratio = 0.0;
        for _ in 0..200 {
            let before = (k * u * u + v * v).sqrt();
            (u, v) = step(u / before, v / before);
            ratio = (k * u * u + v * v).sqrt();
        }
        ratio
    }

    #[test]
    fn spectral_radius_is_one_when_preserving_and_vanishes_when_annihilating() {
        for k in [1e-2, 1.0, 1e2, 1e6] {
            assert!((amplification(0.0, k) - 1.0).abs() < 1e-9, "{k}");
        }
        assert!(amplification(1.0, 1e8) < 1e-3);
        assert!((amplification(0.2, 1e10) - (1.0 - 0.2) / (1.0 + 0.2)).abs() < 1e-2);
        assert!(amplification(1.0, 1e-2) > 0.999_9);
    }
}
