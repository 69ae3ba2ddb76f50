//! Tests of `reference::manual`, a module of it.

use lissom_mechanics::registry::DefaultValue;

use super::*;
use crate::format::keys::{Shape, table_keys};

#[test]
fn defaults_are_values_of_their_keys_and_not_prose() {
    let registry = crate::lower::registry::registry();
    let all = tops().flat_map(|top| variants(top.name, &registry).all).flat_map(|form| form.keys);
    let nested = [Shape::drawn_keys(), Shape::friction_keys(), Shape::signal_keys(), table_keys()];
    let mut found = 0;
    for key in all.chain(nested.into_iter().flatten()) {
        let prose = key.summary.split("default").skip(1);
        let is_number = |rest: &str| {
            rest.trim_start_matches([':', ' ', '`', '-']).starts_with(|c: char| c.is_ascii_digit())
        };
        assert!(!prose.into_iter().any(is_number), "{}: {}", key.name, key.summary);
        let Some(default) = key.default else { continue };
        found += 1;
        assert!(!key.required, "{} is required and has a default", key.name);
        let fits = match (&key.holds, default) {
            (Shape::Positive, DefaultValue::Number(number)) => number > 0.0,
            (Shape::NotNegative, DefaultValue::Number(number)) => number >= 0.0,
            (Shape::Between(least, most), DefaultValue::Number(number)) => (*least..=*most).contains(&number),
            (Shape::Count(least, most), DefaultValue::Number(number)) => {
                number.fract() == 0.0 && (*least as f64..=*most as f64).contains(&number)
            }
            (Shape::Choice(words), DefaultValue::Word(word)) => words.contains(&word),
            (Shape::Flag, DefaultValue::Flag(_)) => true,
            (holds, DefaultValue::Number(_)) => {
                !matches!(holds, Shape::Flag | Shape::Choice(_) | Shape::Text)
            }
            _ => false,
        };
        assert!(fits, "{}: {default} is not {}", key.name, key.holds.value_type().words);
    }
    assert!(found > 80, "only {found} keys have a default");
    // Friction of a joint is that of the element.
    let element = registry.springs.iter().find(|kind| kind.name == "torsional_friction").expect("it exists");
    for key in Shape::friction_keys().iter().filter(|key| key.default.is_some()) {
        let own = element.parameters.iter().find(|own| own.name == key.name).expect("the same names");
        assert_eq!(own.default, key.default, "{}", key.name);
    }
}

#[test]
fn every_word_of_the_format_is_in_the_manual() {
    const KIND: KindEntry = KindEntry {
        name: "revolute",
        summary: "Turns about an axis.",
        sample: "axis = [0, 0, 1]",
        parameters: &[],
        ports: lissom_mechanics::ports::Ports::AXIS,
    };
    const SCHEME: ChoiceEntry =
        ChoiceEntry { name: "radau-iia", summary: "Third order.", parameters: &[], tolerance: None };
    let registry = Registry { joints: vec![KIND], schemes: vec![SCHEME], ..Registry::default() };
    let text = manual(&registry);
    for top in tops() {
        assert!(text.contains(top.name) && text.contains(top.summary), "{}", top.name);
        for key in variants(top.name, &registry).all.iter().flat_map(|form| &form.keys) {
            assert!(text.contains(&format!("`{}", key.name)), "{} {}", top.name, key.name);
        }
    }
    for words in
        ["### `kind = \"revolute\"`", "Turns about an axis.", "- `radau-iia`: Third order.", "`smoothstep`"]
    {
        assert!(text.contains(words), "{words}");
    }
}
