//! Kinks and jumps of forces at the state of a linear model: derivatives there are one-sided, and the linear model does not
//! describe small motions.
//!
//! ```text
//! (r(hx) + r(-hx) - 2 r(0))/h    and    (r(hx) - r(-hx))/2h,      h → 0
//! ```
//!
//! The first vanishes with h and the second has a limit if forces are smooth, for every law. The directions x are random ones
//! that satisfy the constraints, once as displacements and once as velocities.

use lissom_motion::{Motion, Vector6};
use lissom_solver::Pattern;

use super::krylov::Noise;
use super::model::{LinearModel, nothing, point};
use super::shifted::{GeneralShift, START_RATE, small_square};
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, NodeId, Quantity};
use crate::round_off;

/// Number of directions.
const DIRECTIONS: usize = 3;
/// Steps along them, over the model's length. A state that is nearer to a kink than the last one is at the kink.
const STEPS: [f64; 3] = [1e-5, 6.25e-7, 4e-8];
/// Differences of smooth forces decrease by a far smaller factor than this from step to step.
const FALLS: f64 = 0.5;
/// Weight of the stiffness relative to the damping for forces that depend on velocities.
const BESIDE_DAMPING: f64 = 1e-3;

/// A kink or a jump of a force at the state of a linear model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kink {
    /// The law or the unknown whose equation has it.
    pub name: String,
    /// Whether the force has it as a function of velocities, not of displacements.
    pub is_of_rate: bool,
}

