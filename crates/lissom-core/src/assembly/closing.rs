//! Closes joints by minimum-norm Gauss-Newton steps, damped if they do not reduce the violations (Levenberg and Marquardt).
//!
//! ```text
//! [W Bᵀ; B -μ] [δ; λ] = [-W d; -c]
//! ```
//!
//! with the violations c relative to the model's size and d = 0 while joints are being closed. Then d is the change so far: at the
//! solution W d + Bᵀ λ = 0 and c = 0, so that no smaller change closes the joints.

use lissom_motion::{Motion, Rotation, Vector3};
use lissom_solver::{Pattern, Structure};

use super::columns::Columns;
use super::groups::Groups;
use super::{Gap, MIN_REPORTED, gap};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::round_off;
use crate::saddle_point::{Matrix, SaddlePoint};
use crate::system::System;
use crate::tuning::MAX_ITERATIONS;

/// Weight of joint coordinates, which follow the parts: it only makes them unique.
const WEIGHT_OF_COORDINATE: f64 = 1e-8;
/// Largest displacement of a step, relative to the model's size.
const MAX_SHIFT: f64 = 0.25;
/// Largest rotation of a step [rad].
const MAX_TURN: f64 = 0.3;
/// Initial damping μ, the damping at which the iteration is given up, and the minimum, which regularises redundant constraints.
const DAMPING: [f64; 3] = [1e-6, 1e8, 1e-10];
/// Fraction of the tolerance to which joints are closed, in view of round-off.
const CLOSING_SHARE: f64 = 1e-3;
/// Relative decrease of the squared violations below which a step is slow, and number of consecutive slow steps that are allowed.
const SLOW_PROGRESS: (f64, usize) = (1e-8, 5);

/// Positions of all groups and coordinates.
#[derive(Clone)]
pub(super) struct Pose {
    /// Frames of the rigid groups.
    pub(super) frames: Vec<Motion>,
    /// Values of the coordinates.
    pub(super) coordinates: Vec<f64>,
}

/// Equations of an assembly.
pub(super) struct Closing<'a> {
    columns: Columns<'a>,
    groups: &'a Groups,
    at: Kinematics,
    structure: Structure,
    /// None if there are no unknowns or no equations.
    saddle: Option<SaddlePoint<Matrix<f64>>>,
}

impl<'a> Closing<'a> {
    pub(super) fn new(
        system: &'a System,
        at: &Kinematics,
        groups: &'a Groups,
        held: &[CoordinateId],
    ) -> Self {
        let columns = Columns::new(system, groups, held);
        let mut entries: Vec<(usize, usize)> = Vec::new();
        columns.each_entry(None, |row, column, _| entries.extend([(row, column), (column, row)]));
        let size = columns.count[0] + columns.rows.len();
        let structure = Structure::ungrouped(Pattern::from_entries(size, entries).into());
        let is_empty = columns.count[0] == 0 || columns.rows.is_empty();
        // Without row exchanges, and with equilibration, the small weights of coordinates cost accuracy.
        let kind = lissom_solver::kind("pivoting").filter(|_| !is_empty);
        let saddle = kind.map(|kind| {
            let matrix = Matrix::new((kind.real)(&structure), &structure);
            SaddlePoint::new(matrix, columns.count[0]).with_all_equations()
        });
        Self { columns, groups, at: at.clone(), structure, saddle }
    }

    /// Characteristic length of the model [m].
    pub(super) fn length(&self) -> f64 {
        self.groups.length
    }

    /// The pose as modelled, with the coordinates of `at`.
    pub(super) fn as_modelled(&self, at: &Kinematics) -> Pose {
        Pose {
            frames: self.groups.all.iter().map(|group| group.frame).collect(),
            coordinates: at.coordinates.iter().map(|own| own.value).collect(),
        }
    }

    /// Sets the positions of all nodes and coordinates.
    pub(super) fn place(&self, pose: &Pose, at: &mut Kinematics) {
        self.groups.place(&pose.frames, at);
        for (own, &value) in at.coordinates.iter_mut().zip(&pose.coordinates) {
            own.value = value;
        }
    }

