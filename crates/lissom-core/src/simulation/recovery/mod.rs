//! Recovery of velocities, accelerations, multipliers and internal forces from the positions at an instant.
//!
//! A scheme satisfies the constraints at the end of a step; it satisfies their derivatives to a lower order, and multipliers
//! of Radau IIA with two stages are of first order only [Hairer and Wanner 1996, VII.4]. Forces of stiff elements have the
//! same error, because a constraint is the limit of a stiff spring. Both follow from the positions:
//!
//! Legend: τ = h/2 with the step h, or less with more than two stages, S saddle-point matrix of M + τ D + τ² K and the constraints
//! G, f forces, a accelerations of the scheme, c second derivative of the forces along the motion with constant twists, in time too.
//!
//! ```text
//! S (δ, ·) = (-τ² (K v + ∂f/∂t), -(G v + ∂g/∂t)),      S (z, ·) = (τ² K δ, -(G v + ∂g/∂t))            v̂ = v + z
//! S (x, ·) = (-r - τ² (K a + c), -(G a + Ġ v̂ + …)),    r = M a + f(q, v̂) + Gᵀ λ
//! S (y, λ) = (-M a - f(q, v̂) + τ² K x, -(G a + Ġ v̂ + …))
//! accelerations a + y,   internal forces at q + τ² (y - x)
//! ```
//!
//! Stiff parts are treated like constraints: their rates vanish except for those imposed by the surrounding motion. The second solution
//! of each pair changes resolved vibrations by (h ω/2)⁴ instead of (h ω/2)² only. The last one is iterated until the forces are in
//! equilibrium, also if friction depends on multipliers. Nothing is filtered, and K, c and x are zero, without elements that are stiff:
//! if τ² ω² ≤ ρ for all frequencies ω, n solutions remove a share of at most ρⁿ. Derivation: docs/theory/recovery.md.

mod matrix;
mod stiff_parts;

use crate::consistent::initial_conditions::{
    add_rates, gather_accelerations, gather_rates, scatter_accelerations,
};
use crate::integrator::pivoting_unless_augmented;
use crate::kinematics::{Kinematics, LOCKED, Layout, Rotor, Switch, across};
use crate::round_off;
use crate::simulation::Simulation;
use crate::system::{Need, State, System};
use crate::tuning::MAX_ITERATIONS;
use lissom_motion::{Motion, Vector3, Vector6, rotation_part, screw};
use matrix::RecoveryMatrix;

/// Predicted change of the next iteration below which it is omitted.
const NEGLIGIBLE: f64 = 1e-14;

/// Relative change of multipliers below which a solution of the complete equations is accurate to round-off.
const SMALL_CHANGE: f64 = 1e-2;

/// Fractions of a reach at which forces are compared, with the weights of the first derivative, times the reach, and of the second one,
/// times its square: on both sides, or on one if a function of time has a breakpoint on the other.
const BOTH_SIDES: [[f64; 3]; 5] = [
    [0.0, 0.0, -10.0],
    [0.5, 4.0 / 3.0, 16.0 / 3.0],
    [-0.5, -4.0 / 3.0, 16.0 / 3.0],
    [1.0, -1.0 / 6.0, -1.0 / 3.0],
    [-1.0, 1.0 / 6.0, -1.0 / 3.0],
];
const ONE_SIDE: [[f64; 3]; 5] = [
    [0.0, -25.0 / 3.0, 140.0 / 3.0],
    [0.25, 16.0, -416.0 / 3.0],
    [0.5, -12.0, 152.0],
    [0.75, 16.0 / 3.0, -224.0 / 3.0],
    [1.0, -1.0, 44.0 / 3.0],
];
/// Reach of differences of forces that depend on time, over τ: a rope does not become slack within it.
const REACH: f64 = 0.125;

