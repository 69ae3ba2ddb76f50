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
mod tests {
    use super::*;

    #[test]
    fn facts_come_back() {
        let mut summary = Summary::new();
        summary.insert("steps", 800).unwrap();
        summary.insert("largest residual", 1.5e-12).unwrap();
        summary.insert("condition", f64::INFINITY).unwrap();
        summary.insert("events", vec!["a", "b"]).unwrap();
        let text = summary.to_json();
        let back: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(back["steps"], 800);
        assert_eq!(back["condition"], Value::Null);
        assert_eq!(summary.get("events").unwrap()[1], "b");
        assert!(text.ends_with("}\n") && text.lines().count() > 4);
    }
}
