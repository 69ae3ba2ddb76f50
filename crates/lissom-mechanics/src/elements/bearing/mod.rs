//! Bearings of a shaft that rotates about the first axis: forces by displacements and tilts of the shaft in the axes of the base, by their
//! rates and by the speed of rotation.
//!
//! Legend: as in `joints::frame_pair`; a axis of the shaft, e_k axes of the base,
//! ω, v angular velocity and velocity of the tip's frame relative to the base's, in the tip's axes; s speed of rotation, w wrench on the
//! tip's frame.
//!
//! ```text
//! a = R e₁,      q = [x; -e₃·a; e₂·a],      q̇ = P (v, ω) = [R v; c_k·R (ω × e₁)],      c₂ = -e₃,  c₃ = e₂,      s = e₁·R ω
//! f = F(q, q̇, s),      w = Pᵀ f
//! ```
//!
//! The law F may be unsymmetric, so that no energy belongs to it: its work is that of a load.

pub(super) mod film;
pub(super) mod matrices;

use std::fmt::Debug;
use std::sync::Arc;

use lissom_motion::{Matrix3, Matrix6, Motion, Rotation, Vector3, Vector6, lie_bracket_matrix, skew};
use nalgebra::{Matrix5, SMatrix, Vector5};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::Attached;
use super::{Capabilities, Element, Load, Tangents, Unknowns};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::{CarriedFrame, Kinematics};
use crate::number::Written;
use crate::registry::ParameterError;

/// Motion of the shaft in the bearing.
struct ShaftMotion {
    /// Displacements along the three axes [m], and rotations about the second and the third one.
    q: Vector5<f64>,
    /// Rate of q.
    rate: Vector5<f64>,
    /// Speed of rotation [rad/s].
    speed: f64,
}

/// Force on the shaft's resistance, and its derivatives.
struct Response {
    force: Vector5<f64>,
    by_q: Matrix5<f64>,
    by_rate: Matrix5<f64>,
    by_speed: Vector5<f64>,
}

/// The law of a bearing.
trait BearingLaw: Debug + Send + Sync {
    /// Force that the shaft exerts on the base, with derivatives.
    fn response(&self, motion: &ShaftMotion) -> Response;
}

/// A bearing between two nodes.
#[derive(Clone, Debug)]
struct Bearing {
    frames: FramePair,
    law: Arc<dyn BearingLaw>,
}

/// A bearing with this law. Without an `eccentricity`, the limit of the distance between the shaft and the point of the base across the
/// shaft [m], displacements are measured from the start.
fn contribution(
    model: &InitialModel,
    attached: Attached,
    axes: Rotation,
    (law, eccentricity): (Arc<dyn BearingLaw>, Option<f64>),
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let points = [0, 1].map(|side| model.frame(nodes[side]).transform_point(&points[side]));
    let across = axes.apply_inverse(&(points[1] - points[0])).yz().norm();
    if let Some(limit) = eccentricity
        && across >= limit
    {
        let problem = format!(
            "is {} m from the axis of the journal, and the clearance is {} m: specify the centre of the bearing",
            Written(across),
            Written(limit)
        );
        return Err(ParameterError::new("at_base", problem));
    }
    let positions = [if eccentricity.is_some() { points[0] } else { points[1] }, points[1]];
    let frames = [0, 1].map(|side| CarriedFrame {
        node: nodes[side],
        offset: Motion::new(axes, positions[side]).relative_to(&model.frame(nodes[side])),
    });
    Ok(Contribution::of(model, Bearing { frames: FramePair::new(frames), law }))
}

/// Derivatives by translation and rotation of the tip's frame.
type Rows = SMatrix<f64, 5, 6>;

/// Motion of the shaft, and the matrices that its forces are transformed with.
struct State {
    motion: RelativeMotion,
    shaft: ShaftMotion,
    /// P.
    map: Rows,
    /// Derivative of the speed with respect to (v, ω).
    speed_row: Vector6,
}

