//! Singular positions: where the constraints of a closed loop repeat each other though elsewhere they do not, as in a
//! parallelogram whose bars lie in one line. There a mechanism has one freedom more, and more than one way to go on.
//!
//! Seen are the pivots of the loop's B Bᵀ = L D Lᵀ, taken without exchange, each over its largest value so far. Near a
//! singular position one of them is a square of the way to it. It is followed from step to step there, and a parabola
//! through three of its values shows whether it vanishes between steps.
//!
//! Where constraints repeat each other everywhere, as in a planar four-bar of revolutes or in Bennett's linkage, an equation may come
//! to follow from those before it while one that followed from them does no more: a pivot vanishes, and no freedom comes. There the r
//! largest eigenvalues λ of B Bᵀ are taken in place of the pivots, with r independent equations, and of them 1/Σ 1/λ, which
//! is smooth along the motion and vanishes with the smallest.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::loops::{self, Gradient, Loop};
use crate::errors::Warning;
use crate::kinematics::{Kinematics, Subject};
use crate::system::System;

/// Pivots below this part of their equation's square are round-off: the equation repeats others.
const REPEATS: f64 = 1e-9;
/// A pivot that was below is independent above this part.
const INDEPENDENT: f64 = 1e-7;
/// A pivot below this part of its largest value may vanish before the next look: the sine of 13 degrees, squared.
const WATCHED_PIVOT: f64 = 0.05;
/// A pivot of this part of its largest value is singular: a thousandth of a radian beside it.
const SINGULAR: f64 = 1e-6;
/// A loop this far from a singular position may fail because of it [rad].
const CLOSE: f64 = 0.1;
/// What a parabola through values between which parts turn by a quarter of a radian leaves at its zero.
const MISSED: f64 = 2e-3;
/// A minimum is distinguished from zero where it is this part of the smallest value found.
const VANISHES: f64 = 0.1;
/// Motion between two looks over the root of the smallest pivot [rad].
const BETWEEN_LOOKS: f64 = 0.25;
/// Loops of more equations are not watched: looking at them would take longer than a step.
const MAX_EQUATIONS: usize = 100;
/// An equation that takes part in a dependence by less than this is not named.
const MIN_PARTICIPATION: f64 = 1e-3;

/// What is known of singular positions.
#[derive(Clone, Debug, Default)]
pub(crate) struct SingularPositions {
    loops: Vec<Loop>,
    pub(crate) known: Vec<Known>,
    gradient: Gradient,
    pivots: Pivots,
    length: f64,
}

/// What is known of a loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Known {
    /// When the largest pivots were begun with [s].
    since: f64,
    /// Largest pivot of every equation so far, over its square; zero of those that repeat others. Where there are any, the others
    /// have the largest 1/Σ 1/λ so far.
    references: Vec<f64>,
    /// Time, equation and size of the smallest pivot at the last looks, the latest last.
    looks: Vec<(f64, usize, f64)>,
    /// Motion since the last look [rad].
    moved: f64,
}

/// Pivots of B Bᵀ over its diagonal, with the factor L below the diagonal.
#[derive(Clone, Debug)]
struct Pivots {
    pivots: Vec<f64>,
    factor: DMatrix<f64>,
}

impl SingularPositions {
    /// Begins to watch the loops of `system`; angles count as arcs at `length`.
    pub(crate) fn new(system: &System, at: &Kinematics, length: f64) -> Self {
        let length = if length > 0.0 { length } else { 1.0 };
        let mut loops = loops::of(system);
        loops.retain(|found| found.multipliers.len() <= MAX_EQUATIONS);
        let (mut gradient, mut pivots) = (Gradient::default(), Pivots::default());
        let known = |found: &Loop| {
            found.gradient(system, at, length, &mut gradient);
            pivots.of(&mut gradient, found.multipliers.len());
            let references =
                references(&pivots.pivots, || eigenvalues(&mut gradient, found.multipliers.len()));
            Known { since: at.time, references, looks: Vec::new(), moved: 0.0 }
        };
        let known = loops.iter().map(known).collect();
        Self { loops, known, gradient, pivots, length }
    }

    /// Whether there is no loop.
    pub(crate) fn is_empty(&self) -> bool {
        self.loops.is_empty()
    }

    /// The first multiplier whose equation repeats those before it, where watching began.
    pub(crate) fn first_repeating(&self) -> Option<usize> {
        let repeating = |(found, known): (&Loop, &Known)| {
            let equation = known.references.iter().position(|reference| *reference == 0.0)?;
            Some(found.multipliers[equation])
        };
        self.loops.iter().zip(&self.known).filter_map(repeating).min()
    }

