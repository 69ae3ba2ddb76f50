//! Pipes with waves, as segments.

use std::f64::consts::PI;

use super::fluid::ATMOSPHERE;
use super::net::{Net, Part, Term};
use super::{HydraulicKind, port};
use crate::format::keys::{Shape, optional, required, unitless};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "pipe",
    summary: "Smooth pipe with inertia, compressibility and friction of the fluid, in segments: waves up to about a fifth of the frequency `wave speed/(segment length)` are resolved.",
    ports: &[port("a", "node at one end"), port("b", "node at the other end")],
    keys: || {
        let start = optional("start", Shape::Positive, "Pa", "absolute pressure in it at the start");
        vec![
            required("length", Shape::Positive, "m", "length"),
            required("diameter", Shape::Positive, "m", "inner diameter"),
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
    // Inertance I = ρ l/A; laminar drop of Hagen and Poiseuille 128 ρ ν l q/(π d⁴); above Re = 2000 towards the friction factor of
    // Blasius 0.3164 Re^(-1/4), fully from 4000, whose ratio to the laminar one is (Re/1187.4)^(3/4).
    let resistance = 128.0 * fluid.density * fluid.viscosity * own / (PI * diameter.powi(4));
    let drop = "R*q*(1 + smoothstep(abs(q)*e/2000 - 1)*((max(abs(q)*e, 1)/1187.4)^0.75 - 1))";
    for k in 1..=count {
        let terms = [
            ("I", (fluid.density * own / area).into()),
            ("R", resistance.into()),
            ("e", (diameter / (area * fluid.viscosity)).into()),
            ("q", flow_of(k)),
            ("p1", inner(k - 1)),
            ("p2", inner(k)),
        ];
        net.state(part, (&format!("flow{k}"), area, flow), (&format!("(p1 - p2 - {drop})/I"), &terms))?;
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
        net.state(part, (&format!("pressure{k}"), ATMOSPHERE, start), (&rate, &terms))?;
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
