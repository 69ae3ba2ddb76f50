//! Gear: a coordinate of one joint changes in proportion to that of another, c = (q₂ - q₂(0)) - i (q₁ - q₁(0)).

use std::sync::Arc;

use super::coupling::{Relation, RelationPoint};
use super::kind::{Build, JointKind};
use crate::ports::Ports;
use crate::registry::ParameterType::{Between, NotNegative, Number, Positive};
use crate::registry::{OTHER_COORDINATE, ParameterType, WHICH_COORDINATE, optional, required, unitless};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "gear",
    summary: "A coordinate of `other` changes by `ratio` times the change of a coordinate of `joint`: gears, racks, belts.",
    sample: "ratio = -2.5",
    parameters: &[
        required(
            "ratio",
            Number,
            "1, m/rad or rad/m",
            "Change of the dependent coordinate per change of the independent one; negative for external gears.",
        ),
        WHICH_COORDINATE,
        OTHER_COORDINATE,
        optional(
            "efficiency",
            Between(0.01, 1.0),
            "1",
            "Share η of the power that arrives at `other` if `joint` drives; 2 - 1/η if `other` drives: below 0.5 it locks.",
        )
        .or_number(1.0),
        optional("deflection", Positive, "rad or m", "Elastic motion of `joint` before its friction slips.")
            .or_number(1e-4),
        optional("damping", NotNegative, "N m s/rad or N s/m", "Damping of this elastic motion.").or_number(0.0),
        unitless(
            "relative",
            ParameterType::Flag,
            "Whether it is meant to relate rotations relative to parts that turn against each other, which is warned about otherwise.",
        )
        .or_flag(false),
    ],
    ports: Ports::TWO_COORDINATES,
    build: Build::Coupling(|parameters, start| {
        let ratio = parameters.number("ratio")?;
        let [first, other] = [0, 1].map(|k| start.get(k).copied().unwrap_or(0.0));
        Ok(Arc::new(Gear { ratio, offset: other - ratio * first }))
    }),
};

/// Two coordinates in proportion.
#[derive(Clone, Copy, Debug)]
struct Gear {
    ratio: f64,
    /// q₂ - i q₁ at the start.
    offset: f64,
}

impl Relation for Gear {
    fn depends_on_time(&self) -> bool {
        false
    }

    fn jet(&self, (_, q): RelationPoint<'_>, (_, v): RelationPoint<'_>) -> [f64; 3] {
        [q[1] - self.ratio * q[0] - self.offset, v[1] - self.ratio * v[0], 0.0]
    }

    fn change(&self, _: RelationPoint<'_>, _: f64, change: &[f64]) -> f64 {
        change[1] - self.ratio * change[0]
    }
}
