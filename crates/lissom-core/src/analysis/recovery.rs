//! Recovery of velocities, accelerations, multipliers and internal forces from the positions at an instant.
//!
//! A scheme satisfies the constraints at the end of a step; it satisfies their derivatives to a lower order, and multipliers
//! of Radau IIA with two stages are of first order only [Hairer and Wanner 1996, VII.4]. Forces of stiff elements have the
//! same error, for a constraint is the limit of a stiff spring. Both follow from the positions:
//!
//! Legend: τ = h/2 with the step h, or less with more than two stages, S saddle-point matrix of M + τ D + τ² K and the constraints G, f forces, a
//! accelerations of the scheme, c second derivative of the forces along the motion with constant twists.
//!
//! ```text
//! S (δ, ·) = (-τ² K v, -(G v + ∂g/∂t)),                S (z, ·) = (τ² K δ, -(G v + ∂g/∂t))            v̂ = v + z
//! S (x, ·) = (-r - τ² (K a + c), -(G a + Ġ v̂ + …)),    r = M a + f(q, v̂) + Gᵀ λ
//! S (y, λ) = (-M a - f(q, v̂) + τ² K x, -(G a + Ġ v̂ + …))
//! accelerations a + y,   internal forces at q + τ² (y - x)
//! ```
//!
//! Stiff parts are treated like constraints: their rates vanish except for what the motion around them asks for. The second solution
//! of each pair changes vibrations that the step resolves by (h ω/2)⁴ instead of (h ω/2)² only. The last one is repeated
//! until the forces are in equilibrium, also where friction depends on multipliers. Derivation: docs/theory/recovery.md.

use super::initial_conditions::{
    ConsistentInitialConditions, Inertias, gather_accelerations, gather_rates, scatter_accelerations,
};
use super::simulation::Simulation;
use crate::integrator::pivoting_unless_augmented;
use crate::kinematics::{Kinematics, LOCKED, Layout};
use crate::system::{State, System};
use lissom_motion::Motion;

/// Repetitions after which equilibrium counts as not found.
const MAX_REPETITIONS: usize = 30;

/// Changes of multipliers below are round-off.
const REPEATED: f64 = 1e-10;

/// Recovers velocities, accelerations, multipliers and internal forces, for what is recorded. The motion itself does not
/// change.
pub struct Recovery {
    initial: ConsistentInitialConditions,
    /// Number of stages of the scheme: vibrations that are resolved change by (h ω/2) to twice this power, or four.
    stages: usize,
}

/// What recorded quantities depend on, and what has to be recovered for them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// Positions only: nothing is recovered.
    #[default]
    Positions,
    /// Velocities.
    Velocities,
    /// Accelerations, multipliers or internal forces.
    Forces,
}

/// What is recorded of an instant.
pub struct Recovered {
    /// The state with velocities that satisfy the constraints and, if forces are needed, with accelerations and multipliers that
    /// follow from the positions.
    pub rates: State,
    /// The same with positions whose internal forces are in equilibrium with them, if forces are needed.
    pub forces: State,
}

