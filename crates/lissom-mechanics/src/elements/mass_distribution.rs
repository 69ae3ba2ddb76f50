//! Distribution of an element's mass between its nodes: the difference between the consistent mass matrix of its translations and the lumped
//! masses of its nodes. With both a rigid motion of any mesh has the energy, momentum and weight of the interpolated mass.
//!
//! Legend: y_k = x + R c_k points that nodes at x with the rotations R carry, ρ mass per length, area or volume, N_k functions that interpolate
//! the position of the mass from these points, m_k lumped masses, g gravity.
//!
//! ```text
//! M_kl = ∫ ρ N_k N_l - m_k δ_kl,      T = Σ M_kl ẏ_k·ẏ_l/2
//! φ_k = Σ M_kl (ÿ_l - g) on y_k,      (Rᵀ φ_k, c_k × Rᵀ φ_k) on its node
//! w_k = V̇ + Ω̇ × c_k + Ω × (V + Ω × c_k),      ÿ_k = R w_k
//! ```

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::SMatrix;

use super::inertia::Gravity;
use super::{Capabilities, Element, Energy, OwnInertia, Tangents, Unknowns, add_block};
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{Kinematics, NodeId, NodeMotion, split};

type Matrix3x6 = SMatrix<f64, 3, 6>;

/// Difference between consistent and lumped mass of one element.
#[derive(Clone, Debug)]
pub struct MassDistribution<const NODES: usize, const POINTS: usize> {
    nodes: [NodeId; NODES],
    /// Points with the indices of their nodes, in the axes of these [m].
    points: [(usize, Vector3); POINTS],
    /// M_kl [kg].
    matrix: Box<[[f64; POINTS]; POINTS]>,
    /// Whether nodes rotate; otherwise the points are the nodes.
    has_rotations: bool,
    gravity: Gravity,
}

impl<const NODES: usize> MassDistribution<NODES, NODES> {
    /// Mass distribution at nodes without rotations.
    pub fn of_points(
        nodes: [NodeId; NODES],
        consistent: Box<[[f64; NODES]; NODES]>,
        lumped: &[f64; NODES],
        gravity: Gravity,
    ) -> Self {
        let points = std::array::from_fn(|node| (node, Vector3::zeros()));
        Self { has_rotations: false, ..Self::new(nodes, points, consistent, lumped, gravity) }
    }
}

impl<const NODES: usize, const POINTS: usize> MassDistribution<NODES, POINTS> {
    /// The consistent mass matrix `consistent` [kg] on `points`, each with the index of its node and its position in the axes of this node
    /// [m], without the `lumped` masses of the first points [kg].
    pub fn new(
        nodes: [NodeId; NODES],
        points: [(usize, Vector3); POINTS],
        mut consistent: Box<[[f64; POINTS]; POINTS]>,
        lumped: &[f64; NODES],
        gravity: Gravity,
    ) -> Self {
        for (i, own) in lumped.iter().enumerate() {
            consistent[i][i] -= own;
        }
        Self { nodes, points, matrix: consistent, has_rotations: true, gravity }
    }

    /// Σ_l M_kl x_l for each k.
    fn times(&self, vectors: &[Vector3; POINTS]) -> [Vector3; POINTS] {
        self.matrix.each_ref().map(|row| row.iter().zip(vectors).map(|(entry, own)| *entry * own).sum())
    }

    /// A quantity of each point, global axes, from one in the axes of its node.
    fn each(&self, at: &Kinematics, own: impl Fn(&NodeMotion, &Vector3) -> Vector3) -> [Vector3; POINTS] {
        self.points.each_ref().map(|(node, point)| {
            let node = &at.nodes[self.nodes[*node]];
            node.frame.rotation.apply(&own(node, point))
        })
    }

    /// φ.
    fn point_forces(&self, at: &Kinematics) -> [Vector3; POINTS] {
        let gravity = self.gravity.at(at.time);
        self.times(&self.each(at, acceleration).map(|own| own - gravity))
    }

