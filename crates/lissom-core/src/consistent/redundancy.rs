//! Redundant constraints: equations of closed loops that others imply in the whole motion. They are omitted, so that the remaining
//! equations have a solution of their own and determine it to round-off.
//!
//! Legend: B rows of unit norm, an angle represented by an arc; K kept and R omitted equations; N self-stresses; v velocities.
//!
//! ```text
//! rank:        B Bᵀ = L Lᵀ, equation by equation; those with a pivot below (geometric tolerance)² are dependent
//! self-stress: Bᵀ N = 0, Nᵀ N = 1: one for each omitted equation, from L
//! singular:    Nᵀ Ḃ v ≠ 0 for a velocity with B v = 0: dependent at this position only, not omitted
//! multipliers: those of least norm, μ - N Nᵀ μ, with moments as forces at the length that represents a radian
//! violations:  those that a motion can correct, c - N Nᵀ c, with angles as arcs
//! ```
//!
//! Equations that are dependent to within the geometric tolerance count as dependent: axes and lengths are often rounded to six
//! digits. Their misfit remains as a violation of least norm. The selection follows the motion: where the kept equations determine
//! little, it is repeated, for example at the dead centre of a coupling rod, or where an equation is in the axes of a part that rotates,
//! such as the tip of a screw. Steps do so with each tangent. The solution does not depend on the selection.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::initial_conditions::scatter_rates;
use super::loops::{self, Gradient, Loop};
use super::singular_positions::MIN_PARTICIPATION;
use crate::joints::MAX_EQUATIONS;
use crate::joints::constraint::Level;
use crate::kinematics::{Kinematics, Quantity, Subject};
use crate::round_off;
use crate::system::System;

/// Sine of the angle to the others below which an equation depends on them: the geometric tolerance.
pub(crate) const GEOMETRIC_TOLERANCE: f64 = 1e-5;
/// Pivots above which equations are kept, in the order in which they are tried: the well determined ones first.
const PIVOTS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, GEOMETRIC_TOLERANCE * GEOMETRIC_TOLERANCE];
/// Curvature of a violation along a velocity, relative to that of a rotation, above which equations are dependent at one position only.
const CURVED: f64 = 1e-3;
/// Curvature of a violation for equations that are out of line, which curves violations by as much.
const CURVED_OUT_OF_LINE: f64 = 1e-1;
/// Largest angle that is taken for an inaccuracy of the geometry [rad], and number of joints among which it is looked for: the motion of a
/// large mechanism is small at each of its joints.
const MAX_OUT_OF_LINE: f64 = 1e-2;
const MAX_JOINTS: usize = 6;
/// Velocities along which the curvature is examined first.
const FEW_SAMPLES: usize = 2;
/// A selection is repeated if its smallest pivot falls below this fraction of that at its selection.
const WORSE: f64 = 0.1;
/// Smallest pivot of a selection that replaces another one: closer to a singular position none is better determined.
const DETERMINED: f64 = PIVOTS[3];
/// Pivot below which a position is close to a singular one.
const CLOSE: f64 = 1e-2;

/// Redundant equations of a system, which it follows along the motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Redundancy {
    groups: Vec<Group>,
    /// Multipliers of the omitted equations.
    omitted: Vec<usize>,
    out_of_line: Option<OutOfLine>,
    /// Whether equations that are dependent at one position only are omitted there.
    is_instantaneous: bool,
    length: f64,
    work: Work,
}

/// A constraint that would depend on others if its geometry were exact, and holds what they leave free.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OutOfLine {
    /// Joint of the constraint.
    pub(crate) joint: Subject,
    /// The joints on which it would depend.
    pub(crate) others: Subject,
    /// Angle between its direction and theirs [rad].
    pub(crate) angle: f64,
}

/// A closed loop whose equations may be redundant.
#[derive(Clone, Debug)]
struct Group {
    found: Loop,
    /// Equations between positions; the others are between velocities.
    is_of_positions: Vec<bool>,
    selection: Selection,
    stresses: Vec<Stress>,
    /// The self-stresses by column, as scratch memory.
    columns: DMatrix<f64>,
    /// Multiplier of an equation that was dependent at the first position only, if there was one.
    singular: Option<usize>,
    /// Smallest pivot where the kept equations were examined last.
    latest: f64,
}

