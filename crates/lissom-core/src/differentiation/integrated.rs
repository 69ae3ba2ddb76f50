//! Derivatives of the residuals of a step whose strains and violations are integrated from their rates. The contributions of elements
//! and joints to it have no analytic derivatives, so the residuals are differentiated numerically along the variation of the start of
//! the step, its increments and its multipliers.
//!
//! Legend: x start of the step, z increments, μ multipliers, δ their variations with a model parameter θ, r residuals at the stages, σ
//! step length of the difference.
//!
//! ```text
//! ∂r = Σ_k w_k r(x + k σ δx, z + k σ δz, μ + k σ δμ; θ) / σ + Σ_i w_i r(x, z, μ; θ_i),      k = ±1, ±2
//! ```
//!
//! with the weights w_k of a central difference of fourth order. σ displaces the model by the same distance whatever the parameter.
//! The differences are those of single steps, not of runs, so that their round-off does not accumulate.

use std::sync::Arc;

use lissom_motion::Block;

use super::{Lanes, stages::largest_found};
use crate::integrator::equations::joint_changes;
use crate::joints::evaluation_point::Augmentation;
use crate::joints::starts::JointStarts;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::round_off;
use crate::scaling::{StageIncrements, StageMotion, UnitStepState};
use crate::schemes::Tableau;
use crate::simulation::Simulation;
use crate::system::{State, StepPoint, System};

