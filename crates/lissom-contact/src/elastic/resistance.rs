//! Resistance of a contact to rolling and to spinning: a moment per normal force, by bristles that deflect by angles.
//!
//! Legend: ω relative angular velocity and z deflection of the bristles in the axes of the base, n normal, ρ and σ lever arms for rolling
//! and spinning, h force of the bristles, see `contact`, with |h| = 1 where they slip; N normal force.
//!
//! ```text
//! M = -N K h(z, ω),      K = ρ (I - n nᵀ) + σ n nᵀ,      δK h = (σ - ρ) (δn (n·h) + n (h·δn))
//! ```

use crate::law::Coulomb;
use lissom_motion::{Matrix3, Vector3};

use crate::elastic::ContactFriction;
use lissom_mechanics::elements::Contribution;

/// Rotation before the moments against rolling and spinning are full [rad].
const YIELD_ANGLE: f64 = 1e-4;
/// Angular velocity above which their damping saturates [rad/s].
const YIELD_RATE: f64 = 0.1;

/// Resistance to rolling and spinning.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactResistance {
    /// Bristles that deflect by angles, with coefficients of one.
    pub bristles: ContactFriction,
    /// Lever arm of the normal force against rolling, ρ [m].
    pub rolling: f64,
    /// Lever arm against spinning about the normal, σ [m].
    pub spinning: f64,
}

/// Moment per normal force on the tip, and its derivatives.
pub(super) struct Moment {
    pub(super) value: Vector3,
    pub(super) by_spin: Matrix3,
    pub(super) by_bristles: Matrix3,
    pub(super) by_normal: Matrix3,
}

impl ContactResistance {
    /// With these lever arms [m]; none where both are zero. Its bristles are states of the contribution.
    pub fn new([rolling, spinning]: [f64; 2], name: &str, contribution: &mut Contribution) -> Option<Self> {
        if rolling == 0.0 && spinning == 0.0 {
            return None;
        }
        let bristles = ContactFriction {
            bristles: Vec::new(),
            law: Coulomb { sliding: 1.0, at_rest: 1.0, stribeck: YIELD_RATE },
            deflection: YIELD_ANGLE,
        };
        let bristles = bristles.with_bristles(&format!("{name}, rotation"), contribution);
        Some(Self { bristles, rolling, spinning })
    }

    pub(super) fn moment(&self, deflection: &Vector3, spin: &Vector3, normal: &Vector3) -> Moment {
        // No direction is left out.
        let share = self.bristles.share(deflection, spin, &Vector3::zeros());
        let difference = self.spinning - self.rolling;
        let levers = Matrix3::identity() * self.rolling + difference * normal * normal.transpose();
        Moment {
            value: -levers * share.force,
            by_spin: -levers * share.by_sliding,
            by_bristles: -levers * share.by_bristles,
            by_normal: -difference
                * (normal.dot(&share.force) * Matrix3::identity() + normal * share.force.transpose()),
        }
    }

    /// Upper bound of the energy of the bristles per normal force [m].
    pub(super) fn deflected(&self, deflection: &Vector3) -> f64 {
        0.5 * self.stiffness() * deflection.norm_squared()
    }

    /// Second derivative of the energy with respect to the deflection.
    pub(super) fn stiffness(&self) -> f64 {
        self.rolling.max(self.spinning) / self.bristles.deflection
    }
}
