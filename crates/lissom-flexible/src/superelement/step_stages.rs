//! A superelement's forces at the stages of a step, with u integrated from its rates: see `kinematics::step_stages` for the
//! formulas. With σ_j = u̇_j the remainder r acts by s_j + W σ_j (r·s_j) / Q instead of the stress s_j. Inertia and weight are
//! those of the stages.

use lissom_motion::{Vector3, rotation_inverse_tangent, rotation_part};

use super::centre::Centre;
use super::element_scratch::ElementScratch;
use super::part::Part;
use super::vectors::{product, three};
use lissom_mechanics::kinematics::step_stages::{SMALL_CHANGE, STAGES, StepStages, above_round_off};
use lissom_mechanics::round_off;

impl Part {
    /// Adds the forces at the stages of `step`, with those of inertia if `has_inertia`.
    pub(super) fn add_stage_forces(
        &self,
        step: &StepStages<'_>,
        (start, stages, centre): (&mut ElementScratch, &mut [ElementScratch; STAGES], &mut Centre),
        has_inertia: bool,
        out: &mut [&mut [f64]; STAGES],
    ) {
        for (scratch, at) in stages.iter_mut().zip(step.stages) {
            scratch.enter(self, at);
        }
        start.enter(self, step.start);
        self.missed(step, start, stages);
        let squares =
            [0, 1].map(|j| self.weighted(&stages[j].rate).zip(&stages[j].rate).map(|(w, v)| w * v).sum());
        let (inverse, shares) = step.shares(squares);
        let noise = round_off::RIGID_MOTION * self.way(step, stages);
        // The remainder is stored in the stress of the start, which is not needed otherwise.
        let size = self.weighted(&start.stress).zip(&start.stress).map(|(w, r)| w * r).sum::<f64>().sqrt();
        let weight = above_round_off(size, noise);
        start.stress.iter_mut().for_each(|missed| *missed *= weight);
        // The corrected rates replace the start's own velocities and accelerations.
        for row in 0..self.size() {
            let rates = [0, 1].map(|j| stages[j].rate[row] + shares[j] * start.stress[row]);
            let values = step.at_stages(start.displacement[row], rates);
            for (scratch, value) in stages.iter_mut().zip(values) {
                scratch.displacement[row] = value;
            }
            (start.velocity[row], start.acceleration[row]) = (rates[0], rates[1]);
        }
        let rates = [&start.velocity, &start.acceleration];
        for (((scratch, rates), at), out) in stages.iter_mut().zip(rates).zip(step.stages).zip(out) {
            scratch.stress.copy_from_slice(self.preload.as_slice());
            product(&self.stiffness, &scratch.displacement, &mut scratch.stress);
            if let Some(damping) = &self.damping {
                product(damping, rates, &mut scratch.stress);
            }
            let work: f64 =
                scratch.stress.iter().zip(&start.stress).map(|(stress, missed)| stress * missed).sum();
            let factor = inverse * work;
            for (stress, weighted) in scratch.stress.iter_mut().zip(self.weighted(&scratch.rate)) {
                *stress += factor * weighted;
            }
            self.add_conjugate(scratch, &scratch.stress, out);
            if has_inertia {
                self.add_inertia(at, scratch, centre, out);
            }
        }
    }

    /// Stores in the stress of the start the difference between the change of u over the step and the integral of the
    /// rates at the stages.
    fn missed(&self, step: &StepStages<'_>, start: &mut ElementScratch, stages: &[ElementScratch; STAGES]) {
        let frame = self.nodes[self.frame];
        let base = step.start.nodes[frame].frame;
        let (first, last) = (step.start, step.end);
        for (i, &node) in self.nodes.iter().enumerate().filter(|&(i, _)| i != self.frame) {
            let relative = first.nodes[node].frame.relative_to(&base);
            let seen = step.changes[node].relative_to(&step.changes[frame].carried_at(&relative));
            let arm = start.turns[i] * seen.shift;
            let angles = three(&start.displacement, 6 * i + 3);
            let turn = if seen.turn.amax() < SMALL_CHANGE {
                // By integrating θ' = T(θ)⁻¹ η with one step of the classical Runge-Kutta method.
                let eta = rotation_part(&seen.small_logarithm());
                let slope = |way: Vector3| rotation_inverse_tangent(&(angles + way)) * eta;
                let one = slope(Vector3::zeros());
                let two = slope(0.5 * one);
                let three = slope(0.5 * two);
                (one + 2.0 * (two + three) + slope(three)) / 6.0
            } else {
                last.nodes[node].frame.relative_to(&last.nodes[frame].frame).rotation.logarithm() - angles
            };
            start.stress[6 * i..6 * i + 3].copy_from_slice(arm.as_slice());
            start.stress[6 * i + 3..6 * i + 6].copy_from_slice(turn.as_slice());
        }
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            let of = [first, last].map(|at| at.coordinates[coordinate].value);
            start.stress[6 * self.nodes.len() + k] = of[1] - of[0];
        }
        for row in 0..self.size() {
            start.stress[row] -= step.whole([stages[0].rate[row], stages[1].rate[row]]);
        }
    }

    /// W times a vector like u: rotations are weighted as arcs at the element's largest distance.
    fn weighted<'a>(&self, values: &'a [f64]) -> impl Iterator<Item = f64> + use<'a> {
        let reach = self.reach();
        let (interfaces, radian) = (6 * self.nodes.len(), if reach > 0.0 { reach * reach } else { 1.0 });
        let is_rotation = move |row: usize| row < interfaces && row % 6 >= 3;
        values
            .iter()
            .enumerate()
            .map(move |(row, value)| if is_rotation(row) { radian * value } else { *value })
    }

    /// Largest displacement of the element over a step, in both directions [m].
    fn way(&self, step: &StepStages<'_>, stages: &[ElementScratch; STAGES]) -> f64 {
        let of = |j: usize| {
            let square: f64 =
                self.weighted(&stages[j].velocity).zip(&stages[j].velocity).map(|(w, v)| w * v).sum();
            step.lasting[j].abs() * square.sqrt()
        };
        of(0).max(of(1))
    }
}

#[cfg(test)]
#[path = "../../tests/unit/superelement/step_stages.rs"]
mod tests;
