//! Hydraulic parts: nodes with a pressure, and components between them. A kind of component is a file with its `KIND`, and a
//! line in `KINDS`. All of them become states (pressures, flow rates in pipes), signals (flow rates, forces, powers) and loads.
//!
//! Pressures are absolute [Pa]. Flow rates are volumes [m³/s], the same at both ends of a component, so that with the storage
//! `V p'/K` of the nodes volumes and energies balance exactly.

mod accumulator;
mod check_valve;
mod cylinder;
mod fluid;
mod kind;
mod net;
mod nodes;
mod orifice;
mod pipe;
mod pump;
mod relief_valve;
mod valve;

use std::cell::RefCell;

use super::connections::unread;
use super::entries::each_of_kind;
use super::units::check_name;
use crate::document::Document;
use crate::format::keys::{Key, Shape, required, unitless};
use crate::format::top_level::Variant;
use crate::outputs::kinds::OutputComponent;
use crate::parts::context::Context;
use crate::registry::Registry;
use crate::text::Value;
use crate::text::report::Located;

pub(super) use fluid::keys as fluid_keys;
use kind::HydraulicKind;
use net::{Net, Part};

/// A hydraulic part, as messages and outputs name it.
#[derive(Clone, Debug, PartialEq)]
pub struct HydraulicEntry {
    /// Name.
    pub name: Located<String>,
    /// Components with their units: `NAME.COMPONENT` in expressions.
    pub components: &'static [(&'static str, &'static str)],
}

/// All kinds in the order of the manual, those of nodes first.
const KINDS: [&HydraulicKind; 11] = [
    &nodes::VOLUME,
    &nodes::PRESSURE,
    &nodes::JUNCTION,
    &cylinder::KIND,
    &orifice::KIND,
    &valve::KIND,
    &check_valve::KIND,
    &relief_valve::KIND,
    &pump::KIND,
    &accumulator::KIND,
    &pipe::KIND,
];

/// The forms of an entry of `[hydraulics]`.
pub(super) fn variants() -> Vec<Variant> {
    let words: Vec<&'static str> = KINDS.iter().map(|kind| kind.word).collect();
    let form = |kind: &&HydraulicKind| {
        let mut keys = vec![required("kind", Shape::Choice(words.clone().into()), "", "its kind")];
        keys.extend(kind.ports.iter().map(|own| Key {
            required: own.is_required,
            ..unitless(own.key, Shape::Name("hydraulics"), own.summary)
        }));
        keys.extend((kind.keys)());
        Variant { word: kind.word, summary: kind.summary, keys }
    };
    KINDS.iter().map(form).collect()
}

/// The kind of the hydraulic part called `name`, if it has one that exists.
fn kind_of(context: &Context<'_>, name: &str) -> Option<&'static HydraulicKind> {
    let kind = context.entry("hydraulics", name)?.table()?.get("kind")?;
    let Value::Text(word) = &kind.node.value else { return None };
    KINDS.into_iter().find(|own| own.word == word)
}

/// Name and unit of the component `whole` of a hydraulic part, such as `lift.force`.
pub(super) fn component(context: &Context<'_>, whole: &str) -> Option<OutputComponent> {
    let (owner, word) = whole.rsplit_once('.')?;
    kind_of(context, owner)?.components.iter().find(|(own, _)| *own == word).copied()
}

/// Adds the hydraulic parts of a model to its states, signals, loads and springs.
pub(super) fn add(context: &Context<'_>, registry: &Registry, document: &mut Document) {
    let net = RefCell::new(Net::new(context, registry));
    document.hydraulics = each_of_kind(context, "hydraulics", registry, |reader, name, word| {
        check_name(context, "hydraulic part", name, reader.name)?;
        let kind = KINDS.into_iter().find(|kind| kind.word == word)?;
        let part = Part::new(reader, name, kind, |node| kind_of(context, node))?;
        let mut net = net.borrow_mut();
        (kind.add)(&part, &mut net)?;
        net.add_power(&part)?;
        Some(HydraulicEntry { name: Located::new(name.to_owned(), reader.name), components: kind.components })
    });
    let names = context.names("hydraulics");
    if let Some((_, span)) = names.first().filter(|_| names.len() != document.hydraulics.len()) {
        return unread(context, "an entry of [hydraulics]", *span);
    }
    net.into_inner().finish(document);
}
