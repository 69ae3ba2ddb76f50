//! Joints, springs and loads of a model file: their ports, and the parameters of their kind.

use lissom_mechanics::registry::{Parameters, Value as Held};

use super::connections::Places;
use super::entries::each_of_kind;
use super::{Component, assembly, ports};
use crate::format::keys::Shape;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::{KindEntry, Registry};
use crate::text::Value;
use crate::text::report::Located;

pub(super) fn read(
    context: &Context<'_>,
    table: &'static str,
    registry: &Registry,
    places: &Places,
) -> Vec<Component> {
    let kinds: &[KindEntry] = match table {
        "joints" => &registry.joints,
        "springs" => &registry.springs,
        _ => &registry.loads,
    };
    let named = named(context, table, kinds);
    let forms = named.as_ref().unwrap_or(registry);
    each_of_kind(context, table, forms, |reader, name, word| {
        let entry = kinds.iter().find(|entry| entry.name == word)?;
        let (parameters, parameter_spans) = reader.parameters(entry.parameters);
        let signal = reader.signal(entry.parameters);
        let ports = entry.ports;
        let named = signal.as_ref().map(|(_, formula)| formula);
        let attachment = ports::read(reader, name, (ports, named), places);
        let may_have_friction = table == "joints" && ports.may_have_friction();
        let friction = if may_have_friction { friction(reader) } else { None };
        let latch = if may_have_friction { latch(reader) } else { None };
        let release = if may_have_friction { reader.formula("release") } else { None };
        let on_tip = assembly::on_tip(reader, ports);
        let kind = reader.text("kind")?.map(str::to_owned);
        let name = Located::new(name.to_owned(), reader.name);
        let attachment = attachment?;
        Some(Component {
            name,
            kind,
            ports,
            attachment,
            parameters,
            parameter_spans,
            signal,
            latch,
            release,
            friction,
            on_tip,
        })
    })
}

/// The kinds in use in `table`: building the forms of all kinds takes longer than reading the entries, which is significant in
/// sweeps. None if the kind of an entry is missing or unknown, so that the error message can list all of them.
fn named(context: &Context<'_>, table: &str, kinds: &[KindEntry]) -> Option<Registry> {
    let mut named: Vec<KindEntry> = Vec::new();
    for (_, _, node) in context.entries(table) {
        let Value::Table(entry) = &node.value else { return None };
        let Value::Text(word) = &entry.get("kind")?.node.value else { return None };
        if !named.iter().any(|kind| kind.name == word) {
            named.push(*kinds.iter().find(|kind| kind.name == word)?);
        }
    }
    let none = Registry::default();
    Some(match table {
        "joints" => Registry { joints: named, ..none },
        "springs" => Registry { springs: named, ..none },
        _ => Registry { loads: named, ..none },
    })
}

/// The key `friction` of a joint, as parameters of a friction element.
fn friction(reader: &Reader<'_, '_>) -> Option<Located<Parameters>> {
    let node = reader.node("friction")?;
    let context = reader.context;
    let own = Reader::open(context, node, (reader.words("friction"), node.span), Shape::friction_keys())?;
    let mut parameters = Parameters::new();
    for key in ["coulomb", "stribeck", "viscous", "deflection", "damping"] {
        // Defaults are those of the friction element.
        if own.has(key) {
            parameters.insert(key, Held::Number(own.number(key)?.value));
        }
    }
    let coulomb = own.number("coulomb")?.value;
    if let Some(at_rest) = own.number("static") {
        if at_rest.value < coulomb {
            let message = format!("`static` of {} is below `coulomb`", own.what);
            return context.fail(
                at_rest.span,
                message,
                "static friction must not be smaller than sliding friction",
            );
        }
        if at_rest.value > coulomb {
            parameters.insert("breakaway", Held::Number(at_rest.value - coulomb));
        }
    }
    Some(Located::new(parameters, node.span))
}

/// The key `latch` of a joint: where it engages.
fn latch(reader: &Reader<'_, '_>) -> Option<Located<f64>> {
    let node = reader.node("latch")?;
    let own = Reader::open(reader.context, node, (reader.words("latch"), node.span), Shape::latch_keys())?;
    own.number("at")
}