/// Recovers velocities, accelerations, multipliers and internal forces for output. The motion itself does not change.
pub struct Recovery {
    matrix: RecoveryMatrix,
    /// Rotors on which springs act.
    rotors: Vec<Rotor>,
    /// Instants at which forces have kinks or jumps as functions of time [s].
    breakpoints: Vec<f64>,
    /// Number of stages of the scheme: resolved vibrations change by (h ω/2) to twice this power, or four.
    stages: usize,
    found: Recovered,
    work: Workspace,
}

/// Recovered states at an instant.
pub struct Recovered {
    /// The state with velocities that satisfy the constraints and, if forces are needed, with accelerations and multipliers that
    /// follow from the positions.
    pub rates: State,
    /// State with these rates, and positions whose internal forces are in equilibrium with it, if forces are needed.
    pub forces: State,
}

/// Vectors by row, and scratch states.
struct Workspace {
    speeds: Vec<f64>,
    accelerations: Vec<f64>,
    /// Residual of the constraints' derivatives, with opposite sign.
    lacking: Vec<f64>,
    /// Residual of the equations of motion.
    unbalanced: Vec<f64>,
    /// Solution in which stiff parts are treated like constraints, δ or x.
    stiff: Vec<f64>,
    /// y.
    change: Vec<f64>,
    right: Vec<f64>,
    /// Rates and accelerations of violations, by multiplier.
    violation_rates: [Vec<f64>; 2],
    switches: Vec<Switch>,
    /// The positions at rest, and displaced along the motion.
    still: Kinematics,
    moved: Kinematics,
}

impl Recovery {
    /// Recovery for the states of a simulation; none for statics, nor with touches, whose forces are those of the steps.
    pub fn of(simulation: &Simulation) -> Option<Box<Self>> {
        let (settings, system, state) = (simulation.settings(), simulation.system(), simulation.state());
        if !settings.scheme.dynamic || !system.contacts().is_empty() {
            return None;
        }
        let kind = pivoting_unless_augmented(settings);
        let by_row = || vec![0.0; system.layout().size()];
        let by_multiplier = || vec![0.0; system.layout().multiplier_count];
        Some(Box::new(Self {
            matrix: RecoveryMatrix::new(
                (system, state),
                (simulation.representative(), simulation.redundancy().clone()),
                kind,
            ),
            rotors: system.sprung_rotors(),
            breakpoints: system.breakpoints(),
            stages: settings.scheme.stages.len(),
            found: Recovered { rates: state.clone(), forces: state.clone() },
            work: Workspace {
                speeds: by_row(),
                accelerations: by_row(),
                lacking: by_row(),
                unbalanced: by_row(),
                stiff: by_row(),
                change: by_row(),
                right: by_row(),
                violation_rates: [by_multiplier(), by_multiplier()],
                switches: Vec::new(),
                still: state.kinematics.clone(),
                moved: state.kinematics.clone(),
            },
        }))
    }

    /// Recovers the state at the end of a step of `step` [s]. None at the start, and if there is no solution, for example at a singular
    /// position.
    pub fn recover(
        &mut self,
        need: Need,
        (system, state): (&System, &State),
        step: f64,
    ) -> Option<&Recovered> {
        if step <= 0.0 || need == Need::Positions {
            return None;
        }
        // More stages resolve faster vibrations.
        let time = 0.5 * step / self.stages.saturating_sub(1).max(1) as f64;
        self.found.rates.clone_from(state);
        hold_sides(system, &mut self.work.switches, &mut self.found.rates.kinematics);
        self.matrix.factor((system, &self.found.rates.kinematics), time, self.stages.max(2))?;
        self.find_lacking_velocities(system);
        if need == Need::Forces {
            self.found.forces.clone_from(&self.found.rates);
            self.filter_velocities(system, time);
        }
        self.recover_velocities(system)?;
        if need == Need::Velocities {
            return Some(&self.found);
        }
        let Recovered { rates, forces } = &mut self.found;
        if !self.matrix.is_stiff() {
            forces.kinematics.nodes.clone_from(&rates.kinematics.nodes);
            forces.kinematics.coordinates.clone_from(&rates.kinematics.coordinates);
        }
        self.recover_accelerations(system, time)?;
        self.share(system, time)?;
        Some(&self.found)
    }

