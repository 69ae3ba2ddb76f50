//! A beam's forces over an interval whose work is exactly the change of its elastic energy.
//!
//! Along H_from exp(τ ψ) the twist is ψ throughout, so the strain changes at the rate B(τ) ψ. With the mean of B
//! at three Gauss points, and what it misses of the change, δ = Δε - B ψ, put back along the relative
//! increments ρ at half way:
//!
//! ```text
//! B̄ = Σ w B(τ) + δ (Wρ)ᵀ / (ρᵀWρ),   B̄ ψ = Δε,   F̄ = B̄ᵀ S,   F̄·ψ = S·Δε   [after Gonzalez 1996, eq. 3.5]
//! ```
//!
//! δ is of seventh order in ψ, rigid motion has ρ = 0, and any stress S does the work S·Δε. With fewer points
//! δ would matter at small steps too, where its round-off, divided by ρ, is worse than what it mends.

use lissom_motion::{
    Motion, Vector6, inverse_tangent_times, inverse_tangent_transpose_times,
    tangent_derivative_transpose_times, tangent_transpose_times,
};

use super::beam::{Beam, combine, relative_coordinates};
use super::interval::{ALONG, Interval, above_round_off};

impl<const N: usize> Beam<N> {
    /// Adds the mean forces over `interval`.
    pub(super) fn add_mean_forces(&self, interval: &Interval<'_>, out: &mut [f64]) {
        let [from, to] = [interval.from, interval.to].map(|at| self.relative(at));
        let mut stresses = Vec::with_capacity(N);
        let mut missed = Vec::with_capacity(N);
        for station in &self.stations {
            let strain = |relative: &[Vector6; N]| {
                station.strain(&combine(&station.shape, relative), &combine(&station.slope, relative))
            };
            let (before, after) = (strain(&from), strain(&to));
            let change = after - before;
            let viscous = station.law.damping * interval.rate();
            stresses.push(
                station.weight
                    * (station.law.stiffness
                        * (0.5 * (before + after) + (interval.dissipation + viscous) * change)),
            );
            missed.push(change);
        }
        for (tau, weight) in ALONG {
            let way = self.on_the_way(interval, tau);
            let mut conjugate = [Vector6::zeros(); N];
            for ((station, stress), missed) in self.stations.iter().zip(&stresses).zip(&mut missed) {
                let d = combine(&station.shape, &way.relative);
                let d_slope = combine(&station.slope, &way.relative);
                *missed -= weight * station.strain_rate(&d, &d_slope, &way.rates);
                let along = tangent_transpose_times(&d, stress);
                let across = tangent_derivative_transpose_times(&d, &d_slope, stress);
                for i in 0..N {
                    conjugate[i] += station.slope[i] * along + station.shape[i] * across;
                }
            }
            let forces: [Vector6; N] = std::array::from_fn(|i| {
                weight * inverse_tangent_transpose_times(&way.relative[i], &conjugate[i])
            });
            self.add_relative_forces(&way.relative, &forces, out);
        }
        self.add_remainder(interval, &stresses, &missed, out);
    }

    /// What the Gauss points missed of the work.
    fn add_remainder(
        &self,
        interval: &Interval<'_>,
        stresses: &[Vector6],
        missed: &[Vector6],
        out: &mut [f64],
    ) {
        let length = self.length();
        // Strains are differences of absolute places.
        let round_off = 64.0 * f64::EPSILON * (1.0 + self.distance(interval) / length);
        let work: f64 = stresses
            .iter()
            .zip(missed)
            .map(|(stress, rest)| {
                let size = weigh(rest, length).dot(rest).sqrt();
                above_round_off(size, round_off) * stress.dot(rest)
            })
            .sum();
        let way = self.on_the_way(interval, 0.5);
        let weighted = way.seen.map(|rho| weigh(&rho, length));
        let square: f64 = way.seen.iter().zip(&weighted).map(|(rho, weight)| rho.dot(weight)).sum();
        if square > 0.0 && work != 0.0 {
            self.add_relative_forces(&way.relative, &weighted.map(|weight| work / square * weight), out);
        }
    }

    /// Relative coordinates, relative increments ρ_i = ψ_i - Ad(exp(-d_i)) ψ_r and rates of the coordinates
    /// on the way.
    fn on_the_way(&self, interval: &Interval<'_>, tau: f64) -> Way<N> {
        let relative = relative_coordinates(&std::array::from_fn(|i| {
            let frame = interval.frame(self.nodes[i], tau);
            self.offsets[i].as_ref().map_or(frame, |offset| frame * *offset)
        }));
        let in_section: [Vector6; N] = std::array::from_fn(|i| {
            let psi = interval.increments[self.nodes[i]];
            self.offsets[i].as_ref().map_or(psi, |offset| offset.adjoint_inverse_times(&psi))
        });
        let reference = in_section[Self::REFERENCE];
        let seen = std::array::from_fn(|i| {
            if i == Self::REFERENCE {
                Vector6::zeros()
            } else {
                in_section[i] - Motion::exponential(&relative[i]).adjoint_inverse_times(&reference)
            }
        });
        let rates = std::array::from_fn(|i| inverse_tangent_times(&relative[i], &seen[i]));
        Way { relative, seen, rates }
    }

    /// How far the element is from the origin [m].
    fn distance(&self, interval: &Interval<'_>) -> f64 {
        interval.from.nodes[self.nodes[Self::REFERENCE]].frame.position.norm()
    }
}

/// A beam element on its way through an interval.
struct Way<const N: usize> {
    relative: [Vector6; N],
    seen: [Vector6; N],
    rates: [Vector6; N],
}

/// Rotations weighed with the element's length, so that the sum has one unit.
fn weigh(rho: &Vector6, length: f64) -> Vector6 {
    let mut weighted = *rho;
    for k in 3..6 {
        weighted[k] *= length * length;
    }
    weighted
}
