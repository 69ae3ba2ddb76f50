//! The only module that scales: step size, scale, penalty, augmented Lagrangian term, scaled multipliers.
//!
//! Before any discretisation [Bauchau, Epple and Bottasso 2009]: time τ = t/h, so that q' = h v and
//! q'' = h² a, equations of motion times h², constraints times s, multipliers λ = (s/h²) λ̂:
//!
//! ```text
//! M q'' + h D q' + h² K q + s Bᵀ (λ̂ + p C) = h² F,      s C = 0,      s = m_r + d_r h + k_r h²
//! ```
//!
//! Constraints of velocities, B q' = 0, are scaled by s as well, without an augmented term.
//!
//! Elements and joints are independent of scaling; schemes see unit steps only.

use std::ops::Mul;

use lissom_motion::{Motion, Vector6};
use serde::{Deserialize, Serialize};

use crate::elements::inertia::Inertia;
use crate::joints::evaluation_point::Augmentation;
use crate::kinematics::step_stages::STAGES;
use crate::kinematics::{CoordinateMotion, GROUND, Kinematics, Layout, MotionChange, Quantity};
use crate::node_motion::{IncrementKind, Known, Nodes, StageTable};
use crate::schemes::{Combination, Parametrization, Scheme, Stage, Tableau, Weights};
use crate::spin::{Departure, Spins};
use crate::system::{Blend, Linearization, State, System};

pub use crate::system::settings::{DEFAULT_PENALTY, ScaleBy, ScalingChoice};

/// Representative mass, damping and stiffness of a model: averages of the diagonals of M, D and K over all
/// coordinates, massless ones included. A rotation is measured by the arc at the representative length, so that all
/// coordinates have one unit and scale with the unit of length as a mass does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Representative {
    /// m_r [kg].
    pub mass: f64,
    /// d_r [N s/m].
    pub damping: f64,
    /// k_r [N/m].
    pub stiffness: f64,
    /// Representative length: root mean square distance between two nodes, the ground's at its joints, or the radius of gyration of
    /// the parts about their nodes if that is longer [m].
    pub length: f64,
}

impl Representative {
    /// From a linearisation of `system`.
    pub fn of(system: &System, at: &Kinematics, linearization: &Linearization) -> Self {
        let pattern = system.pattern();
        let count = system.layout().coordinate_count();
        let length = extent(system, at);
        let quantities = system.layout().quantities();
        // States have other units than positions.
        let is_place = |row: &usize| quantities[*row] != Quantity::State;
        let places = (0..count).filter(is_place).count().max(1);
        let average = |values: &[f64]| {
            let sum: f64 = (0..count)
                .filter(is_place)
                .filter_map(|row| Some((row, pattern.position(row, row)?)))
                .map(|(row, position)| values[position].abs() / unit(quantities[row], length).powi(2))
                .sum();
            sum / places as f64
        };
        Self {
            mass: average(&linearization.mass),
            damping: average(&linearization.damping),
            stiffness: average(&linearization.stiffness),
            length,
        }
    }
}

/// Length that represents a unit of `quantity`, if `radian` is the length that represents a radian [m].
fn unit(quantity: Quantity, radian: f64) -> f64 {
    match quantity {
        Quantity::Length | Quantity::State => 1.0,
        Quantity::Angle => radian,
    }
}

/// Rows of first-order states, whose units are the user's: neither pivots nor round-off depend on them, and condition numbers must not.
pub(crate) fn state_rows(layout: &Layout) -> Vec<usize> {
    layout.states().map(|(row, ..)| row).collect()
}

/// Size of a model that does not depend on its distance from the origin, where the ground's node is: that counts at the mean location of
/// its joints, if there are any. 1 for a single point mass.
pub(crate) fn extent(system: &System, at: &Kinematics) -> f64 {
    let on_ground =
        system.joints().iter().flat_map(|joint| &joint.frames).filter(|frame| frame.node == GROUND);
    let (sum, number) = on_ground.fold((lissom_motion::Vector3::zeros(), 0.0_f64), |(sum, number), frame| {
        (sum + frame.offset.position, number + 1.0)
    });
    let ground = (number > 0.0).then(|| sum / number);
    let places = || at.nodes.iter().skip(1).map(|node| node.frame.position).chain(ground);
    let count = places().count() as f64;
    let first = places().next().unwrap_or_default();
    let center = places().map(|place| place - first).sum::<lissom_motion::Vector3>() / count;
    // Σ over pairs |xᵢ - xⱼ|² = n Σ |xᵢ - x̄|²
    let square = places().map(|place| (place - first - center).norm_squared()).sum::<f64>();
    let [mass, trace] = system.inertias().iter().map(Inertia::mass).fold([0.0; 2], |[mass, trace], own| {
        [mass + own[(0, 0)], trace + own[(3, 3)] + own[(4, 4)] + own[(5, 5)]]
    });
    // Each sum may be empty.
    let most = (2.0 * square / (count - 1.0)).max(0.0).max((0.5 * trace / mass).max(0.0));
    if most > 0.0 { most.sqrt() } else { 1.0 }
}