    /// Copies to each of the two states the results for the other; none if they are not finite.
    fn share(&mut self, system: &System, time: f64) -> Option<()> {
        let Self { matrix, found: Recovered { rates, forces }, work, .. } = self;
        if !forces.multipliers.iter().chain(&work.change).chain(&work.stiff).all(|value| value.is_finite()) {
            return None;
        }
        let nodes = rates.kinematics.nodes.iter_mut().zip(&mut forces.kinematics.nodes);
        for (rates, forces) in nodes {
            rates.acceleration = forces.acceleration;
            // Springs and dampers are recorded with velocities that are not filtered.
            forces.twist = rates.twist;
        }
        let coordinates = rates.kinematics.coordinates.iter_mut().zip(&mut forces.kinematics.coordinates);
        for (rates, forces) in coordinates {
            rates.acceleration = forces.acceleration;
            forces.rate = rates.rate;
        }
        rates.multipliers.clone_from(&forces.multipliers);
        rates.kinematics.show_multipliers(&rates.multipliers);
        if matrix.is_stiff() {
            let shift = &mut work.right;
            for (shift, (y, x)) in shift.iter_mut().zip(work.change.iter().zip(&work.stiff)) {
                *shift = y - x;
            }
            matrix.clear_rates(system.layout(), shift);
            move_by(system.layout(), time * time, shift, &mut forces.kinematics);
        }
        Some(())
    }

    /// Residuals of the constraint rates, -(G v + ∂g/∂t), by row.
    fn find_lacking_velocities(&mut self, system: &System) {
        let Self { matrix, found: Recovered { rates, .. }, work, .. } = self;
        let layout = system.layout();
        work.lacking.fill(0.0);
        gather_rates(layout, &rates.kinematics, &mut work.speeds);
        let [found, accelerations] = &mut work.violation_rates;
        matrix.violation_rates(system, &rates.kinematics, [found, accelerations]);
        for (lacking, rate) in work.lacking[layout.coordinate_count()..].iter_mut().zip(found) {
            *lacking = -*rate;
        }
    }

    /// Makes the recorded velocities satisfy the constraints; none if they are not finite.
    fn recover_velocities(&mut self, system: &System) -> Option<()> {
        let Self { matrix, found: Recovered { rates, .. }, work, .. } = self;
        work.right.clone_from(&work.lacking);
        matrix.solve(&mut work.right);
        add_rates(system.layout(), (1.0, &work.right), &mut rates.kinematics);
        work.right.iter().all(|value| value.is_finite()).then_some(())
    }

    /// Makes velocities satisfy the constraints, without strain rates of stiff parts except those that forces over time require.
    fn filter_velocities(&mut self, system: &System, time: f64) {
        if !self.matrix.is_stiff() {
            return;
        }
        let square = time * time;
        self.work.stiff.clone_from(&self.work.lacking);
        if system.has_forces_over_time() || !self.rotors.is_empty() {
            self.stop(system);
        }
        let depends_on_time = self.depends_on_time(system, time);
        // Derivatives at constant twists of a rotor contain those of dampers by velocities, which turn with it.
        let has_rotors = !self.rotors.is_empty();
        if depends_on_time || has_rotors {
            let reach = if depends_on_time { REACH * time } else { time };
            self.subtract_change(system, time, reach, 1);
        }
        let Self { matrix, found: Recovered { forces, .. }, work, stages, .. } = self;
        if !depends_on_time && !has_rotors {
            let speeds = &work.speeds;
            matrix.add_stiffness_product(|row| -square * speeds[row], &mut work.stiff);
        }
        matrix.solve(&mut work.stiff);
        for _ in 1..(*stages).max(2) {
            work.right.clone_from(&work.lacking);
            let stiff = &work.stiff;
            matrix.add_stiffness_product(|row| square * stiff[row], &mut work.right);
            matrix.solve(&mut work.right);
            std::mem::swap(&mut work.stiff, &mut work.right);
        }
        add_rates(system.layout(), (1.0, &work.stiff), &mut forces.kinematics);
    }

