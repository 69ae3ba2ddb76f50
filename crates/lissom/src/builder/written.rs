//! Values of code in the form of a model file. Every number is reproduced to the last bit.

use lissom_model::output::number_text;
use lissom_model::toml_text::{key, quoted};

use super::expression::{Expression, Piece};
use super::values::{At, Node};
use crate::ids::{AnyId, ForeignId, IdNames};

/// The value of a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// A text.
    Text(String),
    /// A number.
    Number(f64),
    /// True or false.
    Flag(bool),
    /// Several values.
    List(Vec<Written>),
    /// Values by key.
    Fields(Fields),
    /// Values by the names of entries.
    Named(Vec<(NameOf, Written)>),
    /// The name of an entry.
    Name(NameOf),
    /// A node.
    Node(Node),
    /// An expression.
    Expression(Expression),
}

/// The entry whose name is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NameOf(pub(crate) AnyId);

/// Values by key, in the order in which they were given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields(Vec<(&'static str, Written)>);

impl Fields {
    /// Sets the value of `key`, replacing an earlier one.
    pub(crate) fn set(&mut self, key: &'static str, value: impl Into<Written>) {
        let value = value.into();
        match self.0.iter_mut().find(|(known, _)| *known == key) {
            Some((_, known)) => *known = value,
            None => self.0.push((key, value)),
        }
    }

    /// Whether `key` has a value.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.0.iter().any(|(known, _)| *known == key)
    }

    /// Sets the value of the entry called `name` in the table under `key`, replacing an earlier one.
    pub(crate) fn set_under(&mut self, key: &'static str, name: NameOf, value: Written) {
        if let Some((_, Written::Named(named))) = self.0.iter_mut().find(|(known, _)| *known == key) {
            named.retain(|(known, _)| *known != name);
            named.push((name, value));
        } else {
            self.set(key, Written::Named(vec![(name, value)]));
        }
    }

    /// Keys and values as lines `key = value`, of the entry called `own`.
    ///
    /// # Errors
    /// If it contains an id of another builder.
    pub(crate) fn lines(&self, names: &IdNames, own: &str) -> Result<Vec<String>, ForeignId> {
        self.0.iter().map(|(key, value)| Ok(format!("{key} = {}", value.toml(names, own)?))).collect()
    }
}

impl Written {
    /// As TOML on one line, of the entry called `own`.
    ///
    /// # Errors
    /// If it contains an id of another builder.
    pub(crate) fn toml(&self, names: &IdNames, own: &str) -> Result<String, ForeignId> {
        Ok(match self {
            Self::Text(text) => quoted(text),
            Self::Number(number) if number.is_nan() => "nan".to_owned(),
            Self::Number(number) => number_text(*number),
            Self::Flag(flag) => flag.to_string(),
            Self::List(list) => {
                let entries: Result<Vec<String>, _> =
                    list.iter().map(|entry| entry.toml(names, own)).collect();
                format!("[{}]", entries?.join(", "))
            }
            Self::Fields(fields) => format!("{{ {} }}", fields.lines(names, own)?.join(", ")),
            Self::Named(named) => {
                let entry = |(NameOf(id), value): &(NameOf, Self)| {
                    Ok(format!("{} = {}", key(names.name(*id)?), value.toml(names, own)?))
                };
                format!("{{ {} }}", named.iter().map(entry).collect::<Result<Vec<_>, _>>()?.join(", "))
            }
            Self::Name(NameOf(id)) => quoted(names.name(*id)?),
            Self::Node(node) => quoted(&node_text(*node, names)?),
            Self::Expression(expression) => match expression.pieces() {
                Err(number) => Self::Number(number).toml(names, own)?,
                Ok(pieces) => quoted(&expression_text(pieces, names, own)?),
            },
        })
    }
}

fn node_text(node: Node, names: &IdNames) -> Result<String, ForeignId> {
    Ok(match node {
        Node(None) => "ground".to_owned(),
        Node(Some((part, at))) => {
            let name = names.name(part)?;
            match at {
                At::Itself => name.to_owned(),
                At::Start => format!("{name}.start"),
                At::End => format!("{name}.end"),
                At::Interface(interface) => format!("{name}.{interface}"),
                At::Fraction(fraction) => format!("{name}@{}", number_text(fraction)),
            }
        }
    })
}

fn expression_text(pieces: &[Piece], names: &IdNames, own: &str) -> Result<String, ForeignId> {
    let mut text = String::new();
    for piece in pieces {
        match piece {
            Piece::Text(words) => text.push_str(words),
            Piece::Name(id) => text.push_str(names.name(*id)?),
            Piece::Own => text.push_str(own),
        }
    }
    Ok(text)
}

impl From<f64> for Written {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<usize> for Written {
    fn from(number: usize) -> Self {
        Self::Number(number as f64)
    }
}

impl From<bool> for Written {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<String> for Written {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Fields> for Written {
    fn from(fields: Fields) -> Self {
        Self::Fields(fields)
    }
}

impl<T: Into<Written>, const N: usize> From<[T; N]> for Written {
    fn from(list: [T; N]) -> Self {
        Self::List(list.into_iter().map(Into::into).collect())
    }
}

impl<T: Into<Written>> From<Vec<T>> for Written {
    fn from(list: Vec<T>) -> Self {
        Self::List(list.into_iter().map(Into::into).collect())
    }
}

/// A station of a beam: a fraction of it and the section there.
impl<S: Into<AnyId>> From<(f64, S)> for Written {
    fn from((at, section): (f64, S)) -> Self {
        let mut fields = Fields::default();
        fields.set("at", at);
        fields.set("section", Self::Name(NameOf(section.into())));
        Self::Fields(fields)
    }
}
