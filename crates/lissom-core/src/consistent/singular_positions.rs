//! Singular positions: positions at which the constraints of a closed loop become linearly dependent, such as a parallelogram with
//! aligned bars. There a mechanism has an additional degree of freedom, and the motion can continue on several branches.
//!
//! The criterion is the smallest pivot of the loop's B Bᵀ = L D Lᵀ without pivoting, each relative to its largest value so far. Near a
//! singular position a pivot is proportional to the square of the distance from it. It is monitored from step to step, and a parabola
//! through three of its values determines whether it vanishes between steps.
//!
//! If constraints are redundant everywhere, as in a planar four-bar of revolutes or in Bennett's linkage, the set of independent equations
//! may change: a pivot vanishes without an additional degree of freedom. In this case the r largest eigenvalues λ of B Bᵀ are used instead
//! of the pivots, with r independent equations, in the form 1/Σ 1/λ, which is smooth along the motion and vanishes with the smallest.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::loops::{self, Gradient, Loop};
use crate::errors::Warning;
use crate::kinematics::{Kinematics, Subject};
use crate::round_off;
use crate::system::System;

/// Pivot above which an equation that was redundant is independent.
const INDEPENDENT: f64 = 1e-7;
/// A pivot below this fraction of its largest value may vanish before the next check: the sine of 13 degrees, squared.
const WATCHED_PIVOT: f64 = 0.05;
/// A pivot of this fraction of its largest value is singular: a thousandth of a radian from the singular position.
const SINGULAR: f64 = 1e-6;
/// A loop at this distance from a singular position may fail because of it [rad].
const CLOSE: f64 = 0.1;
/// Error at its zero of a parabola through values between which parts rotate by a quarter of a radian.
const MISSED: f64 = 2e-3;
/// A minimum is zero if it is below this fraction of the smallest evaluated value.
const VANISHES: f64 = 0.1;
/// Motion between two checks, relative to the square root of the smallest pivot [rad].
const BETWEEN_LOOKS: f64 = 0.25;
/// Maximum number of equations of a monitored loop: the check of larger ones would be more expensive than a step.
const MAX_EQUATIONS: usize = 100;
/// Smallest coefficient of an equation in a linear dependence at which its joint is named.
pub(super) const MIN_PARTICIPATION: f64 = 1e-3;

/// Monitor of singular positions.
#[derive(Clone, Debug, Default)]
pub(crate) struct SingularPositions {
    loops: Vec<Loop>,
    pub(crate) known: Vec<Known>,
    gradient: Gradient,
    pivots: Pivots,
    length: f64,
}

/// State of the monitor for one loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Known {
    /// Time since which the largest pivots are recorded [s].
    since: f64,
    /// Largest pivot of every equation so far, relative to its squared norm; zero for redundant ones. If there are any, the other
    /// entries are the largest 1/Σ 1/λ so far.
    references: Vec<f64>,
    /// Time, equation and smallest pivot at the last three checks, the latest last.
    looks: Vec<(f64, usize, f64)>,
    /// Motion since the last check [rad].
    moved: f64,
}

/// Pivots of B Bᵀ with a unit diagonal, and the factor L below the diagonal.
#[derive(Clone, Debug)]
struct Pivots {
    pivots: Vec<f64>,
    factor: DMatrix<f64>,
}

impl SingularPositions {
    /// Starts to monitor the loops of `system`; angles are represented by arcs at `length` [m].
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

    /// The loop closest to a singular position, if one is close: its joints, and the distance [rad].
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

    /// Checks the end of a step; `way` is the displacement of the fastest node relative to the representative length. Warns of the
    /// first singular position since the last check.
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
    /// Whether equations have been redundant in the whole motion.
    fn repeats(&self) -> bool {
        self.references.contains(&0.0)
    }

    /// Number of independent equations.
    fn rank(&self) -> usize {
        self.references.iter().filter(|reference| **reference > 0.0).count()
    }

    /// The independent equation with the smallest pivot relative to its reference, and this ratio.
    fn least(&self, pivots: &[f64]) -> (usize, f64) {
        let own = self.references.iter().zip(pivots).map(|(reference, pivot)| pivot.max(0.0) / reference);
        let finite = own.enumerate().filter(|(_, size)| size.is_finite());
        finite.min_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap_or((0, f64::INFINITY))
    }

    /// Motion until the next check [rad]. The distance from a singular position is proportional to the square root of the pivot:
    /// checks become more frequent as it decreases.
    fn unseen(&self) -> f64 {
        let way = self.looks.last().map_or(1.0, |&(_, _, size)| size.clamp(0.0, 1.0).sqrt());
        (way - WATCHED_PIVOT.sqrt()).max(BETWEEN_LOOKS * way)
    }