/// A self-stress.
#[derive(Clone, Debug, Default)]
struct Stress {
    /// Whether it relates positions only.
    is_of_positions: bool,
    /// Multiplier, and its coefficients in Nᵀ μ and in N.
    entries: Vec<(usize, f64, f64)>,
}

/// Equations of a loop, selected at a position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Selection {
    /// Equations that acted, in ascending order: latches that are released do not.
    acting: Vec<usize>,
    /// Kept equations in the order of the factorisation, by position among those that act.
    kept: Vec<usize>,
    /// Omitted equations, likewise.
    omitted: Vec<usize>,
    /// Smallest pivot of the kept equations.
    smallest: f64,
}

/// Scratch memory.
#[derive(Clone, Debug, Default)]
struct Work {
    gradient: Gradient,
    /// Norms of the rows of B.
    norms: Vec<f64>,
    /// By equation: 1 where the multiplier is a force, the reciprocal of the length where it is a moment [-, 1/m].
    units: Vec<f64>,
    acting: Vec<usize>,
    /// Position of an equation among those that act.
    compact: Vec<usize>,
    square: Vec<f64>,
    factor: Factor,
    shares: Vec<f64>,
}

/// Rows of L, without their leading zeros.
#[derive(Clone, Debug, Default)]
struct Factor {
    kept: Vec<usize>,
    /// First column and first entry of each row.
    rows: Vec<(usize, usize)>,
    entries: Vec<f64>,
}

impl Redundancy {
    /// Finds the redundant equations of `system` at a position that satisfies its constraints; angles are represented by arcs at
    /// `length` [m].
    pub(crate) fn new(system: &System, at: &Kinematics, length: f64) -> Self {
        Self::found(system, at, length, false)
    }

    /// No equation is omitted, redundant or not.
    pub(crate) fn unexamined(length: f64) -> Self {
        Self { length, ..Self::default() }
    }

    /// Finds the equations of rates and accelerations that are redundant at a position, also where this is singular.
    pub(crate) fn of_rates(system: &System, at: &Kinematics, length: f64) -> Self {
        Self::found(system, at, length, true)
    }

    fn found(system: &System, at: &Kinematics, length: f64, is_instantaneous: bool) -> Self {
        let length = if length > 0.0 { length } else { 1.0 };
        let mut made = Self { is_instantaneous, length, ..Self::default() };
        for found in loops::of_all_levels(system) {
            let mut is_of_positions = Vec::new();
            for (_, constraint) in found.constraints(system) {
                let own = constraint.level() == Level::Position;
                is_of_positions.extend(std::iter::repeat_n(own, constraint.equations()));
            }
            let mut group = Group {
                found,
                is_of_positions,
                selection: Selection::default(),
                stresses: Vec::new(),
                columns: DMatrix::zeros(0, 0),
                singular: None,
                latest: 0.0,
            };
            group.measure(system, at, length, &mut made.work);
            group.select(system, at, (length, is_instantaneous), &mut made.work);
            let out_of_line = group.out_of_line(system, at, length, &mut made.work);
            made.out_of_line = made.out_of_line.or(out_of_line);
            let may_change = group.selection.acting.len() < group.is_of_positions.len()
                || group.is_of_positions.contains(&false)
                || group.found.constraints(system).any(|(_, own)| own.is_released(at));
            if may_change || group.singular.is_some() || !group.selection.omitted.is_empty() {
                made.groups.push(group);
            }
        }
        made.collect();
        made
    }

    /// Multipliers of the omitted equations, in ascending order.
    pub(crate) fn omitted(&self) -> &[usize] {
        &self.omitted
    }

    /// A constraint that is nearly redundant at the first position, if there is one.
    pub(crate) fn out_of_line(&self) -> Option<&OutOfLine> {
        self.out_of_line.as_ref()
    }

    /// Multiplier of an equation that was dependent at the first position only, if the motion is still close to it.
    pub(crate) fn singular(&self) -> Option<usize> {
        self.groups.iter().filter(|group| group.latest < CLOSE).find_map(|group| group.singular)
    }

