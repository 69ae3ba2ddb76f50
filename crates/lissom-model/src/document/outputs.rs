//! The outputs of a model file.

use lissom_motion::Vector3;

use super::NodeReference;
use super::entries::each_of_kind;
use super::output_kinds::{Feature, OutputKind, Subject};
use crate::context::Context;
use crate::expression::Formula;
use crate::reader::Reader;
use crate::registry::Registry;
use crate::report::Located;
use crate::suggest;
use crate::sweep::Fatigue;
use crate::text::Node;

/// Whose quantity is recorded.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputSource {
    /// A node, at its own place or at a point [m] (place at the start) that it carries.
    Node {
        /// The node.
        node: Located<NodeReference>,
        /// The point.
        point: Option<Vector3>,
    },
    /// A joint, by name.
    Joint(Located<String>),
    /// A spring, by name.
    Spring(Located<String>),
    /// A contact, by name.
    Contact(Located<String>),
    /// A local load.
    LocalLoad(Located<String>),
    /// A spring, a load, a drive or a joint with friction, by name.
    Actor(Located<String>),
    /// A whole beam, by name.
    Beam(Located<String>),
    /// A superelement, by name.
    Superelement(Located<String>),
    /// The whole model.
    Model,
    /// A signal, an input or a state, by name.
    Signal(Located<String>),
    /// An expression.
    Expression(Located<Formula>),
}

/// Axes in which a joint's reaction is reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReactionAxes {
    /// Global ones.
    #[default]
    Ground,
    /// Those of the joint frame that the base carries.
    Base,
    /// Those of the joint frame that the tip carries.
    Tip,
}

impl ReactionAxes {
    /// Words in the model file.
    pub(crate) const WORDS: [&'static str; 3] = ["ground", "base", "tip"];

    fn named(word: &str) -> Self {
        match word {
            "base" => Self::Base,
            "tip" => Self::Tip,
            _ => Self::Ground,
        }
    }
}

/// One recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: Located<String>,
    /// Quantity.
    pub kind: OutputKind,
    /// Whose.
    pub source: OutputSource,
    /// In which axes, for a reaction.
    pub axes: ReactionAxes,
    /// The node in whose axes its vectors are reported; global axes, or those of the observer, where there is none.
    pub seen_in: Option<Located<NodeReference>>,
    /// The node relative to which it is measured; the ground if there is none.
    pub relative_to: Option<Located<NodeReference>>,
    /// The axis of an angle, at the start, global axes.
    pub axis: Option<Vector3>,
    /// How the cycles of its components are counted, if they are.
    pub fatigue: Option<Fatigue>,
}

pub(super) fn outputs(context: &Context<'_>, registry: &Registry) -> Vec<Output> {
    each_of_kind(context, "outputs", registry, |reader, name, word| {
        let kind = OutputKind::all().find(|kind| kind.name() == word)?;
        let source = match kind.subject() {
            Subject::Node | Subject::Section => node(reader, kind)?,
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
        let axes = (kind.has(Feature::JointAxes).then(|| reader.choice("axes")).flatten())
            .map_or(ReactionAxes::Ground, |word| ReactionAxes::named(word.value));
        let frame = |key: &str, feature| match kind.has(feature).then(|| reader.node(key)).flatten() {
            None => Some(None),
            Some(node) => frame(reader, node, key).map(Some),
        };
        let (seen_in, relative_to) = (frame("in", Feature::Axes)?, frame("relative_to", Feature::Observer)?);
        let axis = if kind.has(Feature::AngleAxis) { Some(reader.vector("axis")?.value) } else { None };
        let fatigue = if kind.has(Feature::Fatigue) { fatigue(reader) } else { None };
        let name = Located::new(name.to_owned(), reader.name);
        Some(Output { name, kind, source, axes, seen_in, relative_to, axis, fatigue })
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
    if let Some(full) = reader.context.resolve(name.value, scope, &exists) {
        return Some(Located::new(full, name.span));
    }
    let message =
        format!("{} names `{}`, but there is no {what} of this name", reader.words("of"), name.value);
    let help = suggest::help(name.value, known()).unwrap_or_else(|| format!("add it to [{}]", tables[0]));
    reader.context.fail(name.span, message, help)
}