    /// The loop that is closest to a singular position, where one is close: its joints in words, and how far it is from
    /// there [rad].
    pub(crate) fn closest(&mut self, system: &System, at: &Kinematics) -> Option<(Subject, f64)> {
        let mut closest: Option<(Subject, f64)> = None;
        for (found, known) in self.loops.iter().zip(&self.known) {
            found.gradient(system, at, self.length, &mut self.gradient);
            self.pivots.of(&mut self.gradient, found.multipliers.len());
            let (equation, size) = if known.repeats() {
                let eigenvalues = eigenvalues(&mut self.gradient, found.multipliers.len());
                let (equation, _) = known.least(&self.pivots.pivots);
                (equation, smallest(&eigenvalues[..known.rank()]) / known.references[equation])
            } else {
                known.least(&self.pivots.pivots)
            };
            let beside = size.max(0.0).sqrt().min(1.0).asin();
            if beside < CLOSE && closest.as_ref().is_none_or(|(_, least)| beside < *least) {
                closest = Some((self.pivots.names(system, found, equation), beside));
            }
        }
        closest
    }

    /// Looks at where a step has led; `way` is how far the fastest node went, over the representative length. Gives the
    /// first singular position since the last look.
    pub(crate) fn look(&mut self, system: &System, at: &Kinematics, way: f64) -> Option<Warning> {
        let mut warning = None;
        for (found, known) in self.loops.iter().zip(&mut self.known) {
            known.moved += way;
            if known.moved < known.unseen() {
                continue;
            }
            known.moved = 0.0;
            found.gradient(system, at, self.length, &mut self.gradient);
            self.pivots.of(&mut self.gradient, found.multipliers.len());
            let singular = if known.repeats() {
                let eigenvalues = eigenvalues(&mut self.gradient, found.multipliers.len());
                known.compare_repeating(at.time, &self.pivots.pivots, &eigenvalues)
            } else {
                known.compare(at.time, &self.pivots.pivots)
            };
            if let Some((time, equation)) = singular {
                let joints = self.pivots.names(system, found, equation);
                warning = warning.or(Some(Warning::SingularPosition { time, joints }));
            }
        }
        warning
    }
}

impl Known {
    /// Whether equations repeat each other wherever the motion has been.
    fn repeats(&self) -> bool {
        self.references.contains(&0.0)
    }

    /// Number of independent equations.
    fn rank(&self) -> usize {
        self.references.iter().filter(|reference| **reference > 0.0).count()
    }

    /// The independent equation whose pivot is smallest over its reference, and how small.
    fn least(&self, pivots: &[f64]) -> (usize, f64) {
        let own = self.references.iter().zip(pivots).map(|(reference, pivot)| pivot.max(0.0) / reference);
        let finite = own.enumerate().filter(|(_, size)| size.is_finite());
        finite.min_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap_or((0, f64::INFINITY))
    }

    /// Motion that may go unseen until the next look [rad]. A pivot is the square of the way to where it vanishes: what
    /// is far comes near first, and near it looks come closer as that does.
    fn unseen(&self) -> f64 {
        let way = self.looks.last().map_or(1.0, |&(_, _, size)| size.clamp(0.0, 1.0).sqrt());
        (way - WATCHED_PIVOT.sqrt()).max(BETWEEN_LOOKS * way)
    }

    /// Time and equation of a singular position, if the motion has come through one.
    fn compare(&mut self, time: f64, pivots: &[f64]) -> Option<(f64, usize)> {
        for (reference, pivot) in self.references.iter_mut().zip(pivots) {
            *reference = reference.max(*pivot);
        }
        let (equation, size) = self.least(pivots);
        self.follow(time, (equation, equation), size)
    }

    /// The same where equations repeat each other, by the eigenvalues of B Bᵀ, the largest first.
    fn compare_repeating(&mut self, time: f64, pivots: &[f64], eigenvalues: &[f64]) -> Option<(f64, usize)> {
        let rank = self.rank();
        if let Some(equation) =
            (0..pivots.len()).find(|&k| self.references[k] == 0.0 && pivots[k] > INDEPENDENT)
            && eigenvalues.get(rank).is_some_and(|next| *next > INDEPENDENT)
        {
            // Fewer repeat others: the last place known was the singular one.
            self.references = references(pivots, || eigenvalues.to_vec());
            self.looks.clear();
            let since = std::mem::replace(&mut self.since, time);
            return Some((since, equation));
        }
        let smallest = smallest(&eigenvalues[..rank]);
        let most = self.references.iter().fold(smallest, |most, reference| most.max(*reference));
        self.references.iter_mut().filter(|reference| **reference > 0.0).for_each(|own| *own = most);
        let (named, _) = self.least(pivots);
        self.follow(time, (rank, named), smallest / most)
    }

    /// Records the size of what vanishes in a singular position, with its number, and returns the position and the
    /// equation to be named, if the motion has come through one.
    fn follow(&mut self, time: f64, (number, equation): (usize, usize), size: f64) -> Option<(f64, usize)> {
        self.looks.push((time, number, size));
        if self.looks.len() > 3 {
            self.looks.remove(0);
        }
        if size < SINGULAR {
            return Some((time, equation));
        }
        self.vanished().map(|time| (time, equation))
    }

