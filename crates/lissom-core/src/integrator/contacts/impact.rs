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
//! elastic parts add to the effective mass [augmented Lagrangian method, Alart and Curnier 1991]. Touches that last do not approach. The
//! share s belongs to the [law](crate::impacts) with E₀ the energy that the step has lost. Only parts that touches, joints or elastic parts
//! connect with an impact take part.

use lissom_motion::{Vector3, Vector6};
use lissom_solver::Pattern;
use nalgebra::Vector2;

use super::touch_point::{Phase, TouchPoint, TouchState, add_friction};
use super::{StepContacts, have_changed};
use crate::kinematics::{Kinematics, LOCKED, Layout, NodeId};
use crate::system::{Linearization, System};

/// R over w of impacts and of touches that last.
const YIELDING: [f64; 2] = [1e-5, 1e-4];
/// R_t over w of both.
const STICKING: [f64; 2] = [0.03, 0.1];
/// Gap left at the end of the step, over the path of approach, up to which an impact is reached in it: corners meet together.
const REACHED: f64 = 0.01;
/// Accuracy of the velocities of impacts and of touches that last, and of sticking, over that of approach.
const ACCURACY: [f64; 2] = [1e-5, 1e-4];

/// A touch that takes part.
#[derive(Clone, Debug)]
pub(crate) struct Participant {
    /// Index among the points of the step.
    pub(crate) index: usize,
    pub(crate) is_impact: bool,
    /// u_A [m/s] and γ_A [N s], in the axes at the end.
    pub(crate) before: Vector3,
    pub(crate) known: Vector3,
    /// Path of approach in the step over its size, min(φ/h, u⁻) [m/s].
    pub(crate) path: f64,
    /// d with s = 1 [m/s].
    pub(crate) departure: f64,
    /// b and o [m/s].
    pub(crate) bias: f64,
    pub(crate) offset: Vector2<f64>,
    /// R and R_t [1/kg].
    pub(crate) resistance: [f64; 2],
    /// μ γ_n [N s].
    pub(crate) bound: f64,
}

impl Participant {
    /// Impulse at a velocity, with its decrease by the velocity.
    pub(crate) fn evaluate(&mut self, point: &TouchPoint, velocity: Vector3, follows: bool) -> TouchState {
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
    pub(crate) participants: Vec<Participant>,
    /// Points of the participants at the end of the step, with their velocities and impulses.
    pub(crate) points: Vec<TouchPoint>,
    pub(crate) states: Vec<TouchState>,
    /// Changes of the velocities by a correction [m/s].
    pub(crate) changes: Vec<Vector3>,
    /// v_B - v_A and λ, by row; zeros without impacts.
    pub(crate) change: Vec<f64>,
    /// Labels of the unknowns that joints and elements connect; those with touches.
    pub(crate) component: Vec<u32>,
    pub(crate) labels: Vec<u32>,
    pub(crate) linearization: Linearization,
    /// On the values of the system's pattern: A with G, and the tangent.
    pub(crate) operator: Vec<f64>,
    pub(crate) smooth: Vec<f64>,
    pub(crate) right: Vec<f64>,
    pub(crate) product: Vec<f64>,
    /// Touches that an impact of the step has caused, by index.
    pub(crate) postponed: Vec<usize>,
    /// The best solution so far.
    pub(crate) best: Vec<f64>,
    pub(crate) best_states: Vec<TouchState>,
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
    pub(crate) fn clear(&mut self) {
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
    pub(crate) fn evaluate(&mut self, layout: &Layout, at: &Kinematics, follows: bool) {
        let Self { participants, points, states, change, .. } = self;
        states.clear();
        for (own, point) in participants.iter_mut().zip(&*points) {
            let velocity = own.before + point.change(at, |node| of_node(layout, node, change));
            states.push(own.evaluate(point, velocity, follows));
        }
    }

    /// Sets the right-hand side to A Δ + Gᵀ λ - Σ Jᵀ (γ_B - γ_A), and G Δ.
    pub(crate) fn residual(&mut self, (pattern, layout): (&Pattern, &Layout), at: &Kinematics) {
        let Self { participants, points, states, change, operator, right, .. } = self;
        pattern.multiply(operator, change, right);
        for ((own, point), state) in participants.iter().zip(&*points).zip(&*states) {
            point.add_wrenches(&-(state.force - own.known), (at, layout), right);
        }
    }

    /// Largest residual of a node over its mass and the velocity of approach.
    pub(crate) fn unbalance(&self, pattern: &Pattern, layout: &Layout) -> f64 {
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
    pub(crate) fn fix_bounds(&mut self) -> bool {
        let all = self.participants.iter_mut().zip(&self.points).zip(&self.states);
        have_changed(all.map(|((own, point), state)| {
            let bound = point.friction_of(state.force.z, state.displacement.xy().norm());
            [bound - std::mem::replace(&mut own.bound, bound), bound]
        }))
    }

    /// Corrects the offsets of pressed points for a share of the rebounds. Whether velocities are not yet accurate.
    pub(crate) fn correct_offsets(&mut self, share: f64) -> bool {
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
    pub(crate) fn begin(&mut self, share: f64) {
        self.change.fill(0.0);
        for own in &mut self.participants {
            own.bias = share * own.departure;
            own.offset = Vector2::zeros();
        }
    }
}

/// Rows of a node in a vector by row.
pub(crate) fn of_node(layout: &Layout, node: NodeId, values: &[f64]) -> Vector6 {
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
    pub(crate) fn find_impacts(
        &mut self,
        layout: &Layout,
        (start, at): (&Kinematics, &Kinematics),
        size: f64,
    ) -> bool {
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
