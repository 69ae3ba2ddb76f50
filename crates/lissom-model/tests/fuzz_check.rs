//! Whatever is damaged in a model, `check` answers: the model is wrong, or it has so many freedoms.

use lissom_core::analysis::mobility::mobility;
use lissom_model::Document;
use lissom_model::lower::{lower, registry::registry};
use proptest::prelude::*;

const EXAMPLES: [&str; 5] = [
    include_str!("../../../examples/pendulum.toml"),
    include_str!("../../../examples/top.toml"),
    include_str!("../../../examples/tip-crank.toml"),
    include_str!("../../../examples/four-bar.toml"),
    include_str!("../../../examples/energy.toml"),
];

const STRANGERS: [&str; 18] = [
    "nan",
    "-inf",
    "1e400",
    "0",
    "-1",
    "1e-320",
    "1e308",
    "3",
    "-0",
    "\"\"",
    "\"t\"",
    "true",
    "[]",
    "\"ground\"",
    "\"beam@0.5\"",
    "\"tip\"",
    "start",
    "1e12",
];

fn check(text: &str) {
    let Ok(document) = Document::parse(text, "fuzz.toml", &registry()) else { return };
    match lower(&document) {
        Ok(lowered) => {
            let found = mobility(&lowered.system, &lowered.state);
            assert!(found.rank <= found.constraints && found.freedoms <= found.coordinates);
            assert_eq!(found.rank + found.redundant.len(), found.constraints);
            let mut values = Vec::new();
            for channel in &lowered.channels {
                channel.evaluate(&lowered.system, &lowered.state, &mut values);
            }
        }
        Err(report) => assert!(report.has_errors() && !report.render(false).is_empty()),
    }
}

/// Words and numbers on one side, everything else on the other.
fn tokens(text: &str) -> Vec<&str> {
    text.split_inclusive([' ', ',', '[', ']', '"', '\n', '=']).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn damaged_examples_are_checked(
        example in 0..EXAMPLES.len(),
        damages in proptest::collection::vec((any::<prop::sample::Index>(), 0..3_u8, 0..STRANGERS.len()), 1..3),
    ) {
        let mut tokens: Vec<String> = tokens(EXAMPLES[example]).into_iter().map(str::to_owned).collect();
        for (place, damage, stranger) in damages {
            let index = place.index(tokens.len());
            match damage {
                0 => drop(tokens.remove(index)),
                1 => tokens.insert(index, tokens[index].clone()),
                _ => {
                    let end = tokens[index].pop().map_or(String::new(), String::from);
                    tokens[index] = format!("{}{end}", STRANGERS[stranger]);
                }
            }
        }
        check(&tokens.concat());
    }
}