    /// Adds the wrenches of forces on the points.
    fn add_wrenches(&self, at: &Kinematics, forces: &[Vector3; POINTS], out: &mut [f64]) {
        for ((node, point), force) in self.points.iter().zip(forces) {
            let force = at.nodes[self.nodes[*node]].frame.rotation.apply_inverse(force);
            let moment = point.cross(&force);
            let out = out[6 * node..].iter_mut();
            out.zip(force.iter().chain(&moment)).for_each(|(sum, value)| *sum += value);
        }
    }

    /// Adds M_kl `left`_kᵀ `right`_l for each two points to a matrix of the local unknowns.
    fn add_products(&self, [left, right]: [&[Matrix3x6; POINTS]; 2], out: &mut [f64]) {
        for (k, (row, _)) in self.points.iter().enumerate() {
            let mut sums = [Matrix3x6::zeros(); NODES];
            for ((entry, (column, _)), own) in self.matrix[k].iter().zip(&self.points).zip(right) {
                sums[*column] += *entry * own;
            }
            for (column, sum) in sums.iter().enumerate() {
                let block = left[k].tr_mul(sum);
                for i in 0..6 {
                    let start = (6 * row + i) * 6 * NODES + 6 * column;
                    out[start..start + 6].iter_mut().enumerate().for_each(|(j, own)| *own += block[(i, j)]);
                }
            }
        }
    }

    /// Adds the mass matrix of nodes without rotations to a matrix of the local unknowns.
    fn add_translations(&self, out: &mut [f64]) {
        for (i, row) in self.matrix.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                (0..3).for_each(|k| out[(6 * i + k) * 6 * NODES + 6 * j + k] += entry);
            }
        }
    }

    /// Derivatives of a quantity of each point in global axes, from those in the axes of its node by linear and angular motion.
    fn derivatives(
        &self,
        at: &Kinematics,
        own: impl Fn(&NodeMotion, &Vector3) -> [Matrix3; 2],
    ) -> [Matrix3x6; POINTS] {
        self.points.each_ref().map(|(node, point)| {
            let node = &at.nodes[self.nodes[*node]];
            let [linear, angular] = own(node, point).map(|part| node.frame.rotation.matrix() * part);
            Matrix3x6::from_fn(|i, j| if j < 3 { linear[(i, j)] } else { angular[(i, j - 3)] })
        })
    }

    /// R [1, -c~] of each point: its velocity for the twist of its node.
    fn carried(&self, at: &Kinematics) -> [Matrix3x6; POINTS] {
        self.derivatives(at, |_, point| [Matrix3::identity(), -skew(point)])
    }
}

fn velocity(node: &NodeMotion, point: &Vector3) -> Vector3 {
    let (linear, spin) = split(&node.twist);
    linear + spin.cross(point)
}

/// w.
fn acceleration(node: &NodeMotion, point: &Vector3) -> Vector3 {
    let ((linear, angular), spin) = (split(&node.acceleration), split(&node.twist).1);
    linear + angular.cross(point) + spin.cross(&velocity(node, point))
}

fn dot<const POINTS: usize>(one: &[Vector3; POINTS], other: &[Vector3; POINTS]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one.dot(other)).sum()
}

