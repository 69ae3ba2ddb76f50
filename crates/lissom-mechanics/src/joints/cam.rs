//! Cam: a coordinate of one joint is a function of that of another, c = q₂ - f(q₁).

use std::sync::Arc;

use super::coupling::{Relation, RelationPoint};
use super::kind::{Build, JointKind};
use crate::law::{Interval, scaled, sum};
use crate::ports::Ports;
use crate::registry::{
    Function, OTHER_COORDINATE, ParameterError, ParameterType, WHICH_COORDINATE, required,
};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "cam",
    summary: "A coordinate of `other` is a function of a coordinate of `joint`, such as the profile of a cam.",
    sample: "profile = \"0.02*(1 - cos(x))\"",
    parameters: &[
        required(
            "profile",
            ParameterType::FunctionOf("x"),
            "m or rad",
            "The other coordinate as a function of the first, `x`.",
        ),
        WHICH_COORDINATE,
        OTHER_COORDINATE,
    ],
    ports: Ports::TWO_COORDINATES,
    build: Build::Coupling(|parameters, _| {
        let profile = parameters.function("profile")?;
        if let Some(kink) = profile.first_kink() {
            let at = if kink.is_nan() { String::new() } else { format!(" at x = {kink:.6}") };
            let problem = format!(
                "has a kink{at}: the speed of the follower would jump there; specify a table `interpolation = \
                 \"spline\"`, or another function"
            );
            return Err(ParameterError::new("profile", problem));
        }
        Ok(Arc::new(Cam { profile }))
    }),
};

/// A follower on a profile.
#[derive(Clone, Debug)]
struct Cam {
    profile: Function,
}

impl Relation for Cam {
    fn depends_on_time(&self) -> bool {
        false
    }

    fn jet(&self, (_, q): RelationPoint<'_>, (_, v): RelationPoint<'_>) -> [f64; 3] {
        let slope = self.profile.first_derivative(q[0]);
        [
            q[1] - self.profile.value(q[0]),
            v[1] - slope * v[0],
            -self.profile.second_derivative(q[0]) * v[0] * v[0],
        ]
    }

    fn domain(&self) -> Option<Interval> {
        self.profile.domain()
    }

    fn bounds(&self, _: Interval, coordinates: &[Interval]) -> Option<Interval> {
        let [from, to] = coordinates[0];
        let profile = self.profile.bounds(from, to)?;
        Some(sum(coordinates[1], scaled(-1.0, profile)))
    }
}
