//! Bushing: springs and dampers along and about three axes between a frame on the base and one on the tip, coupled by full
//! matrices.
//!
//! Legend: (R, p) tip's frame in the base's, p₀ at the start, θ = log R, T tangent operator, V twists in the frames' own
//! axes, A = Ad((R, p)⁻¹), η variation of the tip's frame relative to the base's, w wrench on the tip's frame.
//!
//! ```text
//! q = [p - p₀; θ],      η̇ = V_tip - A V_base,      q̇ = Q η̇,      Q = [R, 0; 0, T(θ)⁻¹]
//! f = K q + C q̇,        w = Qᵀ f,      on the base -Aᵀ w,      energy ½ q·K q
//! ```
//!
//! p has components along the axes of the base's frame. The forces depend only on the relative motion, and for
//! symmetric K they are the gradient of the energy, for rotations below π.

use lissom_motion::{
    Matrix3, Matrix6, Motion, Rotation, Vector3, Vector6, inverse_tangent_derivative,
    inverse_tangent_transpose_derivative, lie_bracket_matrix, rotation_inverse_tangent, rotation_part, screw,
    skew, translation_part,
};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Element, Energy, Tangents, Unknowns, add_block};
use crate::kinematics::{Kinematics, NodeId};
use crate::ports::Ports;
use crate::registry::{ModelAxis, Parameter, ParameterError, ParameterType, Parameters};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "bushing",
    summary: "Springs and dampers along and about three axes, with full matrices, also between coincident points.",
    sample: "stiffness = [1e6, 1e6, 1e5, 100.0, 100.0, 10.0]",
    parameters: &[
        Parameter::optional(
            "stiffness",
            ParameterType::Matrix,
            "N/m, N, N m/rad",
            "6 x 6 or its diagonal: displacements along the axes, rotations about them; default 0.",
        ),
        Parameter::optional(
            "damping",
            ParameterType::Matrix,
            "N s/m, N s, N m s/rad",
            "6 x 6 or its diagonal, as `stiffness`; default 0.",
        ),
        Parameter::optional(
            "axis",
            ParameterType::DirectionOr(ModelAxis::X),
            "",
            "First axis at the start, global axes; default global x. The axes rotate with the base.",
        ),
        Parameter::optional(
            "second_axis",
            ParameterType::DirectionOr(ModelAxis::Y),
            "",
            "Second axis at the start, global axes, made perpendicular to the first; default global y.",
        ),
    ],
    ports: Ports::TWO_LOCATIONS,
    build,
};

/// Bushing between two nodes.
#[derive(Clone, Debug)]
pub struct Bushing {
    nodes: [NodeId; 2],
    /// Frames in the nodes' axes.
    offsets: [Motion; 2],
    stiffness: Matrix6,
    damping: Matrix6,
    /// p₀ [m].
    rest: Vector3,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let first = parameters.vector_or("axis", ModelAxis::X.direction())?;
    let second = parameters.vector_or("second_axis", ModelAxis::Y.direction())?;
    let axes = Rotation::from_axis_and_reference(&first, &second).ok_or_else(|| {
        ParameterError::new("axis", "is parallel to `second_axis`: specify both `axis` and `second_axis`")
    })?;
    let frames = [0, 1].map(|side| model.frame(nodes[side]));
    let places = [0, 1].map(|side| Motion::new(axes, frames[side].transform_point(&points[side])));
    Ok(Contribution::of(
        model,
        Bushing {
            nodes,
            offsets: [0, 1].map(|side| places[side].relative_to(&frames[side])),
            stiffness: parameters.matrix_or_zero("stiffness")?,
            damping: parameters.matrix_or_zero("damping")?,
            rest: places[1].relative_to(&places[0]).position,
        },
    ))
}

/// The relative motion and derived quantities.
struct Deformation {
    /// Ad((R, p)⁻¹).
    to_tip: Matrix6,
    rotation: Matrix3,
    inverse_tangent: Matrix3,
    /// log R.
    angles: Vector3,
    /// q.
    value: Vector6,
    /// η̇ and A V_base.
    twist: Vector6,
    carried: Vector6,
}

impl Deformation {
    /// Q.
    fn map(&self) -> Matrix6 {
        let mut map = Matrix6::zeros();
        map.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.rotation);
        map.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inverse_tangent);
        map
    }
}

