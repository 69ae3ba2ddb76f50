//! Likely cause of a failed step, from the present state.

use crate::errors::StepError;
use crate::errors::step_error::{
    FOR_MANY_TOUCHES, NO_PART_CONVERGES, NO_PART_IS_FINITE, SOFTER, STEPS_THAT_END_THERE,
};
use crate::judge::degenerate_joint;
use crate::kinematics::{LOCKED, NodeId, Quantity, Subject};
use crate::settings::Problem;
use crate::simulation::Simulation;
use crate::spin::MAX_TURN;

/// Velocities beyond those of any machine: the speed of light [m/s], and about ten times the fastest rotors [rad/s]. The steps that
/// resolve a diverging motion become shorter without end.
const MAX_RATES: [f64; 2] = [3e8, 1e6];

impl Simulation {
    /// Fails if a velocity at the end of the attempt is beyond that of any machine.
    pub(crate) fn check_divergence(&self) -> Result<(), StepError> {
        let (layout, at) = (self.system.layout(), &self.attempt.end.kinematics);
        let excess = |(row, rate): (usize, f64)| match layout.quantities()[row] {
            Quantity::Length => (rate.abs() / MAX_RATES[0], row, rate),
            Quantity::Angle => (rate.abs() / MAX_RATES[1], row, rate),
            Quantity::State => (0.0, row, rate),
        };
        let of_coordinates = layout.coordinate_rows.iter().zip(&at.coordinates);
        let of_coordinates = of_coordinates.map(|(&row, own)| (row as usize, own.rate));
        let of_nodes = layout.node_rows.iter().zip(&at.nodes);
        let of_nodes = of_nodes.flat_map(|(rows, node)| rows.iter().copied().zip(node.twist.iter().copied()));
        let of_nodes = of_nodes.filter(|&(row, _)| row != LOCKED).map(|(row, rate)| (row as usize, rate));
        let beyond = |own: &(f64, usize, f64)| own.0 > 1.0;
        let of_joint = of_coordinates.map(excess).max_by(|a, b| a.0.total_cmp(&b.0));
        let fastest = of_joint.filter(beyond).or_else(|| {
            let of_node = of_nodes.map(excess).find(beyond)?;
            // A joint is named rather than the parts that it moves.
            of_joint.filter(|own| own.0 > 0.1).or(Some(of_node))
        });
        fastest.map_or(Ok(()), |(_, row, rate)| {
            let fastest = layout.subject_of(row);
            Err(StepError::Diverges { time: at.time, fastest, rate: rate.abs() })
        })
    }

    /// Replaces the failure of a step by its likely cause: a joint or a closed loop close to a singularity, or a switching force.
    /// `no_part` is true if the shortest parts of the step were tried too.
    pub(crate) fn with_cause(&mut self, error: StepError, no_part: bool) -> StepError {
        let time = match &error {
            StepError::NotConverged { time, .. }
            | StepError::NotFinite { time, .. }
            | StepError::ZeroPivot { time, after_pivoting: true, .. } => *time,
            _ => return error,
        };
        let (at, length) = (&self.state.kinematics, self.integrator.representative.length);
        if let Some((node, angle)) = self.turns_in_a_part() {
            return StepError::TurnsTooFar { time, node, angle };
        }
        if let Some(found) = degenerate_joint::rank_loss(&self.system, &self.origin.kinematics, at, length) {
            let degenerate_joint::RankLoss { joint, kind, equation, angle } = found;
            return StepError::JointLosesHold { time, joint, kind, equation, angle: angle.to_degrees() };
        }
        let problem = Problem { system: &self.system, settings: &self.settings };
        if let Some(cause) = self.monitors.cause(problem, at, time) {
            return cause;
        }
        if let Some(multiplier) = self.integrator.work.redundancy.singular() {
            let layout = self.system.layout();
            let unknown = layout.subject_of(layout.coordinate_count() + multiplier);
            return StepError::ConstraintsDependent {
                time,
                size: self.integrator.scaled.step_size(),
                unknown,
            };
        }
        if !self.settings.scheme.dynamic {
            return error;
        }
        if no_part && let Some(what) = self.switching() {
            let is_planned = self.settings.control.is_none();
            let hint = if is_planned { STEPS_THAT_END_THERE } else { SOFTER };
            return StepError::Switches { time, what, hint };
        }
        match error {
            StepError::NotConverged { time, iterations, correction, worst, hint } => {
                let hint = self.hint(if no_part { NO_PART_CONVERGES } else { hint });
                StepError::NotConverged { time, iterations, correction, worst, hint }
            }
            StepError::NotFinite { time, iterations, worst, .. } if no_part => {
                StepError::NotFinite { time, iterations, worst, hint: NO_PART_IS_FINITE }
            }
            other => other,
        }
    }

    /// What to try when a step fails: another scheme if parts touch at several points, otherwise the `usual`.
    pub(crate) fn hint(&self, usual: &'static str) -> &'static str {
        let (at, first) = (&self.state.kinematics, self.system.signals().first_side());
        // Contacts are idle on the lower branches of their switches.
        let mut apart = at.clone();
        apart.held[first..].fill(-1.0);
        let laws = self.system.elements_with(|own| own.laws);
        let mut touching = laws.filter(|own| own.is_idle(&apart) && !own.is_idle(at));
        if touching.nth(1).is_some() { FOR_MANY_TOUCHES } else { usual }
    }

    /// The switch whose branch changes between the state and the last iterate, if any. Steps of planned size do not iterate branches.
    fn switching(&self) -> Option<Subject> {
        let reached = &self.integrator.work.motions.last()?.at;
        let [before, after] = [&self.state.kinematics, reached].map(|at| {
            let mut values = Vec::new();
            self.system.signals().switches(at, &mut values);
            self.system.switches(at, &mut values);
            values
        });
        let has_switched = |which: &usize| {
            let [before, after] = [before[*which], after[*which]];
            before.number * after.number != 0.0 && before.side() != after.side()
        };
        let which = (0..before.len().min(after.len())).find(has_switched)?;
        Some(self.system.name_of_switch(which))
    }

    /// The node that rotates by more than any step resolves in the shortest part of a step that was tried, and the angle [rad].
    fn turns_in_a_part(&self) -> Option<(String, f64)> {
        if !self.settings.scheme.dynamic {
            return None;
        }
        let spins = &self.integrator.work.unit.spins;
        let turning = |node: NodeId| spins.turning(node, &self.state.kinematics.nodes[node].twist).sqrt();
        let nodes = self.system.layout().nodes();
        let fastest = nodes.max_by(|&a, &b| turning(a).total_cmp(&turning(b)))?;
        let angle = turning(fastest) * self.integrator.scaled.step_size();
        let name = || self.system.layout().name_of_node(fastest).to_owned();
        (angle > MAX_TURN).then(|| (name(), angle))
    }
}

/// The more specific of two failures, of a step and of a part of it: the first, unless it reports only missing convergence and
/// the later one a reason.
pub(crate) fn more_specific(first: Option<StepError>, later: StepError) -> StepError {
    let is_generic =
        |error: &StepError| matches!(error, StepError::NotConverged { .. } | StepError::NotFinite { .. });
    match first {
        // Parts that rotate too far for a step are a consequence.
        Some(StepError::TurnsTooFar { .. }) if matches!(later, StepError::Diverges { .. }) => later,
        Some(first) if !is_generic(&first) || is_generic(&later) => first,
        _ => later,
    }
}
