//! Local error estimate of a step, filtered once through the tangent so that motions faster than the step are damped as by the
//! scheme itself.
//!
//! Legend: e linear combination of the increments and the start of the step that the scheme declares (`ErrorEstimate`), k its
//! order, p order of the scheme, J tangent in use with its constraints, so that constrained directions have no error, w₂ M its
//! inertial part, τ relative tolerance.
//!
//! ```text
//! ε = (|J⁻¹ w₂ M e| / (reference · τ^(k/p)/2))^(1/k)
//! ```
//!
//! If each of N steps of size h = 1/N has an error of h^(p+1), positions at the end have an error of h^p, which is τ with every
//! scheme. ε is the ratio of the step size to the largest allowed one. The filter is that of [Hairer and Wanner 1996, IV.8]. A
//! scheme of several stages has two estimates, of which the larger ε is used. The norm is the maximum norm, with lengths relative
//! to ℓ_r. The reference is the largest displacement or rotation of a node since the start, or that of a drive within the longest
//! step, at most 1. The mean displacement of all nodes is compared with its own largest value, if that is longer: an orbit is not
//! resolved to a fraction of the satellite's size.

use lissom_motion::Vector3;

use super::Integrator;
use super::workspace::Workspace;
use crate::elements::contribution::CoordinateMass;
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, Layout, NodeId, Quantity, Subject};
use crate::schemes::ErrorEstimate;
use crate::settings::Problem;
use crate::spin::Axes;
use crate::system::{Drive, System};

/// Motions smaller than this fraction of the model's size are not resolved individually.
pub(crate) const MIN_REFERENCE: f64 = 1e-6;

/// Errors of a step below this fraction of the model's size are round-off, which no smaller step reduces.
pub(crate) const MIN_ERROR: f64 = 3e-13;

/// Largest scaled displacement or rotation of a node, or change of a generalised coordinate, between two instants, at
/// most 1.
pub(crate) fn excursion(system: &System, (from, to): (&Kinematics, &Kinematics), length: f64) -> f64 {
    let way = |&own: &CoordinateId| {
        let change = (to.coordinates[own].value - from.coordinates[own].value).abs();
        if system.layout().coordinate_quantity(own) == Quantity::Length { change / length } else { change }
    };
    // Coordinates of joints appear in the motion of the attached nodes.
    let mut most = system.free_coordinates.iter().map(way).fold(0.0_f64, f64::max).min(1.0);
    for (a, b) in from.nodes.iter().zip(&to.nodes) {
        let shift = (b.frame.position - a.frame.position).norm() / length;
        let [p, q] = [a, b].map(|node| node.frame.rotation.quaternion());
        // |sin(φ/2)| of the relative rotation, from the chord between the two unit quaternions.
        let chord = |sign: f64| p.iter().zip(&q).map(|(p, q)| (p - sign * q).powi(2)).sum::<f64>();
        let turn = 2.0 * chord(1.0).min(chord(-1.0)).sqrt();
        most = most.max(shift).max(turn);
        if most >= 1.0 {
            return 1.0;
        }
    }
    most
}

/// Mean of a vector over the nodes that can move, in global axes.
fn mean(layout: &Layout, of: impl Fn(NodeId) -> Vector3) -> Vector3 {
    let moving = layout.nodes().filter(|&node| layout.rows_of_node(node).iter().any(|&row| row != LOCKED));
    let (sum, count) =
        moving.fold((Vector3::zeros(), 0.0_f64), |(sum, count), node| (sum + of(node), count + 1.0));
    sum / count.max(1.0)
}

/// Mean displacement of the nodes between two instants [m].
pub(crate) fn travel(system: &System, (from, to): (&Kinematics, &Kinematics)) -> f64 {
    mean(system.layout(), |node| to.nodes[node].frame.position - from.nodes[node].frame.position).norm()
}

/// Size of a scaled displacement by row over the allowed one; the mean displacement of the nodes has a limit of its own, if that is
/// larger. A NaN counts as the largest.
pub(crate) fn relative_size(
    system: &System,
    at: &Kinematics,
    scaled: impl Fn(usize) -> f64,
    [allowed, of_mean]: [f64; 2],
) -> f64 {
    let layout = system.layout();
    let rows = 0..layout.coordinate_count();
    if of_mean <= allowed {
        return largest(rows.map(scaled)) / allowed;
    }
    let own = |row: u32| if row == LOCKED { 0.0 } else { scaled(row as usize) };
    let global = |node: NodeId| {
        let rows = layout.rows_of_node(node);
        at.nodes[node].frame.rotation.apply(&Vector3::from_fn(|k, _| own(rows[k])))
    };
    let mean = mean(layout, global);
    let of_node = |node: NodeId| {
        let common = at.nodes[node].frame.rotation.apply_inverse(&mean);
        let rows = layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED);
        rows.map(move |(k, &row)| (k, row))
            .map(move |(k, row)| own(row) - if k < 3 { common[k] } else { 0.0 })
    };
    let others = layout.coordinate_rows.iter().map(|&row| own(row));
    let apart = largest(layout.nodes().flat_map(of_node).chain(others)) / allowed;
    larger(apart, mean.norm() / of_mean)
}

/// The larger of two numbers; a NaN counts as the largest.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

/// Largest magnitude; a NaN counts as the largest.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, larger)
}

/// Largest change of a drive between two instants, at most 1.
pub(crate) fn driven(system: &System, (from, to): (f64, f64), length: f64) -> f64 {
    let of = |drive: &Drive| {
        let function = &drive.prescribed.value;
        let way = (function.value(to) - function.value(from)).abs();
        let row = system.layout().row_of_coordinate(drive.prescribed.coordinate);
        if system.layout().quantities()[row] == Quantity::Length { way / length } else { way }
    };
    system.drives().iter().map(of).fold(0.0_f64, f64::max).min(1.0)
}

