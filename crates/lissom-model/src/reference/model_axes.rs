//! Keys of a model file whose values are expressed in model axes, for tests and documentation.

use crate::document::tables::variants;
use crate::format::top_level::{Holds, has_named_entries, tops};
use crate::registry::Registry;

/// A form of an entry of a model file, with the keys whose values are transformed with the part in which it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryAxes {
    /// Table of the model file.
    pub table: &'static str,
    /// Kind or shape of the entry; empty in tables of one form.
    pub kind: &'static str,
    /// Keys whose values are expressed in model axes.
    pub keys: Vec<&'static str>,
}

/// All forms of entries that parts may contain.
pub fn model_axes(registry: &Registry) -> Vec<EntryAxes> {
    let mut all = Vec::new();
    for top in tops().filter(|top| has_named_entries(top.name) && !matches!(top.name, "parts" | "parameters"))
    {
        let table = top.name;
        if let Holds::Values(shape) = &top.holds {
            // The value has no separate key.
            let keys = if shape.is_in_model_axes() { vec![""] } else { Vec::new() };
            all.push(EntryAxes { table, kind: "", keys });
        }
        for variant in variants(table, registry).all {
            let in_model_axes = variant.keys.iter().filter(|key| key.holds.is_in_model_axes());
            all.push(EntryAxes {
                table,
                kind: variant.word,
                keys: in_model_axes.map(|key| key.name).collect(),
            });
        }
    }
    all
}
