//! Nodes: what has one pressure.

use lissom_mechanics::registry::Usual;

use super::fluid::ATMOSPHERE;
use super::kind::{HydraulicKind, PASCALS};
use crate::format::keys::{Key, Shape, optional, required, unitless};
use crate::text::report::Located;

/// A node.
pub(super) struct Node {
    pub(super) name: Located<String>,
    pub(super) kind: NodeKind,
}

/// What determines the pressure of a node.
#[derive(Clone, Copy)]
pub(super) enum NodeKind {
    /// The fluid in it [m³], from a pressure at the start [Pa].
    Volume { volume: f64, start: f64 },
    /// An expression.
    Pressure,
    /// The balance of its flows, with a first guess [Pa].
    Junction { start: f64 },
}

/// Registry entry of a volume.
pub(super) const VOLUME: HydraulicKind = HydraulicKind {
    word: "volume",
    summary: "Node with a volume of compressible fluid, such as a line; chambers of cylinders connected to it are added.",
    ports: &[],
    keys: || {
        let words = "of the node itself, besides the chambers of cylinders and pipes that end there";
        let start = optional("start", Shape::Positive, "Pa", "absolute pressure at the start");
        let start = start.usual(PASCALS);
        vec![
            fluid(),
            required("volume", Shape::Positive, "m³", words).usual(Usual::new(0.0, 100.0, "in litres")),
            start.or_number(ATMOSPHERE),
        ]
    },
    separates_fluids: false,
    components: &[("pressure", "Pa"), ("flow", "m^3/s"), ("power", "W"), ("rate", "Pa/s")],
    add: |part, net| {
        let (volume, start) = (part.number("volume")?, part.number("start")?);
        net.add_node(part, NodeKind::Volume { volume, start })
    },
};

/// Registry entry of a prescribed pressure.
pub(super) const PRESSURE: HydraulicKind = HydraulicKind {
    word: "pressure",
    summary: "Node with a prescribed pressure: a tank, or an ideal supply.",
    ports: &[],
    keys: || {
        let words = "absolute pressure, a number or an expression; default: that of the atmosphere";
        vec![fluid(), optional("pressure", Shape::Formula, "Pa", words).usual(PASCALS)]
    },
    separates_fluids: false,
    components: &[("pressure", "Pa"), ("flow", "m^3/s"), ("power", "W")],
    add: |part, net| {
        if part.reader.has("pressure") {
            let pressure = part.reader.formula("pressure")?;
            let formula = &pressure.value;
            let is_constant = formula.arguments().is_empty() && !formula.depends_on_time();
            if is_constant && formula.with_arguments(&[]).jet(0.0).value <= 0.0 {
                let message = format!("`pressure` of {} is not above 0", part.reader.what);
                let help = "pressures are absolute: that of the atmosphere is 101325 Pa";
                return part.reader.context.fail(pressure.span, message, help);
            }
            net.expression(part, "pressure", pressure);
        } else {
            net.signal(part, "pressure", ("p", &[("p", ATMOSPHERE.into())]))?;
        }
        net.add_node(part, NodeKind::Pressure)
    },
};

/// Registry entry of a junction.
pub(super) const JUNCTION: HydraulicKind = HydraulicKind {
    word: "junction",
    summary: "Node without volume: its pressure follows from the balance of the flows.",
    ports: &[],
    keys: || {
        let start =
            optional("start", Shape::Positive, "Pa", "first guess of the absolute pressure at the start");
        vec![fluid(), start.or_number(ATMOSPHERE).usual(PASCALS)]
    },
    separates_fluids: false,
    components: &[("pressure", "Pa"), ("flow", "m^3/s"), ("power", "W")],
    add: |part, net| net.add_node(part, NodeKind::Junction { start: part.number("start")? }),
};

fn fluid() -> Key {
    let words =
        "name of its fluid; may be omitted if there is one or none, which is then a mineral oil HLP 46";
    unitless("fluid", Shape::Name("fluids"), words)
}