/// The scaled equations for one step size.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scaled {
    h: f64,
    s: f64,
    /// p s, or 0 without the augmented term.
    augmented: f64,
    /// Factor of the equations of motion: h², or 1 unscaled.
    dynamic: f64,
    /// Length that represents a radian: the representative length, or 1 m in SI.
    radian: f64,
}

impl Scaled {
    /// For steps of `h` [s].
    pub fn new(choice: &ScalingChoice, representative: &Representative, h: f64) -> Self {
        let Representative { mass, damping, stiffness, .. } = *representative;
        let physical = mass + damping * h + stiffness * h * h;
        let (s, dynamic) = match choice.by {
            ScaleBy::Physical => (if physical > 0.0 { physical } else { 1.0 }, h * h),
            ScaleBy::Unit => (1.0, h * h),
            ScaleBy::None => (1.0, 1.0),
        };
        let augmented = if choice.augmented { choice.penalty * s } else { 0.0 };
        let radian = if choice.by == ScaleBy::Physical { representative.length } else { 1.0 };
        Self { h, s, augmented, dynamic, radian }
    }

    /// For a linear model without steps, with time in units of 1/`rate` [1/s].
    pub(crate) fn at_rate(representative: &Representative, rate: f64) -> Self {
        Self::new(&ScalingChoice::default(), representative, rate.recip())
    }

    /// This scale for steps of another size [s]: any scale is valid, and a tangent assembled with this one
    /// remains usable.
    #[must_use]
    pub fn resized(mut self, choice: &ScalingChoice, h: f64) -> Self {
        self.h = h;
        self.dynamic = if choice.by == ScaleBy::None { 1.0 } else { h * h };
        self
    }

    /// Step size h [s].
    pub fn step_size(&self) -> f64 {
        self.h
    }

    /// Scale factor s.
    pub fn scale(&self) -> f64 {
        self.s
    }

    /// The augmented term in SI.
    pub fn augmentation(&self) -> Augmentation {
        Augmentation {
            weight: self.augmented / self.dynamic,
            radian: self.radian,
            lapse: self.h,
            compliance: self.dynamic / self.s,
        }
    }

    /// Length that represents a unit of `quantity` [m].
    pub fn unit(&self, quantity: Quantity) -> f64 {
        unit(quantity, self.radian)
    }

    /// Factor of the forces in the equations of motion.
    pub(crate) fn dynamic_factor(&self) -> f64 {
        self.dynamic
    }

    /// Factor from a scaled multiplier to λ [N, N m].
    pub fn multiplier_factor(&self) -> f64 {
        self.s / self.dynamic
    }

    /// Scales a residual in place.
    pub fn scale_residual(&self, layout: &Layout, residual: &mut [f64]) {
        let (motion, constraints) = residual.split_at_mut(layout.coordinate_count());
        for value in motion.iter_mut() {
            *value *= self.dynamic;
        }
        for value in constraints.iter_mut() {
            *value *= self.s;
        }
    }

    /// Factors of the derivatives in the tangent of the scaled equations, for a scheme with these weights.
    pub fn blend<T: Copy + Mul<f64, Output = T>>(&self, weights: Weights<T>) -> Blend<T> {
        Blend {
            place: self.dynamic,
            rate: weights.velocity * (self.dynamic / self.h),
            acceleration: weights.acceleration * (self.dynamic / (self.h * self.h)),
            augmented: self.augmented,
            constraint: self.s,
            slip: weights.slip * self.s,
            turning: self.s * self.h,
            slip_augmented: self.augmented * weights.slip_augmented,
        }
    }

