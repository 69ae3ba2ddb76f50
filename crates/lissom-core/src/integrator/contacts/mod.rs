//! Steps with a set of parts that may touch: the points of near parts, and the step's equations with their forces. No touch is an
//! event, and none has unknowns of its own.
//!
//! Legend: r residual of the step's equations, z increments, J gradient of the displacements d of the points, f their forces, A tangent
//! of the equations without touches, C = -∂f/∂d, Δ a correction, D diagonal of A.
//!
//! ```text
//! r(z) = r₀(z) - Jᵀ f(J z),      (A + Jᵀ C J) Δ = -r,      z ← z + α Δ with Δ·r(z + α Δ) ≈ 0
//! ```
//!
//! With bounds of friction that do not change r is the gradient of a convex function of z, apart from r₀ in large rotations and with
//! buckling, so that Newton's method with an exact line search converges [Castro, Permenter and Han 2022]. J, normals and gaps are those
//! at the start of the step, as in linearly implicit schemes; f acts on the position at the start, so that momenta are conserved.

mod coupled_pattern;
mod free_path;
pub(crate) mod impact;
mod known_gaps;
mod near_points;
mod touch_point;

use lissom_motion::{Matrix3, Vector3};
use lissom_solver::SolverKind;

pub(crate) use self::coupled_pattern::CoupledPattern;
use self::impact::Impacts;
use self::near_points::NearPoints;
pub(crate) use self::touch_point::{TouchPoint, TouchState};
use crate::kinematics::{Kinematics, Layout, NodeId};
use crate::saddle_point::TangentValues;
use crate::scaling::StageMotion;
use crate::system::{State, System, Touch};

/// Corrections in which bounds of friction follow the iterates. From then on they are fixed until the iterations converge.
pub(crate) const FOLLOWING: usize = 15;
/// Largest number of times in a step that bounds are fixed anew.
const MAX_ROUNDS: usize = 10;
/// Relative change of bounds below which they are accurate.
const BOUND_CHANGE: f64 = 1e-3;
/// Ratio of residuals below which a tangent serves again.
const KEPT: f64 = 0.5;
/// Share of its value at the start that the slope along a correction may have at its end without a search.
const WHOLE: f64 = 0.1;
/// Share of its value at the start that the slope along a correction may have at the end of a search.
const FOUND: f64 = 1e-2;
/// Largest number of evaluations of a search.
const MAX_EVALUATIONS: usize = 40;

/// What is kept of the touching parts between and within steps.
pub(crate) struct StepContacts {
    pub(crate) solver: &'static SolverKind,
    /// Tolerance of the residual over the motion in the step [-].
    pub(crate) tolerance: f64,
    pub(crate) near: NearPoints,
    pub(crate) states: Vec<TouchState>,
    /// Changes of the displacements by a correction [m].
    pub(crate) changes: Vec<Vector3>,
    pub(crate) pattern: CoupledPattern,
    pub(crate) smooth: SmoothTangent,
    /// Slopes of the touches in the tangent that this step factored last; empty without one.
    pub(crate) slopes: Vec<Matrix3>,
    /// Norms of the residual before the last correction and now.
    pub(crate) unbalance: [f64; 2],
    /// Residual in SI, by row.
    pub(crate) residual: Vec<f64>,
    /// Velocities after impacts.
    pub(crate) impacts: Impacts,
    /// Corrections made in this step, and how often bounds were fixed anew.
    pub(crate) corrections: usize,
    rounds: usize,
}

/// Tangent without touches.
pub(crate) struct SmoothTangent {
    pub(crate) values: TangentValues,
    /// Diagonal of the tangent by coordinate [SI]; empty before it is assembled in a step.
    pub(crate) diagonal: Vec<f64>,
}