    /// Whether the equation of a multiplier is one of a loop whose equations are dependent at this position, only there or in the whole
    /// motion: the rank of B, which a pivot of a tangent does not show where its digits are lost.
    pub(crate) fn is_dependent(&self, system: &System, at: &Kinematics, multiplier: usize) -> bool {
        let has_it = |group: &Group| group.found.multipliers.contains(&multiplier);
        let here = Self::of_rates(system, at, self.length);
        here.groups.iter().any(|group| !group.selection.omitted.is_empty() && has_it(group))
    }

    /// Whether no equation is or may become redundant.
    pub(crate) fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// Selects again where the kept equations determine little at this position, or where others act. Returns whether other equations
    /// are omitted.
    pub(crate) fn follow(&mut self, system: &System, at: &Kinematics) -> bool {
        self.follow_to((system, at), false)
    }

    /// Selects again at an iterate of a step, for its tangent: equations in axes that rotate in the step, such as those of a screw, may be
    /// redundant at its start, and the only independent ones at its end.
    pub(crate) fn follow_iterate(&mut self, system: &System, at: &Kinematics) -> bool {
        self.follow_to((system, at), true)
    }

    fn follow_to(&mut self, (system, at): (&System, &Kinematics), is_iterate: bool) -> bool {
        let (length, is_instantaneous, work) = (self.length, self.is_instantaneous, &mut self.work);
        let mut has_changed = false;
        for group in &mut self.groups {
            group.measure(system, at, length, work);
            let own = &group.selection;
            if is_instantaneous || work.acting != own.acting {
                if is_iterate {
                    continue;
                }
                let before = std::mem::take(&mut group.selection);
                group.select(system, at, (length, is_instantaneous), work);
                has_changed |= group.multipliers(&before).ne(group.multipliers(&group.selection));
                continue;
            }
            if own.omitted.is_empty() && group.singular.is_none() {
                continue;
            }
            let smallest = work.keep(&own.kept);
            group.latest = smallest;
            if smallest < WORSE * own.smallest {
                let present = Selection { smallest, ..own.clone() };
                group.select_like(&present, work);
                has_changed |= present.omitted != group.selection.omitted;
            }
            // Close to a singular position self-stresses are not determined: those of before are kept.
            if smallest > MAX_OUT_OF_LINE * MAX_OUT_OF_LINE {
                group.find_stresses(work);
            }
        }
        if has_changed {
            self.collect();
        }
        has_changed
    }

    fn collect(&mut self) {
        let groups = self.groups.iter();
        self.omitted = groups.flat_map(|group| group.multipliers(&group.selection)).collect();
        self.omitted.sort_unstable();
    }

    /// Replaces multipliers by those of least norm that are in equilibrium with the same loads.
    pub(crate) fn reduce_to_least_norm(&self, multipliers: &mut [f64]) {
        for Stress { entries, .. } in self.groups.iter().flat_map(|group| &group.stresses) {
            let share: f64 = entries.iter().map(|&(k, own, _)| own * multipliers[k]).sum();
            for &(k, _, by) in entries {
                multipliers[k] -= share * by;
            }
        }
    }

    /// Replaces violations or their rates by those nearest that the motion can correct: without the misfit of redundant equations.
    pub(crate) fn remove_misfit(&self, violations: &mut [f64]) {
        let stresses = self.groups.iter().flat_map(|group| &group.stresses);
        // What constraints of velocities leave in a step is no position.
        for Stress { entries, .. } in stresses.filter(|stress| stress.is_of_positions) {
            let share: f64 = entries.iter().map(|&(k, _, by)| by * violations[k]).sum();
            for &(k, own, _) in entries {
                violations[k] -= share * own;
            }
        }
    }

    /// Replaces the omitted equations by those that set their multipliers to zero, in B and Bᵀ on the pattern of `system`.
    pub(crate) fn omit_from(&self, system: &System, constraint: &mut [f64]) {
        let (pattern, count) = (&system.structure().pattern, system.layout().coordinate_count());
        for unknown in self.omitted.iter().map(|k| count + k) {
            for &other in pattern.column(unknown) {
                for (row, column) in [(unknown, other), (other, unknown)] {
                    if let Some(position) = pattern.position(row, column) {
                        constraint[position] = if row == column { -1.0 } else { 0.0 };
                    }
                }
            }
        }
    }

