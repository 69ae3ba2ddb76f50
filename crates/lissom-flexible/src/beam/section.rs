//! A section of a beam element as a frame: its pose and twist, the forces on the nodes from a wrench on it, and derivatives of both.
//!
//! Legend: r reference node, d_i = log(H_r⁻¹ H_i), N_i shape functions at the section, A_i = Ad(exp(-d_i)), V_i twists and ξ_i variations
//! of the nodes in their own axes, w a wrench on the section, ad and X(w) the matrices of lie bracket and coadjoint.
//!
//! ```text
//! d = Σ N_i d_i,   H = H_r exp d,   A = Ad(exp(-d)),   η_i = ξ_i - A_i ξ_r,   δd = Σ N_i T(d_i)⁻¹ η_i
//! V = A V_r + T(d) ḋ,   ḋ = Σ N_i T(d_i)⁻¹ (V_i - A_i V_r),   V = Σ B_i V_i
//! F_i = B_iᵀ w = N_i T(d_i)⁻ᵀ p,   p = T(d)ᵀ w,   F_r = Aᵀ w - Σ A_iᵀ F_i
//! δ(A V_r) = ad(A V_r) T δd,      δ(Aᵀ w) = -Aᵀ X(w) T δd
//! ```

use lissom_motion::{
    Matrix6, Motion, Vector6, coadjoint_matrix, inverse_tangent, inverse_tangent_derivative,
    inverse_tangent_times, inverse_tangent_transpose_derivative, inverse_tangent_transpose_times,
    lie_bracket_matrix, tangent, tangent_derivative, tangent_times, tangent_transpose_derivative,
    tangent_transpose_times,
};

use super::line::BeamLine;
use lissom_mechanics::elements::shape::lagrange;
use lissom_mechanics::kinematics::{CarriedFrame, Kinematics, MAX_NODES, NodeMotion};

/// A section of a beam element, carried by its nodes.
#[derive(Clone, Debug)]
pub struct Section {
    /// Section frames at the nodes, N_i.
    nodes: Vec<(CarriedFrame, f64)>,
    reference: usize,
}

/// Pose and twist of a section, with its dependence on the nodes.
pub struct SectionMotion {
    /// Pose in the inertial frame, and twist V in its own axes.
    pub motion: NodeMotion,
    count: usize,
    reference: usize,
    weights: [f64; MAX_NODES],
    d: Vector6,
    relative: [Vector6; MAX_NODES],
    /// A, and A_i.
    carried: Matrix6,
    adjoints: [Matrix6; MAX_NODES],
    /// From variations of the nodes to those of the section frames at them.
    to_section: [Matrix6; MAX_NODES],
    /// V_r.
    reference_twist: Vector6,
    /// V_i - A_i V_r.
    relative_twists: [Vector6; MAX_NODES],
    /// ḋ.
    rate: Vector6,
}

impl Section {
    /// At s ∈ [0, 1] along a line of beam elements: at a node its section frame alone.
    pub fn of_line(line: &BeamLine, s: f64) -> Self {
        let carried = |k: usize| CarriedFrame { node: line.nodes[k], offset: line.offsets[k] };
        if let Some(k) = line.places.iter().position(|place| (place - s).abs() < 1e-9) {
            return Self { nodes: vec![(carried(k), 1.0)], reference: 0 };
        }
        let count = line.elements.len();
        let element = ((s * count as f64).floor().max(0.0) as usize).min(count - 1);
        let xi = 2.0 * (s * count as f64 - element as f64) - 1.0;
        let weights: &[f64] = match line.order {
            1 => &lagrange::<2>(xi).0,
            2 => &lagrange::<3>(xi).0,
            _ => &lagrange::<4>(xi).0,
        };
        let first = element * line.order;
        Self {
            nodes: weights.iter().enumerate().map(|(i, &weight)| (carried(first + i), weight)).collect(),
            reference: line.order / 2,
        }
    }

    /// Section frames at the nodes.
    pub fn frames(&self) -> impl Iterator<Item = CarriedFrame> {
        self.nodes.iter().map(|(frame, _)| *frame)
    }

