//! A rotor whose equations change with the azimuth, such as under gravity across its axis or in a wind that it meets at an angle, averaged
//! over a turn [Bir 2008].
//!
//! Legend: ψ azimuth, G generator of the transformation to axes at rest (`multiblade`), A one of the matrices M, D and K in the axes of
//! the nodes. The mean of the residuals over the azimuth vanishes in the axes of the nodes.
//!
//! ```text
//! Ā = 1/n Σ exp(ψ_k G) A(ψ_k) exp(-ψ_k G),    ψ_k = 2π k/n
//! ```
//!
//! The periodic part of the motion is omitted, such as the sag of blades by their weight, and so are the forces that it transmits to the
//! support: the support carries its own weight and that of no rotor. What the periodic part of the matrices causes is of second order.

use std::f64::consts::TAU;
use std::sync::Arc;

use lissom_motion::Vector3;
use lissom_solver::{Pattern, Structure};

use super::mode::{Mode, ModeKind};
use super::model::{LinearError, LinearModel, nothing, point};
use super::multiblade::{self, MAX_BLADES, NoMultiblade};
use super::rolling_axes;
use super::steady::RELATIVE_SHIFT;
use crate::joints::evaluation_point::Chart;
use crate::kinematics::Kinematics;
use crate::system::{Linearization, State, System};

/// A model averaged over the azimuth.
pub struct AveragedModel<'a> {
    /// The mean, in axes at rest.
    pub mean: LinearModel<'a>,
    /// The models of every third azimuth.
    samples: Vec<(f64, LinearModel<'a>)>,
}

impl AveragedModel<'_> {
    /// The largest relative change of an eigenvalue of `modes`, of the mean, if the matrices of single azimuths were constant.
    ///
    /// # Errors
    /// If the matrices cannot be factorised.
    pub fn variation_of(&self, modes: &[Mode]) -> Result<f64, LinearError> {
        let mut largest = 0.0_f64;
        for (angle, model) in &self.samples {
            for mode in modes.iter().filter(|mode| mode.kind == ModeKind::Oscillation) {
                // A deviation of 1 at the shift 0.9 s is a relative change of s² by 1 - 0.9², half of which is that of s.
                let change = 0.5 * (1.0 - RELATIVE_SHIFT * RELATIVE_SHIFT);
                largest = largest.max(change * self.mean.deviation_at(mode, model, *angle)?.size);
            }
        }
        Ok(largest)
    }
}

/// The azimuths of a mean; their number is a prime above those of blades, so that each blade is at azimuths of its own.
pub(super) fn azimuths() -> [f64; MAX_BLADES + 1] {
    std::array::from_fn(|k| TAU * k as f64 / (MAX_BLADES + 1) as f64)
}

/// Positions after a rotation of the rotor by `angle`: each node is moved by its own twist.
fn rotated(system: &System, at: &Kinematics, angle: f64) -> Kinematics {
    let rate = at.nodes.iter().map(|node| node.angular_velocity().norm()).fold(0.0, f64::max);
    let time = if rate > 0.0 { angle / rate } else { 0.0 };
    let mut at = at.clone();
    let spins = rolling_axes::spins(system, &at);
    for (node, spin) in at.nodes.iter_mut().zip(&spins) {
        (node.frame, node.twist) = rolling_axes::later(node.frame, &node.twist, spin, time);
    }
    for coordinate in &mut at.coordinates {
        coordinate.value += time * coordinate.rate;
    }
    at
}

/// Means over `azimuths` of the residual and of its derivatives, in the axes of the nodes. The derivatives of constraints are those of the
/// state.
pub(super) fn mean_equations(
    system: &System,
    state: &State,
    violations: &[f64],
    azimuths: &[f64],
    (mean, parts): (&mut [f64], &mut Linearization),
) {
    let (still, unchanged) = nothing(&state.kinematics);
    let weight = 1.0 / azimuths.len() as f64;
    let mut residual = vec![0.0; mean.len()];
    let mut own = system.empty_linearization();
    mean.fill(0.0);
    for (k, &angle) in azimuths.iter().enumerate() {
        let mut at = rotated(system, &state.kinematics, angle);
        at.show_multipliers(&state.multipliers);
        let at = point(&at, (&still, &unchanged), &state.multipliers, violations);
        system.residual(&at, &mut residual);
        for (mean, value) in mean.iter_mut().zip(&residual) {
            *mean += weight * value;
        }
        system.linearize(&at, Chart::RelativeToDrift(&at.at.nodes, &[]), &mut own);
        own.fold_multipliers();
        if k == 0 {
            parts.clone_from(&own);
        }
        let sums = [&mut parts.mass, &mut parts.damping, &mut parts.stiffness];
        for (sum, own) in sums.into_iter().zip([&own.mass, &own.damping, &own.stiffness]) {
            for (sum, value) in sum.iter_mut().zip(own) {
                *sum = if k == 0 { weight * value } else { *sum + weight * value };
            }
        }
    }
}