    /// Computes accelerations and multipliers.
    fn recover_accelerations(&mut self, system: &System, time: f64) -> Option<()> {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let square = time * time;
        self.find_lacking_accelerations(system);
        self.find_stiff_accelerations(system, time);
        let Self { matrix, found: Recovered { forces, .. }, work, .. } = self;
        // Solve for y: resolved vibrations are not filtered.
        work.change.fill(0.0);
        let mut last = f64::INFINITY;
        for repetition in 0..MAX_ITERATIONS {
            if repetition > 0 {
                matrix.residual(system, &forces.kinematics, &forces.multipliers, &mut work.unbalanced);
                let [rates, found] = &mut work.violation_rates;
                matrix.violation_rates(system, &forces.kinematics, [rates, found]);
                work.lacking[..count].fill(0.0);
                for (lacking, found) in work.lacking[count..].iter_mut().zip(found) {
                    *lacking = -*found;
                }
            }
            let Workspace { right, lacking, unbalanced, stiff, change, accelerations, .. } = &mut *work;
            for (right, (lacking, unbalanced)) in right.iter_mut().zip(lacking.iter().zip(&*unbalanced)) {
                *right = lacking - unbalanced;
            }
            if matrix.is_stiff() {
                matrix.add_stiffness_product(|row| square * (stiff[row] - change[row]), right);
            }
            matrix.solve(right);
            layout.states().for_each(|(row, ..)| right[row] = 0.0);
            let (motions, multipliers) = right.split_at(count);
            change.iter_mut().zip(motions).for_each(|(change, further)| *change += further);
            let mut further = 0.0_f64;
            let mut largest = 0.0_f64;
            for (force, change) in forces.multipliers.iter_mut().zip(multipliers) {
                *force += change;
                further = further.max(change.abs());
                largest = largest.max(force.abs());
            }
            matrix.reduce_to_least_norm(&mut forces.multipliers);
            forces.kinematics.show_multipliers(&forces.multipliers);
            for (total, (own, change)) in right.iter_mut().zip(accelerations.iter().zip(&*change)) {
                *total = own + change;
            }
            keep_rates(layout, &forces.kinematics, right);
            scatter_accelerations(layout, right, &mut forces.kinematics);
            let relative = further / largest.max(f64::MIN_POSITIVE);
            if relative <= round_off::ITERATION {
                return Some(());
            }
            if !system.sees_multipliers() {
                let is_small = relative <= SMALL_CHANGE && matrix.is_exact();
                let is_next_small = last.is_finite() && relative * relative <= NEGLIGIBLE * last;
                if is_small || is_next_small || repetition == 3 || relative >= last {
                    return Some(());
                }
            }
            last = relative;
        }
        None
    }

    /// Residuals of the constraint accelerations, -(G a + Ġ v̂ + …), by row.
    fn find_lacking_accelerations(&mut self, system: &System) {
        let Self { matrix, found: Recovered { forces, .. }, work, .. } = self;
        let layout = system.layout();
        gather_accelerations(layout, &forces.kinematics, &mut work.accelerations);
        matrix.clear_rates(layout, &mut work.accelerations);
        work.accelerations[layout.coordinate_count()..].fill(0.0);
        gather_rates(layout, &forces.kinematics, &mut work.speeds);
        work.lacking.fill(0.0);
        let [rates, found] = &mut work.violation_rates;
        matrix.violation_rates(system, &forces.kinematics, [rates, found]);
        for (lacking, acceleration) in work.lacking[layout.coordinate_count()..].iter_mut().zip(found) {
            *lacking = -*acceleration;
        }
    }

