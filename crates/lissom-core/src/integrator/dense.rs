//! Dense output: values within a step. For collocation schemes it follows from the stages, to the order of the scheme
//! (`schemes/dense_polynomial.rs`). For other schemes poses are interpolated by a cubic Hermite polynomial of poses and twists:
//!
//! ```text
//! stages:  H(x) = H₀ exp(x h V₀) exp D(x),      D(x), q', q'' linear combinations of the increments
//! cubic:   H(x) = H₀ exp ψ(x),   ψ(0) = 0,  ψ'(0) = h V₀,  ψ(1) = log(H₀⁻¹ H₁),  ψ'(1) = T(ψ(1))⁻¹ h V₁
//! ```
//!
//! x = 0 … 1 over the step. The error of the cubic is of order h⁴; its multipliers and accelerations are interpolated linearly.

use lissom_motion::{Motion, Vector6, inverse_tangent_times, tangent_times};

use crate::kinematics::{LOCKED, Layout};
use crate::node_motion::depart;
use crate::schemes::{Combination, DensePolynomial, Stage};
use crate::spin::{Departure, Spins};
use crate::system::State;

/// The motion of a step between two states.
#[derive(Clone, Copy)]
pub(crate) struct DenseOutput<'s> {
    /// The start.
    pub(crate) from: &'s State,
    /// The end.
    pub(crate) to: &'s State,
    /// The stages, for collocation schemes.
    pub(crate) stages: Option<SolvedStages<'s>>,
}

/// Stages of a step of a collocation scheme.
#[derive(Clone, Copy)]
pub(crate) struct SolvedStages<'s> {
    pub(crate) polynomial: &'s DensePolynomial,
    pub(crate) table: &'s [Stage],
    pub(crate) layout: &'s Layout,
    /// By stage, then by row.
    pub(crate) increments: &'s [Vec<f64>],
    /// Change of q' at the start in constrained directions, by row.
    pub(crate) start_change: &'s [f64],
    /// Multipliers, by stage [N, N m].
    pub(crate) multipliers: &'s [Vec<f64>],
    /// Nodes whose increments are in axes that do not spin.
    pub(crate) spins: &'s Spins,
}

impl DenseOutput<'_> {
    /// Uses the stages only if `known` is true.
    pub(crate) fn known(mut self, known: bool) -> Self {
        self.stages = self.stages.filter(|_| known);
        self
    }

    /// Midpoint of the widest gap between stages, as a step fraction: the equations are satisfied at stages only.
    pub(crate) fn least_determined(&self) -> f64 {
        let Some(stages) = &self.stages else { return 0.5 };
        let ends = stages.table.iter().map(|stage| stage.abscissa);
        let gaps = std::iter::once(0.0).chain(ends.clone()).zip(ends);
        let widest = gaps.reduce(|one, other| if one.1 - one.0 < other.1 - other.0 { other } else { one });
        widest.map_or(0.5, |(from, to)| 0.5 * (from + to))
    }

    /// Order of the defect with respect to the step size; that of the cubic is four.
    #[expect(clippy::cast_possible_wrap, reason = "stages are few")]
    pub(crate) fn order(&self) -> i32 {
        self.stages.as_ref().map_or(4, |stages| stages.table.len() as i32 + 1)
    }

    /// Writes the state at `time` [s], clamped to the step, to `out`.
    pub(crate) fn interpolate(&self, time: f64, out: &mut State) {
        let (start, end) = (&self.from.kinematics, &self.to.kinematics);
        let duration = end.time - start.time;
        let x = if duration > 0.0 { ((time - start.time) / duration).clamp(0.0, 1.0) } else { 1.0 };
        self.at(x, out);
        out.kinematics.time = time;
    }

    /// Writes the state at the step fraction `x` to `out`; values above 1 extrapolate.
    pub(crate) fn at(&self, x: f64, out: &mut State) {
        match &self.stages {
            Some(stages) => stages.at(self.from, self.to, x, out),
            None => at_share(self.from, self.to, x, out),
        }
    }
}

