//! Ends of steps and the selection of records: planned instants at equal distances, or adaptive steps up to the next
//! mandatory instant. Independent of the system.

use lissom_model::lower::Plan;
use serde::{Deserialize, Serialize};

/// A remainder this close to a whole step, relative to the step, is a whole step.
const WHOLE: f64 = 1e-9;

/// The next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next {
    /// Of this size [s], up to this instant [s].
    Planned { size: f64, end: f64 },
    /// Of any size, not beyond this instant [s].
    Until(f64),
}

/// Progress of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Schedule {
    plan: Plan,
    step_size: f64,
    /// Reference time of planned instants, and step size from there to the end [s].
    base: f64,
    steps: usize,
    /// Planned instants reached since then.
    reached: usize,
    /// Steps done.
    taken: usize,
    /// Records at equal distances since the start.
    recorded: usize,
    /// For adaptive steps: the time reached [s].
    time: f64,
}

impl Schedule {
    /// At the start of `plan`, with planned steps of `step_size` [s].
    pub(crate) fn new(plan: Plan, step_size: f64) -> Self {
        let (base, steps) = (plan.start, plan.steps);
        Self { plan, step_size, base, steps, reached: 0, taken: 0, recorded: 0, time: base }
    }

    pub(crate) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Size of planned steps [s].
    pub(crate) fn step_size(&self) -> f64 {
        self.step_size
    }

    pub(crate) fn is_finished(&self) -> bool {
        if self.plan.is_controlled { self.time >= self.plan.end } else { self.reached >= self.steps }
    }

    /// Time [s], without the round-off of many additions.
    pub(crate) fn time(&self) -> f64 {
        if self.plan.is_controlled { self.time } else { self.planned(self.reached) }
    }

    /// Steps done and planned; for adaptive steps, thousandths of the time.
    pub(crate) fn done(&self) -> (usize, usize) {
        if self.plan.is_controlled {
            let share = (self.time - self.plan.start) / (self.plan.end - self.plan.start);
            ((1000.0 * share) as usize, 1000)
        } else {
            (self.taken, self.taken + self.steps - self.reached)
        }
    }

    /// A planned instant [s]; if a run was diverted beyond its end, that time.
    fn planned(&self, index: usize) -> f64 {
        if index >= self.steps {
            self.plan.end.max(self.base)
        } else {
            self.base + index as f64 * self.step_size
        }
    }

    /// The next record at an equal distance, or the end [s].
    fn next_record(&self) -> f64 {
        let of = |step: f64| self.plan.start + (self.recorded + 1) as f64 * step;
        self.plan.output_step.map_or(self.plan.end, |step| {
            let next = of(step);
            if next >= self.plan.end - WHOLE * step { self.plan.end } else { next }
        })
    }

    /// Planned instants and records nearest to `time` [s], and the end [s].
    pub(crate) fn next_instants(&self, time: f64) -> impl Iterator<Item = f64> {
        let nearest =
            move |(base, distance): (f64, f64)| base + ((time - base) / distance).round() * distance;
        let planned = (!self.plan.is_controlled).then_some((self.base, self.step_size));
        let records = self.plan.output_step.map(|step| (self.plan.start, step));
        planned.into_iter().chain(records).map(nearest).chain([self.plan.end])
    }

    /// The next step.
    pub(crate) fn next(&self) -> Next {
        if self.plan.is_controlled {
            return Next::Until(self.next_record());
        }
        let whole = if self.reached + 1 < self.steps {
            self.step_size
        } else {
            let rest = self.plan.end - self.planned(self.reached);
            if (rest - self.step_size).abs() <= WHOLE * self.step_size { self.step_size } else { rest }
        };
        Next::Planned { size: whole, end: self.planned(self.reached + 1) }
    }

    /// Records a step that ends at `time` [s]. Whether its end is a record.
    pub(crate) fn accept(&mut self, time: f64) -> bool {
        self.taken += 1;
        if self.plan.is_controlled {
            let is_at_record = time >= self.next_record();
            self.time = time;
            self.recorded += usize::from(is_at_record);
            return match self.plan.output_step {
                Some(_) => is_at_record,
                None => self.taken.is_multiple_of(self.plan.output_every),
            };
        }
        self.reached += 1;
        self.taken.is_multiple_of(self.plan.output_every)
    }

    /// Records a step to `time` [s] outside the plan: planned steps continue from there.
    pub(crate) fn divert(&mut self, time: f64) {
        self.taken += 1;
        self.time = time;
        self.base = time;
        self.reached = 0;
        let rest = ((self.plan.end - time) / self.step_size - 1e-6).ceil();
        self.steps = if rest > 0.0 { rest as usize } else { 0 };
        if let Some(step) = self.plan.output_step {
            self.recorded = ((time - self.plan.start) / step + WHOLE).floor().max(0.0) as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(end: f64, steps: usize) -> Plan {
        Plan {
            start: 0.5,
            end,
            steps,
            output_every: 1,
            is_static: false,
            is_controlled: false,
            output_step: None,
        }
    }

    fn size(schedule: &Schedule) -> f64 {
        match schedule.next() {
            Next::Planned { size, .. } => size,
            Next::Until(_) => panic!("steps are planned"),
        }
    }

    #[test]
    fn the_last_step_is_shorter_and_the_end_exact() {
        let mut schedule = Schedule::new(plan(1.55, 11), 0.1);
        let mut sum = 0.5;
        while !schedule.is_finished() {
            sum += size(&schedule);
            assert!(schedule.accept(sum));
            assert!((schedule.time() - sum).abs() < 1e-14);
        }
        assert_eq!(schedule.done(), (11, 11));
        assert_eq!(schedule.time(), 1.55);
    }

    #[test]
    fn a_whole_last_step_keeps_its_size_to_the_bit() {
        let mut schedule = Schedule::new(Plan { start: 0.0, ..plan(0.3, 3) }, 0.1);
        for _ in 0..3 {
            assert_eq!(size(&schedule), 0.1);
            schedule.accept(0.0);
        }
        assert_eq!(schedule.time(), 0.3);
    }

    #[test]
    fn chosen_steps_meet_every_record_and_the_end() {
        let controlled = Plan { is_controlled: true, output_step: Some(0.25), ..plan(1.6, 1) };
        let mut schedule = Schedule::new(controlled, 0.1);
        let mut met = Vec::new();
        while !schedule.is_finished() {
            let Next::Until(limit) = schedule.next() else { panic!("steps are chosen") };
            let time = (schedule.time() + 0.1).min(limit);
            if schedule.accept(time) {
                met.push(time);
            }
        }
        assert_eq!(met, [0.75, 1.0, 1.25, 1.5, 1.6]);
    }

    #[test]
    fn a_run_diverted_beyond_its_end_stands_there() {
        let mut schedule = Schedule::new(plan(1.5, 10), 0.1);
        schedule.divert(1.75);
        assert!(schedule.is_finished() && schedule.time() == 1.75);
    }

    #[test]
    fn planned_steps_go_on_from_where_a_run_was_diverted() {
        let mut schedule = Schedule::new(plan(1.5, 10), 0.1);
        schedule.accept(0.6);
        schedule.divert(0.73);
        let mut sizes = Vec::new();
        while !schedule.is_finished() {
            sizes.push(size(&schedule));
            schedule.accept(0.0);
        }
        assert_eq!(sizes.len(), 8);
        assert!((0.73 + sizes.iter().sum::<f64>() - 1.5).abs() < 1e-14);
    }
}
