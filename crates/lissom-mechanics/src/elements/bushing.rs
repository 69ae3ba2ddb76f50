//! Bushing: springs and dampers along and about three axes between a frame on the base and one on the tip, coupled by full
//! matrices.
//!
//! Legend: as in `joints::frame_pair`; x₀ position at the start, T⁻¹ inverse tangent operator of the logarithm, q deformation, w wrench
//! on the tip's frame.
//!
//! ```text
//! q = [x - x₀; log R],      q̇ = Q η̇,      Q = [R, 0; 0, T⁻¹]         in the axes of the base
//! q = log (R, x),           q̇ = Q η̇,      Q = T⁻¹                    as a screw, with both frames in the middle at the start
//! f = K q + C q̇,            w = Qᵀ f,     energy ½ q·K q
//! ```
//!
//! The forces depend only on the relative motion, and for symmetric K they are the gradient of the energy, for rotations below π. The
//! components of the screw are the same in the axes of base and tip, which may therefore be exchanged.

use lissom_motion::{
    Matrix6, Motion, Rotation, Vector3, Vector6, inverse_tangent, inverse_tangent_derivative,
    inverse_tangent_transpose_derivative, lie_bracket_matrix, rotation_part, screw, skew, translation_part,
};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Energy, Tangents, Unknowns};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CarriedFrame, Kinematics};
use crate::ports::Ports;
use crate::registry::{ModelAxis, Parameter, ParameterError, ParameterType, Parameters, optional, unitless};

/// Names of the forms.
const FORMS: [&str; 2] = ["base_axes", "screw"];

/// The first axis of a spring or bearing with axes of its own.
pub(super) const AXIS: Parameter = unitless(
    "axis",
    ParameterType::DirectionOr(ModelAxis::X),
    "First axis at the start, global axes; default global x. The axes rotate with the base.",
);
/// The second one.
pub(super) const SECOND_AXIS: Parameter = unitless(
    "second_axis",
    ParameterType::DirectionOr(ModelAxis::Y),
    "Second axis at the start, global axes, made perpendicular to the first; default global y.",
);

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "bushing",
    summary: "Springs and dampers along and about three axes, with full matrices, also between coincident points.",
    sample: "stiffness = [1e6, 1e6, 1e5, 100.0, 100.0, 10.0]",
    parameters: &[
        optional(
            "stiffness",
            ParameterType::Matrix,
            "N/m, N, N m/rad",
            "6 x 6 or its diagonal: displacements along the axes, rotations about them.",
        ).or_number(0.0),
        optional(
            "damping",
            ParameterType::Matrix,
            "N s/m, N s, N m s/rad",
            "6 x 6 or its diagonal, as `stiffness`.",
        ).or_number(0.0),
        AXIS,
        SECOND_AXIS,
        unitless(
            "form",
            ParameterType::Choice(&FORMS),
            "Displacement and rotation in the axes of the base (\"base_axes\"), or as a screw, which is the same from both sides.",
        )
        .or_word(FORMS[0]),
    ],
    ports: Ports::TWO_LOCATIONS,
    build,
};

/// Bushing between two nodes.
#[derive(Clone, Debug)]
pub struct Bushing {
    frames: FramePair,
    stiffness: Matrix6,
    damping: Matrix6,
    form: Form,
}

/// How the deformation is measured.
#[derive(Clone, Debug)]
enum Form {
    /// From this position on [m].
    BaseAxes(Vector3),
    Screw,
}

/// The axes that both of these define at the start.
pub(super) fn axes(parameters: &Parameters) -> Result<Rotation, ParameterError> {
    let first = parameters.vector_or("axis", ModelAxis::X.direction())?;
    let second = parameters.vector_or("second_axis", ModelAxis::Y.direction())?;
    Rotation::from_axis_and_reference(&first, &second).ok_or_else(|| {
        ParameterError::new("axis", "is parallel to `second_axis`: specify both `axis` and `second_axis`")
    })
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let axes = axes(parameters)?;
    let [a, b] = [0, 1].map(|side| model.frame(nodes[side]).transform_point(&points[side]));
    let is_screw = parameters.word("form")? == FORMS[1];
    let [stiffness, damping] =
        [parameters.matrix_or_zero("stiffness")?, parameters.matrix_or_zero("damping")?];
    // Forces along the axes of the base do not depend on the rotation of the tip.
    let turns = |matrix: &Matrix6| {
        matrix.fixed_rows::<3>(3).iter().chain(matrix.fixed_columns::<3>(3).iter()).any(|own| *own != 0.0)
    };
    let needs_rotation = is_screw || turns(&stiffness) || turns(&damping);
    for (side, key) in ["base", "tip"].into_iter().enumerate() {
        model.check_carried(key, (nodes[side], points[side]), needs_rotation)?;
    }
    let middle = 0.5 * (a + b);
    let positions = if is_screw { [middle; 2] } else { [a, b] };
    let frames = [0, 1].map(|side| CarriedFrame {
        node: nodes[side],
        offset: Motion::new(axes, positions[side]).relative_to(&model.frame(nodes[side])),
    });
    let form = if is_screw { Form::Screw } else { Form::BaseAxes(axes.apply_inverse(&(b - a))) };
    Ok(Contribution::of(model, Bushing { frames: FramePair::new(frames), stiffness, damping, form }))
}

