//! Orifices, and the law of flow that valves share with them.

use std::f64::consts::PI;

use lissom_mechanics::registry::Usual;

use super::kind::{FLOWS, HydraulicKind, PASCALS, port};
use super::net::{Net, Part, Term};
use crate::format::keys::{Key, Shape, optional, required, unitless};

/// Flow through an orifice of conductance `k` [m³/(s Pa^½)] for a pressure drop `d` [Pa]: the root of the drop, and linear in it
/// far below the transition `w` [Pa] [Merritt 1967, with a smooth transition].
pub(super) const LAW: &str = "k*d/(d^2 + w^2)^0.25";

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "orifice",
    summary: "Orifice: turbulent flow with the root of the pressure drop, laminar at small drops; with `opening` a throttle or a 2/2 valve.",
    ports: &[port("a", "node on one side"), port("b", "node on the other side")],
    keys: || {
        vec![
            optional("area", Shape::Positive, "m²", "of the opening; either it or `rated_flow` is required")
                .usual(Usual::new(0.0, 1.0, "in mm²")),
            unitless("discharge", Shape::Between(0.01, 1.0), "discharge coefficient of the area")
                .or_number(0.7),
            optional("rated_flow", Shape::Positive, "m³/s", "instead of `area`: flow at `rated_drop`")
                .usual(FLOWS),
            optional("rated_drop", Shape::Positive, "Pa", "pressure drop at `rated_flow`").usual(PASCALS),
            unitless(
                "opening",
                Shape::Formula,
                "fraction of the area that is open, an expression; 0 if negative; default: fully open",
            ),
            optional(
                "transition",
                Shape::Positive,
                "Pa",
                "pressure drop between laminar and turbulent flow; default from `critical_reynolds`",
            ),
            unitless("critical_reynolds", Shape::Positive, "Reynolds number at the transition")
                .or_number(12.0),
        ]
    },
    separates_fluids: false,
    components: &[("flow", "m^3/s"), ("power", "W")],
    add,
};

/// Keys of what has a rated flow.
pub(super) fn rated(drop: &'static str) -> [Key; 3] {
    [
        required("rated_flow", Shape::Positive, "m³/s", "flow at `rated_drop`, fully open").usual(FLOWS),
        required("rated_drop", Shape::Positive, "Pa", drop).usual(PASCALS),
        optional("transition", Shape::Positive, "Pa", "pressure drop between laminar and turbulent flow")
            .or_number(1e5),
    ]
}

/// Conductance of what has a rated flow, and its transition.
pub(super) fn of_rated(part: &Part<'_, '_, '_>) -> Option<[(&'static str, Term); 2]> {
    let conductance = part.number("rated_flow")? / part.number("rated_drop")?.sqrt();
    Some([("k", conductance.into()), ("w", part.number("transition")?.into())])
}

fn add(part: &Part<'_, '_, '_>, net: &mut Net<'_, '_>) -> Option<()> {
    let (reader, fluid) = (part.reader, net.fluid(part, 0)?);
    let discharge = part.number("discharge")?;
    // Q = α A √(2 Δp/ρ)
    let per_area = discharge * (2.0 / fluid.density).sqrt();
    let given = ["area", "rated_flow", "rated_drop"].map(|key| reader.has(key));
    let area = match given {
        [true, false, false] => part.number("area")?,
        [false, true, true] => part.number("rated_flow")? / part.number("rated_drop")?.sqrt() / per_area,
        _ => {
            let message =
                format!("{} has neither `area` alone nor `rated_flow` with `rated_drop`", reader.what);
            return reader.context.fail(reader.name, message, "specify either the area or a rated flow");
        }
    };
    // Re = v D/ν at the mean velocity of the jet, v = Q/A, and D = √(4 A/π).
    let critical = part.number("critical_reynolds")? * fluid.viscosity / discharge;
    let transition = if reader.has("transition") {
        part.number("transition")?
    } else {
        PI * fluid.density / (8.0 * area) * critical * critical
    };
    let mut terms = vec![
        ("k", (per_area * area).into()),
        ("w", transition.into()),
        ("pa", part.pressure(0)),
        ("pb", part.pressure(1)),
    ];
    let law = LAW.replace('d', "(pa - pb)");
    if reader.has("opening") {
        net.expression(part, "opening", reader.formula("opening")?);
        terms.push(("open", Term::Name(part.component("opening"))));
        net.signal(part, "flow", (&format!("max(open, 0)*{law}"), &terms))?;
    } else {
        net.signal(part, "flow", (&law, &terms))?;
    }
    net.through(part);
    Some(())
}