    fn find_unbalanced(&mut self, system: &System) {
        let Recovered { forces, .. } = &self.found;
        self.matrix.residual(system, &forces.kinematics, &forces.multipliers, &mut self.work.unbalanced);
    }

    /// Computes x, the accelerations with stiff parts treated like constraints.
    fn find_stiff_accelerations(&mut self, system: &System, time: f64) {
        let square = time * time;
        self.find_unbalanced(system);
        self.work.stiff.fill(0.0);
        if !self.matrix.is_stiff() {
            return;
        }
        self.stop(system);
        let reach = if self.depends_on_time(system, time) { REACH * time } else { time };
        self.subtract_change(system, time, reach, 2);
        let Self { matrix, work, stages, rotors, .. } = self;
        let Workspace { right, lacking, unbalanced, stiff, accelerations, speeds, .. } = work;
        for (stiff, (lacking, unbalanced)) in stiff.iter_mut().zip(lacking.iter().zip(&*unbalanced)) {
            *stiff += lacking - unbalanced;
        }
        still_rates((system.layout(), rotors), speeds, accelerations, right);
        matrix.add_stiffness_product(|row| -square * right[row], stiff);
        matrix.solve(stiff);
        for _ in 2..*stages {
            for (right, (lacking, unbalanced)) in right.iter_mut().zip(lacking.iter().zip(&*unbalanced)) {
                *right = lacking - unbalanced;
            }
            matrix.add_stiffness_product(|row| square * stiff[row], right);
            matrix.solve(right);
            std::mem::swap(stiff, right);
        }
    }