/// Largest displacement in a difference, relative to the length of the model [-, rad].
const PLACES: f64 = 1e-3;
/// Largest change of increments in a difference, relative to the largest motion in the step: strain corrections are distributed among
/// the stages by squares of rates, which are strongly nonlinear. Relative errors of derivatives: of a double pendulum 1e-5 with 1e-3,
/// and 1e-9 with 1e-4; of a turbine whose blades hardly bend 2e-7 and 6e-7, by round-off.
const CHANGES: f64 = 2e-4;
/// Multiples of σ, and the weights of the central difference.
const SIDES: [(f64, f64); 4] =
    [(-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (-2.0, 1.0 / 12.0), (2.0, -1.0 / 12.0)];

/// A perturbed model.
pub(super) struct Neighbour {
    pub(super) system: Arc<System>,
    /// Finite-difference weight of its residuals.
    pub(super) weight: f64,
    /// Representative length of the neighbour [m].
    pub(super) length: f64,
}

/// Storage for a perturbed step.
pub(super) struct IntegratedStep {
    tableau: Tableau,
    start: State,
    unit: UnitStepState,
    joints: JointStarts,
    increments: Vec<Vec<f64>>,
    multipliers: Vec<Vec<f64>>,
    motions: Vec<StageMotion>,
    /// Zero: violations at the start do not depend on model parameters.
    violations: Vec<f64>,
    residuals: Vec<Vec<f64>>,
    /// Durations of the rates at the stages, see [`StepStages`] [s].
    durations: [[f64; STAGES]; STAGES],
    lasting: [f64; STAGES],
}

impl IntegratedStep {
    /// None if strains are evaluated at the stages.
    pub(super) fn new(base: &Simulation) -> Option<Self> {
        let (layout, work) = (base.system.layout(), &base.integrator.work);
        Some(Self {
            tableau: base.settings.scheme.tableau?,
            start: base.state.clone(),
            unit: UnitStepState::new(layout, &base.settings.scheme),
            joints: JointStarts::default(),
            increments: work.increments.clone(),
            multipliers: work.multipliers.clone(),
            motions: work.motions.clone(),
            violations: vec![0.0; layout.multiplier_count],
            residuals: vec![vec![0.0; layout.size()]; work.residuals.len()],
            durations: [[0.0; STAGES]; STAGES],
            lasting: [0.0; STAGES],
        })
    }

    /// Adds the residuals' derivatives with respect to a lane's parameter to `out`, for the last step of `base`.
    pub(super) fn differ(
        &mut self,
        base: &Simulation,
        neighbours: &[Neighbour],
        lane: usize,
        out: &mut [Vec<Block>],
    ) {
        self.start.clone_from(&base.previous);
        self.increments.clone_from(&base.integrator.work.increments);
        self.multipliers.clone_from(&base.integrator.work.multipliers);
        self.move_stages(base);
        for neighbour in neighbours {
            self.evaluate(&neighbour.system, neighbour.length);
            self.add(neighbour.weight, lane, out);
        }
    }

    /// Adds the derivatives of the residuals along the variation in a lane to `out`.
    pub(super) fn vary(&mut self, base: &Simulation, lanes: &Lanes, lane: usize, out: &mut [Vec<Block>]) {
        let share = share(base, lanes, lane);
        for (side, weight) in SIDES {
            let moved = side * share;
            self.start.clone_from(&base.previous);
            lanes.now.displace(lane, base.system.layout(), moved, &mut self.start);
            let work = &base.integrator.work;
            let ways = [
                (&mut self.increments, &work.increments, &lanes.increments),
                (&mut self.multipliers, &work.multipliers, &lanes.multipliers),
            ];
            for (own, of, by) in ways {
                for ((own, of), by) in own.iter_mut().zip(of).zip(by) {
                    for ((value, known), variation) in own.iter_mut().zip(of).zip(by) {
                        *value = known + moved * variation[lane];
                    }
                }
            }
            self.move_stages(base);
            self.evaluate(&base.system, base.integrator.representative.length);
            self.add(weight / share, lane, out);
        }
    }

    /// Computes the motions at the stages and at the end from the start and the increments.
    fn move_stages(&mut self, base: &Simulation) {
        let (layout, scheme, scaled) = (base.system.layout(), &base.settings.scheme, &base.integrator.scaled);
        scaled.to_unit_step(layout, scheme, &self.start, &mut self.unit);
        for stage in 0..scheme.stages.len() {
            let increments = StageIncrements { all: &self.increments, stage };
            scaled.stage_motion(
                layout,
                scheme,
                &self.start,
                &self.unit,
                &increments,
                &mut self.motions[stage],
            );
        }
        scaled.integrate_velocities(layout, &self.tableau, &self.start, &self.increments, &mut self.motions);
        (self.durations, self.lasting) = scaled.durations(&self.tableau);
    }

    /// Evaluates the residuals at the stages, without the augmented term, which vanishes with the violations.
    fn evaluate(&mut self, system: &System, length: f64) {
        let start = &self.start.kinematics;
        system.begin_step(start, &mut self.joints);
        let [first, second, end] = &self.motions[..] else { return };
        let point = StepPoint {
            step: StepStages {
                start,
                stages: [&first.at, &second.at],
                end: &end.at,
                changes: &end.changes,
                durations: self.durations,
                lasting: self.lasting,
                reached: self.tableau.reached,
                length,
            },
            increments: [first, second, end].map(|motion| joint_changes(start, motion, &self.joints)),
            multipliers: [&self.multipliers[0], &self.multipliers[1]],
            violations: &self.violations,
            augmentation: Augmentation::none(),
        };
        system.step_residuals(&point, &mut self.residuals);
    }

    fn add(&self, weight: f64, lane: usize, out: &mut [Vec<Block>]) {
        for (values, out) in self.residuals.iter().zip(out) {
            for (value, block) in values.iter().zip(out) {
                block[lane] += weight * value;
            }
        }
    }
}

/// Round-off of the derivatives of increments in a lane.
pub(super) fn round_off(base: &Simulation, lanes: &Lanes, lane: usize) -> f64 {
    round_off::INCREMENT / share(base, lanes, lane)
}

/// Step length σ of the difference in a lane.
fn share(base: &Simulation, lanes: &Lanes, lane: usize) -> f64 {
    let work = &base.integrator.work;
    let largest = |of: &mut dyn Iterator<Item = (f64, f64)>| {
        of.fold(0.0_f64, |most, (size, value)| most.max((size * value).abs()))
    };
    let sizes = || work.units.coordinates.iter().copied();
    let column = |values: &[Block]| largest(&mut sizes().zip(values.iter().map(|block| block[lane])));
    let place = column(&lanes.now.place);
    let found = largest_found(base, lanes)[lane];
    let change = found.max(base.integrator.scaled.step_size() * column(&lanes.now.rate));
    let straight = largest(&mut sizes().zip(work.unit.velocity.iter().copied()));
    let travel = work
        .increments
        .iter()
        .fold(straight, |most, values| most.max(largest(&mut sizes().zip(values.iter().copied()))));
    let within = |room: f64, extent: f64| if extent > 0.0 { room / extent } else { f64::INFINITY };
    let share = within(PLACES, place.max(change)).min(within(CHANGES * travel, change));
    // If only multipliers vary, in which the residuals are linear, any step length is exact.
    if share.is_finite() && share > 0.0 { share } else { 1.0 }
}
