//! Velocities after the impacts of a step, at the positions of its end. The step itself stops the parts that meet in it; what an impact
//! returns, and its friction, changes velocities alone, so that a rebound adds no height.
//!
//! Legend: v velocities, A at the end of the step and B after its impacts, M, D, K inertia, damping and stiffness there, h step size, γ
//! impulses of the step at touches, J gradients of their velocities u = (u_t, u_n), G those of the constraints, w inverse effective mass
//! of both parts alone, u⁻ velocity of approach, φ gap at the start of the step, e restitution, μ friction.
//!
//! ```text
//! A (v_B - v_A) + Gᵀ λ = Σ Jᵀ (γ_B - γ_A),      G (v_B - v_A) = 0,      A = M + h D + h² K
//! γ_n = max(0, b - u_n)/R,      γ_t = -(u_t + o)/R_t,  at most μ γ_n
//! impacts:  R = w/10⁵,  R_t = 0.03 w,  d = s e √(u⁻² + 2 (u⁻ - u_f) min(φ/h, u⁻))         touches that last:  R = w/10⁴,  R_t = 0.1 w,  d = 0
//! b ← b + d - u_n,   o ← -R_t γ_t     until u_n = d and u_t = 0 where they are pressed and stick
//! ```
//!
//! u_f is the velocity without the touches of the impact. The offsets b and o make the result independent of w, also where joints or
//! elastic parts add to the effective mass [augmented Lagrangian method, Alart and Curnier 1991]. Touches that last do not approach [law of
//! Newton]. The share s of the rebounds is 1, or less if the kinetic energy that they return were more than what the step has lost.
//! Only parts that touches, joints or elastic parts connect with an impact take part.

use lissom_motion::{Vector3, Vector6};
use lissom_solver::Pattern;
use nalgebra::Vector2;

use super::StepContacts;
use super::touch_point::{Phase, TouchPoint, TouchState, add_friction};
use crate::integrator::equations::StepEquations;
use crate::joints::evaluation_point::{Augmentation, Chart, Increments, Point};
use crate::kinematics::{Kinematics, LOCKED, Layout, NodeId, Quantity};
use crate::newton::Failure;
use crate::saddle_point::TangentValues;
use crate::system::{Linearization, System, TangentAssembler};

/// R over w of impacts and of touches that last.
const YIELDING: [f64; 2] = [1e-5, 1e-4];
/// R_t over w of both.
const STICKING: [f64; 2] = [0.03, 0.1];
/// Gap left at the end of the step, over the path of approach, up to which an impact is reached in it: corners meet together.
const REACHED: f64 = 0.01;
/// Accuracy of the velocities of impacts and of touches that last, and of sticking, over that of approach.
const ACCURACY: [f64; 2] = [1e-5, 1e-4];
/// Largest number of times in which offsets are corrected.
const MAX_OFFSETS: usize = 3;
/// Largest number of shares of the rebounds.
const MAX_SHARES: usize = 7;
/// Energy left of what the step has lost, over the kinetic energy, with which a share is large enough.
const UNUSED: f64 = 1e-3;
/// Change of energy over the kinetic energy that is round-off.
const GAIN: f64 = 1e-10;
/// Residual over the momentum of the approach at which an iteration has converged.
const TOLERANCE: f64 = 1e-8;
/// Largest number of corrections, and of those in which bounds of friction follow the iterates.
const MAX_CORRECTIONS: usize = 60;
const FOLLOWING: usize = 15;
/// Relative change of bounds below which they are accurate.
const BOUND_CHANGE: f64 = 1e-3;

/// A touch that takes part.
#[derive(Clone, Debug)]
struct Participant {
    /// Index among the points of the step.
    index: usize,
    is_impact: bool,
    /// u_A [m/s] and γ_A [N s], in the axes at the end.
    before: Vector3,
    known: Vector3,
    /// Path of approach in the step over its size, min(φ/h, u⁻) [m/s].
    path: f64,
    /// d with s = 1 [m/s].
    departure: f64,
    /// b and o [m/s].
    bias: f64,
    offset: Vector2<f64>,
    /// R and R_t [1/kg].
    resistance: [f64; 2],
    /// μ γ_n [N s].
    bound: f64,
}

