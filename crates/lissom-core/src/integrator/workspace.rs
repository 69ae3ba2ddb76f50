//! What a step works with, allocated once.

use lissom_solver::KINDS;
use serde::{Deserialize, Serialize};

use super::anderson::Anderson;
use super::contacts::StepContacts;
use super::corrections::processor;
use super::predictor::Predictor;
use crate::consistent::redundancy::Redundancy;
use crate::joints::derivatives::IncrementTangent;
use crate::joints::starts::JointStarts;
use crate::kinematics::{AxisSpin, Kinematics, LOCKED, Layout, Quantity};
use crate::saddle_point::SaddlePoint;
use crate::saddle_point::stage_tangents::StageTangents;
use crate::scaling::{Representative, Scaled, StageMotion, UnitStepState};
use crate::schemes::{Parametrization, Scheme};
use crate::solver_features::DisabledFeatures;
use crate::spin::Axes;
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

/// First guesses of a step's unknowns.
pub(crate) struct Prediction {
    /// The scheme's own, of the increments, by stage.
    pub(crate) predicted: Vec<Vec<f64>>,
    /// Extrapolation of their errors: one for increments, one for multipliers.
    pub(crate) predictors: [Predictor; 2],
    /// Whether the next guess is extrapolated.
    pub(crate) extrapolates: bool,
    /// Multipliers in axes that do not spin, at the start and by stage, if there are such axes.
    pub(crate) still: Vec<Vec<f64>>,
}

/// Progress of Newton's method.
pub(crate) struct Progress {
    /// The previous correction, by stage.
    pub(crate) before: Vec<Vec<f64>>,
    /// Whether it was halved.
    pub(crate) backed_off: bool,
    /// Size of the last correction of positions.
    pub(crate) correction: f64,
    /// Size beyond which corrections are cut.
    pub(crate) reach: f64,
    /// All iterations and tangents so far.
    pub(crate) effort: Effort,
    /// Secants.
    pub(crate) anderson: Anderson,
}

/// Estimated error of a step.
pub(crate) struct EstimatedError {
    /// By coordinate row.
    pub(crate) unfiltered: Vec<f64>,
    /// By row; that of nodes whose increments are in axes that do not spin is in axes of the tangent.
    pub(crate) filtered: Vec<f64>,
    /// By coordinate row, in axes of the nodes at the end.
    pub(crate) at_end: Vec<f64>,
}

/// Limits that round-off sets.
pub(crate) struct RoundOff {
    /// Limit for displacements, from the extrapolated motion in the present step [scaled]; none until it is needed.
    pub(crate) travel: Option<f64>,
    /// Forces below this are round-off of the stiffest elements' strains [N].
    pub(crate) force: f64,
    /// Diagonal of the derivatives by position, by row, from which it follows.
    pub(crate) stiffness: Vec<f64>,
}

/// Scaled sizes of units.
pub(crate) struct Units {
    /// By coordinate row: 1/ℓ_r for translations, 1 for rotations.
    pub(crate) coordinates: Vec<f64>,
    /// By multiplier: moments are converted to forces at the length that represents a radian.
    pub(crate) multipliers: Vec<f64>,
    /// From residuals in SI to right-hand sides of the tangent in use.
    pub(crate) rows: Vec<f64>,
    /// Representative length [m].
    pub(crate) length: f64,
}

/// Storage of the evaluation of elements and joints.
pub(crate) struct EvaluationSpace {
    /// What joints need of the start of the step.
    pub(crate) joint_starts: JointStarts,
    /// Tangent operators of the nodes' increments, for schemes that measure them from the start.
    pub(crate) node_tangents: Vec<IncrementTangent>,
    /// Drifts of nodes whose increments are in axes that do not spin.
    pub(crate) drifts: Vec<AxisSpin>,
    pub(crate) scratch: Option<Box<Scratch>>,
    /// For evaluation on several threads, if the system is large.
    pub(crate) threads: Option<Threads>,
    pub(crate) processor: pulp::Arch,
    /// Nodes of the last stage before the last correction, for elements that predict the stresses of the geometric stiffness.
    pub(crate) previous: Option<Kinematics>,
}

