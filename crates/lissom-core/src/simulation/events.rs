//! Steps that end at events and at switches of forces.

use super::event_detector::LocatedRoot;
use crate::errors::step_error::SMOOTHER;
use crate::errors::{MAX_LISTED, StepError, Warning, warn};
use crate::kinematics::Subject;
use crate::settings::{Problem, StepReport, Stopwatch};
use crate::signals::event::Occurrence;
use crate::simulation::Simulation;
use crate::simulation::recovery::Recovery;
use crate::simulation::signal_history::Break;
use crate::system::Need;

/// Maximum nesting depth of laws with levels whose arguments have levels themselves.
const MAX_NESTED_LEVELS: usize = 8;
/// Number of steps that end at laws from which these are reported, and their fraction of all steps.
const MIN_LAW_ENDS: usize = 1000;
const LAW_ENDS: f64 = 0.25;

/// Decision on an attempt that has a solution.
pub(crate) enum Verdict {
    /// It can be accepted, and ends at the root if there is one.
    Accept(Option<LocatedRoot>),
    /// A force switched at the start of the step: the attempt is repeated.
    Repeat,
    /// A shorter one is required.
    Shorten,
}

impl Simulation {
    /// The events that happened since the start, in their order.
    pub fn occurrences(&self) -> &[Occurrence] {
        &self.events.known.occurrences
    }

    /// Name of the event that ends the run, if the last step ended at one.
    pub fn stopped_by(&self) -> Option<&str> {
        let event = self.events.known.stopped_by?;
        Some(&self.system.signals().events()[event].name)
    }