    /// Joints of the redundant equations on which that of `multiplier` depends.
    pub(crate) fn joints_around(&self, system: &System, multiplier: usize) -> Subject {
        let takes_part =
            |&&(_, own, by): &&(usize, f64, f64)| own * by > MIN_PARTICIPATION * MIN_PARTICIPATION;
        let stresses = self
            .groups
            .iter()
            .flat_map(|group| &group.stresses)
            .filter(|stress| stress.entries.iter().filter(takes_part).any(|&(k, ..)| k == multiplier));
        let entries = stresses.flat_map(|stress| stress.entries.iter().filter(takes_part));
        let mut others: Vec<usize> = entries.map(|&(k, ..)| k).collect();
        others.sort_unstable();
        Subject::list(joints_of(system, &others, multiplier))
    }

    /// The selections, for snapshots.
    pub(crate) fn selections(&self) -> Vec<Selection> {
        self.groups.iter().map(|group| group.selection.clone()).collect()
    }

    /// Restores the selections of a snapshot. Returns whether they fit.
    pub(crate) fn restore(&mut self, selections: &[Selection]) -> bool {
        let fit = selections.len() == self.groups.len();
        for (group, selection) in self.groups.iter_mut().zip(selections) {
            group.selection.clone_from(selection);
        }
        self.collect();
        fit
    }
}

impl Group {
    /// Multipliers of the omitted equations.
    fn multipliers<'a>(&'a self, selection: &'a Selection) -> impl Iterator<Item = usize> + 'a {
        selection.omitted.iter().map(|&own| self.found.multipliers[selection.acting[own]])
    }

    /// B Bᵀ of the equations that act.
    fn measure(&self, system: &System, at: &Kinematics, length: f64, work: &mut Work) {
        let Work { gradient, norms, units, acting, compact, square, .. } = work;
        self.found.gradient(system, at, length, gradient);
        let quantities = &system.layout().quantities()[system.layout().coordinate_count()..];
        units.clear();
        units.extend(self.found.multipliers.iter().map(|&multiplier| match quantities[multiplier] {
            Quantity::Angle => 1.0 / length,
            Quantity::Length | Quantity::State => 1.0,
        }));
        let count = self.is_of_positions.len();
        norms.resize(count, 0.0);
        gradient.norms(norms);
        acting.clear();
        compact.clear();
        for (equation, norm) in norms.iter().enumerate() {
            compact.push(acting.len());
            if *norm > 0.0 {
                acting.push(equation);
            }
        }
        let count = acting.len();
        square.clear();
        square.resize(count * count, 0.0);
        for column in &gradient.columns {
            for (place, &(i, by_i)) in column.iter().enumerate() {
                for &(j, by_j) in column[..place].iter().filter(|(j, _)| *j != i) {
                    let value = by_i * by_j / (norms[i] * norms[j]);
                    let (a, b) = (compact[i], compact[j]);
                    square[a * count + b] += value;
                    square[b * count + a] += value;
                }
            }
        }
        for equation in 0..count {
            square[equation * count + equation] = 1.0;
        }
    }

    /// Selects the equations to be omitted at a position.
    fn select(
        &mut self,
        system: &System,
        at: &Kinematics,
        (length, is_instantaneous): (f64, bool),
        work: &mut Work,
    ) {
        let smallest = self.keep_independent(work, usize::MAX);
        let mut dependent: Vec<usize> =
            (0..work.acting.len()).filter(|own| !work.factor.kept.contains(own)).collect();
        dependent.sort_by_key(|&own| !self.is_of_positions[work.acting[own]]);
        self.selection = Selection {
            acting: work.acting.clone(),
            kept: work.factor.kept.clone(),
            omitted: dependent,
            smallest,
        };
        if self.selection.omitted.is_empty() {
            self.stresses.clear();
            return;
        }
        let stresses = work.stresses(&self.selection.omitted);
        if !is_instantaneous
            && let Some(lasting) = self.lasting((system, at, length), work, &stresses, CURVED)
        {
            let omitted = most_stressed(lasting.clone());
            let is_kept = |own: &&usize| !omitted.contains(own);
            let singular = self.selection.omitted.iter().find(is_kept);
            self.singular = singular.map(|&own| self.found.multipliers[work.acting[own]]);
            // Those that are dependent here only are kept, last.
            let Selection { kept, omitted: dependent, .. } = &mut self.selection;
            kept.append(dependent);
            kept.retain(|own| !omitted.contains(own));
            self.selection.omitted = omitted;
            self.store(work, &lasting);
        } else {
            self.store(work, &stresses);
        }
    }