impl LinearModel<'_> {
    /// The kink or the jump of a force at the state; none if all forces are smooth there.
    pub fn kink(&self) -> Option<Kink> {
        let mut noise = Noise(11);
        (0..DIRECTIONS).find_map(|_| {
            let direction = self.admitted_direction(&mut noise)?;
            [false, true].into_iter().find_map(|is_of_rate| self.kink_along(&direction, is_of_rate))
        })
    }

    /// A random direction that satisfies the constraints, whose largest displacement is the model's length or an angle of 1
    /// rad.
    fn admitted_direction(&self, noise: &mut Noise) -> Option<Vec<f64>> {
        let (pattern, count) = (self.system.pattern(), self.coordinate_count());
        let square = small_square(&self.representative) / START_RATE;
        let mut parts = self.parts.clone();
        parts.damping.fill(0.0);
        let mut solver = GeneralShift::<f64>::new(self.system, &self.representative);
        solver.factor(&parts, square.sqrt()).ok()?;
        let whole: Vec<f64> = parts
            .stiffness
            .iter()
            .zip(&parts.mass)
            .map(|(stiffness, mass)| stiffness + square * mass)
            .collect();
        let mut motion: Vec<f64> =
            (0..pattern.size()).map(|row| noise.number() / self.unit_of(row)).collect();
        motion[count..].fill(0.0);
        let mut forces = vec![0.0; pattern.size()];
        pattern.multiply(&whole, &motion, &mut forces);
        forces[count..].fill(0.0);
        solver.solve(&mut forces);
        forces[count..].fill(0.0);
        let sizes = forces[..count].iter().enumerate().map(|(row, value)| (value * self.unit_of(row)).abs());
        let size = sizes.fold(0.0, f64::max);
        (size.is_finite() && size > 0.0).then(|| forces.iter().map(|value| value / size).collect())
    }

    /// Factor that converts the coordinate of a row to a fraction of the model's length or an angle.
    fn unit_of(&self, row: usize) -> f64 {
        match self.system.layout().quantities()[row] {
            Quantity::Length => self.length().recip(),
            Quantity::Angle | Quantity::State => 1.0,
        }
    }

    fn kink_along(&self, direction: &[f64], is_of_rate: bool) -> Option<Kink> {
        let rate = if is_of_rate { small_square(&self.representative).sqrt() } else { 1.0 };
        let mut still = self.at.clone();
        // Switches are evaluated, not frozen on their branches.
        let first = self.system.signals().first_side();
        still.held.iter_mut().skip(first).for_each(|side| *side = 0.0);
        let at = |step: f64| moved(self, &still, direction, (step, is_of_rate), rate);
        let zero = self.residual_at(&still);
        let [mut even, mut odd] = [Vec::new(), Vec::new()];
        for step in STEPS {
            let (plus, minus) = (self.residual_at(&at(step)), self.residual_at(&at(-step)));
            let rows = || plus.iter().zip(&minus).zip(&zero);
            even.push(rows().map(|((p, m), z)| (p + m - 2.0 * z) / step).collect::<Vec<f64>>());
            odd.push(rows().map(|((p, m), _)| (p - m) / (2.0 * step)).collect::<Vec<f64>>());
        }
        let least = self.least_difference(direction, &zero, (is_of_rate, rate));
        let row = (0..zero.len()).find(|&row| {
            let fold = [0, 1, 2].map(|k| even[k][row].abs());
            let slope = [(odd[1][row] - odd[0][row]).abs(), (odd[2][row] - odd[1][row]).abs()];
            let is_folded = fold[2] > least[row] && fold[2] > FALLS * fold[1] && fold[1] > FALLS * fold[0];
            is_folded || (slope[1] > least[row] && slope[1] > FALLS * slope[0])
        })?;
        let name = self.switch_between(&at(-STEPS[0]), &at(STEPS[0]));
        let name =
            name.unwrap_or_else(|| format!("the equation of the {}", self.system.layout().name_of(row)));
        Some(Kink { name, is_of_rate })
    }

    /// The law that switches between two configurations.
    fn switch_between(&self, one: &Kinematics, other: &Kinematics) -> Option<String> {
        let [mut a, mut b] = [Vec::new(), Vec::new()];
        for (at, values) in [(one, &mut a), (other, &mut b)] {
            self.system.signals().switches(at, values);
            self.system.switches(at, values);
        }
        let which = a.iter().zip(&b).position(|(a, b)| a.side() != b.side())?;
        Some(self.system.name_of_switch(which).to_string())
    }

    /// Forces of all rows, and violations of the constraints.
    fn residual_at(&self, at: &Kinematics) -> Vec<f64> {
        let count = self.coordinate_count();
        let zeros = vec![0.0; self.multipliers().len()];
        let (still, unchanged) = nothing(at);
        let mut residual = vec![0.0; self.system.layout().size()];
        self.system.residual(&point(at, (&still, &unchanged), self.multipliers(), &zeros), &mut residual);
        self.system.violations(at, &mut residual[count..]);
        residual
    }

    /// By row, the smallest significant difference over a step.
    fn least_difference(&self, direction: &[f64], zero: &[f64], (is_of_rate, rate): (bool, f64)) -> Vec<f64> {
        let (pattern, count) = (self.system.pattern(), self.coordinate_count());
        let size = pattern.size();
        let absolute = |values: &[f64], vector: &[f64]| {
            let mut sum = vec![0.0; size];
            add_terms(&pattern, values, vector, &mut sum);
            sum
        };
        let mut displacements = direction.to_vec();
        displacements[count..].fill(0.0);
        let mut multipliers = vec![0.0; size];
        multipliers[count..].copy_from_slice(self.multipliers());
        let stiff = absolute(&self.parts.stiffness, &displacements);
        let damped = absolute(&self.parts.damping, &displacements);
        let constrained = absolute(&self.parts.constraint, &displacements);
        let reactions = absolute(&self.parts.constraint, &multipliers);
        let weights = absolute(&self.parts.mass, &vec![self.system.gravity().norm(); size]);
        let acting = |row: usize| zero[row].abs() + reactions[row] + weights[row];
        // Levers cancel in moments about a node, whose terms are forces times positions.
        let largest = (0..count).map(|row| acting(row) / self.unit_of(row)).fold(0.0, f64::max);
        (0..size)
            .map(|row| {
                let (terms, forces) = match (row < count, is_of_rate) {
                    (true, false) => (stiff[row], acting(row) + largest * self.unit_of(row)),
                    (true, true) => (
                        rate * damped[row] + BESIDE_DAMPING * stiff[row],
                        acting(row) + largest * self.unit_of(row),
                    ),
                    (false, _) => (constrained[row], 1.0 / self.unit_of(row)),
                };
                round_off::NEGLIGIBLE * terms + round_off::STIFFNESS * (forces + stiff[row]) / STEPS[2]
            })
            .collect()
    }
}

/// Adds |A| |x| to `sum`.
fn add_terms(pattern: &Pattern, values: &[f64], vector: &[f64], sum: &mut [f64]) {
    for (column, &factor) in vector.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        for (&row, &value) in pattern.row_indices()[range.clone()].iter().zip(&values[range]) {
            sum[row] += (value * factor).abs();
        }
    }
}

/// The configuration at a step along a direction, or with velocities along it.
fn moved(
    model: &LinearModel<'_>,
    from: &Kinematics,
    direction: &[f64],
    (step, is_of_rate): (f64, bool),
    rate: f64,
) -> Kinematics {
    let layout = model.system.layout();
    let mut at = from.clone();
    for (node, motion) in NodeId::enumerate(&mut at.nodes) {
        let rows = layout.rows_of_node(node);
        let change =
            Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { step * direction[rows[k] as usize] });
        if is_of_rate {
            motion.twist += rate * change;
        } else {
            motion.frame = motion.frame * Motion::exponential(&change);
        }
    }
    for (coordinate, motion) in CoordinateId::enumerate(&mut at.coordinates) {
        let change = step * direction[layout.row_of_coordinate(coordinate)];
        if is_of_rate {
            motion.rate += rate * change;
        } else {
            motion.value += change;
        }
    }
    at
}
