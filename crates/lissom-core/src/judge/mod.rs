//! Checks a solved step: whether the solution of its equations is a valid motion. Independent of the scheme and the
//! step size.
//!
//! A solution of the discrete equations can be wrong. Contradictory constraints leave a violation, angles beyond half
//! a turn are ambiguous, and a surplus of energy shows that the step left its branch or that the scheme excites
//! motions which it does not resolve.

pub(crate) mod degenerate_joint;
pub(crate) mod start;

use std::f64::consts::PI;

use crate::consistent::redundancy::{GEOMETRIC_TOLERANCE, Redundancy};
use crate::elements::{LimitKind, Place};
use crate::energy_balance::{EnergyBalance, StepWork};
use crate::errors::{MAX_LISTED, StepError, Warning};
use crate::kinematics::{GROUND, Kinematics, NodeId, Quantity, Subject};
use crate::round_off;
use crate::scaling::Representative;
use crate::settings::Problem;
use crate::spin::{MAX_TURN, Spins};
use crate::system::{State, System};

/// Violation at which a constraint is not satisfied, relative to the representative length, or in radians. Solutions leave some 1e-14.
const MAX_VIOLATION: f64 = 1e-5;
/// Violation of redundant constraints: ten times the geometric tolerance to which they may depend on others, which may grow in a motion.
const MAX_MISFIT: f64 = 10.0 * GEOMETRIC_TOLERANCE;
/// Violation above which a warning is given, relative to the representative length, or in radians. Rates of constraints that remain
/// at the start above this fraction of the largest one contradict each other.
const NOTEWORTHY_VIOLATION: f64 = 1e-6;
/// Relative rotation of an element's nodes, as a fraction of half a turn, above which it cannot be distinguished from the
/// opposite one.
const MAX_RELATIVE_TURN: f64 = 0.9;

/// Checks steps of one simulation.
pub(crate) struct Judge<'a> {
    pub(crate) system: &'a System,
    pub(crate) representative: &'a Representative,
    pub(crate) redundancy: &'a Redundancy,
    /// Whether the problem is a motion, not a sequence of equilibria.
    pub(crate) is_motion: bool,
    /// Whether spurious energy fails the step.
    pub(crate) checks_energy: bool,
    /// What to change where steps do not resolve the motion.
    remedy: &'static str,
    /// Nodes whose rotation about an axis steps need not resolve.
    spins: &'a Spins,
}

impl<'a> Judge<'a> {
    /// Checks steps of a model.
    pub(crate) fn new(
        Problem { system, settings }: Problem<'a>,
        representative: &'a Representative,
        (redundancy, spins): (&'a Redundancy, &'a Spins),
    ) -> Self {
        let (is_motion, checks_energy) = (settings.scheme.dynamic, settings.energy_check);
        let remedy = settings.resolution_remedy(!system.contacts().is_empty());
        Self { system, representative, redundancy, is_motion, checks_energy, remedy, spins }
    }
}