    /// The kept constraint that is least determined, if it would depend on others in the whole motion with a small change of its geometry.
    fn out_of_line(
        &self,
        system: &System,
        at: &Kinematics,
        length: f64,
        work: &mut Work,
    ) -> Option<OutOfLine> {
        let small = MAX_OUT_OF_LINE * MAX_OUT_OF_LINE;
        if self.selection.smallest >= small {
            return None;
        }
        self.keep_independent(work, usize::MAX);
        let (weakest, _) = work.factor.pivots().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let strong: Vec<usize> =
            work.factor.pivots().filter(|(_, pivot)| *pivot >= small).map(|(own, _)| own).collect();
        work.keep(&strong);
        let others: Vec<usize> = (0..work.acting.len()).filter(|own| !strong.contains(own)).collect();
        let stresses = work.stresses(&others);
        let lasting = self.lasting((system, at, length), work, &stresses, CURVED_OUT_OF_LINE);
        let is_lasting = lasting.as_ref().map_or(others.len(), DMatrix::ncols) > self.selection.omitted.len();
        let own = others.iter().position(|own| *own == weakest).filter(|_| is_lasting)?;
        let column = work.stresses(&others[own..=own]);
        let multiplier = |own: usize| self.found.multipliers[work.acting[own]];
        let angle = work.angle_of_motion(&column, weakest);
        let among = column.iter().enumerate().filter(|(_, value)| value.abs() > MIN_PARTICIPATION);
        let among: Vec<usize> = among.map(|(own, _)| multiplier(own)).collect();
        let (joint, _) = system.layout().constraint_name(multiplier(weakest));
        let others = joints_of(system, &among, multiplier(weakest));
        (angle < MAX_OUT_OF_LINE && others.len() < MAX_JOINTS).then(|| OutOfLine {
            joint: Subject::new("joint", joint),
            others: Subject::list(others),
            angle,
        })
    }

    /// Selects as many equations as before, if they are better determined.
    fn select_like(&mut self, before: &Selection, work: &mut Work) {
        let smallest = self.keep_independent(work, before.kept.len());
        let own = &mut self.selection;
        if work.factor.kept.len() == before.kept.len()
            && smallest * WORSE > before.smallest
            && smallest > DETERMINED
        {
            own.kept.clone_from(&work.factor.kept);
            own.omitted = (0..own.acting.len()).filter(|equation| !own.kept.contains(equation)).collect();
            own.omitted.sort_by_key(|&equation| !self.is_of_positions[own.acting[equation]]);
            own.smallest = smallest;
        } else {
            work.keep(&before.kept);
            own.smallest = before.smallest;
        }
    }

    /// Factors B Bᵀ of at most `count` independent equations, position constraints first; returns the smallest pivot.
    fn keep_independent(&self, work: &mut Work, count: usize) -> f64 {
        let Work { acting, square, factor, .. } = work;
        factor.clear();
        let mut smallest = 1.0_f64;
        for of_positions in [true, false] {
            let candidates =
                (0..acting.len()).filter(|&own| self.is_of_positions[acting[own]] == of_positions);
            let mut open: Vec<usize> = candidates.collect();
            for least in PIVOTS {
                open.retain(|&equation| {
                    if factor.kept.len() >= count {
                        return true;
                    }
                    let pivot = factor.try_row(square, acting.len(), equation, least);
                    if let Some(pivot) = pivot {
                        smallest = smallest.min(pivot);
                    }
                    pivot.is_none()
                });
            }
        }
        smallest
    }

