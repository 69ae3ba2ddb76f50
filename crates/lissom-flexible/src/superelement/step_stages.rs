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
mod tests {
    use lissom_motion::{Motion, screw};
    use nalgebra::DMatrix;

    use super::*;
    use crate::superelement::{Damping, ReducedMatrices};
    use lissom_mechanics::elements::inertia::Gravity;
    use lissom_mechanics::kinematics::{
        CoordinateId, CoordinateMotion, Kinematics, MotionChange, NodeId, NodeMotion,
    };

    /// Three interfaces that translate up to the first stage and rotate about the floating frame, the second of them, up to the
    /// other: the longer path counts, with rotations as arcs at the size of the part, 5 m.
    #[test]
    fn the_way_of_a_step_is_that_of_all_interfaces() {
        let places = [Vector3::new(2.0, 0.0, 0.0), Vector3::zeros(), Vector3::new(0.0, 4.0, 3.0)];
        let matrices = ReducedMatrices {
            mass: DMatrix::identity(18, 18),
            stiffness: DMatrix::identity(18, 18),
            damping: Damping::None,
            preload: Vec::new(),
            geometric: None,
        };
        let gravity = Gravity::constant(Vector3::zeros());
        let element = Part::new((NodeId::first(3).collect(), Vec::new()), (1, &places), matrices, gravity);
        let moving = |spatial: [Vector3; 2]| Kinematics {
            time: 0.0,
            elapsed: 0.0,
            nodes: (places.iter())
                .map(|place| {
                    let frame = Motion::translation(*place);
                    let twist = frame.adjoint_inverse_times(&screw(&spatial[0], &spatial[1]));
                    NodeMotion { twist, ..NodeMotion::at_rest(frame) }
                })
                .collect(),
            coordinates: Vec::new(),
            held: Vec::new(),
            multipliers: Vec::new(),
        };
        let straight = moving([Vector3::new(-0.6, 0.0, 0.8), Vector3::zeros()]);
        let turning = moving([Vector3::zeros(), Vector3::new(-0.1, 0.0, 0.0)]);
        let by_stage = [3.0_f64.sqrt(), (0.25_f64 + 3.0 * 0.25).sqrt()];
        for lasting in [[0.1, 0.1], [0.1, 0.3], [-0.2, 0.1], [0.1, -0.4]] {
            let step = StepStages {
                start: &straight,
                stages: [&straight, &turning],
                end: &turning,
                changes: &[],
                durations: [[0.0; STAGES]; STAGES],
                lasting,
                reached: [0.0; STAGES],
                length: 1.0,
            };
            let mut stages = [ElementScratch::default(), ElementScratch::default()];
            for (scratch, at) in stages.iter_mut().zip(step.stages) {
                scratch.enter(&element, at);
            }
            let wanted = (by_stage[0] * lasting[0].abs()).max(by_stage[1] * lasting[1].abs());
            let found = element.way(&step, &stages);
            assert!((found - wanted).abs() < 1e-14, "{lasting:?}: {found}, {wanted}");
        }
    }

    /// The error of rates is the change of u over the step minus their integral, for rotations that are small and
    /// large.
    #[test]
    fn the_remainder_closes_the_change_over_the_step() {
        let places = [Vector3::zeros(), Vector3::new(2.0, 0.5, -1.0)];
        let matrices = ReducedMatrices {
            mass: DMatrix::identity(13, 13),
            stiffness: DMatrix::identity(13, 13),
            damping: Damping::None,
            preload: Vec::new(),
            geometric: None,
        };
        let gravity = Gravity::constant(Vector3::zeros());
        let element = Part::new(
            (NodeId::first(2).collect(), CoordinateId::first(1).collect()),
            (0, &places),
            matrices,
            gravity,
        );
        let twist = screw(&Vector3::new(0.3, -0.2, 0.5), &Vector3::new(0.4, 0.7, -0.1));
        for size in [1e-5, 2e-4, 0.02, 0.4] {
            let changed = [
                Motion::exponential(
                    &(size * screw(&Vector3::new(1.0, 2.0, 0.5), &Vector3::new(0.3, -0.6, 0.2))),
                ),
                Motion::exponential(
                    &(size * screw(&Vector3::new(-0.5, 1.0, 1.5), &Vector3::new(1.1, 0.4, -0.8))),
                ),
            ];
            let state = |part: f64, value: f64| {
                let first = Motion::exponential(&(0.7 * twist));
                let second = first
                    * Motion::translation(places[1])
                    * Motion::exponential(
                        &(0.2 * screw(&Vector3::new(0.1, 0.3, 0.2), &Vector3::new(0.5, -0.4, 0.9))),
                    );
                let frames = [first, second];
                let nodes = frames.iter().zip(&changed).map(|(frame, change)| {
                    let frame = if part > 0.0 { *frame * *change } else { *frame };
                    NodeMotion { twist, ..NodeMotion::at_rest(frame) }
                });
                Kinematics {
                    time: 0.0,
                    elapsed: 0.0,
                    nodes: nodes.collect(),
                    coordinates: vec![CoordinateMotion { value, rate: 0.3, acceleration: 0.0 }],
                    held: Vec::new(),
                    multipliers: Vec::new(),
                }
            };
            let (start, end) = (state(0.0, 0.1), state(1.0, 0.1 + size));
            let changes: Vec<MotionChange> = changed.iter().map(MotionChange::of).collect();
            let step = StepStages {
                start: &start,
                stages: [&start, &end],
                end: &end,
                changes: &changes,
                durations: [[0.0; STAGES]; STAGES],
                lasting: [0.1 * size, 0.3 * size],
                reached: [0.0; STAGES],
                length: 1.0,
            };
            let mut stages = [ElementScratch::default(), ElementScratch::default()];
            for (scratch, at) in stages.iter_mut().zip(step.stages) {
                scratch.enter(&element, at);
            }
            let (mut own, mut last) = (ElementScratch::default(), ElementScratch::default());
            own.enter(&element, &start);
            last.enter(&element, &end);
            element.missed(&step, &mut own, &stages);
            for row in 0..element.size() {
                let wanted = last.displacement[row]
                    - own.displacement[row]
                    - step.whole([stages[0].rate[row], stages[1].rate[row]]);
                let error = (own.stress[row] - wanted).abs();
                assert!(error < 1e-14 + 1e-9 * size, "{size}, row {row}: {} {wanted}", own.stress[row]);
            }
        }
    }
}