impl Bushing {
    fn deformation(&self, at: &Kinematics) -> Deformation {
        let [base, tip] = [0, 1].map(|side| at.nodes[self.nodes[side]].frame * self.offsets[side]);
        let twists =
            [0, 1].map(|side| self.offsets[side].adjoint_inverse_times(&at.nodes[self.nodes[side]].twist));
        let relative = tip.relative_to(&base);
        let angles = relative.rotation.logarithm();
        let to_tip = relative.inverse().adjoint();
        let carried = to_tip * twists[0];
        Deformation {
            to_tip,
            rotation: relative.rotation.matrix(),
            inverse_tangent: rotation_inverse_tangent(&angles),
            angles,
            value: screw(&(relative.position - self.rest), &angles),
            twist: twists[1] - carried,
            carried,
        }
    }

    /// f = K q + C q̇.
    fn resultant(&self, of: &Deformation) -> Vector6 {
        self.stiffness * of.value + self.damping * (of.map() * of.twist)
    }

    /// Inverse Ad of the frames' offsets: from variations of the nodes to those of the frames.
    fn carry(&self) -> [Matrix6; 2] {
        [0, 1].map(|side| self.offsets[side].inverse().adjoint())
    }
}

impl Element for Bushing {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let of = self.deformation(at);
        let wrench = of.map().tr_mul(&self.resultant(&of));
        let carry = self.carry();
        let on = [carry[0].tr_mul(&-of.to_tip.tr_mul(&wrench)), carry[1].tr_mul(&wrench)];
        for (side, wrench) in on.iter().enumerate() {
            for k in 0..6 {
                out[6 * side + k] += wrench[k];
            }
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let of = self.deformation(at);
        let (map, resultant) = (of.map(), self.resultant(&of));
        let wrench = map.tr_mul(&resultant);
        let about = |angular: &Vector3| screw(&Vector3::zeros(), angular);
        let rotations = |matrix: Matrix6| -> Matrix3 { matrix.fixed_view::<3, 3>(3, 3).into_owned() };
        let (linear, angular) = (translation_part(&of.twist), rotation_part(&of.twist));

        // ∂q̇/∂η: δ(R v) = -R ṽ η_θ, δ(T⁻¹ w) by θ times T⁻¹ η_θ, and δη̇ = -ad(A V_base) η.
        let mut rate_by_place = -map * lie_bracket_matrix(&of.carried);
        let by_angles = rotations(inverse_tangent_derivative(&about(&of.angles), &about(&angular)));
        for (row, block) in [(0, -of.rotation * skew(&linear)), (3, by_angles * of.inverse_tangent)] {
            let mut view = rate_by_place.fixed_view_mut::<3, 3>(row, 3);
            view += block;
        }
        // ∂w/∂η: δ(Rᵀ F) = (RᵀF)~ η_θ, δ(T⁻ᵀ M) by θ times T⁻¹ η_θ.
        let mut by_place = map.transpose() * (self.stiffness * map + self.damping * rate_by_place);
        let moment = rotation_part(&resultant);
        let turned = rotations(inverse_tangent_transpose_derivative(&about(&of.angles), &about(&moment)));
        let blocks = [(0, skew(&translation_part(&wrench))), (3, turned * of.inverse_tangent)];
        for (row, block) in blocks {
            let mut view = by_place.fixed_view_mut::<3, 3>(row, 3);
            view += block;
        }
        let by_rate = map.transpose() * self.damping * map;

        // ad(η)ᵀ w as a matrix on η.
        let mut coadjoint = Matrix6::zeros();
        let (force, moment) = (skew(&translation_part(&wrench)), skew(&rotation_part(&wrench)));
        coadjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&force);
        coadjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
        let back = of.to_tip.transpose();
        let carry = self.carry();
        // Rows: on the base -Aᵀ w, on the tip w; columns: η = ξ_tip - A ξ_base.
        let columns = [-of.to_tip * carry[0], carry[1]];
        let place_rows =
            [carry[0].transpose() * back * (coadjoint - by_place), carry[1].transpose() * by_place];
        let rate_rows = [-carry[0].transpose() * back * by_rate, carry[1].transpose() * by_rate];
        for i in 0..2 {
            for j in 0..2 {
                add_block(&mut out.stiffness, 12, (6 * i, 6 * j), &(place_rows[i] * columns[j]));
                add_block(&mut out.damping, 12, (6 * i, 6 * j), &(rate_rows[i] * columns[j]));
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let q = self.deformation(at).value;
        Energy { strain: 0.5 * q.dot(&(self.stiffness * q)), ..Energy::default() }
    }
}
