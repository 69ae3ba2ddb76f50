//! Accumulators with a gas.

use lissom_mechanics::registry::Usual;

use super::kind::{HydraulicKind, PASCALS, port};
use super::net::Term;
use crate::format::keys::{Shape, required, unitless};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "accumulator",
    summary: "Accumulator on a volume: its gas is compressed by a polytropic law above the precharge pressure, and below it contains no fluid.",
    ports: &[port("a", "node of kind `volume`")],
    keys: || {
        vec![
            required(
                "gas_volume",
                Shape::Positive,
                "m³",
                "of the gas at the precharge pressure: that of the accumulator",
            )
            .usual(Usual::new(0.0, 10.0, "in litres")),
            required("precharge", Shape::Positive, "Pa", "absolute pressure of the gas without fluid")
                .usual(PASCALS),
            unitless(
                "exponent",
                Shape::Between(1.0, 2.0),
                "polytropic exponent of the gas: 1 for slow changes",
            )
            .or_number(1.4),
        ]
    },
    separates_fluids: false,
    components: &[("volume", "m^3"), ("flow", "m^3/s"), ("power", "W")],
    add: |part, net| {
        let rate = match part.pressure(0) {
            Term::Name(pressure) => pressure.replace(".pressure", ".rate"),
            Term::Number(_) => return None,
        };
        let terms = [
            ("V", part.number("gas_volume")?.into()),
            ("p0", part.number("precharge")?.into()),
            ("n", part.number("exponent")?.into()),
            ("p", part.pressure(0)),
            ("c", Term::Name(part.component("compliance"))),
            ("r", rate.into()),
        ];
        net.signal(part, "volume", ("V - V*(p0/max(p, p0))^(1/n)", &terms))?;
        net.signal(part, "compliance", ("if(p >= p0, V/(n*p)*(p0/max(p, p0))^(1/n), 0)", &terms))?;
        net.signal(part, "flow", ("c*r", &terms))?;
        // The node stores what flows into it, so that its pressure has a rate without an algebraic loop.
        net.compliance(part, 0, "compliance");
        net.signal(part, "power", ("p*c*r", &terms))?;
        Some(())
    },
};