    /// Checks an attempt of `size` [s] that was solved and can be accepted for zeros of switching functions. If one is within the
    /// step, the step is solved again to end there. If a force switches at the start of the step, its branch is changed, and the
    /// attempt and its error estimate have to be repeated.
    ///
    /// # Errors
    /// If the shorter step has no solution, or the motion slides along a switch.
    pub(crate) fn end_at_event(
        &mut self,
        size: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<Verdict, StepError> {
        if self.events.is_empty() {
            return Ok(Verdict::Accept(None));
        }
        let problem = Problem { system: &self.system, settings: &self.settings };
        let step = self.integrator.dense(problem, (&self.state, &self.attempt.end));
        let Some(mut located) = self.events.crossing(&self.system, step, size) else {
            return Ok(Verdict::Accept(None));
        };
        if located.size == 0.0 {
            if !self.events.switch_at_start(&located.indices) {
                return Err(self.chatters(located.indices[0]));
            }
            self.freeze_levels(&located.indices)?;
            self.integrator.work.forget_predictions();
            report.rejected += 1;
            return Ok(Verdict::Repeat);
        }
        let mut solved = size;
        while located.size != solved {
            report.rejected += 1;
            solved = located.size;
            self.attempt(solved, watch)?;
            let problem = Problem { system: &self.system, settings: &self.settings };
            let step = self.integrator.dense(problem, (&self.state, &self.attempt.end));
            if self.events.is_met(&self.system, step, &mut located) {
                break;
            }
        }
        let problem = Problem { system: &self.system, settings: &self.settings };
        let step = self.integrator.dense(problem, (&self.state, &self.attempt.end));
        self.events.join_simultaneous(&self.system, step, &mut located);
        Ok(Verdict::Accept(Some(located)))
    }

    /// Records which events happened at the end of an accepted step, and executes their actions.
    ///
    /// # Errors
    /// If signals switch repeatedly, or there are no consistent accelerations with the values that events set.
    pub(crate) fn after_events(
        &mut self,
        located: Option<&LocatedRoot>,
        longest: f64,
    ) -> Result<(), StepError> {
        if self.events.is_empty() {
            return Ok(());
        }
        if self.system.has_rigid_contacts() {
            self.report_missed_contacts();
            self.follow_contacts();
        }
        let happened = self
            .events
            .accept(&self.system, &self.state, located, longest)
            .map_err(|which| self.chatters(which))?;
        if located.is_some() {
            self.stops.history.add_break(Break::Slope);
            self.report_laws_that_end_steps();
        }
        self.note_indicators(&happened);
        self.freeze_levels(located.map_or(&[], |located| &located.indices))?;
        if happened.is_empty() {
            return self.check_sliding();
        }
        let graph = self.system.signals();
        let mut at = self.state.kinematics.clone();
        let mut sets = happened.iter().flat_map(|&event| &graph.events()[event].sets).peekable();
        if sets.peek().is_some() {
            // Rates are those that would be recorded. All signals are evaluated before any value is set.
            let mut recovery = Recovery::of(self);
            let recovered = recovery.as_mut().and_then(|recovery| {
                recovery.recover(Need::Forces, (&self.system, &self.state), self.attempt.size)
            });
            let read = recovered.map_or(&self.state, |recovered| &recovered.rates);
            for &(held, signal) in sets {
                at.held[held.index()] = graph.value(signal, &read.kinematics);
            }
        }
        let contacts = self.contacts_of(&happened);
        if at.held == self.state.kinematics.held && contacts.is_empty() {
            return Ok(());
        }
        graph.check(&at).map_err(StepError::Signal)?;
        let time = at.time;
        let changed = if contacts.is_empty() {
            self.change_held_values(at)
        } else {
            self.switch_constraints(&contacts, Some(at.held), [time; 2])
        };
        changed.map_err(|error| StepError::Velocities { time, error })?;
        self.events.renew(&self.system, &self.state, &happened);
        self.rearm_contacts();
        self.freeze_switches()
    }

    /// Freezes signals on the known branches of their switches, which may change forces by a jump.
    pub(crate) fn freeze_switches(&mut self) -> Result<(), StepError> {
        if self.events.has_frozen_switches(&self.system, &self.state.kinematics) {
            return Ok(());
        }
        let first = self.system.signals().first_side();
        let mut at = self.state.kinematics.clone();
        self.events.freeze_switches(&self.system, &mut at);
        let pairs = || at.held[first..].iter().zip(&self.state.kinematics.held[first..]);
        if pairs().all(|(side, held)| side == held || *held == 0.0) {
            // Branches that become known change nothing else.
            self.state.kinematics = at;
            return Ok(());
        }
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })
    }

    /// Freezes switches after some have passed zero, and updates laws that depend on those whose level has changed.
    fn freeze_levels(&mut self, passed: &[usize]) -> Result<(), StepError> {
        let mut has_jumped = self.events.have_levels(passed);
        self.freeze_switches()?;
        for _ in 0..MAX_NESTED_LEVELS {
            if !has_jumped {
                break;
            }
            has_jumped = self.events.follow_levels(&self.system, &self.state);
            self.freeze_switches()?;
        }
        Ok(())
    }

    /// The kinks and jumps of forces at which most steps have ended, at most `count`, with the numbers of these steps.
    pub fn laws_that_end_steps(&self, count: usize) -> Vec<(Subject, usize)> {
        let mut found: Vec<(Subject, usize)> = Vec::new();
        for (switch, &steps) in self.events.known.ended().iter().enumerate().filter(|(_, steps)| **steps > 0)
        {
            let subject = self.system.name_of_switch(switch);
            match found.iter_mut().find(|(known, _)| *known == subject) {
                Some((_, sum)) => *sum += steps,
                None => found.push((subject, steps)),
            }
        }
        found.sort_by_key(|(_, steps)| std::cmp::Reverse(*steps));
        found.truncate(count);
        found
    }

    /// Reports laws of signals and local loads at which many steps end; contacts and stops end steps by their nature.
    fn report_laws_that_end_steps(&mut self) {
        // The names of all switches are found a few times in a run.
        if !self.events.known.is_examination_due(MIN_LAW_ENDS) {
            return;
        }
        let mut laws = self.laws_that_end_steps(usize::MAX);
        laws.retain(|(subject, _)| !subject.kind.is_empty());
        let (ended, steps) =
            (laws.iter().map(|(_, steps)| steps).sum::<usize>(), self.report.totals.steps + 1);
        if (ended as f64) < LAW_ENDS * steps as f64 || ended < MIN_LAW_ENDS {
            return;
        }
        let words = laws.iter().take(MAX_LISTED).map(|(law, steps)| format!("{law} ({steps})"));
        let laws = Subject::nameless(words.collect::<Vec<_>>().join(", "));
        let time = self.state.kinematics.time;
        warn(&mut self.report.warnings, Warning::LawsEndSteps { time, ended, steps, laws });
    }

    fn chatters(&self, which: usize) -> StepError {
        let events = self.system.signals().events();
        let what = events.get(which).map_or_else(
            || self.system.name_of_switch(which - events.len()),
            |event| Subject::new("event", &event.name),
        );
        StepError::Chatters { time: self.state.kinematics.time, what, hint: self.hint(SMOOTHER) }
    }
}
