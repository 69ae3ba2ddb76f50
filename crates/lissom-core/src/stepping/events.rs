//! Steps that end at events and where forces switch.

use super::event_detector::LocatedRoot;
use crate::analysis::{Simulation, StepError, StepReport, Stopwatch, warn};
use crate::judge::Warning;
use crate::newton::Outcome;
use crate::signals::event::Occurrence;

/// An attempt that was checked for zeros of switching functions.
pub(super) enum Checked {
    /// It can be accepted, and ends at the zero if there is one.
    Accepted(Outcome, Option<LocatedRoot>),
    /// A force switched at the start of the step: the attempt has to be repeated.
    SwitchedAtStart,
}

impl Simulation {
    /// The events that happened since the start, in their order.
    pub fn occurrences(&self) -> &[Occurrence] {
        &self.event_detector.known.occurrences
    }

    /// Name of the event at which the run is to end, if the last step ended at one.
    pub fn stopped_by(&self) -> Option<&str> {
        let event = self.event_detector.known.stopped_by?;
        Some(&self.system.signals().events()[event].name)
    }

    /// Checks an attempt of `size` [s] that was solved and can be accepted for zeros of switching functions. If one is within the
    /// step, the step is solved anew to end there. If a force switches at the start of the step, its side is changed, and the
    /// attempt has to be repeated, with its error estimate: it was made with the force of the other side.
    ///
    /// # Errors
    /// If the shorter step has no solution, or the motion slides along a switch.
    pub(super) fn end_at_event(
        &mut self,
        (size, mut outcome): (f64, Outcome),
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<Checked, StepError> {
        if self.event_detector.is_empty() {
            return Ok(Checked::Accepted(outcome, None));
        }
        let Some(mut located) = self.event_detector.crossing(&self.system, (&self.state, &self.next), size)
        else {
            return Ok(Checked::Accepted(outcome, None));
        };
        if located.size == 0.0 {
            if !self.event_detector.switch_at_start(&located.indices) {
                return Err(self.chatters(located.indices[0]));
            }
            self.freeze_switches()?;
            self.work.forget_predictions();
            report.rejected += 1;
            return Ok(Checked::SwitchedAtStart);
        }
        let mut solved = size;
        while located.size != solved {
            report.rejected += 1;
            solved = located.size;
            outcome = self.attempt(solved, watch)?;
            if self.event_detector.is_met(&self.system, (&self.state, &self.next), &mut located) {
                break;
            }
        }
        Ok(Checked::Accepted(outcome, Some(located)))
    }

    /// After a step was accepted: notes which events happened at its end, and does what they ask for.
    ///
    /// # Errors
    /// If signals switch again and again, or there are no consistent accelerations with the values that events set.
    pub(super) fn after_events(
        &mut self,
        located: Option<&LocatedRoot>,
        longest: f64,
    ) -> Result<(), StepError> {
        if self.event_detector.is_empty() {
            return Ok(());
        }
        let happened = self
            .event_detector
            .accept(&self.system, &self.state, located, longest)
            .map_err(|which| self.chatters(which))?;
        self.freeze_switches()?;
        if happened.is_empty() {
            return Ok(());
        }
        let graph = self.system.signals();
        let mut at = self.state.kinematics.clone();
        for &event in &happened {
            // All of them see the values before any of them.
            for &(held, signal) in &graph.events()[event].sets {
                at.held[held] = graph.value(signal, &self.state.kinematics);
            }
        }
        if at.held == self.state.kinematics.held {
            return Ok(());
        }
        graph.check(&at).map_err(StepError::Signal)?;
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })?;
        self.event_detector.renew(&self.system, &self.state, &happened);
        self.freeze_switches()
    }

    /// Lets signals be continued from the sides of their switches that are known: forces may jump with them.
    pub(crate) fn freeze_switches(&mut self) -> Result<(), StepError> {
        if self.event_detector.has_frozen_switches(&self.system, &self.state.kinematics) {
            return Ok(());
        }
        let first = self.system.signals().first_side();
        let mut at = self.state.kinematics.clone();
        self.event_detector.freeze_switches(&self.system, &mut at);
        let pairs = || at.held[first..].iter().zip(&self.state.kinematics.held[first..]);
        if pairs().all(|(side, held)| side == held || *held == 0.0) {
            // Sides that become known change nothing.
            self.state.kinematics = at;
            return Ok(());
        }
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })
    }

    /// After a step of planned size that was accepted.
    pub(super) fn note_impacts(&mut self) {
        let found = self.impacts.accept(&self.system, &self.state.kinematics);
        let is_contact = |warning: &Warning| matches!(warning, Warning::ContactTooShort { .. });
        let known = self.warnings.iter().position(is_contact);
        match (found, known) {
            (Some((which, time)), None) => {
                let what = self.system.name_of_switch(which);
                warn(&mut self.warnings, Warning::ContactTooShort { time, what });
            }
            (None, Some(known)) => {
                self.warnings.remove(known);
            }
            _ => {}
        }
    }

    fn chatters(&self, which: usize) -> StepError {
        let events = self.system.signals().events();
        let what = events.get(which).map_or_else(
            || self.system.name_of_switch(which - events.len()),
            |event| format!("event `{}`", event.name),
        );
        StepError::Chatters { time: self.state.kinematics.time, what }
    }
}
