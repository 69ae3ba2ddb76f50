//! Force of an actuator between two points of two nodes, along the line that joins them.
//!
//! ```text
//! Δ = x_B - x_A,   u = Δ/|Δ|,   force p u on the tip and -p u on the base
//! δ(p u) = p (1 - u uᵀ)/|Δ| δΔ
//! ```

use lissom_motion::{Matrix3, Vector3, skew};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::point_spring::{Point, add_pull};
use super::{Capabilities, Element, Load, Tangents, Unknowns, add_block};
use crate::kinematics::{Kinematics, NodeId};
use crate::ports::Ports;
use crate::registry::{Function, ParameterError, ParameterType, Parameters, required};

/// Registry entry.
pub(crate) const KIND: ElementKind = ElementKind {
    name: "force_between",
    summary: "Force of an actuator between two points, along the line through them: a cylinder, a muscle, a cable of given tension.",
    sample: "force = \"200*sin(t)\"",
    parameters: &[required(
        "force",
        ParameterType::Size,
        "N",
        "Force on the tip's point, positive where it pushes the points apart.",
    )],
    ports: Ports::TWO_LOCATIONS,
    build,
};

/// Force between two points.
#[derive(Clone, Debug)]
pub(crate) struct ForceBetween {
    nodes: [NodeId; 2],
    points: [Vector3; 2],
    size: Function,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (nodes, points) = attached.two_nodes()?;
    let [a, b] = [0, 1].map(|i| model.frame(nodes[i]).transform_point(&points[i]));
    if a == b {
        let problem = "is at the same position as `base`: the force has no direction";
        return Err(ParameterError::new("tip", problem));
    }
    Ok(Contribution::of(model, ForceBetween { nodes, points, size: parameters.function("force")? }))
}

impl ForceBetween {
    /// The points, their distance and the direction from base to tip.
    fn line(&self, at: &Kinematics) -> ([Point; 2], f64, Vector3) {
        let points = [0, 1].map(|i| Point::new(&at.nodes[self.nodes[i]], &self.points[i]));
        let span = points[1].position - points[0].position;
        // Any finite direction is better for Newton's method than NaN.
        let length = span.norm().max(f64::MIN_POSITIVE);
        (points, length, span / length)
    }
}

impl Element for ForceBetween {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let (points, _, direction) = self.line(at);
        add_pull(&points, &(-self.size.value(at.time) * direction), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (points, length, u) = self.line(at);
        let pull = -self.size.value(at.time);
        let by_span = pull * (Matrix3::identity() - u * u.transpose()) / length;
        let gradients = points.each_ref().map(Point::gradient);
        for (i, own) in [-1.0, 1.0].into_iter().enumerate() {
            for (j, other) in [-1.0, 1.0].into_iter().enumerate() {
                let mut stiffness = own * other * gradients[i].transpose() * by_span * gradients[j];
                if i == j {
                    // The force in the axes of the rotating node: δ(Rᵀ t) = (Rᵀ t)~ δθ.
                    let local = skew(&points[i].rotation.tr_mul(&(own * pull * u)));
                    let moment = skew(&points[i].offset) * local;
                    let mut turned = stiffness.fixed_view_mut::<3, 3>(0, 3);
                    turned += local;
                    let mut turned = stiffness.fixed_view_mut::<3, 3>(3, 3);
                    turned += moment;
                }
                add_block(&mut out.stiffness, 12, (6 * i, 6 * j), &stiffness);
            }
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for ForceBetween {
    fn breakpoints(&self) -> Vec<f64> {
        self.size.breakpoints()
    }
}
