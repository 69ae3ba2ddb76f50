//! Resolution of names in their scope: inside a part, its own names are used without the part's name.

use std::borrow::Cow;

use super::Outside;
use crate::expression::{Expression, Formula};
use crate::parts::context::Context;
use crate::text::ScopeId;
use crate::text::report::{Problem, Span};
use crate::text::{Node, Value};

/// Tables whose entries expressions may name with a component, such as `tip.u1`.
const OWNERS: [&str; 4] = ["outputs", "joints", "units", "hydraulics"];
/// Tables whose entries expressions may name.
const NUMBERS: [&str; 3] = ["signals", "inputs", "states"];
/// The component of a sampled signal that is its previous sample.
pub(crate) const PREVIOUS_SAMPLE: &str = "last";

impl Context<'_> {
    /// A text whose `{…}` are replaced by the whole numbers that the expressions in them are.
    pub(crate) fn written<'n>(
        &self,
        text: &'n str,
        (span, scope): (Span, ScopeId),
        what: &str,
    ) -> Option<Cow<'n, str>> {
        if !text.contains('{') {
            return Some(Cow::Borrowed(text));
        }
        let mut whole = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            whole.push_str(before);
            let Some((inside, behind)) = after.split_once('}') else {
                return self.fail(
                    span,
                    format!("{what} has a `{{` without `}}`"),
                    "write for example \"link{index - 1}\"",
                );
            };
            let expression = Expression::parse(inside, None, &self.parameters_of(scope));
            match expression.map(|expression| expression.jet(0.0).value) {
                Ok(value) if (value - value.round()).abs() < 1e-9 && value.abs() < 1e9 => {
                    whole.push_str(&value.round().to_string());
                }
                Ok(value) => {
                    let message = format!("`{{{inside}}}` in {what} is {value}, not a whole number");
                    return self.fail(
                        span,
                        message,
                        "names are numbered by whole numbers, such as \"link{index - 1}\"",
                    );
                }
                Err(error) => {
                    let help = "`index` and `count` are known inside of parts with `count`";
                    self.report(
                        Problem::error(span, format!("{what} cannot be read: {error}"))
                            .help(help)
                            .maybe_help(error.help),
                    );
                    return None;
                }
            }
            rest = behind;
        }
        whole.push_str(rest);
        Some(Cow::Owned(whole))
    }

    /// Name in the whole model of `text` in its scope, among those for which `exists` is true.
    pub(crate) fn resolve(&self, text: &str, from: ScopeId, exists: &dyn Fn(&str) -> bool) -> Option<String> {
        let mut text = text.to_owned();
        let mut scope = from;
        loop {
            let own = &self.scopes[scope];
            let full = if text == "ground" { text.clone() } else { format!("{}{text}", own.prefix) };
            if exists(&full) {
                return Some(full);
            }
            let parent = own.parent?;
            if let Outside::Handed(names) = &own.outside {
                let length = text.find(['.', '@']).unwrap_or(text.len());
                let (head, rest) = text.split_at(length);
                let (_, node) = names.iter().find(|(name, _)| name == head)?;
                let Value::Text(target) = &node.value else {
                    return self.wrong_type(
                        node,
                        &format!("`{head}` in `names`"),
                        "a text: a name around the part",
                    );
                };
                let target =
                    self.written(target, (node.span, node.scope), &format!("`{head}` in `names`"))?;
                text = format!("{target}{rest}");
            }
            scope = parent;
        }
    }

    /// The name in the whole model of the entry of `table` that `node` names.
    pub(crate) fn entry_named(&self, table: &str, text: &str, node: &Node, what: &str) -> Option<String> {
        let written = self.written(text, (node.span, node.scope), what)?;
        let found = self.resolve(&written, node.scope, &|full| self.has(table, full));
        // A missing name is reported by the caller.
        Some(found.unwrap_or_else(|| written.into_owned()))
    }

    /// An expression whose names are those of the whole model.
    pub(crate) fn in_whole_model(&self, mut formula: Formula, scope: ScopeId) -> Formula {
        if scope != crate::text::ROOT {
            formula.rename(&|text| self.quantity(text, scope));
        }
        formula
    }

    fn quantity(&self, text: &str, scope: ScopeId) -> String {
        let exists = |full: &str| {
            NUMBERS.iter().any(|table| self.has(table, full))
                || full.rsplit_once('.').is_some_and(|(owner, component)| {
                    let is_previous = component == PREVIOUS_SAMPLE && self.has("signals", owner);
                    is_previous || OWNERS.iter().any(|table| self.has(table, owner))
                })
        };
        // A name unknown inside must remain unknown: it may be the name of another entry outside.
        self.resolve(text, scope, &exists).unwrap_or_else(|| format!("{}{text}", self.scopes[scope].prefix))
    }
}
