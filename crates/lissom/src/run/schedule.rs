//! Ends of steps and the selection of records: planned instants at equal distances, or adaptive steps up to the next
//! mandatory instant. Independent of the system.

use lissom_model::lower::{Plan, Records};
use serde::{Deserialize, Serialize};

/// A remainder this close to a whole step, relative to the step, is a whole step.
const WHOLE: f64 = 1e-9;

/// The next step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Next {
    /// A step of this size [s], up to this instant [s].
    Planned { size: f64, end: f64 },
    /// A step of any size, not beyond this instant [s].
    Until(f64),
}

/// A record that is due.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Due {
    /// A record of this instant within the last step [s].
    Within(f64),
    /// A record of the end of the last step.
    End,
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
    /// The time reached, for adaptive steps, and the start of the last step [s].
    time: f64,
    from: f64,
    /// Samples of the last step that were looked at, and the last record [s].
    part: usize,
    last: f64,
}

impl Schedule {
    /// At the start of `plan`, with planned steps of `step_size` [s].
    pub(crate) fn new(plan: Plan, step_size: f64) -> Self {
        let (base, steps) = (plan.start, plan.steps);
        let [time, from, last] = [base; 3];
        Self {
            plan,
            step_size,
            base,
            steps,
            reached: 0,
            taken: 0,
            recorded: 0,
            time,
            from,
            part: usize::MAX,
            last,
        }
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

    /// Distance of records, if it is given [s].
    fn distance(&self) -> Option<f64> {
        match self.plan.records {
            Records::Ends(step) | Records::Within(step) => Some(step),
            Records::Every(_) | Records::Resolved { .. } => None,
        }
    }

    /// The next record at a `distance` [s], or the end [s].
    fn next_record(&self, distance: f64) -> f64 {
        let next = self.plan.start + (self.recorded + 1) as f64 * distance;
        if next >= self.plan.end - WHOLE * distance { self.plan.end } else { next }
    }

    /// Planned instants and records nearest to `time` [s], and the end [s].
    pub(crate) fn next_instants(&self, time: f64) -> impl Iterator<Item = f64> {
        let nearest =
            move |(base, distance): (f64, f64)| base + ((time - base) / distance).round() * distance;
        let planned = (!self.plan.is_controlled).then_some((self.base, self.step_size));
        let records = self.distance().map(|distance| (self.plan.start, distance));
        planned.into_iter().chain(records).map(nearest).chain([self.plan.end])
    }

    /// The next step.
    pub(crate) fn next(&self) -> Next {
        if self.plan.is_controlled {
            return Next::Until(match self.plan.records {
                Records::Ends(distance) => self.next_record(distance),
                _ => self.plan.end,
            });
        }
        let whole = if self.reached + 1 < self.steps {
            self.step_size
        } else {
            let rest = self.plan.end - self.planned(self.reached);
            if (rest - self.step_size).abs() <= WHOLE * self.step_size { self.step_size } else { rest }
        };
        Next::Planned { size: whole, end: self.planned(self.reached + 1) }
    }

    /// Accepts a step that ends at `time` [s]; [`due`](Self::due) then has its records.
    pub(crate) fn accept(&mut self, time: f64) {
        self.taken += 1;
        self.reached += 1;
        (self.from, self.time, self.part) = (self.time, time, 0);
    }

    /// The next record of the last step.
    pub(crate) fn due(&mut self) -> Option<Due> {
        match self.plan.records {
            Records::Every(steps) => {
                let is_new = std::mem::replace(&mut self.part, usize::MAX) == 0;
                (is_new && self.taken.is_multiple_of(steps)).then_some(Due::End)
            }
            Records::Ends(distance) | Records::Within(distance) => {
                let next = self.next_record(distance);
                let same = WHOLE * distance;
                if next > self.time + same || next <= self.last {
                    return None;
                }
                self.recorded += 1;
                self.last = next;
                Some(if next < self.time - same { Due::Within(next) } else { Due::End })
            }
            Records::Resolved { per_step, least } => {
                while self.part < per_step {
                    self.part += 1;
                    let is_end = self.part == per_step;
                    let share = self.part as f64 / per_step as f64;
                    let time = if is_end { self.time } else { self.from + share * (self.time - self.from) };
                    if time - self.last >= least {
                        self.last = time;
                        return Some(if is_end { Due::End } else { Due::Within(time) });
                    }
                }
                None
            }
        }
    }

    /// Records a step to `time` [s] outside the plan: planned steps continue from there.
    pub(crate) fn divert(&mut self, time: f64) {
        self.taken += 1;
        (self.from, self.time, self.part) = (time, time, usize::MAX);
        self.base = time;
        self.reached = 0;
        let rest = ((self.plan.end - time) / self.step_size - 1e-6).ceil();
        self.steps = if rest > 0.0 { rest as usize } else { 0 };
        if let Some(distance) = self.distance() {
            self.recorded = ((time - self.plan.start) / distance + WHOLE).floor().max(0.0) as usize;
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/run/schedule.rs"]
mod tests;
