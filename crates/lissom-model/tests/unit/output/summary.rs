//! Tests of `output::summary`, a module of it.

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
