//! Check valves.

use super::kind::{HydraulicKind, PASCALS, port};
use super::orifice::{LAW, of_rated, rated};
use crate::format::keys::{Shape, optional};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "check_valve",
    summary: "Check valve: an orifice for flow from `a` to `b`, closed in the other direction.",
    ports: &[port("a", "node from which it flows"), port("b", "node into which it flows")],
    keys: || {
        let mut keys = Vec::from(rated("pressure drop at `rated_flow`, above the opening one"));
        let words = "drop at which it opens";
        keys.push(
            optional("opening_pressure", Shape::NotNegative, "Pa", words).or_number(0.0).usual(PASCALS),
        );
        keys
    },
    separates_fluids: false,
    components: &[("flow", "m^3/s"), ("power", "W")],
    add: |part, net| {
        let mut terms = Vec::from(of_rated(part)?);
        terms.extend([
            ("pa", part.pressure(0)),
            ("pb", part.pressure(1)),
            ("po", part.number("opening_pressure")?.into()),
        ]);
        net.signal(part, "flow", (&LAW.replace('d', "max(pa - pb - po, 0)"), &terms))?;
        net.through(part);
        Some(())
    },
};