/// Options of the solver.
#[derive(Default)]
pub(crate) struct SolverOptions {
    /// Features that are switched off.
    pub(crate) disabled: DisabledFeatures,
    /// Parameters of the others.
    pub(crate) tuning: Tuning,
}

/// Everything a step needs besides system and state, allocated once.
pub(crate) struct Workspace {
    pub(crate) unit: UnitStepState,
    pub(crate) prediction: Prediction,
    /// Increments beyond the extrapolated start of the step, by stage and coordinate row.
    pub(crate) increments: Vec<Vec<f64>>,
    /// Change of q' at the start that the stages imply in constrained directions, by coordinate row; zero until the error of the
    /// attempt is estimated.
    pub(crate) start_change: Vec<f64>,
    /// Multipliers by stage [N, N m].
    pub(crate) multipliers: Vec<Vec<f64>>,
    /// By stage; then at the end of the step, for schemes that integrate velocities.
    pub(crate) motions: Vec<StageMotion>,
    /// Residuals, then corrections, by stage.
    pub(crate) residuals: Vec<Vec<f64>>,
    /// The tangents of the scheme's decoupled systems.
    pub(crate) tangent: SaddlePoint<StageTangents>,
    /// Redundant equations, which steps omit.
    pub(crate) redundancy: Redundancy,
    pub(crate) newton: Progress,
    pub(crate) error: EstimatedError,
    pub(crate) round_off: RoundOff,
    pub(crate) units: Units,
    pub(crate) evaluation: EvaluationSpace,
    pub(crate) options: SolverOptions,
    /// Parts that touch without elements.
    pub(crate) contacts: Option<Box<StepContacts>>,
}