    /// The self-stresses of equations that stay dependent along all velocities, if these are not all of them.
    fn lasting(
        &self,
        (system, at, length): (&System, &Kinematics, f64),
        work: &Work,
        stresses: &DMatrix<f64>,
        curved: f64,
    ) -> Option<DMatrix<f64>> {
        let mut explicit = vec![0.0; self.is_of_positions.len()];
        let still = vec![0.0; system.layout().size()];
        let mut moved = at.clone();
        self.accelerations(system, &mut moved, &still, &mut explicit);
        let mut curvatures = DMatrix::zeros(work.acting.len(), 0);
        loop {
            // Two more than the dimension that they have shown: further ones would add nothing.
            let (known, most) = (curvatures.ncols(), stresses.ncols() + 2);
            let samples = (2 * known).clamp(FEW_SAMPLES, most.max(FEW_SAMPLES));
            curvatures = curvatures.resize_horizontally(samples, 0.0);
            for sample in known..samples {
                let velocity = self.free_velocity(work, sample)?;
                let curvature = self.curvature(system, (&mut moved, length), &velocity, &explicit);
                let square: f64 = velocity.iter().map(|value| value * value).sum();
                for (own, &equation) in work.acting.iter().enumerate() {
                    let unit = work.units[equation] * square;
                    curvatures[(own, sample)] = curvature[equation] * length / unit;
                }
            }
            let of_stresses = stresses.transpose() * &curvatures;
            if of_stresses.amax() < curved {
                return None;
            }
            let found = (&of_stresses * of_stresses.transpose()).symmetric_eigen();
            let flat = (0..stresses.ncols()).filter(|&k| found.eigenvalues[k] < curved * curved);
            let flat: Vec<usize> = flat.collect();
            if stresses.ncols() - flat.len() + FEW_SAMPLES > samples && samples < most {
                continue;
            }
            return Some(stresses * found.eigenvectors.select_columns(&flat));
        }
    }

    /// Accelerations of the violations at a velocity, by column with arcs for angles: the part that is quadratic in it, beside the
    /// `explicit` ones at rest.
    fn curvature(
        &self,
        system: &System,
        (moved, length): (&mut Kinematics, f64),
        velocity: &[f64],
        explicit: &[f64],
    ) -> Vec<f64> {
        let mut rates = vec![0.0; system.layout().size()];
        let (mut found, mut curvature) = (explicit.to_vec(), vec![0.0; explicit.len()]);
        for sign in [1.0, -1.0] {
            for (value, &row) in velocity.iter().zip(&self.found.columns) {
                let is_turn = system.layout().quantities()[row] == Quantity::Angle;
                rates[row] = sign * value / if is_turn { length } else { 1.0 };
            }
            self.accelerations(system, moved, &rates, &mut found);
            for ((sum, found), explicit) in curvature.iter_mut().zip(&found).zip(explicit) {
                *sum += 0.5 * (found - explicit);
            }
        }
        curvature
    }

    /// A velocity that satisfies the acting equations, by column, with arcs for angles; none if there is no motion.
    fn free_velocity(&self, work: &Work, sample: usize) -> Option<Vec<f64>> {
        let Work { gradient, norms, compact, factor, .. } = work;
        // Additive recurrences of the golden ratio are equidistributed.
        let mut velocity: Vec<f64> = (0..self.found.columns.len())
            .map(|column| {
                ((column * (2 * sample + 3) + sample) as f64 * 0.618_033_988_749_894_9).fract() - 0.5
            })
            .collect();
        let norm = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
        let given = norm(&velocity);
        // Repeated against round-off.
        for _ in 0..2 {
            let mut rates = vec![0.0; work.acting.len()];
            for (column, value) in gradient.columns.iter().zip(&velocity) {
                for &(equation, by) in column {
                    rates[compact[equation]] += by / norms[equation] * value;
                }
            }
            let mut shares: Vec<f64> = factor.kept.iter().map(|&equation| rates[equation]).collect();
            factor.substitute(&mut shares);
            factor.substitute_back(&mut shares);
            rates.fill(0.0);
            factor.kept.iter().zip(&shares).for_each(|(&equation, share)| rates[equation] = *share);
            for (column, value) in gradient.columns.iter().zip(&mut velocity) {
                *value -= column
                    .iter()
                    .map(|&(equation, by)| by / norms[equation] * rates[compact[equation]])
                    .sum::<f64>();
            }
        }
        (norm(&velocity) > round_off::NEGLIGIBLE * given).then_some(velocity)
    }

