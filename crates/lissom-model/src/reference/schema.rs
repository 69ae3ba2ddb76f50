//! The JSON schema of a model file, for editors that complete and check while one types. It is made of the same
//! descriptions the decoder reads, and of the registered kinds.

use serde_json::{Map, Value, json};

use crate::document::tables::variants;
use crate::format::keys::table_keys;
use crate::format::keys::{Key, Shape, direction, three_numbers};
use crate::format::part_tables::part_motion;
use crate::format::top_level::VERSION;
use crate::format::top_level::{Holds, Variant, tops};
use crate::registry::Registry;

/// The schema (JSON Schema, draft 2020-12) of the files that [`Document::parse`](crate::Document::parse) reads
/// with `registry`. The decoder alone checks conditions that a schema cannot express, such as the existence of a name.
pub fn schema(registry: &Registry) -> Value {
    let mut properties = Map::new();
    for top in tops() {
        let mut value = match &top.holds {
            Holds::Value(shape) => of_shape(shape),
            Holds::Values(shape) => json!({ "type": "object", "additionalProperties": of_shape(shape) }),
            Holds::Table => table(top.name, registry),
            Holds::Entries => {
                json!({ "type": "object", "additionalProperties": table(top.name, registry) })
            }
        };
        if top.name == "initial"
            && let Value::Object(object) = &mut value
        {
            object.insert("additionalProperties".to_owned(), of_keys(&part_motion()));
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
        return forms.all.first().map_or(json!({}), |form| of_keys(&form.keys));
    };
    // With if/then an editor shows the error in the chosen form, not that no form matches.
    let branch = |form: &Variant| {
        let mut then = of_keys(&form.keys);
        describe(&mut then, form.summary);
        json!({ "if": { "properties": { tag: { "const": form.word } } }, "then": then })
    };
    let branches: Vec<Value> = forms.all.iter().map(branch).collect();
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
        "required": [tag],
        "allOf": branches,
    })
}

fn of_keys(keys: &[Key]) -> Value {
    let mut properties = Map::new();
    for key in keys {
        let mut value = of_shape(&key.holds);
        let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
        describe(&mut value, &format!("{}{unit}", key.summary));
        properties.insert(key.name.to_owned(), value);
    }
    let required: Vec<&str> = keys.iter().filter(|key| key.required).map(|key| key.name).collect();
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

/// A number in a range, or an expression.
fn number(range: &Value) -> Value {
    let mut number = json!({ "type": "number" });
    if let (Value::Object(number), Value::Object(range)) = (&mut number, range) {
        number.extend(range.clone());
    }
    json!({ "anyOf": [number, { "type": "string", "minLength": 1 }] })
}

fn list(item: &Value, length: usize) -> Value {
    json!({ "type": "array", "items": item, "minItems": length, "maxItems": length })
}

fn matrix(size: usize) -> Value {
    list(&list(&number(&json!({})), size), size)
}

fn any_of(choices: &[Value]) -> Value {
    json!({ "anyOf": choices })
}

fn of_shape(shape: &Shape) -> Value {
    let plain = || number(&json!({}));
    let text = || json!({ "type": "string", "minLength": 1 });
    let vector = || list(&plain(), 3);
    match shape {
        Shape::Text => json!({ "type": "string" }),
        Shape::Version => json!({ "const": VERSION }),
        Shape::Number | Shape::Profile | Shape::Formula | Shape::Equation => plain(),
        Shape::Positive => number(&json!({ "exclusiveMinimum": 0 })),
        Shape::NotNegative => number(&json!({ "minimum": 0 })),
        Shape::Between(least, most) => number(&json!({ "minimum": least, "maximum": most })),
        Shape::Count(least, most) => number(&json!({ "type": "integer", "minimum": least, "maximum": most })),
        Shape::Flag => json!({ "type": "boolean" }),
        three_numbers!() => vector(),
        direction!() => any_of(&[vector(), json!({ "enum": ["x", "y", "z", "-x", "-y", "-z"] })]),
        Shape::Point => {
            let placed = json!({
                "type": "object",
                "properties": { "in": text(), "at": vector() },
                "required": ["in"],
                "additionalProperties": false,
            });
            any_of(&[vector(), placed])
        }
        Shape::Names | Shape::Nodes | Shape::Coordinates => {
            json!({ "type": "array", "minItems": 1, "items": text() })
        }
        Shape::Entries(table) => json!({ "$ref": format!("#/properties/{table}") }),
        Shape::Choice(words) => json!({ "enum": words }),
        Shape::Choices(words) => {
            json!({ "type": "array", "minItems": 1, "uniqueItems": true, "items": { "enum": words } })
        }
        Shape::Name(_) | Shape::Node => text(),
        Shape::Place | Shape::PlaceOrNode => any_of(&[text(), vector()]),
        Shape::Function | Shape::FunctionOf(_) | Shape::Size | Shape::Force(_) => {
            any_of(&[plain(), of_keys(&table_keys())])
        }
        Shape::Signal => any_of(&[plain(), of_keys(&Shape::signal_keys())]),
        Shape::Axes => list(&vector(), 2),
        Shape::Mass => any_of(&[number(&json!({ "exclusiveMinimum": 0 })), of_keys(&Shape::density_keys())]),
        Shape::Inertia => any_of(&[vector(), matrix(3), of_keys(&Shape::solid_keys())]),
        Shape::Solid => {
            let solid = of_keys(&Shape::drawn_keys());
            any_of(&[solid.clone(), json!({ "type": "array", "minItems": 1, "items": solid })])
        }
        Shape::Latch => of_keys(&Shape::latch_keys()),
        Shape::Friction => of_keys(&Shape::friction_keys()),
        Shape::Stiffness => any_of(&[list(&plain(), 6), matrix(6)]),
        Shape::SectionMass => any_of(&[list(&plain(), 6), matrix(6), of_keys(&Shape::slice_mass_keys())]),
        Shape::Shear => any_of(&[plain(), list(&plain(), 2)]),
        Shape::Stations => {
            json!({ "type": "array", "minItems": 2, "items": of_keys(&Shape::station_keys()) })
        }
        Shape::Places => json!({ "type": "array", "minItems": 2, "items": of_keys(&Shape::place_keys()) }),
        Shape::Interfaces => {
            json!({ "type": "array", "minItems": 1, "items": of_keys(&Shape::interface_keys()) })
        }
        Shape::Rows => json!({ "type": "array", "minItems": 2, "items": list(&plain(), 2) }),
        Shape::NumberRows => {
            let row = json!({ "type": "array", "minItems": 2, "items": plain() });
            json!({ "type": "array", "minItems": 2, "items": row })
        }
        Shape::Pair | Shape::Range => list(&plain(), 2),
        Shape::Words => list(&text(), 2),
        Shape::Numbers => json!({ "type": "array", "minItems": 1, "items": plain() }),
        Shape::SquareMatrix => {
            let row = json!({ "type": "array", "minItems": 1, "items": plain() });
            any_of(&[plain(), row.clone(), json!({ "type": "array", "minItems": 1, "items": row })])
        }
        Shape::Table => json!({ "type": "object" }),
    }
}