impl Participant {
    /// Impulse at a velocity, with its decrease by the velocity.
    fn evaluate(&mut self, point: &TouchPoint, velocity: Vector3, follows: bool) -> TouchState {
        let mut state = TouchState::default();
        let [yielding, sticking] = self.resistance;
        let closing = self.bias - velocity.z;
        if closing > 0.0 {
            state.force.z = closing / yielding;
            state.slope[(2, 2)] = 1.0 / yielding;
        }
        state.displacement = velocity;
        if follows {
            self.bound = point.friction_of(state.force.z, velocity.xy().norm());
        }
        let pull = [0, 1].map(|k| (self.offset[k] + velocity[k]) / sticking);
        add_friction(pull, 1.0 / sticking, self.bound, &mut state);
        state
    }
}

/// The velocity problem of a step.
#[derive(Default)]
pub(crate) struct Impacts {
    participants: Vec<Participant>,
    /// The same points at the end of the step, with their velocities and impulses.
    points: Vec<TouchPoint>,
    states: Vec<TouchState>,
    /// Changes of the velocities by a correction [m/s].
    changes: Vec<Vector3>,
    /// v_B - v_A and λ, by row; zeros without impacts.
    change: Vec<f64>,
    /// Labels of the unknowns that joints and elements connect; those with touches.
    component: Vec<u32>,
    labels: Vec<u32>,
    linearization: Linearization,
    /// On the values of the system's pattern: A with G, and the tangent.
    operator: Vec<f64>,
    smooth: Vec<f64>,
    right: Vec<f64>,
    product: Vec<f64>,
    /// Touches that an impact of the step has caused, by index.
    postponed: Vec<usize>,
    /// The best solution so far.
    best: Vec<f64>,
    best_states: Vec<TouchState>,
}

impl Impacts {
    pub(super) fn new(system: &System) -> Self {
        let pattern = &system.structure().pattern;
        let size = pattern.size();
        let mut component: Vec<u32> = (0..size as u32).collect();
        for column in 0..size {
            for &row in pattern.column(column) {
                unite(&mut component, row, column);
            }
        }
        let zeros = vec![0.0; size];
        Self {
            component,
            linearization: system.empty_linearization(),
            change: zeros.clone(),
            right: zeros.clone(),
            product: zeros.clone(),
            best: zeros,
            ..Self::default()
        }
    }

    /// v_B - v_A and λ by row [m/s, rad/s, N s, N m s]; none without impacts.
    pub(crate) fn change(&self) -> Option<&[f64]> {
        (!self.participants.is_empty()).then_some(&self.change[..])
    }

    /// Forgets the impacts of the last step.
    pub(super) fn clear(&mut self) {
        self.participants.clear();
        self.postponed.clear();
    }

    /// The state of a point of the step after the impacts, the point at the end of the step, and whether it departs; none if it takes no
    /// part.
    pub(super) fn result(&self, index: usize) -> Option<(&TouchPoint, &TouchState, bool)> {
        let own = self.participants.binary_search_by_key(&index, |own| own.index).ok()?;
        let participant = &self.participants[own];
        let departs = participant.is_impact && participant.departure > self.points[own].rest_velocity();
        Some((&self.points[own], &self.states[own], departs))
    }

    /// Whether a touch that another impact caused is to be solved in the next step.
    pub(super) fn postpones(&self, index: usize) -> bool {
        self.postponed.binary_search(&index).is_ok()
    }

    /// Label of the unknowns that joints and elements connect with a node; none if it does not move.
    pub(super) fn label_of(&self, layout: &Layout, node: NodeId) -> Option<usize> {
        label_of(&self.component, layout, node)
    }

    /// Largest velocity of approach [m/s].
    fn approach(&self) -> f64 {
        let own = self.participants.iter().map(|own| own.before.amax());
        let approach = self.points.iter().map(|point| point.approach);
        own.chain(approach).fold(0.0, f64::max)
    }

