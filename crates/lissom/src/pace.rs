//! How long the next step is: from one planned instant to the next, in dynamics at once, in statics in
//! halves where a step fails. Knows no system.

use lissom_model::lower::Plan;

/// Smallest parts a planned load step may be cut into: twelve halvings.
const PARTS: u32 = 1 << 12;
/// After so many easy steps in a row the step grows again.
const EASY_STEPS: u32 = 3;
/// A remainder this close to a whole step, relative to the step, is one.
const WHOLE: f64 = 1e-9;

/// The place between two planned instants. Places are whole multiples of the current step's size, so that
/// every planned instant is met exactly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pace {
    plan: Plan,
    step_size: f64,
    /// Planned instants reached, the start not counted.
    reached: usize,
    /// Parts done of the way to the next planned instant.
    part: u32,
    /// Parts in the next step.
    size: u32,
    easy: u32,
}

impl Pace {
    /// At the start of `plan`, with planned steps of `step_size` [s].
    pub(crate) fn new(plan: Plan, step_size: f64) -> Self {
        Self { plan, step_size, reached: 0, part: 0, size: PARTS, easy: 0 }
    }

    pub(crate) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Planned instants reached, the start not counted.
    pub(crate) fn reached(&self) -> usize {
        self.reached
    }

    /// Whether it stands at a planned instant.
    pub(crate) fn is_at_planned(&self) -> bool {
        self.part == 0
    }

    pub(crate) fn is_finished(&self) -> bool {
        self.reached >= self.plan.steps
    }

    /// Time [s], free of the round-off of many additions.
    pub(crate) fn time(&self) -> f64 {
        let from = self.planned(self.reached);
        if self.part == 0 {
            return from;
        }
        let fraction = f64::from(self.part) / f64::from(PARTS);
        from + fraction * (self.planned(self.reached + 1) - from)
    }

    /// A planned instant [s].
    fn planned(&self, index: usize) -> f64 {
        if index >= self.plan.steps { self.plan.end } else { self.plan.start + index as f64 * self.step_size }
    }

    /// Size of the next step [s].
    pub(crate) fn next_size(&self) -> f64 {
        let whole = if self.reached + 1 < self.plan.steps {
            self.step_size
        } else {
            let rest = self.plan.end - self.planned(self.reached);
            if (rest - self.step_size).abs() <= WHOLE * self.step_size { self.step_size } else { rest }
        };
        whole * f64::from(self.size) / f64::from(PARTS)
    }

    /// The step was taken; `easy` if it may be longer next time.
    pub(crate) fn accept(&mut self, easy: bool) {
        self.part += self.size;
        if self.part >= PARTS {
            self.part = 0;
            self.reached += 1;
        }
        self.easy = if easy { self.easy + 1 } else { 0 };
        // A doubled step must end where whole doubled steps end.
        if self.easy >= EASY_STEPS && self.size < PARTS && self.part.is_multiple_of(2 * self.size) {
            self.size *= 2;
            self.easy = 0;
        }
    }

    /// The step failed. Whether it is to be tried again with half its size.
    pub(crate) fn refuse(&mut self) -> bool {
        self.easy = 0;
        if !self.plan.is_static || self.size == 1 {
            return false;
        }
        self.size /= 2;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(end: f64, steps: usize, is_static: bool) -> Plan {
        Plan { start: 0.5, end, steps, output_every: 1, is_static }
    }

    #[test]
    fn the_last_step_is_shorter_and_the_end_exact() {
        let mut pace = Pace::new(plan(1.55, 11, false), 0.1);
        let mut sum = 0.5;
        while !pace.is_finished() {
            let size = pace.next_size();
            sum += size;
            pace.accept(true);
            assert!((pace.time() - sum).abs() < 1e-14);
            assert!(pace.is_at_planned());
        }
        assert_eq!(pace.reached(), 11);
        assert_eq!(pace.time(), 1.55);
    }

    #[test]
    fn a_whole_last_step_keeps_its_size_to_the_bit() {
        let mut pace = Pace::new(Plan { start: 0.0, ..plan(0.3, 3, false) }, 0.1);
        for _ in 0..3 {
            assert_eq!(pace.next_size(), 0.1);
            pace.accept(true);
        }
        assert_eq!(pace.time(), 0.3);
        assert!(!pace.refuse(), "dynamics has fixed steps");
    }

    #[test]
    fn load_steps_halve_grow_back_and_meet_every_planned_instant() {
        let mut pace = Pace::new(plan(6.5, 6, true), 1.0);
        let mut met = Vec::new();
        let mut sizes = Vec::new();
        while !pace.is_finished() {
            let time = pace.time();
            let size = pace.next_size();
            // Between 1.6 and 1.9 nothing longer than 0.1 is possible.
            if size > 0.1 && time + size > 1.6 && time < 1.9 {
                assert!(pace.refuse());
                continue;
            }
            sizes.push(size);
            pace.accept(true);
            if pace.is_at_planned() {
                met.push(pace.time());
            }
        }
        assert_eq!(met, [1.5, 2.5, 3.5, 4.5, 5.5, 6.5]);
        assert!((sizes.iter().sum::<f64>() - 6.0).abs() < 1e-12);
        assert_eq!(sizes.iter().copied().fold(1.0, f64::min), 0.0625);
        assert_eq!(*sizes.last().unwrap(), 1.0, "{sizes:?}");
    }

    #[test]
    fn hard_steps_do_not_grow() {
        let mut pace = Pace::new(plan(2.5, 2, true), 1.0);
        assert!(pace.refuse());
        for _ in 0..4 {
            assert_eq!(pace.next_size(), 0.5);
            pace.accept(false);
        }
        assert!(pace.is_finished());
    }

    #[test]
    fn twelve_halvings_are_the_end() {
        let mut pace = Pace::new(plan(1.5, 1, true), 1.0);
        let halvings = (0..100).take_while(|_| pace.refuse()).count();
        assert_eq!(halvings, 12);
    }
}