    /// Accelerations of the violations at these rates, by row of the layout, without those of the parts.
    fn accelerations(&self, system: &System, at: &mut Kinematics, rates: &[f64], out: &mut [f64]) {
        scatter_rates(system.layout(), rates, at);
        for (first, constraint) in self.found.constraints(system) {
            let mut own = [0.0; MAX_EQUATIONS];
            let own = &mut own[..constraint.equations()];
            constraint.acceleration(at, own);
            out[first..first + own.len()].copy_from_slice(own);
        }
    }

    /// Finds the self-stresses from the factor of the kept equations.
    fn find_stresses(&mut self, work: &mut Work) {
        let mut columns = std::mem::replace(&mut self.columns, DMatrix::zeros(0, 0));
        work.find_stresses(&self.selection.omitted, &mut columns);
        self.store(work, &columns);
        self.columns = columns;
    }

    fn store(&mut self, work: &Work, stresses: &DMatrix<f64>) {
        self.stresses.resize_with(stresses.ncols(), Stress::default);
        for (own, column) in self.stresses.iter_mut().zip(stresses.column_iter()) {
            own.entries.clear();
            own.is_of_positions = true;
            for (&equation, &value) in work.acting.iter().zip(&column).filter(|(_, value)| **value != 0.0) {
                let unit = work.units[equation];
                own.is_of_positions &= self.is_of_positions[equation];
                own.entries.push((self.found.multipliers[equation], value * unit, value / unit));
            }
        }
    }
}

impl Work {
    /// Factors B Bᵀ of these equations; returns the smallest pivot.
    fn keep(&mut self, equations: &[usize]) -> f64 {
        self.factor.clear();
        let count = self.acting.len();
        let pivots = equations.iter().map(|&own| {
            // Without those that are dependent at a singular position.
            let pivot = self.factor.try_row(&self.square, count, own, PIVOTS[PIVOTS.len() - 1]);
            pivot.unwrap_or(0.0)
        });
        pivots.fold(1.0, f64::min)
    }

    /// Angle between the motion that only `equation` prevents, given the coefficients of its nearest dependence, and its direction without
    /// the equation. A drive has a right angle, however large the mechanism that it moves.
    fn angle_of_motion(&self, coefficients: &DMatrix<f64>, equation: usize) -> f64 {
        let (mut whole, mut local) = (0.0_f64, 0.0_f64);
        for column in &self.gradient.columns {
            let value: f64 =
                column.iter().map(|&(k, by)| by / self.units[k] * coefficients[self.compact[k]]).sum();
            whole += value * value;
            if column.iter().any(|&(k, _)| self.norms[k] > 0.0 && self.compact[k] == equation) {
                local += value * value;
            }
        }
        let own = coefficients[equation].abs() * self.norms[self.acting[equation]]
            / self.units[self.acting[equation]];
        whole / (own * local.sqrt())
    }

    /// Self-stresses of which each contains one of the omitted equations, made orthonormal.
    fn stresses(&mut self, omitted: &[usize]) -> DMatrix<f64> {
        let mut stresses = DMatrix::zeros(0, 0);
        self.find_stresses(omitted, &mut stresses);
        stresses
    }

    /// Computes the self-stresses in storage that is used again.
    fn find_stresses(&mut self, omitted: &[usize], stresses: &mut DMatrix<f64>) {
        let Self { norms, units, acting, square, factor, shares, .. } = self;
        let count = acting.len();
        if stresses.shape() == (count, omitted.len()) {
            stresses.fill(0.0);
        } else {
            *stresses = DMatrix::zeros(count, omitted.len());
        }
        for (k, &equation) in omitted.iter().enumerate() {
            let row = &square[equation * count..(equation + 1) * count];
            shares.clear();
            shares.extend(factor.kept.iter().map(|&kept| row[kept]));
            factor.substitute(shares);
            factor.substitute_back(shares);
            // From multipliers of rows of unit norm to forces.
            let unit = |own: usize| units[acting[own]] / norms[acting[own]];
            stresses[(equation, k)] = unit(equation);
            for (&kept, share) in factor.kept.iter().zip(&*shares) {
                stresses[(kept, k)] = -share * unit(kept);
            }
        }
        // Modified Gram-Schmidt orthogonalisation, repeated against round-off.
        for _ in 0..2 {
            for k in 0..stresses.ncols() {
                let (earlier, mut own) = stresses.columns_range_pair_mut(..k, k);
                for earlier in earlier.column_iter() {
                    own.axpy(-earlier.dot(&own), &earlier, 1.0);
                }
                let norm = own.norm();
                if norm > 0.0 {
                    own.scale_mut(1.0 / norm);
                }
            }
        }
    }
}