    /// The velocities at all participants for the present change.
    fn evaluate(&mut self, layout: &Layout, at: &Kinematics, follows: bool) {
        let Self { participants, points, states, change, .. } = self;
        states.clear();
        for (own, point) in participants.iter_mut().zip(&*points) {
            let velocity = own.before + point.change(at, |node| of_node(layout, node, change));
            states.push(own.evaluate(point, velocity, follows));
        }
    }

    /// Sets the right-hand side to A Δ + Gᵀ λ - Σ Jᵀ (γ_B - γ_A), and G Δ.
    fn residual(&mut self, (pattern, layout): (&Pattern, &Layout), at: &Kinematics) {
        let Self { participants, points, states, change, operator, right, .. } = self;
        pattern.multiply(operator, change, right);
        for ((own, point), state) in participants.iter().zip(&*points).zip(&*states) {
            point.add_wrenches(&-(state.force - own.known), (at, layout), right);
        }
    }

    /// Largest residual of a node over its mass and the velocity of approach.
    fn unbalance(&self, pattern: &Pattern, layout: &Layout) -> f64 {
        let diagonal =
            |row: usize| pattern.position(row, row).map_or(0.0, |position| self.operator[position]);
        let of_node = |rows: &[u32; 6]| {
            let mut sum = 0.0;
            let mut mass = 0.0_f64;
            for &row in rows.iter().filter(|row| **row != LOCKED) {
                let own = diagonal(row as usize);
                if own > 0.0 {
                    mass = if mass == 0.0 { own } else { mass };
                    sum += self.right[row as usize].powi(2) / own;
                }
            }
            if mass > 0.0 { (sum / mass).sqrt() } else { 0.0 }
        };
        let most = layout.node_rows.iter().map(of_node).fold(0.0, f64::max);
        most / self.approach().max(f64::MIN_POSITIVE)
    }

    /// Fixes the bounds of friction anew. Whether they have changed.
    fn fix_bounds(&mut self) -> bool {
        let (mut change, mut all) = (0.0, 0.0);
        for ((own, point), state) in self.participants.iter_mut().zip(&self.points).zip(&self.states) {
            let bound = point.friction_of(state.force.z, state.displacement.xy().norm());
            change += (bound - own.bound).powi(2);
            all += bound * bound;
            own.bound = bound;
        }
        change > BOUND_CHANGE * BOUND_CHANGE * all
    }

    /// Corrects the offsets of pressed points for a share of the rebounds. Whether velocities are not yet accurate.
    fn correct_offsets(&mut self, share: f64) -> bool {
        let scale = self.approach();
        let mut is_changed = false;
        for (own, state) in self.participants.iter_mut().zip(&self.states) {
            if state.force.z <= 0.0 {
                continue;
            }
            let missing = share * own.departure - state.displacement.z;
            if missing.abs() > ACCURACY[usize::from(!own.is_impact)] * scale {
                own.bias += missing;
                is_changed = true;
            }
            if own.is_impact {
                let offset = -state.force.xy() * own.resistance[1];
                is_changed |= (offset - own.offset).amax() > ACCURACY[1] * scale;
                own.offset = offset;
            }
        }
        is_changed
    }

    /// Begins a solution with a share of the rebounds.
    fn begin(&mut self, share: f64) {
        self.change.fill(0.0);
        for own in &mut self.participants {
            own.bias = share * own.departure;
            own.offset = Vector2::zeros();
        }
    }
}

/// Rows of a node in a vector by row.
fn of_node(layout: &Layout, node: NodeId, values: &[f64]) -> Vector6 {
    let rows = layout.rows_of_node(node);
    Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { values[rows[k] as usize] })
}

/// Unites the components of two unknowns.
fn unite(labels: &mut [u32], one: usize, other: usize) {
    let (one, other) = (root(labels, one), root(labels, other));
    labels[one.max(other)] = one.min(other) as u32;
}

/// The label of an unknown's component.
fn root(labels: &[u32], mut unknown: usize) -> usize {
    while labels[unknown] as usize != unknown {
        unknown = labels[unknown] as usize;
    }
    unknown
}

