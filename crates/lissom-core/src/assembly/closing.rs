//! Closes joints: Gauss-Newton steps of least size, damped where they do not help (Levenberg and Marquardt).
//!
//! ```text
//! [W Bᵀ; B -μ] [δ; λ] = [-W d; -c]
//! ```
//!
//! with the violations c relative to the model's size, d = 0 while joints close, and then d = the change so far: at the
//! solution W d + Bᵀ λ = 0 and c = 0, so that no smaller change closes the joints.

use lissom_motion::{Motion, Rotation, Vector3};
use lissom_solver::{Pattern, Structure};

use super::columns::Columns;
use super::groups::Groups;
use super::{Gap, MIN_REPORTED, gap};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::saddle_point::{Matrix, SaddlePoint};
use crate::system::System;

const MAX_ITERATIONS: usize = 200;
/// Coordinates of joints follow the parts: their weight only makes them unique.
const WEIGHT_OF_COORDINATE: f64 = 1e-8;
/// Largest displacement of a step, relative to the model's size.
const MAX_SHIFT: f64 = 0.25;
/// Largest rotation of a step [rad].
const MAX_TURN: f64 = 0.3;
/// Damping μ at the start, where it gives up, and that of constraints that repeat each other.
const DAMPING: [f64; 3] = [1e-6, 1e8, 1e-10];
/// Joints are closed to this part of the tolerance, as round-off allows.
const CLOSING_SHARE: f64 = 1e-3;
/// Steps that make the violations smaller by less than this part are slow; so many of them end in a least gap.
const SLOW_PROGRESS: (f64, usize) = (1e-8, 5);
/// Steps below this, relative to the model's size, no longer change the least change.
const SETTLED: f64 = 1e-9;

/// Up to so many unknowns a dense matrix is faster.
const DENSE: usize = 60;

/// Where everything is.
#[derive(Clone)]
pub(super) struct Pose {
    /// Of every rigid group.
    pub(super) frames: Vec<Motion>,
    /// Of every coordinate.
    pub(super) coordinates: Vec<f64>,
}

/// The equations of an assembly.
pub(super) struct Closing<'a> {
    columns: Columns<'a>,
    groups: &'a Groups,
    at: Kinematics,
    structure: Structure,
    /// None where there is nothing to solve for.
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
        // Small weights of coordinates cost digits without exchanges of rows, and so does their equilibration.
        let sparse = lissom_solver::kind("pivoting").filter(|_| size > DENSE);
        let kind = sparse.or_else(|| lissom_solver::kind("dense"));
        let saddle = kind.filter(|_| !is_empty).map(|kind| {
            let matrix = Matrix::new((kind.real)(&structure), &structure);
            SaddlePoint::new(matrix, columns.count[0]).without_compliance()
        });
        Self { columns, groups, at: at.clone(), structure, saddle }
    }

    /// Size of the model [m].
    pub(super) fn length(&self) -> f64 {
        self.groups.length
    }

    /// The pose as drawn, with coordinates as they are at `at`.
    pub(super) fn as_modelled(&self, at: &Kinematics) -> Pose {
        Pose {
            frames: self.groups.all.iter().map(|group| group.frame).collect(),
            coordinates: at.coordinates.iter().map(|own| own.value).collect(),
        }
    }

    /// Puts all nodes and coordinates to their places.
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

    /// Violations of the equations that count, relative to the model's size.
    fn violations(&mut self, pose: &Pose) -> Vec<f64> {
        self.place_own(pose);
        let Columns { system, rows, .. } = &self.columns;
        let mut violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&self.at, &mut violations);
        rows.iter().map(|&k| violations[k] * self.columns.row_scale(k)).collect()
    }

    /// The largest of them.
    pub(super) fn largest(&mut self, pose: &Pose) -> f64 {
        largest(&self.violations(pose))
    }

    /// The gaps beyond `tolerance`, the widest first; small ones beside wide ones are left out.
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

    /// The step δ, then the multipliers; none where the matrix cannot be factored.
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
        saddle.solve(&self.structure, &mut right);
        right.iter().all(|value| value.is_finite()).then_some(right)
    }

    /// The pose after a step, which is shortened where it is too long.
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

    /// Closes the joints as far as they close, with steps of least size.
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

    /// The closed pose nearest to `drawn`, from one that is closed; none where it is not found.
    pub(super) fn nearest(&mut self, start: Pose, drawn: &Pose, tolerance: f64) -> Option<Pose> {
        let mut pose = start;
        for _ in 0..MAX_ITERATIONS {
            let change = self.change(&pose, drawn);
            let violations = self.violations(&pose);
            let step = self.solve(&pose, (&change, &violations), DAMPING[2])?;
            pose = self.moved(&pose, &step);
            if largest(&step[..self.columns.count[1]]) <= SETTLED {
                let closed = self.close(pose, tolerance);
                return (self.largest(&closed) <= tolerance).then_some(closed);
            }
        }
        None
    }

    /// What has changed since `drawn`, by column; coordinates have no part in it.
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

/// The largest size; a value that is not a number is the largest of all.
fn largest(values: &[f64]) -> f64 {
    let size = |value: &f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    values.iter().map(size).fold(0.0, f64::max)
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}
