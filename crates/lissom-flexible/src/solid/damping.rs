//! Damping of a solid element: stresses in proportion to the rates of its strains, as of its law at small strains.
//!
//! Legend: τ time of damping, C elasticity with K₀, q_I = F⁻ᵀ G_I, g_I = Σ w J q_I derivative of the volume by the position of node I,
//! L = Σ v_I q_Iᵀ, other symbols as in `law` and in the module above.
//!
//! ```text
//! f_I = Σ w F S G_I + m g_I,      S = τ C Ė,   Ė = sym Fᵀ Ḟ,      m = τ (K - K₀)/V₀ Σ v_J·g_J
//!
//! by velocities   Σ w F (τ C sym Fᵀ(e_k ⊗ G_J)) G_I  +  τ (K - K₀)/V₀ g_I g_J·e_k
//! by positions    Σ w (e_k ⊗ G_J) S G_I + F (τ C sym (e_k ⊗ G_J)ᵀ Ḟ) G_I
//!                 + τ (K - K₀)/V₀ g_I h_J·e_k + m Σ w J (q_I q_J - q_J q_I)·e_k,      h_J = Σ w J (tr L q_J - Lᵀ q_J)
//! ```
//!
//! Rigid rotations have no rates of strain, and the power of the forces is never negative.

use lissom_motion::{Matrix3, Vector3};

use super::deformation::Deformation;
use super::stage_forces::strain_change;
use super::{Deformed, Solid};
use lissom_mechanics::elements::{Element, Tangents, Unknowns, add_block};
use lissom_mechanics::kinematics::Kinematics;

/// The damping of a solid element.
#[derive(Clone, Debug)]
pub struct SolidDamping<const NODES: usize, const POINTS: usize> {
    solid: Solid<NODES, POINTS>,
    /// Stresses over rates of stresses [s].
    time: f64,
}

/// The state of an element in motion.
struct Moving<const NODES: usize, const POINTS: usize> {
    points: [Deformation; POINTS],
    velocities: [Vector3; NODES],
    /// Ḟ.
    rates: [Matrix3; POINTS],
    /// g_I.
    volume_slopes: [Vector3; NODES],
    /// m [Pa].
    mean: f64,
}

impl<const NODES: usize, const POINTS: usize> SolidDamping<NODES, POINTS> {
    /// Damping of `solid` in proportion to its stiffness, by `time` [s].
    pub fn new(solid: Solid<NODES, POINTS>, time: f64) -> Self {
        Self { solid, time }
    }

    fn moving(&self, at: &Kinematics) -> Moving<NODES, POINTS> {
        let (velocities, reference) = (self.solid.velocities_at_nodes(at), &self.solid.reference);
        let Deformed { points, .. } = self.solid.deformed(at);
        let rates = reference
            .gradients
            .each_ref()
            .map(|slopes| velocities.iter().zip(slopes).map(|(v, slope)| v * slope.transpose()).sum());
        let volume_slopes = self.solid.volume_slopes(&points);
        let rate: f64 = velocities.iter().zip(&volume_slopes).map(|(v, slope)| v.dot(slope)).sum();
        Moving { points, velocities, rates, volume_slopes, mean: self.bulk() * rate }
    }

    /// τ (K - K₀)/V₀.
    fn bulk(&self) -> f64 {
        self.time * self.solid.law.bulk_of_mean() / self.solid.reference.volume
    }

    /// τ C Ė.
    fn stress(&self, gradient: &Matrix3, rate: &Matrix3) -> Matrix3 {
        self.time * self.solid.law.small_stress(&strain_change(gradient, rate))
    }
}

impl<const NODES: usize, const POINTS: usize> Element for SolidDamping<NODES, POINTS> {
    fn unknowns(&self) -> Unknowns<'_> {
        self.solid.unknowns()
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let moving = self.moving(at);
        let points = moving.points.iter().zip(&moving.rates);
        let stresses = points.map(|(at, rate)| at.gradient * self.stress(&at.gradient, rate));
        self.solid.add_forces(stresses, out);
        for (slope, out) in moving.volume_slopes.iter().zip(out.chunks_exact_mut(6)) {
            out.iter_mut().zip(&(moving.mean * slope)).for_each(|(sum, value)| *sum += value);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let Moving { points, velocities, rates, volume_slopes, mean } = self.moving(at);
        let (reference, size) = (&self.solid.reference, 6 * NODES);
        let mut by_positions = [Vector3::zeros(); NODES];
        for ((point, rate), (slopes, volume)) in
            points.iter().zip(&rates).zip(reference.gradients.iter().zip(&reference.volumes))
        {
            let gradient = &point.gradient;
            let stress = self.stress(gradient, rate);
            let turned = slopes.map(|slope| point.inverse_transpose * slope);
            let own: Matrix3 = velocities.iter().zip(&turned).map(|(v, q)| v * q.transpose()).sum();
            let weight = volume * point.determinant;
            // Derivatives of the stress by the entries of Ḟ and of F, of which those by G are combinations.
            let moduli: [[[Matrix3; 2]; 3]; 3] = std::array::from_fn(|k| {
                std::array::from_fn(|along| {
                    let change = Vector3::ith(k, *volume) * Vector3::ith(along, 1.0).transpose();
                    let by_position = change * stress + gradient * self.stress(&change, rate);
                    [gradient * self.stress(gradient, &change), by_position]
                })
            });
            for (j, slope) in slopes.iter().enumerate() {
                by_positions[j] += weight * (own.trace() * turned[j] - own.tr_mul(&turned[j]));
                for (k, [x, y, z]) in moduli.iter().enumerate() {
                    let [by_velocity, by_position] =
                        [0, 1].map(|by| x[by] * slope.x + y[by] * slope.y + z[by] * slope.z);
                    for (i, other) in slopes.iter().enumerate() {
                        let [damping, stiffness] = [by_velocity * other, by_position * other];
                        for row in 0..3 {
                            let entry = (6 * i + row) * size + 6 * j + k;
                            out.damping[entry] += damping[row];
                            out.stiffness[entry] += stiffness[row];
                        }
                    }
                }
                for (i, other) in turned.iter().enumerate().filter(|_| mean != 0.0) {
                    let block =
                        mean * weight * (other * turned[j].transpose() - turned[j] * other.transpose());
                    add_block(&mut out.stiffness, size, (6 * i, 6 * j), &block);
                }
            }
        }
        let bulk = self.bulk();
        for i in (0..NODES).filter(|_| bulk != 0.0) {
            for j in 0..NODES {
                let own = bulk * volume_slopes[i];
                add_block(&mut out.damping, size, (6 * i, 6 * j), &(own * volume_slopes[j].transpose()));
                add_block(&mut out.stiffness, size, (6 * i, 6 * j), &(own * by_positions[j].transpose()));
            }
        }
    }
}