impl<'a> LinearModel<'a> {
    /// The model of this state after a rotation by `angle`.
    ///
    /// # Errors
    /// If there is no linear model there.
    pub(super) fn rotated_by(&self, angle: f64) -> Result<LinearModel<'a>, LinearError> {
        let kinematics = rotated(self.system, &self.at, angle);
        let size = self.multipliers().len();
        let state = State {
            position_remainders: vec![Vector3::zeros(); kinematics.nodes.len()],
            algorithmic: vec![0.0; self.coordinate_count()],
            violations: vec![0.0; size],
            multipliers: self.multipliers().to_vec(),
            time_remainder: 0.0,
            accumulated: Vec::new(),
            touches: Vec::new(),
            kinematics,
        };
        LinearModel::of(self.system, &state, self.solver)
    }

    /// The model averaged over the azimuth; this is the model of one azimuth of a state whose mean residual vanishes.
    ///
    /// # Errors
    /// If the rotor has no multi-blade coordinates, or there is no linear model at another azimuth.
    pub fn averaged(&self) -> Result<Result<AveragedModel<'a>, NoMultiblade>, LinearError> {
        let generator = match multiblade::generator(self) {
            Ok(generator) => generator,
            Err(none) => return Ok(Err(none)),
        };
        let own = self.pattern();
        let count = self.coordinate_count();
        let sets = generator.closed_sets();
        let reached = |row: usize| sets.get(row).cloned().unwrap_or_else(|| vec![row]);
        let wide = Pattern::from_entries(
            own.size(),
            (0..own.size()).flat_map(|column| {
                let rows: Vec<usize> = own.column(column).iter().flat_map(|&row| reached(row)).collect();
                let pairs = move |column| rows.clone().into_iter().map(move |row| (row, column));
                reached(column).into_iter().flat_map(pairs)
            }),
        );
        let mut parts = self.system.empty_linearization();
        let values = [
            &mut parts.mass,
            &mut parts.damping,
            &mut parts.stiffness,
            &mut parts.gram,
            &mut parts.constraint,
        ];
        for values in values {
            *values = vec![0.0; wide.entries()];
        }
        let mut samples = Vec::new();
        let azimuths = azimuths();
        for (k, &angle) in azimuths.iter().enumerate() {
            let model = self.rotated_by(angle)?;
            let turn = generator.exponential(angle, &sets);
            for column in 0..own.size() {
                for at in own.column_starts()[column]..own.column_starts()[column + 1] {
                    let row = own.row_indices()[at];
                    if k == 0
                        && let Some(slot) = wide.position(row, column)
                    {
                        parts.gram[slot] = model.parts.gram[at];
                        parts.constraint[slot] = model.parts.constraint[at];
                    }
                    let values = [model.parts.mass[at], model.parts.damping[at], model.parts.stiffness[at]];
                    if row >= count || column >= count || values == [0.0; 3] {
                        continue;
                    }
                    for &(row, left) in &turn[row] {
                        for &(column, right) in &turn[column] {
                            let Some(slot) = wide.position(row, column) else { continue };
                            let weight = left * right / azimuths.len() as f64;
                            parts.mass[slot] += weight * values[0];
                            parts.damping[slot] += weight * values[1];
                            parts.stiffness[slot] += weight * values[2];
                        }
                    }
                }
            }
            if k % 3 == 0 {
                samples.push((angle, model));
            }
        }
        let structure = Structure { pattern: Arc::new(wide), groups: self.structure().groups.clone() };
        let mean = self.with_generator(parts, structure, generator.clone());
        Ok(Ok(AveragedModel { mean: mean.in_axes_of(generator), samples }))
    }
}
