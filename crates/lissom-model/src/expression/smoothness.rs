//! Whether an expression has a kink or a jump, for relations between positions: their slopes are velocities, which cannot jump
//! without an impact. A switching function of the expression is followed along lines through the space of its arguments. At its
//! zeros value and gradient are compared, continued from both sides. Functions that switch but are smooth there pass, such as
//! `max(0, x)^3`.

use super::jet::{Function, Jet};
use super::program::{Step, run_continued};

/// Lines begin at distances from the origin of these powers of ten.
const DECADES: std::ops::RangeInclusive<i32> = -6..=6;
/// Intervals of a line in which a zero is searched.
const INTERVALS: usize = 32;
/// Halvings of such an interval.
const HALVINGS: usize = 60;
/// Lines in a general direction at each distance.
const GENERAL_LINES: usize = 4;
/// Differences of values and gradients below this fraction of those at the ends of the interval are round-off.
const ROUND_OFF: f64 = 1e-6;

/// Where an expression is not smooth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Kink {
    /// The variable there.
    pub(crate) variable: f64,
    /// The arguments there.
    pub(crate) arguments: Vec<f64>,
}

/// The first kink or jump that is found of steps with `count` arguments.
pub(super) fn first_kink(steps: &[Step], count: usize) -> Option<Kink> {
    let is_stepped = |step: &Step| {
        use Function::{Ceil, Floor, Mod, Normal, Random, Round};
        matches!(step, Step::Call(Floor | Ceil | Round) | Step::Call2(Mod | Random | Normal))
    };
    if steps.iter().any(is_stepped) {
        return Some(Kink { variable: f64::NAN, arguments: vec![f64::NAN; count] });
    }
    let of = Switched { steps, dimension: count + 1 };
    let mut lines = DECADES.flat_map(|decade| of.lines(10_f64.powi(decade)));
    lines.find_map(|line| of.kink_along(&line))
}

/// An expression over points of variable and arguments.
struct Switched<'s> {
    steps: &'s [Step],
    dimension: usize,
}

/// Start and direction of a line.
type Line = (Vec<f64>, Vec<f64>);

impl Switched<'_> {
    /// Lines of this length: along each axis and in general directions, not through the origin of the other axes.
    fn lines(&self, length: f64) -> Vec<Line> {
        // Multiples of the golden section have no simple relations between each other.
        let mut seed = 0.0_f64;
        let mut next = || {
            seed = (seed + 0.618_033_988_749_895).fract();
            2.0 * seed - 1.0
        };
        let mut lines = Vec::new();
        for axis in 0..self.dimension + GENERAL_LINES {
            let aside: Vec<f64> = (0..self.dimension).map(|_| 0.3 * length * next()).collect();
            let direction: Vec<f64> = (0..self.dimension)
                .map(|k| if axis >= self.dimension { next() } else { f64::from(u8::from(k == axis)) })
                .collect();
            let start = aside.iter().zip(&direction).map(|(aside, way)| {
                if axis < self.dimension && *way == 1.0 { -1.013 * length } else { aside - length * way }
            });
            lines.push((start.collect(), direction.iter().map(|way| 2.0 * length * way).collect()));
        }
        lines
    }

    fn kink_along(&self, line: &Line) -> Option<Kink> {
        let at = |share: f64| -> Vec<f64> {
            line.0.iter().zip(&line.1).map(|(start, way)| start + share * way).collect()
        };
        let (mut share, mut switches) = (0.0, self.switches(&at(0.0)));
        for k in 1..=INTERVALS {
            let end = k as f64 / INTERVALS as f64;
            let next = self.switches(&at(end));
            let changed = |i: &usize| (switches[*i] > 0.0) != (next[*i] > 0.0);
            for which in (0..next.len()).filter(changed) {
                let (mut low, mut high) = (share, end);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    let is_before = (self.switches(&at(middle))[which] > 0.0) == (switches[which] > 0.0);
                    if is_before { low = middle } else { high = middle }
                }
                let zero = at(high);
                let ends = [at(share), at(end)].map(|point| self.jets(&point, &[]));
                if self.is_kinked(&zero, which, &ends) {
                    return Some(Kink { variable: zero[0], arguments: zero[1..].to_vec() });
                }
            }
            (share, switches) = (end, next);
        }
        None
    }

    fn switches(&self, point: &[f64]) -> Vec<f64> {
        let mut found = Vec::new();
        let of = |index: usize| point[index + 1];
        run_continued(self.steps, point[0], of, &[], |switch| found.push(switch.number));
        found
    }

    /// The value, and the slope in each direction.
    fn jets(&self, point: &[f64], sides: &[f64]) -> Vec<f64> {
        let jet = |wanted: usize| {
            let of = |index: usize| {
                let value = point[index];
                if index == wanted { Jet::variable(value) } else { Jet::constant(value) }
            };
            run_continued(self.steps, of(0), |index| of(index + 1), sides, |_| ())
        };
        std::iter::once(jet(0).value).chain((0..self.dimension).map(|k| jet(k).first)).collect()
    }

    fn is_kinked(&self, zero: &[f64], which: usize, ends: &[Vec<f64>; 2]) -> bool {
        let mut sides: Vec<f64> =
            self.switches(zero).iter().map(|value| if *value > 0.0 { 1.0 } else { -1.0 }).collect();
        let [above, below] = [1.0, -1.0].map(|side| {
            sides[which] = side;
            self.jets(zero, &sides)
        });
        let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let largest = |range: std::ops::Range<usize>| {
            [&above, &below, &ends[0], &ends[1]]
                .map(|jets| size(&jets[range.clone()]))
                .into_iter()
                .fold(0.0, f64::max)
        };
        let differs = |range: std::ops::Range<usize>| {
            let allowed = ROUND_OFF * largest(range.clone());
            above[range.clone()].iter().zip(&below[range]).any(|(a, b)| (a - b).abs() > allowed)
        };
        differs(0..1) || differs(1..self.dimension + 1)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/expression/smoothness.rs"]
mod tests;