impl Factor {
    fn clear(&mut self) {
        self.kept.clear();
        self.rows.clear();
        self.entries.clear();
    }

    /// Appends the row of an equation if its pivot exceeds `least`, and returns the pivot.
    fn try_row(&mut self, square: &[f64], count: usize, equation: usize, least: f64) -> Option<f64> {
        let own = &square[equation * count..(equation + 1) * count];
        let Self { kept, rows, entries } = self;
        let begin = entries.len();
        let first = kept.iter().position(|&other| own[other] != 0.0).unwrap_or(kept.len());
        let mut pivot = own[equation];
        for j in first..kept.len() {
            let (other_first, other_begin) = rows[j];
            let from = first.max(other_first);
            let (known, other) =
                (&entries[begin + (from - first)..begin + (j - first)], &entries[other_begin..]);
            let sum: f64 = known.iter().zip(&other[from - other_first..]).map(|(a, b)| a * b).sum();
            let value = (own[kept[j]] - sum) / other[j - other_first];
            pivot -= value * value;
            entries.push(value);
        }
        if pivot <= least {
            entries.truncate(begin);
            return None;
        }
        entries.push(pivot.sqrt());
        rows.push((first, begin));
        kept.push(equation);
        Some(pivot)
    }

    /// Kept equations with their pivots.
    fn pivots(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let ends = self.rows.iter().enumerate().map(|(j, &(first, begin))| self.entries[begin + j - first]);
        self.kept.iter().copied().zip(ends.map(|root| root * root))
    }

    /// Solves L x = b in place.
    fn substitute(&self, values: &mut [f64]) {
        for (j, &(first, begin)) in self.rows.iter().enumerate() {
            let own = &self.entries[begin..=begin + j - first];
            let sum: f64 = own.iter().zip(&values[first..j]).map(|(a, b)| a * b).sum();
            values[j] = (values[j] - sum) / own[j - first];
        }
    }

    /// Solves Lᵀ x = b in place.
    fn substitute_back(&self, values: &mut [f64]) {
        for (j, &(first, begin)) in self.rows.iter().enumerate().rev() {
            let own = &self.entries[begin..=begin + j - first];
            values[j] /= own[j - first];
            let value = values[j];
            for (other, by) in values[first..j].iter_mut().zip(own) {
                *other -= value * by;
            }
        }
    }
}

/// Joints of equations, except that of the equation `own`.
fn joints_of(system: &System, equations: &[usize], own: usize) -> Vec<Subject> {
    let (own, _) = system.layout().constraint_name(own);
    let mut joints: Vec<Subject> = Vec::new();
    for &k in equations {
        let (joint, _) = system.layout().constraint_name(k);
        let joint = Subject::new("joint", joint).called(format!("`{joint}`"));
        if joint.name != own && !joints.contains(&joint) {
            joints.push(joint);
        }
    }
    joints
}

/// One row for each column of orthonormal `stresses`, chosen by elimination with the largest entries.
fn most_stressed(mut stresses: DMatrix<f64>) -> Vec<usize> {
    let mut chosen = Vec::new();
    for k in 0..stresses.ncols() {
        let (row, _) = stresses.column(k).iter().enumerate().fold((0, 0.0), |most, (row, value)| {
            if value.abs() > most.1 { (row, value.abs()) } else { most }
        });
        let pivot = stresses.row(row).clone_owned();
        for j in k + 1..stresses.ncols() {
            let own = stresses.column(k).clone_owned();
            stresses.column_mut(j).axpy(-pivot[j] / pivot[k], &own, 1.0);
        }
        chosen.push(row);
    }
    chosen.sort_unstable();
    chosen
}