    /// A stage's coefficients for the motion of nodes, in SI.
    fn stage_table(&self, scheme: &Scheme, stage: &Stage) -> StageTable {
        let kind = match scheme.parametrization {
            Parametrization::FromStart => IncrementKind::FromStart,
            Parametrization::RelativeToDrift if scheme.tableau.is_some() => IncrementKind::VelocityChange,
            Parametrization::RelativeToDrift => IncrementKind::RelativeToDrift,
            Parametrization::Inertial => IncrementKind::Inertial,
        };
        StageTable {
            kind,
            ahead: if scheme.dynamic { stage.abscissa * self.h } else { 0.0 },
            velocity: stage.velocity.increments.map(|weight| weight / self.h),
            acceleration: stage.acceleration.increments.map(|weight| weight / (self.h * self.h)),
            gain: 1.0 / self.h,
        }
    }

    /// Unit-step velocities q' = h v, accelerations q'' = h² v̇ and the scheme's algorithmic acceleration of a state,
    /// by row, and the terms of the stages' motions that depend on the start of the step.
    pub fn to_unit_step(&self, layout: &Layout, scheme: &Scheme, state: &State, out: &mut UnitStepState) {
        let square = self.h * self.h;
        for (rows, node) in layout.node_rows.iter().zip(&state.kinematics.nodes) {
            for (k, &row) in rows.iter().enumerate() {
                if row != crate::kinematics::LOCKED {
                    out.velocity[row as usize] = self.h * node.twist[k];
                    out.acceleration[row as usize] = square * node.acceleration[k];
                }
            }
        }
        out.spins.begin(&state.kinematics, self.h);
        for spin in out.spins.iter() {
            let curvature = spin.start_curvature();
            spin.rows()
                .iter()
                .zip(curvature.iter())
                .for_each(|(&row, value)| out.acceleration[row] = square * value);
        }
        for (&row, coordinate) in layout.coordinate_rows.iter().zip(&state.kinematics.coordinates) {
            out.velocity[row as usize] = self.h * coordinate.rate;
            out.acceleration[row as usize] = square * coordinate.acceleration;
        }
        for (value, algorithmic) in out.algorithmic.iter_mut().zip(&state.algorithmic) {
            *value = square * algorithmic;
        }
        for (index, stage) in scheme.stages.iter().enumerate() {
            let UnitStepState {
                velocity, acceleration, algorithmic, known_velocity, known_acceleration, ..
            } = &mut *out;
            let start = [&velocity[..], &acceleration[..], &algorithmic[..]];
            known_part(&stage.velocity.times(1.0 / self.h), start, known_velocity);
            known_part(&stage.acceleration.times(1.0 / square), start, known_acceleration);
            let known = Known { velocity: &out.known_velocity, acceleration: &out.known_acceleration };
            out.nodes.enter(index, &self.stage_table(scheme, stage), &state.kinematics, known);
        }
    }

    /// The scheme's algorithmic acceleration after a step, in SI, from a linear combination of the increments and the
    /// start.
    pub fn memory_from_unit_step(
        &self,
        combination: &Combination,
        start: &UnitStepState,
        increments: &[Vec<f64>],
        memory: &mut [f64],
    ) {
        let combination = combination.times(1.0 / (self.h * self.h));
        known_part(&combination, [&start.velocity, &start.acceleration, &start.algorithmic], memory);
        for (weight, increment) in combination.increments.iter().zip(increments) {
            for (value, increment) in memory.iter_mut().zip(increment) {
                *value += weight * increment;
            }
        }
    }

    /// Time of a stage and time since the start of the step.
    fn instant(&self, start: f64, stage: &Stage) -> (f64, f64) {
        let elapsed = stage.abscissa * self.h;
        (start + elapsed, elapsed)
    }

