//! Derivatives of the residuals of a step whose strains and violations are integrated from their rates. What elements and
//! joints add there has no derivatives of its own, so the residuals are differentiated along the direction in which the start
//! of the step, its increments and its multipliers vary.
//!
//! Legend: x start of the step, z increments, μ multipliers, δ their variations with a number θ of the model, r residuals at the
//! stages, σ a share.
//!
//! ```text
//! ∂r = Σ_k w_k r(x + k σ δx, z + k σ δz, μ + k σ δμ; θ) / σ + Σ_i w_i r(x, z, μ; θ_i),      k = ±1, ±2
//! ```
//!
//! with the weights w_k of a central difference of fourth order. The share moves the model by the same distance whatever the
//! number: nothing is compared between runs, and what rounding leaves is that of a step and not of a run.

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

/// Displacement of places over which residuals are differentiated, by the length of the model [-, rad].
const PLACES: f64 = 1e-3;
/// The same of what a step changes, by how far anything moves in it: strains that rates miss are shared among the stages by
/// squares of rates, which are far from linear. With 1e-3 derivatives of a double pendulum are wrong by 1e-5, with 1e-4 by 1e-9;
/// those of a turbine whose blades hardly bend by 2e-7 of round-off, and by 6e-7.
const CHANGES: f64 = 2e-4;
/// Shares of the variation, and their weights in its derivative.
const SIDES: [(f64, f64); 4] =
    [(-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (-2.0, 1.0 / 12.0), (2.0, -1.0 / 12.0)];

/// A model beside the one that is differentiated.
pub(super) struct Neighbour {
    pub(super) system: Arc<System>,
    /// Of its residuals in their derivative by the number.
    pub(super) weight: f64,
    /// Its representative length [m].
    pub(super) length: f64,
}

/// Room for a step beside the one that was taken.
pub(super) struct IntegratedStep {
    tableau: Tableau,
    start: State,
    unit: UnitStepState,
    joints: JointStarts,
    increments: Vec<Vec<f64>>,
    multipliers: Vec<Vec<f64>>,
    motions: Vec<StageMotion>,
    /// Violations at the start do not change with numbers of the model.
    violations: Vec<f64>,
    residuals: Vec<Vec<f64>>,
    /// How long the rates at the stages last, see [`StepStages`] [s].
    durations: [[f64; STAGES]; STAGES],
    lasting: [f64; STAGES],
}

impl IntegratedStep {
    /// None where strains are evaluated where a stage is.
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

    /// Sets `out` to the derivatives of the residuals by the number of a lane at the motion of the last step of `base`.
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

    /// Motions at the stages and at the end, from the start and the increments.
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

    /// Residuals at the stages, without the augmented term, which vanishes with the violations.
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

/// What rounding leaves of derivatives of increments in the lane.
pub(super) fn round_off(base: &Simulation, lanes: &Lanes, lane: usize) -> f64 {
    round_off::INCREMENT / share(base, lanes, lane)
}

/// The share of the variation in a lane over which residuals are differentiated.
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
    let straight = largest(&mut sizes().zip(work.unit.rate.iter().copied()));
    let travel = work
        .increments
        .iter()
        .fold(straight, |most, values| most.max(largest(&mut sizes().zip(values.iter().copied()))));
    let within = |room: f64, extent: f64| if extent > 0.0 { room / extent } else { f64::INFINITY };
    let share = within(PLACES, place.max(change)).min(within(CHANGES * travel, change));
    // Where nothing varies but multipliers, in which the residuals are linear, any share will do.
    if share.is_finite() && share > 0.0 { share } else { 1.0 }
}