    /// Pose and twist.
    pub fn motion(&self, at: &Kinematics) -> SectionMotion {
        let count = self.nodes.len();
        let zeros = [Vector6::zeros(); MAX_NODES];
        let mut own = SectionMotion {
            motion: NodeMotion::at_rest(Motion::identity()),
            count,
            reference: self.reference,
            weights: [0.0; MAX_NODES],
            d: Vector6::zeros(),
            relative: zeros,
            carried: Matrix6::identity(),
            adjoints: [Matrix6::identity(); MAX_NODES],
            to_section: [Matrix6::identity(); MAX_NODES],
            reference_twist: Vector6::zeros(),
            relative_twists: zeros,
            rate: Vector6::zeros(),
        };
        let twist_of = |frame: &CarriedFrame| frame.offset.adjoint_inverse_times(&at.nodes[frame.node].twist);
        let reference = &self.nodes[self.reference].0;
        let base = reference.frame(at);
        own.reference_twist = twist_of(reference);
        for (i, (frame, weight)) in self.nodes.iter().enumerate() {
            if frame.offset != Motion::identity() {
                own.to_section[i] = frame.offset.inverse().adjoint();
            }
            if i == self.reference {
                continue;
            }
            let relative = frame.frame(at).relative_to(&base);
            own.weights[i] = *weight;
            own.relative[i] = relative.logarithm();
            own.adjoints[i] = relative.inverse().adjoint();
            own.relative_twists[i] = twist_of(frame) - own.adjoints[i] * own.reference_twist;
            own.d += *weight * own.relative[i];
            own.rate += *weight * inverse_tangent_times(&own.relative[i], &own.relative_twists[i]);
        }
        let moved = Motion::exponential(&own.d);
        own.carried = moved.inverse().adjoint();
        own.motion = NodeMotion::at_rest(base * moved);
        own.motion.twist = own.carried * own.reference_twist + tangent_times(&own.d, &own.rate);
        own
    }
}

impl SectionMotion {
    fn others(&self) -> impl Iterator<Item = usize> + use<> {
        let reference = self.reference;
        (0..self.count).filter(move |&i| i != reference)
    }

    /// From derivatives with respect to η_i to those with respect to variations of the nodes.
    fn spread(&self, by_relative: &[Matrix6; MAX_NODES], by_reference: &Matrix6) -> [Matrix6; MAX_NODES] {
        let mut all = *by_relative;
        all[self.reference] = *by_reference;
        for i in self.others() {
            all[self.reference] -= by_relative[i] * self.adjoints[i];
        }
        std::array::from_fn(|i| all[i] * self.to_section[i])
    }

    /// B_i: from variations of the nodes to that of the section.
    pub fn columns(&self) -> [Matrix6; MAX_NODES] {
        let turned = tangent(&self.d);
        let mut own = [Matrix6::zeros(); MAX_NODES];
        for i in self.others() {
            own[i] = self.weights[i] * turned * inverse_tangent(&self.relative[i]);
        }
        self.spread(&own, &self.carried)
    }

    /// Derivatives of the section's twist with respect to variations of the nodes, at constant twists of these.
    pub fn twist_by(&self) -> [Matrix6; MAX_NODES] {
        let turned = tangent(&self.d);
        let carried = self.carried * self.reference_twist;
        let by_d = lie_bracket_matrix(&carried) * turned + tangent_derivative(&self.d, &self.rate);
        let mut own = [Matrix6::zeros(); MAX_NODES];
        for i in self.others() {
            let (d, inverse) = (&self.relative[i], inverse_tangent(&self.relative[i]));
            let seen = self.adjoints[i] * self.reference_twist;
            // ∂ḋ_i/∂η_i.
            let rate_by = inverse_tangent_derivative(d, &self.relative_twists[i]) * inverse
                - inverse * lie_bracket_matrix(&seen);
            own[i] = self.weights[i] * (by_d * inverse + turned * rate_by);
        }
        self.spread(&own, &Matrix6::zeros())
    }

    /// Derivatives of the forces on the nodes from a constant wrench on the section: by node of the force, then of the variation.
    pub fn forces_by(&self, wrench: &Vector6) -> [[Matrix6; MAX_NODES]; MAX_NODES] {
        let conjugate = tangent_transpose_times(&self.d, wrench);
        let turn = tangent_transpose_derivative(&self.d, wrench);
        let mut inverse = [Matrix6::zeros(); MAX_NODES];
        for i in self.others() {
            inverse[i] = self.weights[i] * inverse_tangent(&self.relative[i]);
        }
        // δ(Aᵀ w) by η_k, and below less Σ δ(A_iᵀ F_i).
        let of_reference = -self.carried.transpose() * coadjoint_matrix(wrench) * tangent(&self.d);
        let mut blocks = [[Matrix6::zeros(); MAX_NODES]; MAX_NODES];
        for k in self.others() {
            blocks[self.reference][k] = of_reference * inverse[k];
        }
        for i in self.others() {
            let force = self.weights[i] * inverse_tangent_transpose_times(&self.relative[i], &conjugate);
            for k in self.others() {
                let mut block = inverse[i].transpose() * turn * inverse[k];
                let mut at_reference = Matrix6::zeros();
                if i == k {
                    block += inverse_tangent_transpose_derivative(&self.relative[i], &conjugate) * inverse[i];
                    at_reference = coadjoint_matrix(&force);
                }
                blocks[self.reference][k] -= self.adjoints[i].transpose() * (block - at_reference);
                blocks[i][k] = block;
            }
        }
        std::array::from_fn(|i| {
            let carry = self.to_section[i].transpose();
            self.spread(&blocks[i], &Matrix6::zeros()).map(|block| carry * block)
        })
    }
}