    /// Time and equation of a singular position, if the motion has passed one.
    fn compare(&mut self, time: f64, pivots: &[f64]) -> Option<(f64, usize)> {
        for (reference, pivot) in self.references.iter_mut().zip(pivots) {
            *reference = reference.max(*pivot);
        }
        let (equation, size) = self.least(pivots);
        self.follow(time, (equation, equation), size)
    }

    /// Time and equation of a singular position of redundant equations, from the eigenvalues of B Bᵀ in descending order.
    fn compare_repeating(&mut self, time: f64, pivots: &[f64], eigenvalues: &[f64]) -> Option<(f64, usize)> {
        let rank = self.rank();
        if let Some(equation) =
            (0..pivots.len()).find(|&k| self.references[k] == 0.0 && pivots[k] > INDEPENDENT)
            && eigenvalues.get(rank).is_some_and(|next| *next > INDEPENDENT)
        {
            // Fewer equations are redundant now: the last known position was singular.
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

    /// Records the quantity that vanishes at a singular position, with its index. Returns time and equation of the singular position,
    /// if the motion has passed one.
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

    /// Time at which the pivot vanished between the last three checks, if it did.
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

/// Reference values of the pivots; if equations are redundant, from the eigenvalues of B Bᵀ in descending order.
fn references(pivots: &[f64], eigenvalues: impl FnOnce() -> Vec<f64>) -> Vec<f64> {
    let independent = |pivot: &f64| if *pivot > round_off::RANK { *pivot } else { 0.0 };
    let mut references: Vec<f64> = pivots.iter().map(independent).collect();
    if !references.contains(&0.0) {
        return references;
    }
    let eigenvalues = eigenvalues();
    // The rank is that of the eigenvalues: nearly dependent equations are ambiguous among the pivots.
    let rank = eigenvalues.iter().filter(|value| **value > round_off::RANK).count();
    let mut by_pivot: Vec<usize> = (0..pivots.len()).collect();
    by_pivot.sort_by(|a, b| pivots[*b].total_cmp(&pivots[*a]));
    references.fill(0.0);
    by_pivot[..rank].iter().for_each(|&equation| references[equation] = smallest(&eigenvalues[..rank]));
    references
}

/// Eigenvalues of B Bᵀ with rows of B of unit norm, in descending order.
fn eigenvalues(gradient: &mut Gradient, count: usize) -> Vec<f64> {
    let mut square = DMatrix::zeros(count, count);
    gradient.square(&mut square);
    square.fill_upper_triangle_with_lower_triangle();
    let mut eigenvalues: Vec<f64> = square.symmetric_eigenvalues().iter().copied().collect();
    eigenvalues.sort_by(|a, b| b.total_cmp(a));
    eigenvalues
}

/// 1/Σ 1/λ of eigenvalues: a smooth approximation of the smallest.
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
    /// Factors L D Lᵀ of B Bᵀ with rows of B of unit norm; redundant equations are skipped.
    fn of(&mut self, gradient: &mut Gradient, count: usize) {
        self.pivots.resize(count, 0.0);
        self.factor.resize_mut(count, count, 0.0);
        gradient.square(&mut self.factor);
        let square = self.factor.as_mut_slice();
        for k in 0..count {
            // Column by column, in the order of storage.
            let (known, rest) = square.split_at_mut((k + 1) * count);
            let factors = &mut known[k * count + k..];
            let pivot = factors[0];
            self.pivots[k] = pivot;
            if pivot <= round_off::RANK {
                factors[1..].fill(0.0);
                continue;
            }
            let factors = &mut factors[1..];
            for (j, column) in rest.chunks_exact_mut(count).enumerate() {
                // Equations of joints without a common part are independent.
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

    /// Joints of the equations on which the vanishing one depends: its row of L, by back substitution.
    fn names(&self, system: &System, found: &Loop, equation: usize) -> Subject {
        let mut shares: Vec<f64> = (0..equation).map(|k| self.factor[(equation, k)]).collect();
        for k in (0..equation).rev() {
            for j in k + 1..equation {
                shares[k] -= self.factor[(j, k)] * shares[j];
            }
        }
        let mut joints: Vec<Subject> = Vec::new();
        let takes_part =
            |k: &usize| shares[*k].abs() > MIN_PARTICIPATION && self.pivots[*k] > round_off::RANK;
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