impl Workspace {
    pub(crate) fn new(
        (system, state): (&System, &State),
        scheme: &Scheme,
        (representative, redundancy): (&Representative, Redundancy),
        (solver, equilibrated): (&'static lissom_solver::SolverKind, bool),
    ) -> Self {
        let layout = system.layout();
        let stages = scheme.stages.len();
        let count = layout.coordinate_count();
        let sizes = sizes(layout, representative);
        // Stiffness of elastic solids is symmetric; of other models it is so at equilibrium only, or not at all.
        let is_symmetric = !scheme.dynamic
            && solver.name == KINDS[0].name
            && !system.has_signal_feedback()
            && 2 * layout.node_rows.iter().filter(|rows| rows[3] == LOCKED).count() > layout.node_rows.len();
        let tangents = if is_symmetric {
            StageTangents::symmetric(solver, system.structure(), &scheme.coupling)
        } else {
            StageTangents::new(solver, system.structure(), &scheme.coupling)
        };
        let mut tangent = SaddlePoint::new(tangents, count);
        // Without constraints elimination does not need rows of one size, and a tangent with touches is factored only once.
        if equilibrated && (system.contacts().is_empty() || layout.multiplier_count > 0) {
            tangent = tangent.equilibrated(layout.size());
        }
        tangent.omit(redundancy.omitted());
        let mut unit = UnitStepState::new(layout, scheme);
        unit.spins.omit(redundancy.omitted());
        Self {
            unit,
            prediction: Prediction {
                predicted: vec![vec![0.0; count]; stages],
                predictors: [
                    Predictor::new(stages, &sizes),
                    Predictor::new(stages, &vec![1.0; layout.multiplier_count]),
                ],
                extrapolates: false,
                still: vec![state.multipliers.clone(); stages + 1],
            },
            increments: vec![vec![0.0; count]; stages],
            start_change: vec![0.0; count],
            multipliers: vec![state.multipliers.clone(); stages],
            motions: vec![
                StageMotion::new(&state.kinematics);
                stages + usize::from(scheme.tableau.is_some())
            ],
            residuals: vec![vec![0.0; layout.size()]; stages],
            tangent,
            redundancy,
            newton: Progress {
                before: vec![vec![0.0; layout.size()]; stages],
                backed_off: false,
                correction: f64::INFINITY,
                reach: 1.0,
                effort: Effort::default(),
                anderson: Anderson::new(stages, layout.size(), &sizes),
            },
            error: EstimatedError {
                unfiltered: vec![0.0; count],
                filtered: vec![0.0; layout.size()],
                at_end: vec![0.0; count],
            },
            round_off: RoundOff { travel: None, force: 0.0, stiffness: vec![0.0; layout.size()] },
            units: Units {
                coordinates: sizes,
                multipliers: vec![1.0; layout.multiplier_count],
                rows: vec![1.0; layout.size()],
                length: representative.length,
            },
            evaluation: EvaluationSpace {
                joint_starts: JointStarts::default(),
                node_tangents: match scheme.parametrization {
                    Parametrization::FromStart | Parametrization::Inertial => {
                        vec![IncrementTangent::none(); state.kinematics.nodes.len()]
                    }
                    Parametrization::RelativeToDrift => Vec::new(),
                },
                drifts: Vec::new(),
                scratch: Some(Box::default()),
                threads: None,
                processor: processor(layout.size()),
                previous: system.predicts_stresses().then(|| state.kinematics.clone()),
            },
            options: SolverOptions::default(),
            contacts: StepContacts::of((system, solver)),
        }
    }

    /// Records the error of the scheme's first guess; `multipliers` are those at the start of the step.
    /// The step was of this length [s].
    pub(crate) fn learn(&mut self, scheme: &Scheme, step: f64, multipliers: &[f64]) {
        for (stage, predicted) in scheme.stages.iter().zip(&mut self.prediction.predicted) {
            self.unit.predict(&stage.prediction, predicted);
        }
        let [of_increments, of_multipliers] = &mut self.prediction.predictors;
        of_increments.learn(
            &self.increments,
            |stage| &self.prediction.predicted[stage],
            &self.options.tuning,
        );
        if self.unit.spins.is_empty() {
            of_multipliers.learn(&self.multipliers, |_| multipliers, &self.options.tuning);
            return;
        }
        let [start, stages @ ..] = &mut self.prediction.still[..] else { return };
        start.copy_from_slice(multipliers);
        self.unit.spins.turn_multipliers(start, [Axes::Body(0.0), Axes::Still]);
        for ((still, found), stage) in stages.iter_mut().zip(&self.multipliers).zip(&scheme.stages) {
            still.copy_from_slice(found);
            self.unit.spins.turn_multipliers(still, [Axes::Body(stage.abscissa * step), Axes::Still]);
        }
        of_multipliers.learn(stages, |_| start, &self.options.tuning);
    }

    /// Records how residuals are to be scaled for the tangent in use.
    pub(crate) fn note_scales(&mut self, layout: &Layout, scaled: &Scaled) {
        self.units.rows.fill(1.0);
        scaled.scale_residual(layout, &mut self.units.rows);
        self.tangent.scale(&mut self.units.rows);
        let quantities = &layout.quantities()[layout.coordinate_count()..];
        for (size, &quantity) in self.units.multipliers.iter_mut().zip(quantities) {
            *size = 1.0 / scaled.unit(quantity);
        }
    }

    /// From residuals in SI to right-hand sides of the tangent in use.
    pub(crate) fn row_factors(&self) -> &[f64] {
        &self.units.rows
    }

    /// Makes the next first guess from the scheme alone.
    pub(crate) fn forget_predictions(&mut self) {
        self.prediction.predictors.iter_mut().for_each(Predictor::forget);
    }

    /// Changes to steps that are `ratio` times as long. The prediction error of positions is of third order in the step size,
    /// that of multipliers of first order.
    pub(crate) fn rescale_predictions(&mut self, ratio: f64) {
        let [of_increments, of_multipliers] = &mut self.prediction.predictors;
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