    /// Motion at a stage in SI, from the increments since the start of the step and the scheme's formulas for
    /// unit-step velocities and accelerations. `increments[j][row]` are those of stage j.
    pub fn stage_motion(
        &self,
        layout: &Layout,
        scheme: &Scheme,
        start: &State,
        unit: &UnitStepState,
        increments: &StageIncrements<'_>,
        reached: &mut StageMotion,
    ) {
        let stage = &scheme.stages[increments.stage];
        // Load steps have no velocities to extrapolate with.
        let straight = if scheme.dynamic { 1.0 } else { 0.0 };
        let square = self.h * self.h;
        let StageMotion { at: out, changes, coordinate_changes } = reached;
        (out.time, out.elapsed) = self.instant(start.kinematics.time, stage);
        out.held.copy_from_slice(&start.kinematics.held);
        let own = &increments.all[increments.stage];
        let table = self.stage_table(scheme, stage);
        unit.nodes.update_nodes(increments.stage, &table, &start.kinematics, increments.all, (out, changes));
        for spin in unit.spins.iter() {
            let combined = |combination: &Combination, unit_of_time: f64| {
                spin.by_row(|row| unit.combine(combination, increments.all, row) / unit_of_time)
            };
            let departure = Departure {
                place: spin.by_row(|row| own[row]),
                rate: combined(&stage.velocity, self.h),
                curvature: combined(&stage.acceleration, square),
            };
            let node = spin.node();
            let (motion, change) = spin.depart(table.ahead, &departure);
            (out.nodes[node], changes[node.index()]) = (motion, MotionChange::of(&change));
        }
        for (coordinate, &row) in layout.coordinate_rows.iter().enumerate() {
            let row = row as usize;
            let from = &start.kinematics.coordinates[coordinate];
            let to = &mut out.coordinates[coordinate];
            let ahead = straight * from.rate;
            coordinate_changes[coordinate] = out.elapsed * ahead + own[row];
            to.value = from.value + coordinate_changes[coordinate];
            to.rate = ahead + unit.combine(&stage.velocity, increments.all, row) / self.h;
            to.acceleration = unit.combine(&stage.acceleration, increments.all, row) / square;
        }
    }
}

impl Scaled {
    /// Accelerations at the stages of a scheme that integrates velocities, and the motion at the end of the step:
    ///
    /// ```text
    /// h V̇_i = Σ_j (A⁻¹)_ij (V_j - V_0),   V_end = V_0 + Σ_j (bᵀA⁻¹)_j (V_j - V_0),   ψ_end = Σ_j (bᵀA⁻¹)_j ψ_j
    /// ```
    ///
    /// On entry the stages contain (V_j - V_0)/h in place of accelerations, see [`Self::stage_motion`]; algebraic
    /// coordinates contain their rates.
    pub fn integrate_velocities(
        &self,
        layout: &Layout,
        tableau: &Tableau,
        start: &State,
        increments: &[Vec<f64>],
        motions: &mut [StageMotion],
    ) {
        let [first, second, reached] = motions else { return };
        let (w, end) = (&tableau.inverse, &tableau.reached);
        reached.at.elapsed = self.h;
        reached.at.time = start.kinematics.time + self.h;
        reached.at.held.copy_from_slice(&start.kinematics.held);
        for (node, rows) in layout.node_rows.iter().enumerate() {
            let from = &start.kinematics.nodes[node];
            let (a, b) = (&mut first.at.nodes[node], &mut second.at.nodes[node]);
            let to = &mut reached.at.nodes[node];
            if rows.iter().all(|&row| row == crate::kinematics::LOCKED) {
                *to = *from;
                continue;
            }
            let gains = [a.acceleration, b.acceleration];
            a.acceleration = w[0][0] * gains[0] + w[0][1] * gains[1];
            b.acceleration = w[1][0] * gains[0] + w[1][1] * gains[1];
            if tableau.is_stiffly_accurate() {
                *to = *b;
                reached.changes[node] = second.changes[node];
                continue;
            }
            let mut psi = Vector6::zeros();
            for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != crate::kinematics::LOCKED) {
                let row = row as usize;
                psi[k] = end[0] * increments[0][row] + end[1] * increments[1][row];
            }
            to.twist = from.twist + self.h * (end[0] * gains[0] + end[1] * gains[1]);
            to.acceleration = b.acceleration;
            let ahead = self.h * from.twist;
            to.frame = from.frame * Motion::exponential(&ahead) * Motion::exponential(&psi);
            reached.changes[node] = MotionChange::exponential(&ahead).then(&MotionChange::exponential(&psi));
        }
        for (coordinate, &row) in layout.coordinate_rows.iter().enumerate() {
            let row = row as usize;
            let from = &start.kinematics.coordinates[coordinate];
            let (a, b) = (&mut first.at.coordinates[coordinate], &mut second.at.coordinates[coordinate]);
            let gains = [a.rate - from.rate, b.rate - from.rate];
            a.acceleration = (w[0][0] * gains[0] + w[0][1] * gains[1]) / self.h;
            b.acceleration = (w[1][0] * gains[0] + w[1][1] * gains[1]) / self.h;
            let change = self.h * from.rate + end[0] * increments[0][row] + end[1] * increments[1][row];
            reached.coordinate_changes[coordinate] = change;
            reached.at.coordinates[coordinate] = CoordinateMotion {
                value: from.value + change,
                rate: from.rate + end[0] * gains[0] + end[1] * gains[1],
                acceleration: b.acceleration,
            };
        }
    }

    /// Integration times of the stage rates up to each stage, and up to the end [s].
    pub(crate) fn durations(&self, tableau: &Tableau) -> ([[f64; STAGES]; STAGES], [f64; STAGES]) {
        (
            tableau.stages.map(|row| row.map(|weight| self.h * weight)),
            tableau.end.map(|weight| self.h * weight),
        )
    }
}