/// `out = M e` over the coordinate rows; zero for massless coordinates.
pub(crate) fn inertial_part(system: &System, at: &Kinematics, error: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for inertia in system.inertias() {
        let rows = system.layout().rows_of_node(inertia.node());
        for (i, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            let mut sum = 0.0;
            for (k, &column) in rows.iter().enumerate().filter(|&(_, &column)| column != LOCKED) {
                sum += inertia.mass()[(i, k)] * error[column as usize];
            }
            out[row as usize] += sum;
        }
    }
    system.masses(at, &mut |mass| {
        let value = |&row: &u32| if row == LOCKED { 0.0 } else { error[row as usize] };
        let local: Vec<f64> = mass.rows.iter().map(value).collect();
        mass.times(&local, |row, sum| {
            if mass.rows[row] != LOCKED {
                out[mass.rows[row] as usize] += sum;
            }
        });
    });
    for CoordinateMass { coordinates, matrix } in &system.coordinate_masses {
        let rows: Vec<usize> =
            coordinates.iter().map(|&own| system.layout().row_of_coordinate(own)).collect();
        for (i, &row) in rows.iter().enumerate() {
            let products = rows.iter().enumerate().map(|(k, &column)| matrix[(i, k)] * error[column]);
            out[row] += products.sum::<f64>();
        }
    }
}

impl Integrator {
    /// Stores the estimated error of the last attempt, which ended at `end`, in the workspace, unfiltered and filtered. It is not
    /// filtered if forces have switched at the start of the step (`has_switched`).
    pub(crate) fn estimate_error(
        &mut self,
        problem: Problem<'_>,
        estimate: &ErrorEstimate,
        end: &Kinematics,
        has_switched: bool,
    ) {
        self.filter_error(problem, estimate, end, has_switched);
        let Workspace { unit, error, .. } = &mut *self.work;
        let count = error.at_end.len();
        error.at_end.copy_from_slice(&error.filtered[..count]);
        unit.spins.turn(&mut error.at_end, [Axes::Tangent, Axes::Body(self.scaled.step_size())]);
    }

    fn filter_error(
        &mut self,
        problem: Problem<'_>,
        estimate: &ErrorEstimate,
        end: &Kinematics,
        has_switched: bool,
    ) {
        let Problem { system, settings } = problem;
        let scheme = &settings.scheme;
        let work = &mut *self.work;
        let is_of_states = scheme.errors.last() == Some(estimate);
        let quantities = system.layout().quantities();
        for (row, error) in work.error.unfiltered.iter_mut().enumerate() {
            let is_defined = is_of_states || quantities[row] != Quantity::State;
            *error = if is_defined {
                work.unit.combine(&estimate.combination, &work.increments, row)
            } else {
                0.0
            };
        }
        let (motion, constraints) = work.error.filtered.split_at_mut(work.error.unfiltered.len());
        if has_switched {
            // The filter would suppress a motion that the switch has just started, such as an impact on a stiff stop.
            motion.copy_from_slice(&work.error.unfiltered);
            system.layout().states().for_each(|(row, ..)| motion[row] = 0.0);
            work.unit.spins.turn(motion, [Axes::Still, Axes::Tangent]);
            return;
        }
        inertial_part(system, end, &work.error.unfiltered, motion);
        // Inertias of rotors are the same in all axes that are turned about theirs.
        work.unit.spins.turn(motion, [Axes::Still, Axes::Tangent]);
        constraints.fill(0.0);
        work.tangent.scale(&mut work.error.filtered);
        work.tangent.matrices.solve_inertial(&scheme.coupling, &mut work.error.filtered);
        work.tangent.scale(&mut work.error.filtered);
    }

    /// Takes the velocity at the start out of the dense output in constrained directions and those of stiff parts. The last error of a
    /// collocation scheme, which must have been estimated, is proportional to the velocity that its stages imply at the start.
    pub(crate) fn correct_dense_start(&mut self, Problem { system, settings }: Problem<'_>) {
        let scheme = &settings.scheme;
        let (Some(dense), Some(estimate)) = (&scheme.dense, scheme.errors.last()) else { return };
        let work = &mut *self.work;
        let factor = dense.slopes_at_start().next().unwrap_or(0.0) / estimate.combination.increments[0];
        let errors = work.error.unfiltered.iter().zip(&work.error.filtered);
        for (change, (whole, free)) in work.start_change.iter_mut().zip(errors) {
            *change = factor * (whole - free);
        }
        for spin in work.unit.spins.iter() {
            for &row in spin.rows() {
                work.start_change[row] = factor * work.error.unfiltered[row];
            }
            let free = spin.in_still_axes(&work.error.filtered);
            for (&row, free) in spin.rows().iter().zip(free.iter()) {
                work.start_change[row] -= factor * free;
            }
        }
        // Rates of first-order states follow from the states.
        system.layout().states().for_each(|(row, ..)| work.start_change[row] = 0.0);
    }

    /// The unknown with the largest estimated error of the last attempt.
    pub(crate) fn most_inaccurate(&self, system: &System, at: &Kinematics) -> Subject {
        let (error, units) = (&self.work.error, &self.work.units.coordinates);
        let all = error.filtered.iter().zip(units).map(|(error, size)| (error * size).abs());
        // States are not filtered, and relative to their magnitude.
        let states = system.layout().states().map(|(row, own, magnitude)| {
            (row, (error.unfiltered[row] / magnitude.max(at.coordinates[own].value.abs())).abs())
        });
        let most = all.enumerate().chain(states).max_by(|a, b| a.1.total_cmp(&b.1));
        system.layout().subject_of(most.map_or(0, |(row, _)| row))
    }
}