impl SolvedStages<'_> {
    fn at(&self, from: &State, to: &State, x: f64, out: &mut State) {
        let Self { polynomial, table, layout, increments, start_change, multipliers, spins } = *self;
        let (start, end) = (&from.kinematics, &to.kinematics);
        let duration = end.time - start.time;
        let ahead = x * duration;
        let weights = polynomial.at(x, table);
        let combine = |combination: &Combination, row: usize| {
            let terms = combination.increments.iter().zip(increments);
            combination.velocity * start_change[row]
                + terms.map(|(weight, stage)| weight * stage[row]).sum::<f64>()
        };
        let (per_time, per_square) = (1.0 / duration, 1.0 / (duration * duration));
        out.kinematics.held.clone_from(&start.held);
        out.touches.clone_from(&to.touches);
        (out.kinematics.time, out.kinematics.elapsed) = (start.time + ahead, 0.0);
        let nodes = out.kinematics.nodes.iter_mut().zip(&start.nodes).zip(&layout.node_rows);
        for ((node, from), rows) in nodes {
            if rows.iter().all(|&row| row == LOCKED) {
                *node = *from;
                continue;
            }
            let of_rows = |combination: &Combination, factor: f64| {
                Vector6::from_fn(|k, _| {
                    if rows[k] == LOCKED { 0.0 } else { factor * combine(combination, rows[k] as usize) }
                })
            };
            let acceleration = weights.acceleration.acceleration * from.acceleration
                + of_rows(&weights.acceleration, per_square);
            *node = depart(
                from,
                ahead,
                &of_rows(&weights.place, 1.0),
                [&of_rows(&weights.velocity, per_time), &acceleration],
            );
        }
        for spin in spins.iter() {
            let of = |combination: &Combination, factor: f64| {
                spin.by_row(|row| factor * combine(combination, row))
            };
            let departure = Departure {
                place: of(&weights.place, 1.0),
                rate: of(&weights.velocity, per_time),
                curvature: weights.acceleration.acceleration * *spin.start_curvature()
                    + of(&weights.acceleration, per_square),
            };
            (out.kinematics.nodes[spin.node()], _) = spin.depart(ahead, &departure);
        }
        let coordinates = out.kinematics.coordinates.iter_mut().zip(&start.coordinates);
        for ((own, from), &row) in coordinates.zip(&layout.coordinate_rows) {
            let row = row as usize;
            own.value = from.value + ahead * from.rate + combine(&weights.place, row);
            own.rate = from.rate + per_time * combine(&weights.velocity, row);
            own.acceleration = weights.acceleration.acceleration * from.acceleration
                + per_square * combine(&weights.acceleration, row);
        }
        out.accumulated.clear();
        let accumulated = from.accumulated.iter().zip(&to.accumulated);
        out.accumulated.extend(accumulated.map(|(a, b)| a + x * (b - a)));
        let [of_start, of_stages @ ..] = &weights.multipliers;
        for (k, own) in out.multipliers.iter_mut().enumerate() {
            let stages = of_stages.iter().zip(multipliers).map(|(weight, stage)| weight * stage[k]);
            *own = of_start * from.multipliers[k] + stages.sum::<f64>();
        }
        out.kinematics.show_multipliers(&out.multipliers);
    }
}

/// State at the step fraction `x` of the cubic between two states; values above 1 extrapolate.
pub(crate) fn at_share(from: &State, to: &State, x: f64, out: &mut State) {
    let (start, end) = (&from.kinematics, &to.kinematics);
    let duration = end.time - start.time;
    out.kinematics.held.clone_from(&start.held);
    out.touches.clone_from(&to.touches);
    let between = |a: f64, b: f64| a + x * (b - a);
    out.kinematics.time = start.time + x * duration;
    out.kinematics.elapsed = 0.0;
    for ((node, a), b) in out.kinematics.nodes.iter_mut().zip(&start.nodes).zip(&end.nodes) {
        let whole = (a.frame.inverse() * b.frame).logarithm();
        let first = duration * a.twist;
        let last = inverse_tangent_times(&whole, &(duration * b.twist));
        let (place, rate) = hermite(x, &whole, &first, &last);
        node.frame = a.frame * Motion::exponential(&place);
        node.twist = if duration > 0.0 { tangent_times(&place, &rate) / duration } else { b.twist };
        node.acceleration = a.acceleration + x * (b.acceleration - a.acceleration);
    }
    for ((own, a), b) in out.kinematics.coordinates.iter_mut().zip(&start.coordinates).zip(&end.coordinates) {
        let place = Vector6::from_element(b.value - a.value);
        let (place, rate) = hermite(
            x,
            &place,
            &Vector6::from_element(duration * a.rate),
            &Vector6::from_element(duration * b.rate),
        );
        own.value = a.value + place[0];
        own.rate = if duration > 0.0 { rate[0] / duration } else { b.rate };
        own.acceleration = between(a.acceleration, b.acceleration);
    }
    out.accumulated.clear();
    let accumulated = from.accumulated.iter().zip(&to.accumulated);
    out.accumulated.extend(accumulated.map(|(a, b)| between(*a, *b)));
    for ((own, a), b) in out.multipliers.iter_mut().zip(&from.multipliers).zip(&to.multipliers) {
        *own = between(*a, *b);
    }
    out.kinematics.show_multipliers(&out.multipliers);
}

/// Value and derivative at x of the cubic from 0 to `whole` with the end derivatives `first` and `last`.
fn hermite(x: f64, whole: &Vector6, first: &Vector6, last: &Vector6) -> (Vector6, Vector6) {
    let (square, cube) = (x * x, x * x * x);
    let place =
        (3.0 * square - 2.0 * cube) * whole + (x - 2.0 * square + cube) * first + (cube - square) * last;
    let rate = (6.0 * x - 6.0 * square) * whole
        + (1.0 - 4.0 * x + 3.0 * square) * first
        + (3.0 * square - 2.0 * x) * last;
    (place, rate)
}
