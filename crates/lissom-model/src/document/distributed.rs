//! Forces per length of a beam.

use lissom_motion::Rotation;

use crate::expression::Formula;
use crate::format::suggest;
use crate::reading::reader::Reader;
use crate::text::Value;
use crate::text::report::{Problem, Span};

/// A force per length of a beam's reference line.
#[derive(Clone, Debug, PartialEq)]
pub struct DistributedForce {
    /// Components [N/m], each of the time and, as its only argument if it has one, of the fraction `s`.
    pub components: [Formula; 3],
    /// The axes of the components, where they are fixed; none for those of the section, with which the force turns.
    pub axes: Option<Rotation>,
    /// Where it is written.
    pub span: Span,
}

/// The forces per length of a beam.
pub(super) fn read(reader: &Reader<'_, '_>) -> Option<Vec<DistributedForce>> {
    let mut forces = Vec::new();
    for (key, turns) in [("force_per_length", false), ("section_force_per_length", true)] {
        let Some(node) = reader.node(key) else { continue };
        let (context, what) = (reader.context, reader.words(key));
        let list = context.list(node, 3, &what)?;
        let mut components = Vec::new();
        for entry in list {
            // It names nothing of the model, whose names would be those of the part.
            let formula = context.own_formula(entry, &what)?;
            if let Some(name) = formula.arguments().iter().find(|name| name.text != "s") {
                let place = match &entry.value {
                    Value::Text(text) => context.sources.within(entry.span, text, &name.range),
                    _ => entry.span,
                };
                let problem = Problem::error(place, format!("{what} cannot name `{}`", name.text));
                let help = "it may contain `s` from 0 to 1 along the beam, `t` and the parameters";
                let near = suggest::help(&name.text, ["s", "t"]);
                context.report(problem.label("unknown here").help(help).maybe_help(near));
                return None;
            }
            components.push(formula);
        }
        let axes = if turns { None } else { Some(context.frame(reader.scope)?.rotation) };
        forces.push(DistributedForce { components: components.try_into().ok()?, axes, span: node.span });
    }
    Some(forces)
}