impl Recovery {
    /// For the states of a simulation; none for statics.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        let settings = simulation.settings();
        settings.scheme.dynamic.then(|| Self {
            initial: ConsistentInitialConditions::new(
                simulation.system(),
                simulation.state(),
                simulation.representative(),
                pivoting_unless_augmented(settings),
            ),
            stages: settings.scheme.stages.len(),
        })
    }

    /// What is recorded of a state to which a step of `step` [s] led. None at the start, and where nothing is found, as in a
    /// singular position.
    pub fn recover(
        &mut self,
        need: Need,
        (system, state): (&System, &State),
        step: f64,
    ) -> Option<Recovered> {
        if step <= 0.0 || need == Need::Positions {
            return None;
        }
        // More stages resolve faster motion.
        let time = 0.5 * step / self.stages.saturating_sub(1).max(1) as f64;
        let mut rates = state.clone();
        hold_sides(system, &mut rates.kinematics);
        self.initial.factor(system, &rates, Inertias::Within(time)).ok()?;
        let mut forces = rates.clone();
        let lacking = self.lacking_velocities(system, &rates);
        self.recover_velocities(system, &lacking, &mut rates)?;
        if need == Need::Velocities {
            return Some(Recovered { rates, forces });
        }
        self.filter_velocities(system, time, &lacking, &mut forces);
        let shift = self.recover_accelerations(system, time, &mut forces)?;
        if !forces.multipliers.iter().chain(&shift).all(|value| value.is_finite()) {
            return None;
        }
        let nodes = rates.kinematics.nodes.iter_mut().zip(&forces.kinematics.nodes);
        nodes.for_each(|(node, found)| node.acceleration = found.acceleration);
        let coordinates = rates.kinematics.coordinates.iter_mut().zip(&mut forces.kinematics.coordinates);
        coordinates.for_each(|(coordinate, found)| coordinate.acceleration = found.acceleration);
        for (_, impulse) in system.layout().impulses() {
            let force = forces.kinematics.coordinates[impulse].rate;
            rates.kinematics.coordinates[impulse].rate = force;
        }
        rates.multipliers.clone_from(&forces.multipliers);
        rates.kinematics.show_multipliers(&rates.multipliers);
        // Springs and dampers are recorded at velocities that are not filtered.
        let nodes = forces.kinematics.nodes.iter_mut().zip(&rates.kinematics.nodes);
        nodes.for_each(|(node, found)| node.twist = found.twist);
        let coordinates = forces.kinematics.coordinates.iter_mut().zip(&rates.kinematics.coordinates);
        coordinates.for_each(|(coordinate, found)| coordinate.rate = found.rate);
        move_by(system.layout(), 1.0, &shift, &mut forces.kinematics);
        Some(Recovered { rates, forces })
    }

    /// What the rates of constraints lack, -(G v + ∂g/∂t), by row: of constraints between positions and between velocities.
    fn lacking_velocities(&self, system: &System, state: &State) -> Vec<f64> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let mut speeds = vec![0.0; layout.size()];
        gather_rates(layout, &state.kinematics, &mut speeds);
        let mut lacking = vec![0.0; layout.size()];
        self.initial.subtract_product(system, &speeds, &mut lacking);
        let slides: Vec<(usize, f64)> = layout.impulses().map(|(row, _)| (row, lacking[row])).collect();
        lacking[..count].fill(0.0);
        for (row, slide) in slides {
            lacking[row] = slide;
        }
        let mut explicit = vec![0.0; layout.multiplier_count];
        system.constraint_velocities(&state.kinematics, &mut explicit);
        lacking[count..].iter_mut().zip(&explicit).for_each(|(value, rate)| *value -= rate);
        lacking
    }

    /// Makes the velocities to be recorded satisfy the constraints; none where no finite ones are found.
    fn recover_velocities(&mut self, system: &System, lacking: &[f64], rates: &mut State) -> Option<()> {
        let mut change = lacking.to_vec();
        self.initial.solve(system, &mut change);
        add_rates(system.layout(), &change, &mut rates.kinematics);
        change.iter().all(|value| value.is_finite()).then_some(())
    }

    /// Makes velocities satisfy the constraints, without strain rates of stiff parts.
    fn filter_velocities(&mut self, system: &System, time: f64, lacking: &[f64], found: &mut State) {
        let layout = system.layout();
        let mut speeds = vec![0.0; layout.size()];
        gather_rates(layout, &found.kinematics, &mut speeds);
        let mut stiff = lacking.to_vec();
        self.initial.add_stiffness_product(system, -time * time, &speeds, &mut stiff);
        self.initial.solve(system, &mut stiff);
        for _ in 1..self.stages.max(2) {
            let mut next = lacking.to_vec();
            self.initial.add_stiffness_product(system, time * time, &stiff, &mut next);
            self.initial.solve(system, &mut next);
            stiff = next;
        }
        add_rates(layout, &stiff, &mut found.kinematics);
    }

    /// Finds accelerations and multipliers; returns the shift of the positions by row.
    fn recover_accelerations(&mut self, system: &System, time: f64, found: &mut State) -> Option<Vec<f64>> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let square = time * time;
        let mut accelerations = vec![0.0; layout.size()];
        gather_accelerations(layout, &found.kinematics, &mut accelerations);
        layout.rate_rows().for_each(|row| accelerations[row] = 0.0);
        // What constraints lack, of positions and of velocities.
        let mut lacking = vec![0.0; layout.size()];
        let mut turning = vec![0.0; layout.size()];
        self.initial.subtract_product(system, &accelerations, &mut lacking);
        self.initial.turn_slides(system, &found.kinematics, &mut turning);
        let slides: Vec<(usize, f64)> =
            layout.impulses().map(|(row, _)| (row, lacking[row] - turning[row])).collect();
        lacking[..count].fill(0.0);
        system.constraint_accelerations(&found.kinematics, &mut turning[count..]);
        lacking[count..].iter_mut().zip(&turning[count..]).for_each(|(value, turning)| *value -= turning);

        let residual = |recovery: &Self, state: &State| {
            let mut out = vec![0.0; layout.size()];
            system.residual(&recovery.initial.point(&state.kinematics, &state.multipliers), &mut out);
            out[count..].fill(0.0);
            layout.rate_rows().for_each(|row| out[row] = 0.0);
            out
        };
        // Stiff parts like constraints.
        let mut stiff = lacking.clone();
        let unbalanced = residual(self, found);
        subtract(&unbalanced, &mut stiff);
        self.initial.add_stiffness_product(system, -square, &accelerations, &mut stiff);
        self.subtract_turning(system, time, found, &mut stiff);
        for &(row, slide) in &slides {
            stiff[row] = slide;
        }
        self.initial.solve(system, &mut stiff);
        for _ in 2..self.stages {
            let mut next = lacking.clone();
            subtract(&unbalanced, &mut next);
            self.initial.add_stiffness_product(system, square, &stiff, &mut next);
            for &(row, slide) in &slides {
                next[row] = slide;
            }
            self.initial.solve(system, &mut next);
            stiff = next;
        }

        // Vibrations that are resolved as they are.
        let mut change = vec![0.0; layout.size()];
        let mut last = f64::INFINITY;
        // Solved for as a whole, those of redundant constraints are the least ones.
        found.multipliers.fill(0.0);
        for repetition in 0..MAX_REPETITIONS {
            let mut right = residual(self, found);
            for value in &mut right {
                *value = -*value;
            }
            let shift: Vec<f64> = stiff.iter().zip(&change).map(|(x, y)| x - y).collect();
            self.initial.add_stiffness_product(system, square, &shift, &mut right);
            if repetition == 0 {
                right[count..].copy_from_slice(&lacking[count..]);
                for &(row, slide) in &slides {
                    right[row] = slide;
                }
            }
            self.initial.solve(system, &mut right);
            for (row, impulse) in layout.impulses() {
                found.kinematics.coordinates[impulse].rate += std::mem::take(&mut right[row]);
            }
            layout.states().for_each(|(row, ..)| right[row] = 0.0);
            change[..count].iter_mut().zip(&right).for_each(|(change, further)| *change += further);
            let forces = right[count..].iter().fold(0.0_f64, |most, force| most.max(force.abs()));
            found.multipliers.iter_mut().zip(&right[count..]).for_each(|(force, further)| *force += further);
            found.kinematics.show_multipliers(&found.multipliers);
            let mut total = accelerations.clone();
            total.iter_mut().zip(&change).for_each(|(total, change)| *total += change);
            keep_rates(layout, &found.kinematics, &mut total);
            scatter_accelerations(layout, &total, &mut found.kinematics);
            let largest = found.multipliers.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
            let relative = forces / largest.max(f64::MIN_POSITIVE);
            if relative <= REPEATED || (!system.sees_multipliers() && (repetition == 3 || relative >= last)) {
                let shift = change.iter().zip(&stiff).map(|(y, x)| square * (y - x));
                let mut shift: Vec<f64> = shift.collect();
                layout.rate_rows().for_each(|row| shift[row] = 0.0);
                shift.truncate(count);
                return Some(shift);
            }
            last = relative;
        }
        None
    }

    /// right -= τ² d²f/dt² along the motion with constant twists: by differences over τ and τ/2, without motion, so that forces of position
    /// alone are compared.
    fn subtract_turning(&self, system: &System, time: f64, state: &State, right: &mut [f64]) {
        let layout = system.layout();
        let mut speeds = vec![0.0; layout.size()];
        gather_rates(layout, &state.kinematics, &mut speeds);
        layout.rate_rows().for_each(|row| speeds[row] = 0.0);
        let mut still = state.kinematics.clone();
        for node in &mut still.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        let mut is_state = vec![false; still.coordinates.len()];
        layout.states().for_each(|(_, coordinate, _)| is_state[coordinate.index()] = true);
        for (coordinate, _) in still.coordinates.iter_mut().zip(is_state).filter(|(_, is_state)| !is_state) {
            (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
        }
        let zero = vec![0.0; layout.multiplier_count];
        let mut forces = vec![0.0; layout.size()];
        let mut sum = vec![0.0; layout.size()];
        // Richardson's extrapolation of the second differences, f'' = (4 Δ(τ/2) - Δ(τ))/3.
        for (shift, weight) in [(0.0, -30.0), (0.5, 16.0), (-0.5, 16.0), (1.0, -1.0), (-1.0, -1.0)] {
            let mut moved = still.clone();
            move_by(layout, shift * time, &speeds, &mut moved);
            system.residual(&self.initial.point(&moved, &zero), &mut forces);
            sum.iter_mut().zip(&forces).for_each(|(sum, force)| *sum += weight / 3.0 * force);
        }
        let count = layout.coordinate_count();
        layout.rate_rows().for_each(|row| sum[row] = 0.0);
        if sum[..count].iter().all(|value| value.is_finite()) {
            subtract(&sum[..count], &mut right[..count]);
        }
    }
}