    /// When the pivot vanished between the last three looks.
    fn vanished(&self) -> Option<f64> {
        let &[a, b, c] = self.looks.as_slice() else { return None };
        let same = a.1 == b.1 && b.1 == c.1;
        let smallest = a.2.min(b.2).min(c.2);
        if !same || smallest > WATCHED_PIVOT || b.0 <= a.0 || c.0 <= b.0 {
            return None;
        }
        let slopes = [(b.2 - a.2) / (b.0 - a.0), (c.2 - b.2) / (c.0 - b.0)];
        let bend = (slopes[1] - slopes[0]) / (c.0 - a.0);
        if bend <= 0.0 {
            return None;
        }
        let time = 0.5 * (a.0 + b.0) - 0.5 * slopes[0] / bend;
        let least = a.2 + (slopes[0] + bend * (time - b.0)) * (time - a.0);
        let vanishes = least < (VANISHES * smallest).min(MISSED);
        (vanishes && time > a.0 && time < c.0).then_some(time)
    }
}

/// What pivots are compared with from now on; with the eigenvalues of B Bᵀ, the largest first, where equations repeat others.
fn references(pivots: &[f64], eigenvalues: impl FnOnce() -> Vec<f64>) -> Vec<f64> {
    let independent = |pivot: &f64| if *pivot > REPEATS { *pivot } else { 0.0 };
    let mut references: Vec<f64> = pivots.iter().map(independent).collect();
    if !references.contains(&0.0) {
        return references;
    }
    let eigenvalues = eigenvalues();
    // As many as eigenvalues say: what is nearly dependent may count among pivots as one thing or the other.
    let rank = eigenvalues.iter().filter(|value| **value > REPEATS).count();
    let mut by_pivot: Vec<usize> = (0..pivots.len()).collect();
    by_pivot.sort_by(|a, b| pivots[*b].total_cmp(&pivots[*a]));
    references.fill(0.0);
    by_pivot[..rank].iter().for_each(|&equation| references[equation] = smallest(&eigenvalues[..rank]));
    references
}

/// Eigenvalues of B Bᵀ, rows of B brought to length 1, the largest first.
fn eigenvalues(gradient: &mut Gradient, count: usize) -> Vec<f64> {
    let mut square = DMatrix::zeros(count, count);
    gradient.square(&mut square);
    square.fill_upper_triangle_with_lower_triangle();
    let mut eigenvalues: Vec<f64> = square.symmetric_eigenvalues().iter().copied().collect();
    eigenvalues.sort_by(|a, b| b.total_cmp(a));
    eigenvalues
}

/// 1/Σ 1/λ of eigenvalues: smooth where they change along a motion, and near the smallest.
fn smallest(eigenvalues: &[f64]) -> f64 {
    if eigenvalues.iter().any(|value| *value <= 0.0) {
        return 0.0;
    }
    1.0 / eigenvalues.iter().map(|value| value.recip()).sum::<f64>()
}

impl Default for Pivots {
    fn default() -> Self {
        Self { pivots: Vec::new(), factor: DMatrix::zeros(0, 0) }
    }
}

impl Pivots {
    /// L D Lᵀ of B Bᵀ, rows of B brought to length 1; equations that repeat earlier ones are left out.
    fn of(&mut self, gradient: &mut Gradient, count: usize) {
        self.pivots.resize(count, 0.0);
        self.factor.resize_mut(count, count, 0.0);
        gradient.square(&mut self.factor);
        let square = self.factor.as_mut_slice();
        for k in 0..count {
            // Column by column, as the numbers lie.
            let (known, rest) = square.split_at_mut((k + 1) * count);
            let factors = &mut known[k * count + k..];
            let pivot = factors[0];
            self.pivots[k] = pivot;
            if pivot <= REPEATS {
                factors[1..].fill(0.0);
                continue;
            }
            let factors = &mut factors[1..];
            for (j, column) in rest.chunks_exact_mut(count).enumerate() {
                // Equations of joints that share no part know nothing of each other.
                if factors[j] == 0.0 {
                    continue;
                }
                let upper = factors[j] / pivot;
                for (entry, factor) in column[k + 1 + j..].iter_mut().zip(&factors[j..]) {
                    *entry -= factor * upper;
                }
                factors[j] = upper;
            }
        }
    }

    /// Joints whose equations give the one that vanishes: its row of L, through those before it.
    fn names(&self, system: &System, found: &Loop, equation: usize) -> Subject {
        let mut shares: Vec<f64> = (0..equation).map(|k| self.factor[(equation, k)]).collect();
        for k in (0..equation).rev() {
            for j in k + 1..equation {
                shares[k] -= self.factor[(j, k)] * shares[j];
            }
        }
        let mut joints: Vec<Subject> = Vec::new();
        let takes_part = |k: &usize| shares[*k].abs() > MIN_PARTICIPATION && self.pivots[*k] > REPEATS;
        for k in (0..equation).filter(takes_part).chain([equation]) {
            let (joint, _) = system.layout().constraint_name(found.multipliers[k]);
            let joint = Subject::new("joint", joint).called(format!("`{joint}`"));
            if !joints.contains(&joint) {
                joints.push(joint);
            }
        }
        Subject::list(joints)
    }
}
