//! Pipes with waves, as segments.

use std::f64::consts::PI;

use super::fluid::ATMOSPHERE;
use super::kind::{DIAMETERS, HydraulicKind, PASCALS, port};
use super::net::{Net, Part, Term};
use crate::format::keys::{Shape, optional, required, unitless};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "pipe",
    summary: "Pipe with inertia, compressibility and friction of the fluid, in segments: waves up to about a fifth of the frequency `wave speed/(segment length)` are resolved.",
    ports: &[port("a", "node at one end"), port("b", "node at the other end")],
    keys: || {
        let start =
            optional("start", Shape::Positive, "Pa", "absolute pressure in it at the start").usual(PASCALS);
        vec![
            required("length", Shape::Positive, "m", "length"),
            required("diameter", Shape::Positive, "m", "inner diameter").usual(DIAMETERS),
            optional("roughness", Shape::NotNegative, "m", "of the wall").or_number(0.0),
            unitless("segments", Shape::Count(1, 50), "number of segments").or_count(5),
            start.or_number(ATMOSPHERE),
            optional("start_flow", Shape::Number, "m³/s", "flow in it at the start, from `a` to `b`")
                .or_number(0.0),
        ]
    },
    separates_fluids: false,
    components: &[("flow_a", "m^3/s"), ("flow_b", "m^3/s"), ("power", "W")],
    add,
};

fn add(part: &Part<'_, '_, '_>, net: &mut Net<'_, '_>) -> Option<()> {
    let fluid = net.fluid(part, 0)?;
    let (length, diameter) = (part.number("length")?, part.number("diameter")?);
    let (start, flow) = (part.number("start")?, part.number("start_flow")?);
    let count = part.reader.count("segments")?.value;
    let (area, own) = (PI * diameter * diameter / 4.0, length / count as f64);
    let inner = |k: usize| match k {
        0 => part.pressure(0),
        _ if k == count => part.pressure(1),
        _ => Term::Name(part.component(&format!("pressure{k}"))),
    };
    let flow_of = |k: usize| Term::Name(part.component(&format!("flow{k}")));
    // Inertance I = ρ l/A. The laminar drop of Hagen and Poiseuille, R q = 128 ρ ν l q/(π d⁴), times f Re/64 with the friction factor
    // of Churchill (1977), which is smooth from laminar to turbulent flow.
    let resistance = 128.0 * fluid.density * fluid.viscosity * own / (PI * diameter.powi(4));
    let reynolds = "hypot(e*q, 1)";
    let turbulent = format!("((2.457*ln(1/((7/{reynolds})^0.9 + 0.27*r)))^16 + (37530/{reynolds})^16)");
    let drop = format!("R*q*(1 + ({reynolds}/8)^12/{turbulent}^1.5)^(1/12)");
    for k in 1..=count {
        let terms = [
            ("I", (fluid.density * own / area).into()),
            ("R", resistance.into()),
            ("e", (diameter / (area * fluid.viscosity)).into()),
            ("r", (part.number("roughness")? / diameter).into()),
            ("q", flow_of(k)),
            ("p1", inner(k - 1)),
            ("p2", inner(k)),
        ];
        net.state(
            part,
            (&format!("flow{k}"), area, flow, false),
            (&format!("(p1 - p2 - {drop})/I"), &terms),
        )?;
    }
    for k in 1..count {
        let (compressibility, mut terms) = fluid.compressibility();
        terms.extend([
            ("p", inner(k)),
            ("V", (area * own).into()),
            ("q1", flow_of(k)),
            ("q2", flow_of(k + 1)),
        ]);
        let rate = format!("(q1 - q2)/(V*({compressibility}))");
        net.state(part, (&format!("pressure{k}"), ATMOSPHERE, start, !fluid.has_air()), (&rate, &terms))?;
    }
    // Half a segment of fluid is at each end.
    net.signal(part, "end", ("V", &[("V", (area * own / 2.0).into())]))?;
    net.signal(part, "flow_a", ("q", &[("q", flow_of(1))]))?;
    net.signal(part, "flow_b", ("-q", &[("q", flow_of(count))]))?;
    for (port, word) in [(0, "flow_a"), (1, "flow_b")] {
        net.flow(part, port, (word, 1.0));
        net.volume(part, port, "end");
    }
    Some(())
}