impl Judge<'_> {
    /// Checks the step from `start` to `end`, in which loads and drives did this `work`. Returns the energy balance after it, and the
    /// largest violation of a constraint, relative to the representative length, or in radians.
    ///
    /// # Errors
    /// If the end of the step is invalid.
    pub(crate) fn examine(
        &self,
        (start, end): (&State, &State),
        work: StepWork,
        energy_balance: &EnergyBalance,
    ) -> Result<(EnergyBalance, f64), StepError> {
        let violation = self.constraints(end)?;
        self.sliders(end)?;
        ropes(self.system, &end.kinematics)?;
        if self.is_motion {
            positive_mass(self.system, &end.kinematics)?;
        }
        if let Some(degenerate_joint::RankLoss { joint, kind, equation, angle }) =
            degenerate_joint::crossed(self.system, &start.kinematics, &end.kinematics)
        {
            let (time, angle) = (end.kinematics.time, angle.to_degrees());
            return Err(StepError::JointLosesHold { time, joint, kind, equation, angle });
        }
        let is_smooth = self.is_motion && self.turns(start, end)?;
        let weighs = !is_smooth || energy_balance.is_due();
        if weighs {
            relative_turns(self.system, &end.kinematics)?;
            overlaps(self.system, &end.kinematics)?;
        }
        let after =
            energy_balance.after(self.system, (&start.into(), &end.into()), work, (weighs, self.is_motion));
        if self.checks_energy && self.is_motion {
            let node = || self.most_restless(start, end);
            after.refuse_gain(energy_balance, end.kinematics.time, (node, self.remedy))?;
        }
        Ok((after, violation))
    }

    /// Name of the node whose velocity changes most; a rotation counts as the arc at the representative length.
    fn most_restless(&self, start: &State, end: &State) -> String {
        let length = self.representative.length;
        let change = |node: NodeId| {
            let change = end.kinematics.nodes[node].twist - start.kinematics.nodes[node].twist;
            change.fixed_rows::<3>(0).norm().max(length * change.fixed_rows::<3>(3).norm())
        };
        let nodes = self.system.layout().nodes();
        let most = nodes.max_by(|&a, &b| change(a).total_cmp(&change(b))).unwrap_or(GROUND);
        self.system.layout().name_of_node(most).to_owned()
    }

    /// Fails if constraints are violated by more than the error of the solution or, where they are redundant, by more than the geometric
    /// tolerance: they contradict each other. Returns the largest violation.
    fn constraints(&self, end: &State) -> Result<f64, StepError> {
        let limit = if self.redundancy.omitted().is_empty() { MAX_VIOLATION } else { MAX_MISFIT };
        let worst = self.violations(end).fold(0.0_f64, f64::max);
        if worst <= limit {
            return Ok(worst);
        }
        let (violated, others) = self.names_of_violated(end, worst);
        Err(self.contradiction(end.kinematics.time, violated, &others))
    }

    fn contradiction(&self, time: f64, violated: Subject, others: &Subject) -> StepError {
        let mut drives = self.system.constraints().filter(|own| own.may_depend_on_time());
        let reason = match (drives.next(), drives.next()) {
            (None, _) => "their geometry does not fit, so that nothing can move farther",
            (Some(_), None) => "the drive prescribes a position that the joints do not allow",
            (Some(_), Some(_)) => {
                "a drive prescribes a position that the joints do not allow, or two drives prescribe different ones"
            }
        };
        StepError::Contradiction { time, violated, reason: format!("{others}: {reason}") }
    }

    /// Reports redundant constraints that are violated by more than the error of the solution, and by less than the limit of failure.
    pub(crate) fn misfit(&self, end: &State, worst: f64) -> Option<Warning> {
        let (violated, others) =
            (worst > NOTEWORTHY_VIOLATION).then(|| self.names_of_violated(end, worst))?;
        Some(Warning::RedundantMisfit { time: end.kinematics.time, violated, others })
    }

    /// Violations relative to the representative length, or in radians.
    fn violations<'e>(&'e self, end: &'e State) -> impl Iterator<Item = f64> + 'e {
        self.system.layout().relative_violations(&end.violations, self.representative.length)
    }

    /// Quantities of the constraints.
    fn quantities(&self) -> &[Quantity] {
        let layout = self.system.layout();
        &layout.quantities()[layout.coordinate_count()..]
    }

    /// The most violated constraints with their violations, and those on which they depend.
    fn names_of_violated(&self, end: &State, worst: f64) -> (Subject, Subject) {
        let mut named: Vec<(f64, usize)> =
            self.violations(end).enumerate().map(|(k, size)| (size, k)).collect();
        // Constraints with equal violations are listed in the model's order, not by their last digits.
        let rank = |size: f64| (20.0 * size / worst).round();
        named.sort_by(|a, b| rank(b.0).total_cmp(&rank(a.0)));
        let mut violated: Vec<Subject> = Vec::new();
        for &(_, k) in named.iter().filter(|(size, _)| *size > 0.1 * worst).take(MAX_LISTED) {
            violated.push(self.name_of_violated(k, end.violations[k]));
        }
        let others = named.first().map(|&(_, k)| self.redundancy.joints_around(self.system, k));
        let others = others.filter(|others| others.entry().is_some());
        (Subject::list(violated), others.unwrap_or_else(|| Subject::nameless("other constraints")))
    }

    /// A constraint's equation with its violation.
    fn name_of_violated(&self, k: usize, violation: f64) -> Subject {
        let (joint, equation) = self.system.layout().constraint_name(k);
        let unit = match self.quantities()[k] {
            Quantity::Length => "m",
            Quantity::Angle => "rad",
            Quantity::State => "",
        };
        let words =
            format!("`{joint}` ({equation}) by {:.3e} {unit}", crate::number::Written(violation.abs()));
        Subject::new("joint", joint).called(words)
    }

    /// Fails if a slider has left the end of its beam.
    fn sliders(&self, end: &State) -> Result<(), StepError> {
        for slider in self.system.sliders() {
            let (place, length) = (end.kinematics.coordinates[slider.coordinate].value, slider.length());
            let beyond = (place - length).max(-place);
            if beyond > round_off::EQUILIBRIUM * length {
                let (time, joint) = (end.kinematics.time, slider.name.clone());
                return Err(StepError::BeyondBeam { time, joint, place, length });
            }
        }
        Ok(())
    }

    /// Fails if a node rotates by more than a step resolves. Returns whether the motion is smooth: no velocity changes by
    /// half of the largest.
    fn turns(&self, start: &State, end: &State) -> Result<bool, StepError> {
        let elapsed = end.kinematics.time - start.kinematics.time;
        let (mut fastest, mut node) = (0.0_f64, GROUND);
        let (mut largest, mut change) = ([0.0_f64; 2], [0.0_f64; 2]);
        for (id, (from, to)) in NodeId::enumerate(start.kinematics.nodes.iter().zip(&end.kinematics.nodes)) {
            let turning = self.spins.turning(id, &to.twist);
            if turning > fastest {
                (fastest, node) = (turning, id);
            }
            let difference = self.spins.seen_from_start(id, elapsed, &to.twist) - from.twist;
            largest = [largest[0].max(to.twist.fixed_rows::<3>(0).norm_squared()), largest[1].max(turning)];
            change = [
                change[0].max(difference.fixed_rows::<3>(0).norm_squared()),
                change[1].max(difference.fixed_rows::<3>(3).norm_squared()),
            ];
        }
        let angle = fastest.sqrt() * elapsed;
        if angle <= MAX_TURN {
            // In smooth motion velocities change by less than half of the largest.
            return Ok((0..2).all(|k| change[k] <= 0.25 * largest[k]));
        }
        let node = self.system.layout().name_of_node(node).to_owned();
        Err(StepError::TurnsTooFar { time: end.kinematics.time, node, angle })
    }
}