/// The relative motion and derived quantities.
struct Deformation {
    motion: RelativeMotion,
    /// q.
    value: Vector6,
    /// Argument of T⁻¹.
    logarithm: Vector6,
    /// Q.
    map: Matrix6,
}

impl Bushing {
    fn deformation(&self, at: &Kinematics) -> Deformation {
        let motion = self.frames.motion(at);
        let relative = motion.relative;
        match self.form {
            Form::Screw => {
                let value = relative.logarithm();
                Deformation { motion, value, logarithm: value, map: inverse_tangent(&value) }
            }
            Form::BaseAxes(rest) => {
                let angles = relative.rotation.logarithm();
                let logarithm = screw(&Vector3::zeros(), &angles);
                let mut map = inverse_tangent(&logarithm);
                map.fixed_view_mut::<3, 3>(0, 0).copy_from(&motion.rotation);
                Deformation { value: screw(&(motion.position - rest), &angles), logarithm, map, motion }
            }
        }
    }

    /// f = K q + C q̇.
    fn resultant(&self, of: &Deformation) -> Vector6 {
        self.stiffness * of.value + self.damping * (of.map * of.motion.twist)
    }

    /// Derivatives of Q v and of Qᵀ f with respect to η.
    fn map_derivatives(&self, of: &Deformation, resultant: &Vector6) -> [Matrix6; 2] {
        let about = |angular: Vector3| screw(&Vector3::zeros(), &angular);
        let twist = &of.motion.twist;
        match self.form {
            Form::Screw => [
                inverse_tangent_derivative(&of.logarithm, twist) * of.map,
                inverse_tangent_transpose_derivative(&of.logarithm, resultant) * of.map,
            ],
            Form::BaseAxes(_) => {
                // δ(R v) = -R ṽ η_θ and δ(Rᵀ F) = (RᵀF)~ η_θ.
                let rotation = &of.motion.rotation;
                let linear = -rotation * skew(&translation_part(twist));
                let force = skew(&rotation.tr_mul(&translation_part(resultant)));
                let inverse = of.map.fixed_view::<3, 3>(3, 3);
                let turned = [
                    (linear, inverse_tangent_derivative(&of.logarithm, &about(rotation_part(twist)))),
                    (
                        force,
                        inverse_tangent_transpose_derivative(&of.logarithm, &about(rotation_part(resultant))),
                    ),
                ];
                turned.map(|(translation, rotation)| {
                    let mut by = Matrix6::zeros();
                    by.fixed_view_mut::<3, 3>(0, 3).copy_from(&translation);
                    by.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rotation.fixed_view::<3, 3>(3, 3) * inverse));
                    by
                })
            }
        }
    }
}

impl Element for Bushing {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.frames.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let of = self.deformation(at);
        self.frames.add_wrench(&of.motion, &of.map.tr_mul(&self.resultant(&of)), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let of = self.deformation(at);
        let (map, resultant) = (&of.map, self.resultant(&of));
        let [rate_by_map, wrench_by_map] = self.map_derivatives(&of, &resultant);
        // δη̇ = -ad(A V_base) η at constant twists of the nodes.
        let rate_by_place = rate_by_map - map * lie_bracket_matrix(&of.motion.carried);
        let by_place =
            map.transpose() * (self.stiffness * map + self.damping * rate_by_place) + wrench_by_map;
        let by_rate = map.transpose() * self.damping * map;
        let size = out.size();
        let wrench = map.tr_mul(&resultant);
        self.frames.add_stiffness(&of.motion, (&wrench, &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(&of.motion, &by_rate, (size, &mut out.damping));
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { frames: Some(self.frames.frames), ..Capabilities::default() }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let q = self.deformation(at).value;
        Energy { strain: 0.5 * q.dot(&(self.stiffness * q)), ..Energy::default() }
    }
}