impl StepContacts {
    /// Contacts of the parts of a system; none if nothing may touch.
    pub(crate) fn of((system, solver): (&System, &'static SolverKind)) -> Option<Box<Self>> {
        if system.contacts().is_empty() {
            return None;
        }
        let values = TangentValues::Real(vec![0.0; system.structure().pattern.entries()]);
        Some(Box::new(Self {
            solver,
            tolerance: 0.0,
            near: NearPoints::new(system),
            states: Vec::new(),
            changes: Vec::new(),
            pattern: CoupledPattern::new(system.layout(), system.structure()),
            smooth: SmoothTangent { values, diagonal: Vec::new() },
            slopes: Vec::new(),
            unbalance: [0.0; 2],
            residual: vec![0.0; system.layout().size()],
            impacts: Impacts::new(system),
            corrections: 0,
            rounds: 0,
        }))
    }

    /// Label of the parts that joints and elements connect with a node; none if it does not move.
    pub(crate) fn label_of(&self, layout: &Layout, node: NodeId) -> Option<usize> {
        self.impacts.label_of(layout, node)
    }

    /// Counts a correction. Whether the tangent without touches is to be assembled again for it: it hardly changes within a step, unless
    /// the iterations converge slowly.
    pub(crate) fn count_correction(&mut self) -> bool {
        self.corrections += 1;
        self.corrections > FOLLOWING
    }

    /// Whether the last tangent serves again: every touch is as it was, closed or open and sticking or slipping, and the residual falls
    /// as fast as it does with new tangents, which also omit that bounds follow the normal forces.
    pub(crate) fn keeps_tangent(&self) -> bool {
        let [before, now] = self.unbalance;
        let is_same = |(slope, state): (&Matrix3, &TouchState)| form_of(slope) == form_of(&state.slope);
        !self.slopes.is_empty() && now < KEPT * before && self.slopes.iter().zip(&self.states).all(is_same)
    }

    /// Finds the points at which parts may touch in a step of `size` [s], part of a `planned` one [s], from the `start`, which may be that of
    /// the motion.
    pub(crate) fn begin(
        &mut self,
        system: &System,
        (start, is_first): (&State, bool),
        [size, planned]: [f64; 2],
    ) {
        (self.corrections, self.rounds) = (0, 0);
        self.smooth.diagonal.clear();
        self.slopes.clear();
        self.near.begin(system, (start, is_first), [size, planned]);
    }

    /// Adds the forces of all points at the end of a motion from the `start` to the left-hand side of the equations.
    pub(crate) fn add_forces(
        &mut self,
        start: &Kinematics,
        motion: &StageMotion,
        layout: &Layout,
        out: &mut [f64],
    ) {
        let follows = self.corrections <= FOLLOWING;
        self.states.clear();
        for point in &mut self.near.points {
            let displacement = point.displacement(start, &motion.at, &motion.changes);
            let state = if follows {
                point.evaluate_with_bound(&displacement)
            } else {
                point.evaluate(&displacement)
            };
            self.states.push(state);
            point.add_wrenches(&-state.force, (&motion.at, layout), out);
        }
    }

    /// Updates what was fixed while the iterations converged. Whether nothing has changed.
    pub(crate) fn is_settled(&mut self, (from, motion): (&State, &StageMotion), size: f64) -> bool {
        if self.near.has_left(from, motion, size) {
            // Other points.
            self.slopes.clear();
            return false;
        }
        !self.has_new_bounds()
    }

    /// Fixes the bounds of friction anew, if they were fixed. Whether they have changed.
    fn has_new_bounds(&mut self) -> bool {
        if self.corrections <= FOLLOWING || self.rounds >= MAX_ROUNDS {
            return false;
        }
        self.rounds += 1;
        let pairs = self.near.points.iter_mut().zip(&self.states);
        have_changed(pairs.map(|(point, state)| [point.update_bound(state), point.bound]))
    }

    /// The touches of a motion that begins, before its first step.
    pub(crate) fn write_first_touches(&mut self, out: &mut Vec<Touch>) {
        self.states.clear();
        self.states.extend(self.near.points.iter().map(|point| point.evaluate(&Vector3::zeros())));
        self.write_touches(out);
    }

    /// The touches at the end of the step.
    pub(crate) fn write_touches(&self, out: &mut Vec<Touch>) {
        out.clear();
        let pairs = self.near.points.iter().zip(&self.states).enumerate();
        out.extend(pairs.filter_map(|(index, (point, state))| {
            let (touch, continues) = match self.impacts.result(index) {
                None => (point.end(state)?, !self.impacts.postpones(index)),
                Some((placed, impact, departs)) => (point.end_of_impact(state, (placed, impact)), !departs),
            };
            let continues = touch.continues && continues;
            let energy = if continues { touch.energy } else { 0.0 };
            Some(Touch { continues, energy, ..touch })
        }));
    }
}

/// Whether a touch with this slope is closed, and whether it sticks.
fn form_of(slope: &Matrix3) -> [bool; 2] {
    [slope[(2, 2)] > 0.0, slope[(0, 0)] == slope[(1, 1)] && slope[(0, 1)] == 0.0]
}

/// Whether bounds are not yet accurate, from the change of each and its value.
fn have_changed(bounds: impl Iterator<Item = [f64; 2]>) -> bool {
    let add = |[changes, all]: [f64; 2], [change, bound]: [f64; 2]| {
        [changes + change * change, all + bound * bound]
    };
    let [changes, all] = bounds.fold([0.0; 2], add);
    changes > BOUND_CHANGE * BOUND_CHANGE * all
}

/// Share α of a correction at which the slope ℓ' along it vanishes, which is `slope` at its start: of touches with their states, the
/// slopes that the correction is solved with and the changes of their displacements by it, and with these forces at displacements.
pub(crate) fn share_of_correction<'a>(
    slope: f64,
    (states, slopes, changes): (&[TouchState], impl Iterator<Item = &'a Matrix3>, &[Vector3]),
    force: impl Fn(usize, Vector3) -> Vector3,
) -> f64 {
    let touches = || states.iter().zip(changes).enumerate();
    let steepening: f64 = slopes.zip(changes).map(|(slope, change)| change.dot(&(slope * change))).sum();
    let rise = (-slope - steepening).max(0.0);
    let known = slope + touches().map(|(_, (state, change))| state.force.dot(change)).sum::<f64>();
    minimum_along(slope, |share| {
        let of = |(k, (state, change)): (usize, (&TouchState, &Vector3))| {
            force(k, state.displacement + share * change).dot(change)
        };
        known + share * rise - touches().map(of).sum::<f64>()
    })
}

/// Share of a correction at which the slope `at` along it vanishes, which is `slope` at its start.
fn minimum_along(slope: f64, at: impl Fn(f64) -> f64) -> f64 {
    let end = at(1.0);
    if !(slope < 0.0 && end > WHOLE * -slope) {
        return 1.0;
    }
    // The method of Illinois.
    let [mut low, mut high] = [[0.0, slope], [1.0, end]];
    let mut share = 1.0;
    for _ in 0..MAX_EVALUATIONS {
        share = (low[0] * high[1] - high[0] * low[1]) / (high[1] - low[1]);
        if !(share > low[0] && share < high[0]) {
            share = 0.5 * (low[0] + high[0]);
        }
        let value = at(share);
        if value.abs() < FOUND * -slope {
            break;
        }
        if value > 0.0 {
            high = [share, value];
            low[1] *= 0.5;
        } else {
            low = [share, value];
            high[1] *= 0.5;
        }
    }
    share
}