    /// Sets `still` to the state at rest; rates of states are kept.
    fn stop(&mut self, system: &System) {
        let Self { found: Recovered { forces, .. }, work: Workspace { still, .. }, .. } = self;
        still.clone_from(&forces.kinematics);
        for node in &mut still.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        for coordinate in &mut still.coordinates {
            (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
        }
        for (_, state, _) in system.layout().states() {
            still.coordinates[state] = forces.kinematics.coordinates[state];
        }
    }

    /// Whether forces of the state at rest, `still`, are others at another time.
    fn depends_on_time(&mut self, system: &System, time: f64) -> bool {
        if !system.has_forces_over_time() {
            return false;
        }
        let Workspace { right, change, still, moved, .. } = &mut self.work;
        system.forces_over_time(still, right);
        moved.clone_from(still);
        moved.time -= time;
        system.forces_over_time(moved, change);
        right != change
    }

    /// `stiff` -= τ² times the derivative of this order, along the motion with constant twists, of the forces f of elements that may be
    /// stiff: by differences over a reach at rest, so that only forces that depend on positions and time are compared.
    fn subtract_change(&mut self, system: &System, time: f64, reach: f64, order: usize) {
        let Self { matrix, work, breakpoints, rotors, .. } = self;
        let layout = system.layout();
        let count = layout.coordinate_count();
        let Workspace { speeds, right: found, change: sum, stiff, still, moved, .. } = work;
        matrix.clear_rates(layout, speeds);
        let (now, is_over_time) = (still.time, reach < time);
        let has_breakpoint = |side: f64| {
            let margin = 1e-6 * reach;
            let is_within = |own: f64| own > margin && own < reach + margin;
            is_over_time && breakpoints.iter().any(|&own| is_within(side * (own - now)))
        };
        let (points, side) = match [-1.0, 1.0].map(has_breakpoint) {
            [false, false] => (&BOTH_SIDES, 1.0),
            [true, false] => (&ONE_SIDE, 1.0),
            // A step ends at breakpoints.
            _ => (&ONE_SIDE, -1.0),
        };
        let scale = (time / reach).powi(2) * if order == 1 { side * reach } else { 1.0 };
        sum.fill(0.0);
        for [shift, first, second] in points {
            moved.clone_from(still);
            if *shift != 0.0 {
                move_along((layout, rotors), side * shift * reach, speeds, moved);
                if is_over_time {
                    moved.time = now + side * shift * reach;
                }
            }
            system.stiff_forces(moved, found);
            turn_forces((layout, rotors), side * shift * reach, speeds, found);
            let weight = scale * if order == 1 { first } else { second };
            sum.iter_mut().zip(&*found).for_each(|(sum, force)| *sum += weight * force);
        }
        sum[count..].fill(0.0);
        matrix.clear_rates(layout, sum);
        if sum.iter().all(|value| value.is_finite()) {
            stiff.iter_mut().zip(&*sum).for_each(|(stiff, sum)| *stiff -= sum);
        }
    }
}

/// Freezes switches on their present branches, so that forces are continued from there.
fn hold_sides(system: &System, switches: &mut Vec<Switch>, at: &mut Kinematics) {
    let first = system.signals().first_side();
    if at.held.len() == first {
        return;
    }
    switches.clear();
    system.switches(at, switches);
    for (held, switch) in at.held[first..].iter_mut().zip(&*switches).filter(|(held, _)| **held == 0.0) {
        *held = switch.side();
    }
}

/// Keeps the accelerations of first-order states.
fn keep_rates(layout: &Layout, at: &Kinematics, accelerations: &mut [f64]) {
    for (row, coordinate, _) in layout.states() {
        accelerations[row] = at.coordinates[coordinate].acceleration;
    }
}

/// Rates of twists along the path of [`move_along`], in place of `accelerations`: velocities of a rotor are constant in axes that do not
/// spin.
fn still_rates(
    (layout, rotors): (&Layout, &[Rotor]),
    speeds: &[f64],
    accelerations: &[f64],
    out: &mut [f64],
) {
    out.copy_from_slice(accelerations);
    for rotor in rotors {
        let rows = layout.rows_of_node(rotor.node);
        let (spin, still) = rotor.parts(&components(rows, speeds));
        let turned = across(&spin, &still);
        rows.iter().zip(turned.iter()).for_each(|(&row, turned)| out[row as usize] += turned);
    }
}

/// Components of a node.
fn components(rows: &[u32; 6], values: &[f64]) -> Vector6 {
    Vector6::from_fn(|k, _| values[rows[k] as usize])
}

/// Turns forces on rotors, in axes to which these have turned in a time [s], back to axes that do not spin.
fn turn_forces((layout, rotors): (&Layout, &[Rotor]), time: f64, speeds: &[f64], forces: &mut [f64]) {
    for rotor in rotors {
        let rows = layout.rows_of_node(rotor.node);
        let angle = time * rotor.axis.dot(&rotation_part(&components(rows, speeds)));
        let turned = rotor.turned(angle, &components(rows, forces));
        rows.iter().zip(turned.iter()).for_each(|(&row, turned)| forces[row as usize] = *turned);
    }
}

/// Moves nodes and coordinates for a time [s] at `speeds`, which are constant in axes of the nodes, or in axes of rotors that do not spin.
fn move_along((layout, rotors): (&Layout, &[Rotor]), time: f64, speeds: &[f64], at: &mut Kinematics) {
    move_by(layout, time, speeds, at);
    for rotor in rotors {
        let rows = layout.rows_of_node(rotor.node);
        let twist = components(rows, speeds);
        let (spin, still) = rotor.parts(&twist);
        let turn = Motion::exponential(&screw(&Vector3::zeros(), &(time * spin)));
        let instead = Motion::exponential(&(-time * twist)) * Motion::exponential(&(time * still)) * turn;
        let frame = &mut at.nodes[rotor.node].frame;
        *frame = *frame * instead;
    }
}

/// Displaces nodes and coordinates by a factor times `changes`.
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