/// Labels of the components of both parts of a point.
fn connected<'a>(
    labels: &'a [u32],
    layout: &'a Layout,
    point: &TouchPoint,
) -> impl Iterator<Item = usize> + 'a {
    point.nodes.into_iter().filter_map(move |node| label_of(labels, layout, node))
}

/// Label of the component of a node; none if it does not move.
fn label_of(labels: &[u32], layout: &Layout, node: NodeId) -> Option<usize> {
    let row = layout.rows_of_node(node).iter().find(|row| **row != LOCKED)?;
    Some(root(labels, *row as usize))
}

impl StepContacts {
    /// Finds the impacts of a step of `size` [s] from the `start` that ended `at` these positions, and the touches that take part.
    /// Whether there are any.
    fn find_impacts(&mut self, layout: &Layout, (start, at): (&Kinematics, &Kinematics), size: f64) -> bool {
        let Self { near, states, impacts, .. } = self;
        let is_impact = |point: &TouchPoint, state: &TouchState| {
            let reached = REACHED * size * point.approach;
            point.phase == Phase::Impact && (state.force.z > 0.0 || point.distance_at(state) < reached)
        };
        let pairs = || near.points.iter().zip(states.iter());
        if !pairs().any(|(point, state)| is_impact(point, state)) {
            return false;
        }
        let lasts = |point: &TouchPoint, state: &TouchState| {
            point.distance_at(state) <= point.rest_velocity() * size && point.lasts_from(size)
        };
        let Impacts { component, labels, .. } = impacts;
        labels.clone_from(component);
        for (point, _) in pairs().filter(|(point, state)| is_impact(point, state) || lasts(point, state)) {
            let mut both = connected(labels, layout, point);
            let pair = (both.next(), both.next());
            drop(both);
            if let (Some(one), Some(other)) = pair {
                unite(labels, one, other);
            }
        }
        let all = pairs().filter(|(point, state)| is_impact(point, state));
        let mut hit: Vec<usize> = all.flat_map(|(point, _)| connected(labels, layout, point)).collect();
        hit.sort_unstable();
        impacts.points.clear();
        for (index, (point, state)) in near.points.iter().zip(states.iter()).enumerate() {
            let is_impact = is_impact(point, state);
            let is_hit =
                |labels: &[u32]| connected(labels, layout, point).any(|own| hit.binary_search(&own).is_ok());
            let takes_part = is_impact || lasts(point, state) && is_hit(&impacts.labels);
            if !takes_part {
                if state.force.z > 0.0
                    && point.phase != Phase::Lasting
                    && point.is_unresolved
                    && is_hit(&impacts.labels)
                {
                    impacts.postponed.push(index);
                }
                continue;
            }
            let kind = usize::from(!is_impact);
            let mut placed = near.placed_at(point, at);
            if is_impact {
                placed.approach = (-placed.velocity(start).z).max(0.0);
            }
            impacts.participants.push(Participant {
                index,
                is_impact,
                before: placed.velocity(at),
                known: size * placed.turned(point, &state.force),
                path: point.gap().clamp(0.0, size * placed.approach.max(0.0)) / size,
                departure: 0.0,
                bias: 0.0,
                offset: Vector2::zeros(),
                resistance: [YIELDING[kind] * point.compliance, STICKING[kind] * point.compliance],
                bound: 0.0,
            });
            impacts.points.push(placed);
        }
        true
    }
}

