//! What a step works with, allocated once.

use serde::{Deserialize, Serialize};

use super::anderson::Anderson;
use super::corrections::processor;
use super::predictor::Predictor;
use crate::joints::derivatives::IncrementTangent;
use crate::joints::starts::JointStarts;
use crate::kinematics::{Layout, Quantity};
use crate::saddle_point::SaddlePoint;
use crate::saddle_point::stage_tangents::StageTangents;
use crate::scaling::{Representative, Scaled, StageMotion, UnitStepState};
use crate::schemes::{Increments, Scheme};
use crate::solver_features::DisabledFeatures;
use crate::system::{Scratch, State, System, Threads};
use crate::tuning::Tuning;

/// What was done to find solutions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Effort {
    /// Newton iterations.
    pub(crate) iterations: usize,
    /// Tangents factored.
    pub(crate) factorizations: usize,
}

/// Everything a step needs besides system and state, allocated once.
pub(crate) struct Workspace {
    pub(crate) unit: UnitStepState,
    /// The scheme's first guess of the increments, by stage.
    pub(crate) predicted: Vec<Vec<f64>>,
    /// What first guesses of the increments have missed, and of the multipliers; stage after stage.
    pub(crate) predictors: [Predictor; 2],
    /// Whether the next first guess is to make use of them.
    pub(crate) extrapolates: bool,
    /// Departures from going straight on since the start of the step, by stage and coordinate row.
    pub(crate) increments: Vec<Vec<f64>>,
    /// Tangent operators of the nodes' increments, for schemes that measure them from the start.
    pub(crate) node_tangents: Vec<IncrementTangent>,
    /// Multipliers by stage [N, N m].
    pub(crate) multipliers: Vec<Vec<f64>>,
    /// By stage; then at the end of the step, for schemes that integrate velocities.
    pub(crate) motions: Vec<StageMotion>,
    /// Residuals, then corrections, by stage.
    pub(crate) residuals: Vec<Vec<f64>>,
    /// The correction before, as far as it stands.
    pub(crate) before: Vec<Vec<f64>>,
    /// Whether that one was just halved.
    pub(crate) backed_off: bool,
    /// Size of the last correction of places.
    pub(crate) correction: f64,
    /// All iterations and tangents so far, whatever they led to.
    pub(crate) effort: Effort,
    /// Room for the error estimate: by coordinate row, and by row.
    pub(crate) error: Vec<f64>,
    pub(crate) filtered: Vec<f64>,
    /// Round-off of displacements from how far parts go straight on in the present step, scaled; none until it is needed.
    pub(crate) travel_round_off: Option<f64>,
    /// Forces below this are round-off of the stiffest elements' strains [N].
    pub(crate) force_round_off: f64,
    /// What joints see at the start of the step.
    pub(crate) joint_starts: JointStarts,
    pub(crate) scratch: Option<Box<Scratch>>,
    /// Diagonal of the derivatives by place, by row.
    pub(crate) stiffness: Vec<f64>,
    /// The tangents of the scheme's decoupled systems.
    pub(crate) tangent: SaddlePoint<StageTangents>,
    /// Scaled size of one unit of each coordinate row: 1/ℓ_r for translations, 1 for rotations.
    pub(crate) sizes: Vec<f64>,
    /// Scaled size of one unit of each multiplier: moments as forces at the length that stands for a radian.
    pub(crate) multiplier_sizes: Vec<f64>,
    /// From residuals in SI to right-hand sides of the tangent in use.
    pub(crate) row_factors: Vec<f64>,
    pub(crate) processor: pulp::Arch,
    /// Representative length [m].
    pub(crate) length: f64,
    /// For evaluation on several threads, where that pays.
    pub(crate) threads: Option<Threads>,
    pub(crate) anderson: Anderson,
    /// Features that are switched off.
    pub(crate) disabled: DisabledFeatures,
    /// Parameters of the solver.
    pub(crate) tuning: Tuning,
}

