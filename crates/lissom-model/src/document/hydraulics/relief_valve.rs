//! Pressure relief valves.

use super::kind::{FLOWS, HydraulicKind, PASCALS, port};
use crate::format::keys::{Shape, required};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "relief_valve",
    summary: "Relief valve: opens at a pressure difference from `a` to `b`, and its flow is proportional to what is above.",
    ports: &[
        port("a", "node whose pressure it limits"),
        port("b", "node into which it flows, such as the tank"),
    ],
    keys: || {
        vec![
            required("opening_pressure", Shape::Positive, "Pa", "difference at which it opens")
                .usual(PASCALS),
            required(
                "rated_flow",
                Shape::Positive,
                "m³/s",
                "flow at the difference `opening_pressure + pressure_rise`",
            )
            .usual(FLOWS),
            required(
                "pressure_rise",
                Shape::Positive,
                "Pa",
                "rise of the difference from opening to `rated_flow`",
            )
            .usual(PASCALS),
        ]
    },
    separates_fluids: false,
    components: &[("flow", "m^3/s"), ("power", "W")],
    add: |part, net| {
        let terms = [
            ("k", (part.number("rated_flow")? / part.number("pressure_rise")?).into()),
            ("pa", part.pressure(0)),
            ("pb", part.pressure(1)),
            ("po", part.number("opening_pressure")?.into()),
        ];
        net.signal(part, "flow", ("k*max(pa - pb - po, 0)", &terms))?;
        net.through(part);
        Some(())
    },
};
