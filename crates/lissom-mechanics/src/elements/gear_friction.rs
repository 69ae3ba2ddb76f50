//! Friction of a gear in proportion to the force between its teeth, by the bristle of [dry friction](super::friction).
//!
//! Legend: v rate of the independent coordinate, m moment or force of the teeth on it, μ multiplier of the gear, z deflection of the
//! bristle (a first-order state), z_c that at which it slips, σ its damping, η efficiency.
//!
//! ```text
//! z' = v - |v| z/z_c,      F = (1/η - 1) |m| z/z_c + σ z',      m ∝ μ
//! ```
//!
//! Where it slides the share η of the power arrives if the independent coordinate drives, and 2 - 1/η if the other one does: below
//! η = 1/2 none, the gear locks.

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::{Bristle, Capabilities, Element, Load, Tangents, Unknowns};
use crate::kinematics::{CoordinateId, Kinematics};

/// Path of the first step over the deflection at slip beyond which a bristle begins in its steady state: with an undeflected one, normal
/// forces at the start that depend on its rate may have no solution.
const SUDDEN_START: f64 = 1.0;

/// Friction of a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct GearFriction {
    /// The independent coordinate, then the bristle's deflection.
    coordinates: [CoordinateId; 2],
    multipliers: [usize; 1],
    /// (1/η - 1) |m/μ|.
    factor: f64,
    /// z_c [rad, m].
    deflection: f64,
    /// σ [N m s/rad, N s/m].
    damping: f64,
}

impl GearFriction {
    /// Friction of a gear with this efficiency, deflection and damping, and the multiplier of this index; `moment` is that on the
    /// independent coordinate per unit of the multiplier.
    pub fn contribution(
        model: &InitialModel,
        coordinate: CoordinateId,
        (multiplier, moment): (usize, f64),
        [efficiency, deflection, damping]: [f64; 3],
    ) -> Contribution {
        let name = format!("{}, friction of a gear", model.coordinate_name(coordinate));
        let mut contribution = Contribution::to(model);
        let bristle = contribution.add_state(name, 0.0, deflection);
        let factor = (1.0 / efficiency - 1.0) * moment.abs();
        let coordinates = [coordinate, bristle];
        let own = Self { coordinates, multipliers: [multiplier], factor, deflection, damping };
        contribution.with(own)
    }

    fn multiplier(&self, at: &Kinematics) -> f64 {
        at.multipliers.get(self.multipliers[0]).copied().unwrap_or(0.0)
    }
}

impl Element for GearFriction {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { coordinates: &self.coordinates, multipliers: &self.multipliers, ..Unknowns::default() }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let [own, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let bent = bristle.value / self.deflection;
        out[0] += self.factor * self.multiplier(at).abs() * bent + self.damping * bristle.rate;
        out[1] += bristle.rate - own.rate + own.rate.abs() * bent;
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let [own, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let (bent, multiplier) = (bristle.value / self.deflection, self.multiplier(at));
        let sign = |value: f64| if value == 0.0 { 0.0 } else { value.signum() };
        let size = out.size();
        out.stiffness[1] += self.factor * multiplier.abs() / self.deflection;
        out.stiffness[size + 1] += own.rate.abs() / self.deflection;
        out.damping[1] += self.damping;
        out.damping[size] += sign(own.rate) * bent - 1.0;
        out.damping[size + 1] += 1.0;
        out.add_by_multiplier(&[self.factor * sign(multiplier) * bent, 0.0]);
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), bristle: Some(self), ..Capabilities::default() }
    }
}

impl Bristle for GearFriction {
    fn steady_at_start(&self, at: &Kinematics, size: f64) -> Option<(CoordinateId, f64)> {
        let [coordinate, bristle] = self.coordinates.map(|coordinate| at.coordinates[coordinate]);
        let is_sudden = bristle.value == 0.0 && size * coordinate.rate.abs() > SUDDEN_START * self.deflection;
        is_sudden.then_some((self.coordinates[1], self.deflection * coordinate.rate.signum()))
    }

    /// The force follows from multipliers, which are known at stages alone.
    fn unresolved_work(&self, _from: &Kinematics, _to: &Kinematics) -> Option<f64> {
        None
    }
}

impl Load for GearFriction {}