/// Holds switches on the sides on which they are, so that forces are continued from there.
fn hold_sides(system: &System, at: &mut Kinematics) {
    let mut switches = Vec::new();
    system.switches(at, &mut switches);
    let first = system.signals().first_side();
    for (held, switch) in at.held[first..].iter_mut().zip(&switches).filter(|(held, _)| **held == 0.0) {
        *held = switch.side();
    }
}

/// Adds changes to the velocities, but not to forces of constraints between velocities.
fn add_rates(layout: &Layout, changes: &[f64], at: &mut Kinematics) {
    let mut is_force = vec![false; at.coordinates.len()];
    layout.impulses().for_each(|(_, impulse)| is_force[impulse.index()] = true);
    let coordinates = at.coordinates.iter_mut().zip(&layout.coordinate_rows).zip(is_force);
    for ((coordinate, &row), _) in coordinates.filter(|(_, is_force)| !is_force) {
        coordinate.rate += changes[row as usize];
    }
    for (rows, node) in layout.node_rows.iter().zip(&mut at.nodes) {
        for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            node.twist[k] += changes[row as usize];
        }
    }
}

fn subtract(values: &[f64], from: &mut [f64]) {
    from.iter_mut().zip(values).for_each(|(own, value)| *own -= value);
}

/// Accelerations of rates stay as they are.
fn keep_rates(layout: &Layout, at: &Kinematics, accelerations: &mut [f64]) {
    let coordinates = layout.states().map(|(row, coordinate, _)| (row, coordinate));
    for (row, coordinate) in coordinates.chain(layout.impulses()) {
        accelerations[row] = at.coordinates[coordinate].acceleration;
    }
}

/// Moves nodes and coordinates by a factor of their changes.
fn move_by(layout: &Layout, factor: f64, changes: &[f64], at: &mut Kinematics) {
    for (rows, node) in layout.node_rows.iter().zip(&mut at.nodes) {
        let mut change = lissom_motion::Vector6::zeros();
        for (k, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            change[k] = factor * changes[row as usize];
        }
        node.frame = node.frame * Motion::exponential(&change);
    }
    for (&row, coordinate) in layout.coordinate_rows.iter().zip(&mut at.coordinates) {
        coordinate.value += factor * changes[row as usize];
    }
}
