//! Force of an actuator between two points of two nodes, along the line that joins them.
//!
//! ```text
//! Δ = x_B - x_A,   u = Δ/|Δ|,   force p u on the tip and -p u on the base
//! δ(p u) = p (1 - u uᵀ)/|Δ| δΔ
//! ```

use std::sync::Arc;

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::over_measure::Measure;
use super::polyline::Polyline;
use super::{Capabilities, Element, Load, Tangents, Unknowns};
use crate::kinematics::Kinematics;
use crate::ports::Ports;
use crate::registry::{Constant, Function, ParameterError, ParameterType, Parameters, required};

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
    line: Polyline<2>,
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
    let line = Polyline::between(nodes, points, Arc::new(Constant(0.0)));
    Ok(Contribution::of(model, ForceBetween { line, size: parameters.function("force")? }))
}

impl Element for ForceBetween {
    fn unknowns(&self) -> Unknowns<'_> {
        self.line.unknowns()
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        self.line.add_force(&self.line.read(at), -self.size.value(at.time), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.line.add_bend(&self.line.read(at), -self.size.value(at.time), out);
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