/// Motion at a stage, and its change since the start of the step.
#[derive(Clone, Debug)]
pub struct StageMotion {
    /// Positions, twists and accelerations.
    pub at: Kinematics,
    /// Change of every node's motion.
    pub changes: Vec<MotionChange>,
    /// Change of every algebraic coordinate.
    pub coordinate_changes: Vec<f64>,
}

impl StageMotion {
    /// No change from `at`.
    pub fn new(at: &Kinematics) -> Self {
        Self {
            at: at.clone(),
            changes: vec![MotionChange::none(); at.nodes.len()],
            coordinate_changes: vec![0.0; at.coordinates.len()],
        }
    }
}

/// Increments of all stages, and the index of the stage considered.
#[derive(Clone, Copy, Debug)]
pub struct StageIncrements<'a> {
    /// By stage, then by row.
    pub all: &'a [Vec<f64>],
    /// The stage.
    pub stage: usize,
}

/// The start of a step of unit length, by coordinate row.
#[derive(Clone, Debug)]
pub struct UnitStepState {
    /// q'.
    pub velocity: Vec<f64>,
    /// q''.
    pub acceleration: Vec<f64>,
    /// The scheme's memory, like q''.
    pub algorithmic: Vec<f64>,
    /// Terms of velocity and acceleration at a stage that depend on the start, in SI.
    known_velocity: Vec<f64>,
    known_acceleration: Vec<f64>,
    nodes: Nodes,
    /// Nodes whose increments are in axes that do not spin.
    pub(crate) spins: Spins,
}

impl UnitStepState {
    /// Storage for the coordinates of a system.
    pub fn new(layout: &Layout, scheme: &Scheme) -> Self {
        let zeros = vec![0.0; layout.coordinate_count()];
        Self {
            velocity: zeros.clone(),
            acceleration: zeros.clone(),
            algorithmic: zeros.clone(),
            known_velocity: zeros.clone(),
            known_acceleration: zeros,
            nodes: Nodes::new(layout, scheme.stages.len()),
            spins: Spins::new(layout, scheme),
        }
    }

    /// A scheme's initial guess, with all increments zero, for all rows.
    pub(crate) fn predict(&self, combination: &Combination, out: &mut [f64]) {
        known_part(combination, [&self.velocity, &self.acceleration, &self.algorithmic], out);
    }

    /// A scheme's linear combination of the increments and the start, for one row.
    pub fn combine(&self, combination: &Combination, increments: &[Vec<f64>], row: usize) -> f64 {
        let mut sum = combination.velocity * self.velocity[row]
            + combination.algorithmic * self.algorithmic[row]
            + combination.acceleration * self.acceleration[row];
        for (weight, increment) in combination.increments.iter().zip(increments) {
            sum += weight * increment[row];
        }
        sum
    }
}

/// Terms of a linear combination from the velocities, accelerations and memory at the start, by row.
fn known_part(
    combination: &Combination,
    [velocity, acceleration, algorithmic]: [&[f64]; 3],
    out: &mut [f64],
) {
    for (((value, velocity), acceleration), algorithmic) in
        out.iter_mut().zip(velocity).zip(acceleration).zip(algorithmic)
    {
        *value = combination.velocity * velocity
            + combination.algorithmic * algorithmic
            + combination.acceleration * acceleration;
    }
}
