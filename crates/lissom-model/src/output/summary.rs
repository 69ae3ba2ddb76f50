//! Result of a run as a JSON object: counts, times and norms by name, in the order of their insertion.

use serde::Serialize;
use serde_json::{Map, Value};

/// Facts about a run, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    facts: Map<String, Value>,
}

impl Summary {
    /// No facts.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds or replaces a fact. Numbers that are not finite become `null`, which is all that JSON has.
    ///
    /// # Errors
    /// If the value cannot be written as JSON, such as a map whose keys are not texts.
    pub fn insert(&mut self, name: &str, fact: impl Serialize) -> Result<(), serde_json::Error> {
        let value = serde_json::to_value(fact)?;
        self.facts.insert(name.to_owned(), value);
        Ok(())
    }

    /// A fact by name.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.facts.get(name)
    }

    /// The facts as an indented JSON text.
    pub fn to_json(&self) -> String {
        format!("{:#}\n", Value::Object(self.facts.clone()))
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/summary.rs"]
mod tests;
