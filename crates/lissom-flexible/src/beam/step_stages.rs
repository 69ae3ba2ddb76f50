//! A beam's forces at the stages of a step, with strains integrated from their rates. See `kinematics::step_stages` for the
//! formulas; σ_j are the twists of the nodes relative to the reference node.

use lissom_motion::{
    Motion, Vector6, inverse_tangent_times, inverse_tangent_transpose_times,
    tangent_derivative_transpose_times, tangent_rate_times, tangent_times, tangent_transpose_times,
};

use super::{Beam, Relative, Station, combine};
use lissom_mechanics::kinematics::Kinematics;
use lissom_mechanics::kinematics::step_stages::{SMALL_CHANGE, STAGES, StepStages, above_round_off, weigh};
use lissom_mechanics::round_off;

/// Two Gauss points on 0 … 1.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// A beam element at a stage.
pub(super) struct Visit<const N: usize> {
    relative: Relative<N>,
    /// W σ.
    pub(super) weighted: Relative<N>,
    /// σ·W σ.
    pub(super) square: f64,
    /// ḋ.
    rates: Relative<N>,
    /// Forces conjugate to d.
    conjugate: Relative<N>,
    /// Work of the stresses over the remainders.
    work: f64,
}

/// Strains of a station at the stages, with the term of damping, and the error of their rates.
pub(super) struct Strains {
    pub(super) stressing: [Vector6; STAGES],
    pub(super) missed: Vector6,
}

