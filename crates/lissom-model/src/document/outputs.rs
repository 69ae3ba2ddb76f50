//! Reads the outputs of a model file.

use super::entries::each_of_kind;
use super::hydraulics::component;
use super::{Feature, NodeReference, Output, OutputKind, OutputSource, ReactionAxes, Subject};
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::Registry;
use crate::sweep::Fatigue;
use crate::text::Node;
use crate::text::report::Located;

pub(super) fn outputs(context: &Context<'_>, registry: &Registry) -> Vec<Output> {
    each_of_kind(context, "outputs", registry, |reader, name, word| {
        let kind = OutputKind::all().find(|kind| kind.name() == word)?;
        let source = match kind.subject() {
            Subject::Node | Subject::Section | Subject::ShellNode | Subject::SolidNode => node(reader, kind)?,
            Subject::Joint => OutputSource::Joint(reader.name_in("of")?),
            Subject::Spring => OutputSource::Spring(reader.name_in("of")?),
            Subject::Contact => OutputSource::Contact(reader.name_in("of")?),
            Subject::LocalLoad => OutputSource::LocalLoad(reader.name_in("of")?),
            Subject::Actor => {
                let tables = ["springs", "loads", "joints"];
                OutputSource::Actor(name_of_one(reader, &tables, "spring, load or joint")?)
            }
            Subject::Beam => OutputSource::Beam(reader.name_in("of")?),
            Subject::Superelement => OutputSource::Superelement(reader.name_in("of")?),
            Subject::Model => OutputSource::Model,
            Subject::Signal => {
                let tables = ["signals", "inputs", "states"];
                OutputSource::Signal(name_of_one(reader, &tables, "signal, input or state")?)
            }
            Subject::Expression => OutputSource::Expression(reader.formula("value")?),
        };
        let axes = if kind.has(Feature::JointAxes) {
            ReactionAxes::named(reader.choice("axes")?.value)
        } else {
            ReactionAxes::Ground
        };
        let context = reader.context;
        let frame = |key: &str, feature| match kind.has(feature).then(|| reader.node(key)).flatten() {
            None => Some(None),
            Some(node) => frame(reader, node, key).map(Some),
        };
        let (seen_in, relative_to) = (frame("in", Feature::Axes)?, frame("relative_to", Feature::Observer)?);
        let axis = if kind.has(Feature::AngleAxis) { Some(reader.vector("axis")?.value) } else { None };
        let station = if kind.has(Feature::Station) { reader.number("station") } else { None };
        let text = |key: &str| reader.text(key).map(|text| text.value.to_owned());
        let unit = if kind.has(Feature::Unit) { text("unit") } else { None };
        let of_part = |source: &OutputSource| match source {
            OutputSource::Signal(name) => component(context, &name.value).map(|(_, unit)| unit.to_owned()),
            _ => None,
        };
        let unit = unit.or_else(|| of_part(&source));
        let plot = text("plot");
        let fatigue = if kind.has(Feature::Fatigue) { fatigue(reader) } else { None };
        let name = Located::new(name.to_owned(), reader.name);
        Some(Output { name, kind, source, axes, seen_in, relative_to, axis, station, unit, plot, fatigue })
    })
}

/// The node of an output, and the point that it carries.
fn node(reader: &Reader<'_, '_>, kind: OutputKind) -> Option<OutputSource> {
    let context = reader.context;
    let node = context.node(reader.node("of")?, &reader.words("of"))?;
    if kind.subject() == Subject::Section && !matches!(node.value, NodeReference::Beam { .. }) {
        let message = format!("{} is of a node that is not on a beam", reader.what);
        return context.fail(node.span, message, "specify a position on a beam, such as \"beam@0.5\"");
    }
    let point = match kind.has(Feature::Point).then(|| reader.node("point")).flatten() {
        None => None,
        Some(place) => Some(context.place(place, &reader.words("point"))?.value),
    };
    if matches!(node.value, NodeReference::PointMass(_)) && point.is_some() {
        let message = format!("{} names a point, but a point mass carries none", reader.what);
        let span = reader.node("point").map_or(node.span, |point| point.span);
        return context.fail(span, message, "remove `point`");
    }
    Some(OutputSource::Node { node, point })
}

/// How cycles are counted; none where there is no exponent, and where something is wrong, which is reported.
fn fatigue(reader: &Reader<'_, '_>) -> Option<Fatigue> {
    let (exponent, cycles) = (reader.number("woehler_exponent"), reader.number("reference_cycles"));
    if let (Some(cycles), false) = (&cycles, reader.has("woehler_exponent")) {
        let message = format!("{} has `reference_cycles` without `woehler_exponent`", reader.what);
        return reader.context.fail(cycles.span, message, "add `woehler_exponent`, or remove this");
    }
    exponent.map(|exponent| Fatigue { exponent: exponent.value, cycles: cycles.map(|cycles| cycles.value) })
}

/// A node that has axes.
fn frame(reader: &Reader<'_, '_>, node: &Node, key: &str) -> Option<Located<NodeReference>> {
    let found = reader.context.node(node, &reader.words(key))?;
    if let NodeReference::PointMass(name) = &found.value {
        let message = format!("{} names the point mass `{name}`, which has no axes", reader.words(key));
        return reader.context.fail(node.span, message, "specify the ground, a body or a position on a beam");
    }
    Some(found)
}

/// The name of an entry of one of some `tables`, which are called `what`.
fn name_of_one(reader: &Reader<'_, '_>, tables: &[&str], what: &str) -> Option<Located<String>> {
    let name = reader.text("of")?;
    let known = || tables.iter().flat_map(|table| reader.context.names(table)).map(|(name, _)| name);
    let scope = reader.node("of")?.scope;
    let exists = |full: &str| tables.iter().any(|table| reader.context.has(table, full));
    let is_of_unit = |full: &str| {
        let owner = full.rsplit_once('.').map(|(owner, _)| owner);
        tables[0] == "signals" && owner.is_some_and(|owner| reader.context.has("units", owner))
    };
    let is_of_part = |full: &str| tables[0] == "signals" && component(reader.context, full).is_some();
    let is_known = |full: &str| exists(full) || is_of_unit(full) || is_of_part(full);
    if let Some(full) = reader.context.resolve(name.value, scope, &is_known) {
        return Some(Located::new(full, name.span));
    }
    let message =
        format!("{} names `{}`, but there is no {what} of this name", reader.words("of"), name.value);
    let help = suggest::help(name.value, known()).unwrap_or_else(|| format!("add it to [{}]", tables[0]));
    reader.context.fail(name.span, message, help)
}