impl Bearing {
    fn state(&self, at: &Kinematics) -> State {
        let motion = self.frames.motion(at);
        let rotation = motion.rotation;
        let mut map = Rows::zeros();
        map.fixed_view_mut::<3, 3>(0, 0).copy_from(&rotation);
        // R (ω × e₁) = -R e₁~ ω
        let tilt = -rotation * skew(&Vector3::x());
        map.fixed_view_mut::<1, 3>(3, 3).copy_from(&-tilt.row(2));
        map.fixed_view_mut::<1, 3>(4, 3).copy_from(&tilt.row(1));
        let mut speed_row = Vector6::zeros();
        speed_row.fixed_rows_mut::<3>(3).copy_from(&rotation.row(0).transpose());
        let axis = rotation.column(0);
        let x = motion.position;
        let shaft = ShaftMotion {
            q: Vector5::new(x.x, x.y, x.z, -axis.z, axis.y),
            rate: map * motion.twist,
            speed: speed_row.dot(&motion.twist),
        };
        State { motion, shaft, map, speed_row }
    }
}

impl State {
    /// Derivatives of q̇ and s with respect to η at constant twists of the nodes.
    fn rates_by_place(&self) -> (Rows, Vector6) {
        let RelativeMotion { rotation, twist, carried, .. } = &self.motion;
        let bracket = lie_bracket_matrix(carried);
        let mut rates = -self.map * bracket;
        let mut speed = -bracket.tr_mul(&self.speed_row);
        // δ(R v) = -R v~ η_θ
        let turned = |vector: &Vector3| -rotation * skew(vector);
        let (linear, angular) =
            (twist.fixed_rows::<3>(0).into_owned(), twist.fixed_rows::<3>(3).into_owned());
        let translation = turned(&linear);
        let tilt = turned(&angular.cross(&Vector3::x()));
        for k in 0..3 {
            for row in 0..3 {
                rates[(row, 3 + k)] += translation[(row, k)];
            }
            rates[(3, 3 + k)] -= tilt[(2, k)];
            rates[(4, 3 + k)] += tilt[(1, k)];
        }
        let spin = turned(&angular);
        for k in 0..3 {
            speed[3 + k] += spin[(0, k)];
        }
        (rates, speed)
    }

    /// Derivative of Pᵀ f with respect to η at constant f.
    fn map_by_place(&self, force: &Vector5<f64>) -> Matrix6 {
        let mut by = Matrix6::zeros();
        let to_tip = |vector: Vector3| self.motion.rotation.tr_mul(&vector);
        // δ(Rᵀ F) = (Rᵀ F)~ η_θ
        by.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(&to_tip(force.fixed_rows::<3>(0).into_owned())));
        let moment: Matrix3 = skew(&Vector3::x()) * skew(&to_tip(Vector3::new(0.0, force[4], -force[3])));
        by.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
        by
    }
}

impl Element for Bearing {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.frames.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let state = self.state(at);
        let response = self.law.response(&state.shaft);
        self.frames.add_wrench(&state.motion, &state.map.tr_mul(&response.force), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let state = self.state(at);
        let Response { force, by_q, by_rate, by_speed } = self.law.response(&state.shaft);
        let (rates, speed) = state.rates_by_place();
        let force_by_place: Rows = by_q * state.map + by_rate * rates + by_speed * speed.transpose();
        let force_by_rate: Rows = by_rate * state.map + by_speed * state.speed_row.transpose();
        let by_place = state.map.tr_mul(&force_by_place) + state.map_by_place(&force);
        let by_rate = state.map.tr_mul(&force_by_rate);
        let (wrench, size) = (state.map.tr_mul(&force), out.size());
        self.frames.add_stiffness(&state.motion, (&wrench, &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(&state.motion, &by_rate, (size, &mut out.damping));
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), frames: Some(self.frames.frames), ..Capabilities::default() }
    }
}

impl Load for Bearing {
    fn depends_on_motion(&self) -> bool {
        true
    }
}
