//! Events of a model file.

use lissom_mechanics::signals::event::Direction;

use super::analysis::{Analysis, AnalysisKind};
use super::entries::each;
use crate::expression::Formula;
use crate::format::keys::{Key, Shape, choice, required, unitless};
use crate::format::suggest;
use crate::parts::context::Context;
use crate::text::Value;
use crate::text::report::{Located, Span};

/// Something that happens when an expression passes through zero.
#[derive(Clone, Debug, PartialEq)]
pub struct EventEntry {
    /// Name.
    pub name: Located<String>,
    /// The expression.
    pub zero_of: Located<Formula>,
    /// Which way it passes.
    pub direction: Direction,
    /// Whether the run ends there.
    pub stop: bool,
    /// Inputs changed by the event, with their new values.
    pub set: Vec<(Located<String>, Located<Formula>)>,
}

/// Keys of an event.
pub(super) fn keys() -> Vec<Key> {
    vec![
        required("zero_of", Shape::Formula, "", "the event occurs when this expression crosses zero"),
        unitless("direction", choice(&["both", "rising", "falling"]), "direction of the crossing")
            .or_word("both"),
        unitless("stop", Shape::Flag, "whether the run ends at the event").or_flag(false),
        unitless(
            "set",
            Shape::Table,
            "inputs to be changed by the event, with expressions of their new values",
        ),
    ]
}

pub(super) fn events(context: &Context<'_>) -> Vec<EventEntry> {
    each(context, "events", |reader, name| {
        let zero_of = reader.formula("zero_of");
        let direction = match reader.choice("direction")?.value {
            "rising" => Direction::Rising,
            "falling" => Direction::Falling,
            _ => Direction::Both,
        };
        let mut set = Vec::new();
        if let Some(node) = reader.node("set") {
            let Value::Table(table) = &node.value else {
                return context.wrong_type(node, &reader.words("set"), "a table of inputs and expressions");
            };
            for (input, entry) in table {
                let own = context.resolve(input, entry.node.scope, &|full| context.has("inputs", full));
                let Some(own) = own else {
                    let known = context.names("inputs");
                    let help = suggest::help(input, known.iter().map(|(known, _)| *known))
                        .unwrap_or_else(|| format!("add `{input} = 0` to [inputs]: events set inputs only"));
                    return context.fail(
                        entry.key,
                        format!("event `{name}` sets `{input}`, which is not an input"),
                        help,
                    );
                };
                let formula = context.formula(&entry.node, &format!("`set.{input}` of event `{name}`"))?;
                set.push((Located::new(own, entry.key), Located::new(formula, entry.node.span)));
            }
        }
        Some(EventEntry {
            name: Located::new(name.to_owned(), reader.name),
            zero_of: zero_of?,
            direction,
            stop: reader.flag("stop")?.value,
            set,
        })
    })
}

/// Events need motion in time.
pub(super) fn check(context: &Context<'_>, analysis: &Analysis) {
    let first: Option<(&str, Span)> = context.names("events").first().copied();
    if let (AnalysisKind::Statics { .. }, Some((name, span))) = (&analysis.kind, first) {
        let message = format!("event `{name}` cannot occur in statics: there is no motion in time");
        context.fail::<()>(span, message, "remove [events], or use `kind = \"dynamics\"`");
    }
}
