//! Inertia of a rigid body frame with gravity: a rigid body, a point mass, or a beam node's share of
//! the beam. In body axes the mass matrix is constant.
//!
//! ```text
//! f = M (V̇ - γ) - ad_Vᵀ M V,     γ = (Rᵀ g, 0)
//! ```
//!
//! M 6x6 mass matrix about the node, V twist, g gravity. [Sonneville, Cardona and Brüls 2014, eq. 25]

use lissom_motion::{Matrix6, Vector3, Vector6, coadjoint_matrix, coadjoint_times, skew};

use super::inertia_blocks::InertiaBlocks;
use super::{Capabilities, Element, Energy, Tangents, Unknowns, add_block, is_same};
use crate::evaluation::blocks::Blocks;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{Kinematics, NodeId, split};
use crate::registry::Function;

/// Acceleration of gravity, constant or multiplied by a function of time.
#[derive(Clone, Debug)]
pub struct Gravity {
    /// Full value [m/s²].
    pub acceleration: Vector3,
    /// The factor that applies; none for 1.
    pub factor: Option<Function>,
}

impl Gravity {
    /// Full gravity at all times.
    pub fn constant(acceleration: Vector3) -> Self {
        Self { acceleration, factor: None }
    }

    /// Gravity at `time` [m/s²].
    pub fn at(&self, time: f64) -> Vector3 {
        self.factor.as_ref().map_or(self.acceleration, |factor| factor.value(time) * self.acceleration)
    }

    fn is_zero(&self) -> bool {
        self.acceleration == Vector3::zeros()
    }
}

/// Mass matrix of one node.
#[derive(Clone, Debug)]
pub struct Inertia {
    node: [NodeId; 1],
    mass: Matrix6,
    pub(super) gravity: Gravity,
}

impl Inertia {
    /// Inertia `mass` (6x6, body axes, about the node) of `node` under `gravity`.
    pub fn new(node: NodeId, mass: Matrix6, gravity: Gravity) -> Self {
        Self { node: [node], mass, gravity }
    }

    /// Mass matrix of a rigid body about its reference point: mass [kg], centre of mass [m] and
    /// inertia tensor about the centre of mass [kg m²], all in body axes.
    pub fn of_rigid_body(mass: f64, center: &Vector3, inertia: &lissom_motion::Matrix3) -> Matrix6 {
        let c = skew(center);
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(mass);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-mass * c));
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&(mass * c));
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&(inertia - mass * c * c));
        matrix
    }

    /// The 6x6 mass matrix.
    pub fn mass(&self) -> &Matrix6 {
        &self.mass
    }

    /// The node.
    pub fn node(&self) -> NodeId {
        self.node[0]
    }

    /// Mass, and first moment m c from the coupling block m c̃.
    fn moments(&self) -> (f64, Vector3) {
        (self.mass[(0, 0)], Vector3::new(self.mass[(5, 1)], self.mass[(3, 2)], self.mass[(4, 0)]))
    }

    /// Gravity in body axes, as a twist rate γ.
    fn gravity_in_body(&self, at: &Kinematics) -> Vector6 {
        let g = at.nodes[self.node[0]].frame.rotation.apply_inverse(&self.gravity.at(at.time));
        Vector6::new(g.x, g.y, g.z, 0.0, 0.0, 0.0)
    }
}

impl Element for Inertia {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.node)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let node = &at.nodes[self.node[0]];
        let force = self.mass * (node.acceleration - self.gravity_in_body(at))
            - coadjoint_times(&node.twist, &(self.mass * node.twist));
        for (sum, value) in out.iter_mut().zip(force.iter()) {
            *sum += value;
        }
    }

    fn blocks(elements: &[Self]) -> Option<Box<dyn Blocks>> {
        Some(Box::new(InertiaBlocks::new(elements)))
    }

    fn derivative(neighbours: &[(&Self, f64)]) -> Option<Self> {
        let (first, _) = neighbours.first()?;
        let is_alike = |other: &Self| first.node == other.node && is_same(&first.gravity, &other.gravity);
        neighbours.iter().all(|(other, _)| is_alike(other)).then(|| Self {
            mass: neighbours.iter().map(|(other, weight)| other.mass * *weight).sum(),
            ..(*first).clone()
        })
    }

    /// Gravity is corrected along the momenta P_j, so that its work is exactly the change of potential energy:
    /// by ρ P_j with ρ Σ D_j V_j·P_j = -ΔW - Σ D_j V_j·M γ_j.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        for (at, out) in step.stages.iter().zip(out.iter_mut()) {
            self.forces(at, out);
        }
        if self.gravity.is_zero() {
            return;
        }
        let node = self.node[0];
        let twists = step.stages.map(|at| at.nodes[node].twist);
        let momenta = twists.map(|twist| self.mass * twist);
        let powers = [0, 1].map(|j| momenta[j].dot(&self.gravity_in_body(step.stages[j])));
        let change = &step.changes[node];
        let g = split(&self.gravity_in_body(step.start)).0;
        let (mass, moment) = self.moments();
        let missed = g.dot(&(mass * change.shift + change.turn * moment)) - step.whole(powers);
        let (inverse, _) = step.shares([0, 1].map(|j| twists[j].dot(&momenta[j])));
        for (momentum, out) in momenta.iter().zip(out) {
            for k in 0..6 {
                out[k] -= missed * inverse * momentum[k];
            }
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let twist = &at.nodes[self.node[0]].twist;
        add_block(&mut out.mass, 6, (0, 0), &self.mass);
        // ∂(ad_Vᵀ M V) = ad_Vᵀ M δV + X(M V) δV
        let mut gyroscopic = -coadjoint_matrix(&(self.mass * twist));
        for column in 0..6 {
            let momentum: Vector6 = self.mass.column(column).into_owned();
            let mut view = gyroscopic.column_mut(column);
            view -= coadjoint_times(twist, &momentum);
        }
        add_block(&mut out.damping, 6, (0, 0), &gyroscopic);
        if !self.gravity.is_zero() {
            // δ(Rᵀ g) = (Rᵀ g)~ δθ
            let g = skew(&split(&self.gravity_in_body(at)).0);
            let columns = -(self.mass.fixed_view::<6, 3>(0, 0) * g);
            add_block(&mut out.stiffness, 6, (0, 3), &columns);
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let node = &at.nodes[self.node[0]];
        let (mass, moment) = self.moments();
        let weight_moment = mass * node.frame.position + node.frame.rotation.apply(&moment);
        Energy {
            kinetic: 0.5 * node.twist.dot(&(self.mass * node.twist)),
            strain: 0.0,
            potential: -self.gravity.acceleration.dot(&weight_moment),
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { is_body_inertia: true, ..Capabilities::default() }
    }
}