    fn place_own(&mut self, pose: &Pose) {
        self.groups.place(&pose.frames, &mut self.at);
        for (own, &value) in self.at.coordinates.iter_mut().zip(&pose.coordinates) {
            own.value = value;
        }
    }

    /// Violations of the equations in use, relative to the model's size.
    fn violations(&mut self, pose: &Pose) -> Vec<f64> {
        self.place_own(pose);
        let Columns { system, rows, .. } = &self.columns;
        let mut violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&self.at, &mut violations);
        rows.iter().map(|&k| violations[k] * self.columns.row_scale(k)).collect()
    }

    /// Largest relative violation.
    pub(super) fn largest(&mut self, pose: &Pose) -> f64 {
        largest(&self.violations(pose))
    }

    /// Gaps beyond `tolerance`, the widest first, without those that are small relative to the widest.
    pub(super) fn gaps(&mut self, pose: &Pose, tolerance: f64) -> Vec<Gap> {
        let violations = self.violations(pose);
        let Columns { system, rows, .. } = &self.columns;
        let (layout, length) = (system.layout(), self.groups.length);
        let mut found: Vec<(f64, Gap)> = Vec::new();
        let all: Vec<(usize, f64)> = rows.iter().copied().zip(violations).collect();
        let is_same = |a: &(usize, f64), b: &(usize, f64)| {
            layout.constraint_name(a.0).0 == layout.constraint_name(b.0).0
        };
        for of_joint in all.chunk_by(is_same) {
            let (joint, _) = layout.constraint_name(of_joint[0].0);
            let [mut distance, mut angle] = [0.0_f64; 2];
            for &(multiplier, value) in of_joint {
                match layout.quantities()[layout.coordinate_count() + multiplier] {
                    Quantity::Angle => angle = angle.hypot(value),
                    Quantity::Length | Quantity::State => distance = distance.hypot(value),
                }
            }
            if let Some(gap) = gap(joint, (distance, angle), (length, tolerance)) {
                found.push((largest(&[distance, angle]), gap));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let widest = found.first().map_or(0.0, |(size, _)| *size);
        found.into_iter().filter(|(size, _)| *size >= MIN_REPORTED * widest).map(|(_, gap)| gap).collect()
    }

    /// Computes the step δ and the multipliers; none if the matrix is singular.
    fn solve(
        &mut self,
        pose: &Pose,
        (change, violations): (&[f64], &[f64]),
        damping: f64,
    ) -> Option<Vec<f64>> {
        self.place_own(pose);
        let linearization = self.columns.system.linearization_at(&self.at);
        let pattern = &self.structure.pattern;
        let saddle = self.saddle.as_mut()?;
        let values = &mut saddle.matrices.values;
        values.fill(0.0);
        let mut add = |row: usize, column: usize, value: f64| {
            if let Some(position) = pattern.position(row, column) {
                values[position] += value;
            }
        };
        self.columns.each_entry(Some(&linearization.constraint), |row, column, value| {
            add(row, column, value);
            add(column, row, value);
        });
        let [columns, of_groups] = self.columns.count;
        let mut right: Vec<f64> = Vec::with_capacity(pattern.size());
        for (column, change) in change.iter().enumerate() {
            let weight = if column < of_groups { 1.0 } else { WEIGHT_OF_COORDINATE };
            add(column, column, weight);
            right.push(-weight * change);
        }
        for (row, violation) in violations.iter().enumerate() {
            add(columns + row, columns + row, -damping);
            right.push(-violation);
        }
        saddle.factor(&self.structure, 1.0).ok()?;
        saddle.solve(&mut right);
        right.iter().all(|value| value.is_finite()).then_some(right)
    }

    /// The pose after a step, which is scaled down if it is too long.
    fn moved(&self, pose: &Pose, step: &[f64]) -> Pose {
        let length = self.groups.length;
        let of_group = |index: usize| {
            let of = |k: usize| self.columns.of_group[index][k].map_or(0.0, |column| step[column]);
            let shift = length * Vector3::new(of(0), of(1), of(2));
            let turn = length / self.groups.all[index].radius * Vector3::new(of(3), of(4), of(5));
            (shift, turn)
        };
        let longest = (0..self.groups.all.len())
            .map(of_group)
            .map(|(shift, turn)| (shift.norm() / (MAX_SHIFT * length)).max(turn.norm() / MAX_TURN))
            .fold(1.0, f64::max);
        let mut moved = pose.clone();
        for (index, frame) in moved.frames.iter_mut().enumerate() {
            let (shift, turn) = of_group(index);
            frame.position += frame.rotation.apply(&(shift / longest));
            frame.rotation = (frame.rotation * Rotation::exponential(&(turn / longest))).normalized();
        }
        for (coordinate, value) in CoordinateId::enumerate(&mut moved.coordinates) {
            if let Some(column) = self.columns.of_coordinate[coordinate.index()] {
                *value += self.columns.unit(coordinate) * step[column] / longest;
            }
        }
        moved
    }

    /// Closes the joints as far as possible, with minimum-norm steps.
    pub(super) fn close(&mut self, start: Pose, tolerance: f64) -> Pose {
        let mut pose = start;
        let mut violations = self.violations(&pose);
        let [mut damping, most, least] = DAMPING;
        let still = vec![0.0; self.columns.count[0]];
        let mut slow = 0;
        for _ in 0..MAX_ITERATIONS {
            if largest(&violations) <= CLOSING_SHARE * tolerance || damping > most || slow > SLOW_PROGRESS.1 {
                break;
            }
            let step = self.solve(&pose, (&still, &violations), damping);
            let next = step.map(|step| self.moved(&pose, &step)).map(|next| (self.violations(&next), next));
            let before = square(&violations);
            match next {
                Some((found, next)) if square(&found) < before => {
                    slow = if square(&found) > (1.0 - SLOW_PROGRESS.0) * before { slow + 1 } else { 0 };
                    (pose, violations) = (next, found);
                    damping = (0.1 * damping).max(least);
                }
                _ => damping *= 10.0,
            }
        }
        pose
    }

    /// The closed pose nearest to `drawn`, from a closed `start`; none if it is not found.
    pub(super) fn nearest(&mut self, start: Pose, drawn: &Pose, tolerance: f64) -> Option<Pose> {
        let mut pose = start;
        for _ in 0..MAX_ITERATIONS {
            let change = self.change(&pose, drawn);
            let violations = self.violations(&pose);
            let step = self.solve(&pose, (&change, &violations), DAMPING[2])?;
            pose = self.moved(&pose, &step);
            if largest(&step[..self.columns.count[1]]) <= round_off::EQUILIBRIUM {
                let closed = self.close(pose, tolerance);
                return (self.largest(&closed) <= tolerance).then_some(closed);
            }
        }
        None
    }

    /// Change since `drawn`, by column; that of coordinates is zero.
    fn change(&self, pose: &Pose, drawn: &Pose) -> Vec<f64> {
        let mut change = vec![0.0; self.columns.count[0]];
        for (index, (now, before)) in pose.frames.iter().zip(&drawn.frames).enumerate() {
            let shift = now.rotation.apply_inverse(&(now.position - before.position)) / self.groups.length;
            let turn = (before.rotation.inverse() * now.rotation).logarithm();
            let turn = turn * (self.groups.all[index].radius / self.groups.length);
            for (k, value) in shift.iter().chain(&turn).enumerate() {
                if let Some(column) = self.columns.of_group[index][k] {
                    change[column] = *value;
                }
            }
        }
        change
    }
}

/// Maximum norm; infinite if a value is NaN.
fn largest(values: &[f64]) -> f64 {
    let size = |value: &f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    values.iter().map(size).fold(0.0, f64::max)
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}
