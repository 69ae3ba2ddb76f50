//! Whatever is damaged in a model, `check` answers: the model is wrong, or it has so many degrees of freedom.

use lissom::start::lower;
use lissom_core::consistent::mobility::mobility;
use lissom_model::Document;
use lissom_model::lower::registry::registry;
use proptest::prelude::*;

use super::damage::{Damage, STRANGERS, tokens};

const EXAMPLES: [&str; 5] = [
    include_str!("../../../../examples/pendulum.toml"),
    include_str!("../../../../examples/top.toml"),
    include_str!("../../../../examples/tip-crank.toml"),
    include_str!("../../../../examples/four-bar.toml"),
    include_str!("../../../../examples/energy.toml"),
];

/// What may be in a model beside strangers that no model has.
const NUMBERS_AND_NAMES: [&str; 3] = ["3", "1e12", "\"tip\""];

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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn damaged_examples_are_checked(
        example in 0..EXAMPLES.len(),
        damages in proptest::collection::vec(
            (any::<prop::sample::Index>(), 0..6_u8, 0..STRANGERS.len() + NUMBERS_AND_NAMES.len()),
            1..3,
        ),
    ) {
        let strangers = [&STRANGERS[..], &NUMBERS_AND_NAMES].concat();
        let mut tokens = tokens(EXAMPLES[example]);
        for (place, damage, stranger) in damages {
            let index = place.index(tokens.len());
            let damage = match damage {
                0 => Damage::Remove,
                1 => Damage::Double,
                2 => Damage::Swap((index * 7 + stranger * 13) % tokens.len()),
                _ => Damage::Replace(strangers[stranger]),
            };
            damage.apply(&mut tokens, index);
        }
        check(&tokens.concat());
    }
}