impl Workspace {
    pub(crate) fn new(
        system: &System,
        state: &State,
        scheme: &Scheme,
        representative: &Representative,
        solver: &lissom_solver::SolverKind,
        equilibrated: bool,
    ) -> Self {
        let layout = system.layout();
        let stages = scheme.stages.len();
        let count = layout.coordinate_count();
        let sizes = sizes(layout, representative);
        let tangents = StageTangents::new(solver, system.structure(), &scheme.coupling);
        let mut tangent = SaddlePoint::new(tangents, count);
        if equilibrated {
            tangent = tangent.equilibrated(layout.size());
        }
        Self {
            unit: UnitStepState::new(layout, scheme),
            predicted: vec![vec![0.0; count]; stages],
            predictors: [
                Predictor::new(stages, &sizes),
                Predictor::new(stages, &vec![1.0; layout.multiplier_count]),
            ],
            extrapolates: false,
            increments: vec![vec![0.0; count]; stages],
            node_tangents: match scheme.increments {
                Increments::FromStart => vec![IncrementTangent::none(); state.kinematics.nodes.len()],
                Increments::Departure => Vec::new(),
            },
            multipliers: vec![state.multipliers.clone(); stages],
            motions: vec![
                StageMotion::new(&state.kinematics);
                stages + usize::from(scheme.tableau.is_some())
            ],
            residuals: vec![vec![0.0; layout.size()]; stages],
            before: vec![vec![0.0; layout.size()]; stages],
            backed_off: false,
            correction: f64::INFINITY,
            effort: Effort::default(),
            error: vec![0.0; count],
            filtered: vec![0.0; layout.size()],
            travel_round_off: None,
            force_round_off: 0.0,
            joint_starts: JointStarts::default(),
            scratch: Some(Box::default()),
            stiffness: vec![0.0; layout.size()],
            tangent,
            anderson: Anderson::new(stages, layout.size(), &sizes),
            sizes,
            multiplier_sizes: vec![1.0; layout.multiplier_count],
            row_factors: vec![1.0; layout.size()],
            processor: processor(layout.size()),
            length: representative.length,
            threads: None,
            disabled: DisabledFeatures::default(),
            tuning: Tuning::default(),
        }
    }

    /// Records the error of the scheme's first guess; `multipliers` are those at the start of the step.
    pub(crate) fn learn(&mut self, scheme: &Scheme, multipliers: &[f64]) {
        for (stage, predicted) in scheme.stages.iter().zip(&mut self.predicted) {
            self.unit.predict(&stage.prediction, predicted);
        }
        let [of_increments, of_multipliers] = &mut self.predictors;
        of_increments.learn(&self.increments, |stage| &self.predicted[stage], &self.tuning);
        of_multipliers.learn(&self.multipliers, |_| multipliers, &self.tuning);
    }

    /// Records how residuals are to be scaled for the tangent in use.
    pub(crate) fn note_scales(&mut self, layout: &Layout, scaled: &Scaled) {
        self.row_factors.fill(1.0);
        scaled.scale_residual(layout, &mut self.row_factors);
        self.tangent.scale(&mut self.row_factors);
        let quantities = &layout.quantities()[layout.coordinate_count()..];
        for (size, &quantity) in self.multiplier_sizes.iter_mut().zip(quantities) {
            *size = 1.0 / scaled.unit(quantity);
        }
    }

    /// From residuals in SI to right-hand sides of the tangent in use.
    pub(crate) fn row_factors(&self) -> &[f64] {
        &self.row_factors
    }

    /// Makes the next first guess from the scheme alone.
    pub(crate) fn forget_predictions(&mut self) {
        self.predictors.iter_mut().for_each(Predictor::forget);
    }

    /// Goes over to steps that are `ratio` times as long: what is missed of places is of third order in the step, the
    /// change of multipliers of first order.
    pub(crate) fn rescale_predictions(&mut self, ratio: f64) {
        let [of_increments, of_multipliers] = &mut self.predictors;
        of_increments.rescale(ratio, 3);
        of_multipliers.rescale(ratio, 1);
    }
}

/// Scaled size of one unit of each coordinate row: 1/ℓ_r for lengths, 1 for angles, 0 for states.
pub(crate) fn sizes(layout: &Layout, representative: &Representative) -> Vec<f64> {
    let size = |quantity: &Quantity| match quantity {
        Quantity::Length => 1.0 / representative.length,
        Quantity::Angle => 1.0,
        // Measured apart, each by its own magnitude.
        Quantity::State => 0.0,
    };
    layout.quantities()[..layout.coordinate_count()].iter().map(size).collect()
}