impl StepEquations<'_> {
    /// Finds the impacts of the step that was solved, and the velocities after them.
    pub(crate) fn resolve_impacts(&mut self) -> Result<(), Failure> {
        let Some(mut contacts) = self.work.contacts.take() else { return Ok(()) };
        contacts.impacts.clear();
        let (layout, size) = (self.system.layout(), self.scaled.step_size());
        let motions = (&self.start.kinematics, &self.work.motions[0].at);
        let result = if contacts.find_impacts(layout, motions, size) {
            self.solve_impacts(&mut contacts)
        } else {
            Ok(())
        };
        self.work.contacts = Some(contacts);
        result
    }

    fn solve_impacts(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        self.linearize_end(&mut contacts.impacts);
        let kinetic = self.kinetic_energy(&mut contacts.impacts);
        let lost = self.lost(contacts);
        self.find_departures(contacts)?;
        // Shares and what they return: the largest that gains no energy, and the smallest that does.
        let (mut low, mut high) = ([0.0; 2], [1.0, f64::INFINITY]);
        let mut share = 1.0;
        let mut is_found = false;
        for count in 0..MAX_SHARES {
            contacts.impacts.begin(share);
            for _ in 0..=MAX_OFFSETS {
                self.converge(contacts)?;
                if !contacts.impacts.correct_offsets(share) {
                    break;
                }
            }
            let returned = self.returned(&mut contacts.impacts);
            let impacts = &mut contacts.impacts;
            if returned - lost <= GAIN * kinetic {
                low = [share, returned];
                is_found = true;
                std::mem::swap(&mut impacts.best, &mut impacts.change);
                impacts.best_states.clone_from(&impacts.states);
                if count == 0 || lost - returned < UNUSED * kinetic || count + 2 >= MAX_SHARES {
                    break;
                }
            } else {
                high = [share, returned];
            }
            let missing = (lost - low[1]).max(0.0) / (high[1] - low[1]);
            let part = if low[0] > 0.0 { 0.9 * missing } else { 0.99 * missing.sqrt() };
            share = low[0] + (high[0] - low[0]) * part.clamp(0.05, 0.98);
        }
        let impacts = &mut contacts.impacts;
        if is_found {
            std::mem::swap(&mut impacts.best, &mut impacts.change);
            std::mem::swap(&mut impacts.best_states, &mut impacts.states);
            for own in &mut impacts.participants {
                own.departure *= low[0];
            }
        } else {
            // The step stops what meets.
            impacts.clear();
        }
        self.note_scales();
        Ok(())
    }

    /// Sets the operators at the end of the step.
    fn linearize_end(&mut self, impacts: &mut Impacts) {
        let (system, at) = (self.system, &self.work.motions[0].at);
        let layout = system.layout();
        let pattern = &system.structure().pattern;
        let zero = vec![0.0; layout.multiplier_count];
        let still = vec![crate::kinematics::MotionChange::none(); at.nodes.len()];
        let unchanged = vec![0.0; at.coordinates.len()];
        let point = Point {
            at,
            stressed: at.into(),
            increments: Increments { start: at, nodes: &still, coordinates: &unchanged, joints: None },
            multipliers: &zero,
            violations: &zero,
            augmentation: Augmentation::of_lengths(self.scaled.unit(Quantity::Angle)),
        };
        let Impacts { linearization: all, operator, smooth, .. } = impacts;
        system.linearize(&point, Chart::Body, all);
        operator.clear();
        operator.extend_from_slice(&all.mass);
        // States have no inertia.
        for (row, ..) in layout.states() {
            if let Some(diagonal) = pattern.position(row, row) {
                operator[diagonal] += 1.0;
            }
        }
        if system.has_stiff_elements() {
            all.damping.fill(0.0);
            all.stiffness.fill(0.0);
            let mass = std::mem::take(&mut all.mass);
            all.mass = vec![0.0; mass.len()];
            let mut scratch = all.scratch.take().unwrap_or_default();
            system.linearize_elements(true, at, &mut scratch, &mut TangentAssembler::Separate(all));
            all.scratch = Some(scratch);
            all.mass = mass;
            let size = self.scaled.step_size();
            for ((value, damping), stiffness) in operator.iter_mut().zip(&all.damping).zip(&all.stiffness) {
                *value += size * (damping + size * stiffness);
            }
        }
        smooth.clear();
        let scale = self.scaled.scale();
        let constraints = all.gram.iter().zip(&all.constraint);
        smooth.extend(
            operator
                .iter()
                .zip(constraints)
                .map(|(own, (gram, constraint))| own + scale * (gram + constraint)),
        );
        operator.iter_mut().zip(&all.constraint).for_each(|(own, constraint)| *own += constraint);
    }

    /// Velocities without the touches of the impacts, and from them the departures.
    fn find_departures(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        let layout = self.system.layout();
        let impacts = &mut contacts.impacts;
        impacts.change.fill(0.0);
        impacts.right.fill(0.0);
        let at = &self.work.motions[0].at;
        for (own, point) in impacts.participants.iter().zip(&impacts.points) {
            point.add_wrenches(&own.known, (at, layout), &mut impacts.right);
        }
        impacts.states.clear();
        impacts.states.resize(impacts.points.len(), TouchState::default());
        self.solve_velocities(contacts)?;
        let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
        let right = &impacts.right;
        for (own, point) in impacts.participants.iter_mut().zip(&impacts.points) {
            let Some(restitution) = point.restitution().filter(|_| own.is_impact) else { continue };
            // The solution is subtracted.
            let free = own.before.z - point.change(at, |node| of_node(layout, node, right)).z;
            let arrival = point.approach;
            let squared = arrival * arrival - 2.0 * (arrival + free) * own.path;
            own.departure = restitution * squared.max(0.0).sqrt();
        }
        Ok(())
    }

    /// Newton's method for the velocities with the present offsets.
    fn converge(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        let system = self.system;
        let (layout, pattern) = (system.layout(), &*system.structure().pattern);
        let mut corrections = 0;
        let mut fixed = 0;
        loop {
            let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
            impacts.evaluate(layout, at, corrections <= FOLLOWING);
            impacts.residual((pattern, layout), at);
            let unbalance = impacts.unbalance(pattern, layout);
            if !unbalance.is_finite() {
                return Err(Failure::NotFinite { iterations: corrections });
            }
            if unbalance <= TOLERANCE {
                if corrections <= FOLLOWING || fixed >= MAX_OFFSETS || !impacts.fix_bounds() {
                    return Ok(());
                }
                fixed += 1;
            }
            if corrections >= MAX_CORRECTIONS {
                return Err(Failure::NotConverged { iterations: corrections, correction: unbalance });
            }
            corrections += 1;
            let slope_of = |impacts: &Impacts, residual: &[f64]| -> f64 {
                -impacts.right.iter().zip(residual).map(|(change, own)| change * own).sum::<f64>()
            };
            contacts.impacts.product.clone_from(&contacts.impacts.right);
            self.solve_velocities(contacts)?;
            let (at, impacts) = (&self.work.motions[0].at, &mut contacts.impacts);
            let count = layout.coordinate_count();
            let slope = slope_of(impacts, &impacts.product[..count]);
            let Impacts { participants, points, states, changes, change, right, .. } = impacts;
            changes.clear();
            changes.extend(points.iter().map(|point| -point.change(at, |node| of_node(layout, node, right))));
            let steepening = |(state, change): (&TouchState, &Vector3)| change.dot(&(state.slope * change));
            let rise = (-slope - states.iter().zip(&*changes).map(steepening).sum::<f64>()).max(0.0);
            let known: f64 =
                states.iter().zip(&*changes).map(|(state, change)| state.force.dot(change)).sum();
            let touches = |share: f64| -> f64 {
                let each = participants.iter().zip(&*points).zip(states.iter().zip(&*changes));
                each.map(|((own, point), (state, change))| {
                    let velocity = state.displacement + share * change;
                    own.clone().evaluate(point, velocity, false).force.dot(change)
                })
                .sum()
            };
            let share = super::minimum_along(slope, |share| slope + known + share * rise - touches(share));
            for (value, correction) in change.iter_mut().zip(&*right) {
                *value -= share * correction;
            }
        }
    }

    /// Solves for a correction of the velocities and the multipliers, in place of the right-hand side, with the slopes of the states.
    fn solve_velocities(&mut self, contacts: &mut StepContacts) -> Result<(), Failure> {
        let layout = self.system.layout();
        let StepContacts { impacts, pattern, .. } = &mut *contacts;
        if pattern.follow((layout, false), &impacts.points, &impacts.states) {
            self.take_pattern(contacts);
        }
        let StepContacts { impacts, pattern, .. } = contacts;
        let TangentValues::Real(mut values) = self.work.tangent.matrices.take_values(0) else {
            unreachable!("the scheme has one stage")
        };
        let touches = (&impacts.points[..], &impacts.states[..], 1.0);
        pattern.assemble(&impacts.smooth, touches, (&self.work.motions[0].at, layout), &mut values);
        self.work.tangent.matrices.set_values(0, TangentValues::Real(values));
        let scale = self.scaled.scale();
        self.work.tangent.renew(&pattern.structure, scale).map_err(Failure::Factor)?;
        self.work.newton.effort.factorizations += 1;
        let right = &mut self.work.residuals[0];
        right.copy_from_slice(&impacts.right);
        let count = layout.coordinate_count();
        right[count..].iter_mut().for_each(|value| *value *= scale);
        self.work.tangent.scale(right);
        self.work.tangent.matrices.solve(&self.scheme.coupling, &mut self.work.residuals);
        let solution = &mut self.work.residuals[0];
        self.work.tangent.scale(solution);
        solution[count..].iter_mut().for_each(|value| *value *= scale);
        impacts.right.copy_from_slice(solution);
        Ok(())
    }

    /// ½ v_Aᵀ M v_A [J].
    fn kinetic_energy(&self, impacts: &mut Impacts) -> f64 {
        let pattern = &self.system.structure().pattern;
        let Impacts { linearization, right, product, .. } = impacts;
        velocities(self.system.layout(), &self.work.motions[0].at, right);
        pattern.multiply(&linearization.mass, right, product);
        0.5 * dot(right, product)
    }

    /// Energy that the step has lost [J]: ½ (v_A - v)ᵀ M (v_A - v), and what its touches have dissipated.
    fn lost(&self, contacts: &mut StepContacts) -> f64 {
        let layout = self.system.layout();
        let pattern = &self.system.structure().pattern;
        let (start, at) = (&self.start.kinematics, &self.work.motions[0].at);
        let StepContacts { near, states, impacts, .. } = contacts;
        let Impacts { linearization, right, product, .. } = impacts;
        velocities(layout, at, right);
        for ((rows, before), after) in layout.node_rows.iter().zip(&start.nodes).zip(&at.nodes) {
            let turned =
                |vector: Vector3| after.frame.rotation.apply_inverse(&before.frame.rotation.apply(&vector));
            let (velocity, spin) = crate::kinematics::split(&before.twist);
            let (velocity, spin) = (turned(velocity), turned(spin));
            for (k, &row) in rows.iter().enumerate().filter(|(_, row)| **row != LOCKED) {
                right[row as usize] -= if k < 3 { velocity[k] } else { spin[k - 3] };
            }
        }
        for (&row, before) in layout.coordinate_rows.iter().zip(&start.coordinates) {
            right[row as usize] -= before.rate;
        }
        pattern.multiply(&linearization.mass, right, product);
        let stored: f64 = start.touches.iter().map(|touch| touch.energy).sum();
        let dissipated = |(point, state): (&TouchPoint, &TouchState)| {
            -state.force.dot(&state.displacement) - point.energy(state)
        };
        0.5 * dot(right, product) + stored + near.points.iter().zip(&*states).map(dissipated).sum::<f64>()
    }

    /// Kinetic energy that the impacts return [J].
    fn returned(&self, impacts: &mut Impacts) -> f64 {
        let pattern = &self.system.structure().pattern;
        let Impacts { linearization, right, product, change, .. } = impacts;
        velocities(self.system.layout(), &self.work.motions[0].at, right);
        for (velocity, change) in right.iter_mut().zip(&*change) {
            *velocity += 0.5 * change;
        }
        pattern.multiply(&linearization.mass, right, product);
        dot(&change[..self.system.layout().coordinate_count()], product)
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Velocities by row; zeros for states and multipliers.
fn velocities(layout: &Layout, at: &Kinematics, out: &mut [f64]) {
    out.fill(0.0);
    for (rows, node) in layout.node_rows.iter().zip(&at.nodes) {
        for (k, &row) in rows.iter().enumerate().filter(|(_, row)| **row != LOCKED) {
            out[row as usize] = node.twist[k];
        }
    }
    for (&row, coordinate) in layout.coordinate_rows.iter().zip(&at.coordinates) {
        out[row as usize] = coordinate.rate;
    }
    for (row, ..) in layout.states() {
        out[row] = 0.0;
    }
}
