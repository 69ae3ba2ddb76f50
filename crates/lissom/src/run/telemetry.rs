//! Data of every step about its tangent: condition, pivots, iterations. For long runs samples are merged, so that the
//! summary remains small, and the condition is estimated less and less often. Nothing depends on the clock: a resumed
//! run reports the same as an uninterrupted one.

use lissom_core::settings::StepReport;
use lissom_core::simulation::Simulation;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Maximum number of samples.
const MAX_SAMPLES: usize = 512;

/// One step, or several consecutive ones in a long run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number of the step, from 1.
    pub step: usize,
    /// Time at its end [s].
    pub time: f64,
    /// Condition number of the tangent in use, by its last estimate in the 1-norm.
    pub condition: Option<f64>,
    /// Smallest pivot over largest diagonal entry of the tangent factorised last.
    pub relative_pivot: Option<f64>,
    /// Newton iterations since the last sample.
    pub iterations: usize,
    /// Tangents factorised since the last sample.
    pub factorizations: usize,
}

/// Samples over a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Telemetry {
    samples: Vec<Sample>,
    /// Number of steps per sample.
    every: usize,
    /// Iterations and tangents since the last sample.
    open: (usize, usize),
    /// The last estimate, and whether another tangent has been factorised since.
    condition: Option<f64>,
    is_stale: bool,
    range: Option<(f64, f64)>,
}

impl Default for Telemetry {
    fn default() -> Self {
        Self { samples: Vec::new(), every: 1, open: (0, 0), condition: None, is_stale: true, range: None }
    }
}

impl Telemetry {
    /// The samples, in the order of time.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Condition number of the tangent after the first step.
    pub fn first_condition(&self) -> Option<f64> {
        self.samples.first()?.condition
    }

    /// Smallest and largest condition number estimated.
    pub fn condition_range(&self) -> Option<(f64, f64)> {
        self.range
    }

    /// Whether recording the last step will estimate the condition of its tangent.
    pub(crate) fn will_estimate(&self, simulation: &Simulation, report: &StepReport) -> bool {
        (self.is_stale || report.factorizations > 0) && is_estimated(simulation.totals().steps)
    }

    fn is_due(&self, simulation: &Simulation) -> bool {
        let step = simulation.totals().steps;
        step == 1 || step.is_multiple_of(self.every)
    }

    /// Records a completed step.
    pub(crate) fn note(&mut self, simulation: &mut Simulation, report: &StepReport) {
        self.open.0 += report.iterations;
        self.open.1 += report.factorizations;
        self.is_stale |= report.factorizations > 0;
        let step = simulation.totals().steps;
        if self.is_stale && is_estimated(step) {
            self.estimate(simulation);
        }
        if !self.is_due(simulation) {
            return;
        }
        let (iterations, factorizations) = std::mem::take(&mut self.open);
        self.samples.push(Sample {
            step,
            time: simulation.state().kinematics.time,
            condition: self.condition,
            relative_pivot: simulation.relative_pivot(),
            iterations,
            factorizations,
        });
        if self.samples.len() >= MAX_SAMPLES {
            self.thin_out();
        }
    }

    fn estimate(&mut self, simulation: &mut Simulation) {
        if let Some(value) = simulation.condition_estimate() {
            self.condition = Some(value);
            let (least, most) = self.range.unwrap_or((value, value));
            self.range = Some((least.min(value), most.max(value)));
            self.is_stale = false;
        }
    }

    /// Merges pairs of samples.
    fn thin_out(&mut self) {
        self.every *= 2;
        let mut kept: Vec<Sample> = Vec::with_capacity(MAX_SAMPLES);
        let (mut iterations, mut factorizations) = (0, 0);
        for sample in &self.samples {
            iterations += sample.iterations;
            factorizations += sample.factorizations;
            if sample.step == 1 || sample.step.is_multiple_of(self.every) {
                kept.push(Sample { iterations, factorizations, ..*sample });
                (iterations, factorizations) = (0, 0);
            }
        }
        self.open.0 += iterations;
        self.open.1 += factorizations;
        self.samples = kept;
    }

    /// As columns for the summary.
    pub fn to_json(&self) -> Value {
        let column = |of: fn(&Sample) -> Value| self.samples.iter().map(of).collect::<Value>();
        json!({
            "every": self.every,
            "step": column(|sample| json!(sample.step)),
            "time": column(|sample| json!(sample.time)),
            "condition_estimate": column(|sample| json!(sample.condition)),
            "relative_pivot": column(|sample| json!(sample.relative_pivot)),
            "newton_iterations": column(|sample| json!(sample.iterations)),
            "factorizations": column(|sample| json!(sample.factorizations)),
        })
    }
}

/// Whether the condition is estimated after this number of steps: after the first ones, then less and less often.
fn is_estimated(steps: usize) -> bool {
    steps <= 8 || steps.is_power_of_two()
}
