//! A shell's forces at the stages of a step, with strains integrated from their rates. See `kinematics::step_stages` for the formulas; σ_j are
//! the twists of the nodes relative to the first node.

use lissom_motion::{Motion, Pose, Triple, Vector3, Vector6};
use nalgebra::SVector;

use super::constants::Constants;
use super::linearize::{SIZE, gradient};
use super::quadrilateral::{NODES, STRAINS};
use super::strains::Deformed;
use super::{Shell, forces};
use lissom_mechanics::kinematics::Kinematics;
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages, above_round_off, weigh};
use lissom_mechanics::round_off;

type Strains = SVector<f64, STRAINS>;

/// An element at a stage.
struct Visit {
    frames: [Pose<f64>; NODES],
    motions: [Motion; NODES],
    deformed: Deformed<f64>,
    /// W σ.
    weighted: [Vector6; NODES],
    /// σ·W σ.
    square: f64,
    /// ė.
    rates: Strains,
}

impl Shell {
    /// Adds the forces at the stages of `step`.
    pub(super) fn add_stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let length = self.size();
        let visits = step.stages.map(|at| self.visit(at, length));
        let [start, end] = [step.start, step.end].map(|at| Deformed::at(&self.numbers, &self.frames(at)));
        let begin = Strains::from(start.strains(&self.numbers));
        let change = Strains::from(self.changes(step, &start, &end));
        let mut rates = visits.each_ref().map(|visit| visit.rates);
        let (inverse, shares) = step.shares(visits.each_ref().map(|visit| visit.square));
        let mut missed = change - step.whole(rates);
        let way = visits.iter().zip(step.lasting).map(|(visit, lasting)| lasting.abs() * visit.square.sqrt());
        let round_off = round_off::RIGID_MOTION * length * way.fold(0.0, f64::max);
        missed *= above_round_off(missed.norm(), round_off);
        for (rate, share) in rates.iter_mut().zip(shares) {
            *rate += missed * share;
        }
        let integrated = step.at_stages(begin, rates);
        for ((visit, strains), out) in visits.iter().zip(&integrated).zip(out) {
            let stress = forces::stress(&self.numbers, &std::array::from_fn(|k| strains[k]));
            let wrenches = visit.deformed.conjugate(&stress).wrenches(&self.numbers, &visit.frames);
            let values = wrenches.iter().flat_map(|wrench| wrench.components());
            out.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            let work: f64 = stress.iter().zip(&missed).map(|(stress, missed)| stress * missed).sum();
            let mut balance = Vector6::zeros();
            for i in 1..NODES {
                let force = work * inverse * visit.weighted[i];
                balance -= visit.motions[i].adjoint_inverse_transpose_times(&force);
                out[6 * i..].iter_mut().zip(&force).for_each(|(sum, value)| *sum += value);
            }
            out.iter_mut().zip(&balance).for_each(|(sum, value)| *sum += value);
        }
    }

    /// Changes of the strains over a step.
    fn changes(&self, step: &StepStages<'_>, start: &Deformed<f64>, end: &Deformed<f64>) -> [f64; STRAINS] {
        let nodes = self.nodes.map(|node| (&step.start.nodes[node].frame, &step.changes[node]));
        let moved = nodes.map(|(frame, change)| frame.rotation.apply(&change.shift));
        let apart = |at: &Kinematics| {
            self.nodes.map(|node| at.nodes[node].frame.position - at.nodes[self.nodes[0]].frame.position)
        };
        let [from, to] = [step.start, step.end].map(apart);
        let positions = |i: usize| Triple::from(&(0.5 * (from[i] + to[i])));
        let middle: [[Triple<f64>; 3]; NODES] = std::array::from_fn(|i| {
            std::array::from_fn(|k| (start.triads[i][k] + end.triads[i][k]).scaled(0.5))
        });
        let turned: [[Triple<f64>; 3]; NODES] = std::array::from_fn(|i| {
            let (frame, change) = nodes[i];
            std::array::from_fn(|k| {
                let director = Vector3::from(self.numbers.director(i, k));
                Triple::from(&frame.rotation.apply(&(change.turn * director)))
            })
        });
        let middle = Deformed::of(&self.numbers, &std::array::from_fn(positions), &middle);
        let shift = std::array::from_fn(|i| Triple::from(&(moved[i] - moved[0])));
        start.changes(end, &middle, &Deformed::of(&self.numbers, &shift, &turned))
    }

    fn visit(&self, at: &Kinematics, length: f64) -> Visit {
        let frames = self.frames(at);
        let deformed = Deformed::at(&self.numbers, &frames);
        let (gradient, _) = gradient(&self.numbers, &frames, &deformed);
        let nodes = self.nodes.map(|node| &at.nodes[node]);
        let motions = nodes.map(|node| node.frame.relative_to(&nodes[0].frame));
        let seen: [Vector6; NODES] = std::array::from_fn(|i| {
            if i == 0 {
                Vector6::zeros()
            } else {
                nodes[i].twist - motions[i].adjoint_inverse_times(&nodes[0].twist)
            }
        });
        let weighted = seen.map(|twist| weigh(&twist, length));
        let velocities: [f64; SIZE] = std::array::from_fn(|k| nodes[k / 6].twist[k % 6]);
        let rates = Strains::from_fn(|k, _| gradient[k].iter().zip(&velocities).map(|(g, v)| g * v).sum());
        let square = seen.iter().zip(&weighted).map(|(twist, weight)| twist.dot(weight)).sum();
        Visit { frames, motions, deformed, weighted, square, rates }
    }
}