impl<const NODES: usize, const POINTS: usize> Element for MassDistribution<NODES, POINTS> {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        self.add_wrenches(at, &self.point_forces(at), out);
    }

    /// With δ_j the difference between ẏ at stage j and its integral from the accelerations at the stages, and δ the same at the end, the
    /// forces miss the work δ·M (ẏ - δ/2) - Σ D_j δ_j·M ÿ_j of a quadratic energy. It is added along the momenta of the lumped masses.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        if !self.has_rotations {
            return step.stages.iter().zip(out).for_each(|(at, out)| self.forces(at, out));
        }
        let start = self.each(step.start, velocity);
        let velocities = step.stages.map(|at| self.each(at, velocity));
        let accelerations = step.stages.map(|at| self.each(at, acceleration));
        let end: [Vector3; POINTS] = std::array::from_fn(|k| {
            let (node, point) = (self.nodes[self.points[k].0], &self.points[k].1);
            let gained = step.whole(step.stages.map(|at| at.nodes[node].acceleration));
            let (linear, spin) = split(&(step.start.nodes[node].twist + gained));
            step.end.nodes[node].frame.rotation.apply(&(linear + spin.cross(point)))
        });
        let rates = |k: usize| accelerations.each_ref().map(|own| own[k]);
        let missed_at_end: [Vector3; POINTS] =
            std::array::from_fn(|k| end[k] - start[k] - step.whole(rates(k)));
        let integrated: [[Vector3; STAGES]; POINTS] =
            std::array::from_fn(|k| step.at_stages(start[k], rates(k)));
        let mean = std::array::from_fn(|k| end[k] - 0.5 * missed_at_end[k]);
        let at_stages = [0, 1].map(|j| {
            let apart = std::array::from_fn(|k| velocities[j][k] - integrated[k][j]);
            dot(&apart, &self.times(&accelerations[j]))
        });
        let missed = dot(&missed_at_end, &self.times(&mean)) - step.whole(at_stages);
        let momenta =
            velocities.each_ref().map(|own| std::array::from_fn(|k| self.matrix[k][k].abs() * own[k]));
        let (inverse, _) = step.shares([0, 1].map(|j| dot(&velocities[j], &momenta[j])));
        for ((at, momenta), out) in step.stages.iter().zip(&momenta).zip(out) {
            let forces = self.point_forces(at);
            let corrected = std::array::from_fn(|k| forces[k] + (missed * inverse) * momenta[k]);
            self.add_wrenches(at, &corrected, out);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        if !self.has_rotations {
            return self.add_translations(&mut out.mass);
        }
        let carried = self.carried(at);
        self.add_products([&carried, &carried], &mut out.mass);
        let by_twist = self.derivatives(at, |node, point| {
            let spin = skew(&split(&node.twist).1);
            [spin, -skew(&velocity(node, point)) - spin * skew(point)]
        });
        self.add_products([&carried, &by_twist], &mut out.damping);
        let by_turn =
            self.derivatives(at, |node, point| [Matrix3::zeros(), -skew(&acceleration(node, point))]);
        self.add_products([&carried, &by_turn], &mut out.stiffness);
        for ((node, point), force) in self.points.iter().zip(self.point_forces(at)) {
            let turned = skew(&at.nodes[self.nodes[*node]].frame.rotation.apply_inverse(&force));
            add_block(&mut out.stiffness, 6 * NODES, (6 * node, 6 * node + 3), &turned);
            add_block(&mut out.stiffness, 6 * NODES, (6 * node + 3, 6 * node + 3), &(skew(point) * turned));
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let velocities = self.each(at, velocity);
        let positions = self
            .points
            .each_ref()
            .map(|(node, point)| at.nodes[self.nodes[*node]].frame.transform_point(point));
        let moment: Vector3 = self.times(&positions).iter().sum();
        Energy {
            kinetic: 0.5 * dot(&velocities, &self.times(&velocities)),
            strain: 0.0,
            potential: -self.gravity.acceleration.dot(&moment),
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { inertia: Some(self), is_body_inertia: true, ..Capabilities::default() }
    }
}

impl<const NODES: usize, const POINTS: usize> OwnInertia for MassDistribution<NODES, POINTS> {
    fn mass(&self, at: &Kinematics, out: &mut Vec<f64>) {
        out.clear();
        out.resize(36 * NODES * NODES, 0.0);
        if self.has_rotations {
            let carried = self.carried(at);
            self.add_products([&carried, &carried], out);
        } else {
            self.add_translations(out);
        }
    }
}