/// Fails if the kinetic energy of an element is negative in some motion: its equations are unstable there.
fn positive_mass(system: &System, at: &Kinematics) -> Result<(), StepError> {
    let found = system.elements_with(|own| own.inertia).find(|element| !element.has_positive_mass(at));
    let Some(&node) = found.and_then(|element| element.unknowns().nodes.first()) else { return Ok(()) };
    let interface = system.layout().name_of_node(node).to_owned();
    Err(StepError::NegativeKineticEnergy { time: at.time, interface })
}

/// Fails if sections of a beam overlap.
fn overlaps(system: &System, at: &Kinematics) -> Result<(), StepError> {
    let beam = system.beams.overlapping(at);
    beam.map_or(Ok(()), |beam| Err(StepError::SectionsOverlap { time: at.time, beam: beam.to_owned() }))
}

/// Fails if a rope under tension no longer lies on one of its sheaves.
fn ropes(system: &System, at: &Kinematics) -> Result<(), StepError> {
    let Some((rope, beyond)) = system.exceeded((LimitKind::Sheave, 1.0), [at; 2]) else { return Ok(()) };
    let Place::Point(index, how) = beyond.place else { return Ok(()) };
    let parts = system.parts_of(rope).join("` and `");
    Err(StepError::OffSheave { time: at.time, parts, point: index + 1, how })
}

/// Fails if two nodes of an element are rotated relative to each other by nearly half a turn or more.
pub(crate) fn relative_turns(system: &System, at: &Kinematics) -> Result<(), StepError> {
    let pairs =
        system.elements_with(|own| own.deformation).filter_map(|element| element.max_relative_rotation(at));
    let most = pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least });
    let Some((cosine, [one, other])) = most else { return Ok(()) };
    if cosine >= (0.5 * MAX_RELATIVE_TURN * PI).cos() {
        return Ok(());
    }
    let layout = system.layout();
    Err(StepError::ElementTurns {
        time: at.time,
        nodes: [one, other].map(|node| layout.name_of_node(node).to_owned()),
        turns: 2.0 * cosine.clamp(0.0, 1.0).acos() / PI,
    })
}