impl<const N: usize> Beam<N> {
    /// Adds the forces at the stages of `step`.
    pub(super) fn add_stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let mut visits = step.stages.map(|at| self.visit(at));
        let inverse = self.integrate(step, &mut visits, |visits, station, strains| {
            for (visit, strain) in visits.iter_mut().zip(&strains.stressing) {
                let stress = station.weight * (station.law.stiffness * strain);
                visit.work += stress.dot(&strains.missed);
                let d = combine(&station.shape, &visit.relative);
                let d_slope = combine(&station.slope, &visit.relative);
                let along = tangent_transpose_times(&d, &stress);
                let across = tangent_derivative_transpose_times(&d, &d_slope, &stress);
                for i in 0..N {
                    visit.conjugate[i] += station.slope[i] * along + station.shape[i] * across;
                }
            }
        });
        for (visit, out) in visits.iter().zip(out) {
            let forces: Relative<N> = std::array::from_fn(|i| {
                if i == Self::REFERENCE {
                    Vector6::zeros()
                } else {
                    inverse_tangent_transpose_times(&visit.relative[i], &visit.conjugate[i])
                        + visit.work * inverse * visit.weighted[i]
                }
            });
            let motions = visit.relative.map(|d| Motion::exponential(&d));
            self.add_relative_forces(&motions, &forces, out);
        }
    }

    pub(super) fn visit(&self, at: &Kinematics) -> Visit<N> {
        let length = self.length();
        let relative = self.relative(at);
        let seen = self.relative_twists(at, &relative);
        let weighted = seen.map(|twist| weigh(&twist, length));
        Visit {
            relative,
            square: seen.iter().zip(&weighted).map(|(twist, weight)| twist.dot(weight)).sum(),
            weighted,
            rates: std::array::from_fn(|i| inverse_tangent_times(&relative[i], &seen[i])),
            conjugate: [Vector6::zeros(); N],
            work: 0.0,
        }
    }

    /// Integrates the strains of every station and passes them to `each`. Returns 1/Q.
    pub(super) fn integrate(
        &self,
        step: &StepStages<'_>,
        visits: &mut [Visit<N>; STAGES],
        mut each: impl FnMut(&mut [Visit<N>; STAGES], &Station<N>, &Strains),
    ) -> f64 {
        let length = self.length();
        let [from, to] = [step.start, step.end].map(|at| self.relative(at));
        let (inverse, shares) = step.shares([visits[0].square, visits[1].square]);
        let moved = self.coordinate_changes(step, &from, &to);
        let round_off = round_off::RIGID_MOTION * self.way(step) / length;
        for station in &self.stations {
            let strain = |relative: &Relative<N>| {
                station.strain(&combine(&station.shape, relative), &combine(&station.slope, relative))
            };
            let begin = strain(&from);
            let mut rates: [Vector6; STAGES] = std::array::from_fn(|i| {
                let relative = &visits[i].relative;
                let (d, d_slope) = (combine(&station.shape, relative), combine(&station.slope, relative));
                station.strain_rate(&d, &d_slope, &visits[i].rates)
            });
            let change = match &moved {
                Some(changes) => station.strain_change(&from, changes),
                None => strain(&to) - begin,
            };
            let mut missed = change - step.whole(rates);
            missed *= above_round_off(weigh(&missed, length).dot(&missed).sqrt(), round_off);
            for (rate, share) in rates.iter_mut().zip(shares) {
                *rate += share * missed;
            }
            let strains = step.at_stages(begin, rates);
            let stressing = std::array::from_fn(|i| strains[i] + station.law.damping * rates[i]);
            each(visits, station, &Strains { stressing, missed });
        }
        inverse
    }

    /// Changes of the relative coordinates over a step without cancellation, or none if they are so large that their
    /// difference is accurate enough. With η the relative motion, exp(d + Δd) = exp d exp η, they are the integral of
    /// d' = T(d)⁻¹ η, by one step of the classical Runge-Kutta method.
    fn coordinate_changes(
        &self,
        step: &StepStages<'_>,
        from: &Relative<N>,
        to: &Relative<N>,
    ) -> Option<Relative<N>> {
        let length = self.length();
        let is_small = |i: usize| {
            let change = to[i] - from[i];
            change.fixed_rows::<3>(0).norm() < SMALL_CHANGE * length
                && change.fixed_rows::<3>(3).norm() < SMALL_CHANGE
        };
        if !(0..N).all(is_small) {
            return None;
        }
        let section = |i: usize| {
            let change = step.changes[self.nodes[i]];
            self.offsets[i].as_ref().map_or(change, |offset| change.carried_at(offset))
        };
        let base = section(Self::REFERENCE);
        Some(std::array::from_fn(|i| {
            if i == Self::REFERENCE {
                return Vector6::zeros();
            }
            let seen = base.carried_at(&Motion::exponential(&from[i]));
            let eta = section(i).relative_to(&seen).small_logarithm();
            let slope = |way: Vector6| inverse_tangent_times(&(from[i] + way), &eta);
            let first = slope(Vector6::zeros());
            let second = slope(0.5 * first);
            let third = slope(0.5 * second);
            let fourth = slope(third);
            (first + 2.0 * (second + third) + fourth) / 6.0
        }))
    }

    /// Largest displacement of the element's nodes over a step, in both directions [m].
    fn way(&self, step: &StepStages<'_>) -> f64 {
        let length = self.length();
        let mut way = 0.0_f64;
        for (at, lasting) in step.stages.iter().zip(step.lasting) {
            for &node in &self.nodes {
                let twist = &at.nodes[node].twist;
                way = way.max(lasting.abs() * weigh(twist, length).dot(twist).sqrt());
            }
        }
        way
    }
}

impl<const N: usize> Station<N> {
    /// T(d + Δd)(d' + Δd') - T(d) d' for small changes, without cancellation.
    fn strain_change(&self, from: &Relative<N>, changes: &Relative<N>) -> Vector6 {
        let (d, d_slope) = (combine(&self.shape, from), combine(&self.slope, from));
        let change = combine(&self.shape, changes);
        let turned: Vector6 =
            GAUSS.iter().map(|&tau| 0.5 * tangent_rate_times(&(d + tau * change), &change, &d_slope)).sum();
        tangent_times(&(d + change), &combine(&self.slope, changes)) + turned
    }
}
