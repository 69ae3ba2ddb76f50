//! The JSON schema of a model file, for editors that complete and check while one types. It is made of the same
//! descriptions the decoder reads, and of the registered kinds.

use serde_json::{Map, Value, json};

use crate::document::tables::variants;
use crate::format::part_tables::part_motion;
use crate::format::top_level::{Holds, Variant, tops};
use crate::format::value_types::{any_of, schema_of_keys};
use crate::registry::Registry;

/// The schema (JSON Schema, draft 2020-12) of the files that [`Document::parse`](crate::Document::parse) reads
/// with `registry`. The decoder alone checks conditions that a schema cannot express, such as the existence of a name.
pub fn schema(registry: &Registry) -> Value {
    let mut properties = Map::new();
    for top in tops() {
        let mut value = match &top.holds {
            Holds::Value(shape) => shape.value_type().schema,
            Holds::Values(shape) => {
                json!({ "type": "object", "additionalProperties": shape.value_type().schema })
            }
            Holds::Table => table(top.name, registry),
            Holds::Entries => {
                json!({ "type": "object", "additionalProperties": table(top.name, registry) })
            }
        };
        if top.name == "initial"
            && let Value::Object(object) = &mut value
        {
            object.insert("additionalProperties".to_owned(), schema_of_keys(&part_motion()));
        }
        describe(&mut value, top.summary);
        properties.insert(top.name.to_owned(), value);
    }
    let required: Vec<&str> = tops().filter(|top| top.required).map(|top| top.name).collect();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Lissom model",
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn describe(value: &mut Value, words: &str) {
    if let Value::Object(object) = value {
        object.insert("description".to_owned(), json!(words));
    }
}

/// A table: one form, or one of several chosen by a word.
fn table(name: &str, registry: &Registry) -> Value {
    let forms = variants(name, registry);
    let Some(tag) = forms.tag else {
        return forms.all.first().map_or(json!({}), |form| schema_of_keys(&form.keys));
    };
    // With if/then an editor shows the error in the chosen form, not that no form matches.
    let branch = |form: &Variant| {
        let mut then = schema_of_keys(&form.keys);
        describe(&mut then, form.summary);
        json!({ "if": { "properties": { tag: { "const": form.word } }, "required": [tag] }, "then": then })
    };
    let mut branches: Vec<Value> = forms.all.iter().map(branch).collect();
    if forms.is_inferred {
        branches.push(
            json!({ "if": { "not": { "required": [tag] } }, "then": schema_of_keys(&forms.merged_keys()) }),
        );
    }
    let words = json!({ "enum": forms.words() });
    let choice = if name == "sections" {
        // Its dimensions may be within.
        any_of(&[
            words.clone(),
            json!({ "type": "object", "properties": { "kind": words }, "required": ["kind"] }),
        ])
    } else {
        words
    };
    json!({
        "type": "object",
        "properties": { tag: choice },
        "required": if forms.is_inferred { vec![] } else { vec![tag] },
        "allOf": branches,
    })
}
