//! Proportional 4/3 valves.

use lissom_mechanics::registry::Usual;

use super::kind::{HydraulicKind, port};
use super::net::{Net, Part, Term};
use super::orifice::{LAW, of_rated, rated};
use crate::format::keys::{Shape, required, unitless};

/// Registry entry.
pub(super) const KIND: HydraulicKind = HydraulicKind {
    word: "valve",
    summary: "Proportional 4/3 valve: a positive command opens `supply` to `a` and `b` to `tank`, a negative one `supply` to `b` and `a` to `tank`.",
    ports: &[
        port("supply", "node of the supply"),
        port("tank", "node of the return line"),
        port("a", "node of the first consumer port"),
        port("b", "node of the second consumer port"),
    ],
    keys: || {
        let mut keys =
            vec![
                required("command", Shape::Formula, "", "opening from -1 to 1, an expression")
                    .usual(Usual::new(0.0, 1.5, "in per cent")),
            ];
        keys.extend(rated("pressure drop of one edge at `rated_flow`"));
        let words = "command below which all edges are closed; negative: opening of all edges at command 0";
        keys.push(unitless("overlap", Shape::Between(-0.9, 0.9), words).or_number(0.0));
        keys
    },
    separates_fluids: false,
    components: &[
        ("flow_a", "m^3/s"),
        ("flow_b", "m^3/s"),
        ("flow_supply", "m^3/s"),
        ("flow_tank", "m^3/s"),
        ("command", ""),
        ("power", "W"),
    ],
    add,
};

fn add(part: &Part<'_, '_, '_>, net: &mut Net<'_, '_>) -> Option<()> {
    net.expression(part, "command", part.reader.formula("command")?);
    let mut terms = Vec::from(of_rated(part)?);
    terms.extend([
        ("u", Term::Name(part.component("command"))),
        ("o", part.number("overlap")?.into()),
        ("ps", part.pressure(0)),
        ("pt", part.pressure(1)),
        ("pa", part.pressure(2)),
        ("pb", part.pressure(3)),
    ]);
    let edges = [
        ("supply_a", '+', "(ps - pa)"),
        ("a_tank", '-', "(pa - pt)"),
        ("supply_b", '-', "(ps - pb)"),
        ("b_tank", '+', "(pb - pt)"),
    ];
    for (edge, sign, drop) in edges {
        let law = format!("clamp(({sign}u - o)/(1 - o), 0, 1)*{}", LAW.replace('d', drop));
        net.signal(part, edge, (&law, &terms))?;
    }
    let ports = [
        ("flow_supply", 0, "sa + sb"),
        ("flow_tank", 1, "-at - bt"),
        ("flow_a", 2, "at - sa"),
        ("flow_b", 3, "bt - sb"),
    ];
    let edges = ["supply_a", "a_tank", "supply_b", "b_tank"].map(|edge| Term::Name(part.component(edge)));
    let terms: Vec<_> = ["sa", "at", "sb", "bt"].into_iter().zip(edges).collect();
    for (word, port, sum) in ports {
        net.signal(part, word, (sum, &terms))?;
        net.flow(part, port, (word, 1.0));
    }
    Some(())
}
