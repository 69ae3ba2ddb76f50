//! Whatever the text, the decoder reads the model or reports what is wrong, and never panics.

use crate::support;
use crate::support::answers;
use crate::support::damage;
use crate::support::damaged_expressions;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use lissom_model::Document;
use proptest::prelude::*;

use answers::Answer;
use damage::{Damage, STRANGERS, tokens};
use damaged_expressions::{damaged_expression, expression_words};

fn good_files() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good");
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|path| fs::read_to_string(path).unwrap()).collect()
}

/// Reads the text, shows the report, and looks at every span.
fn answer(text: &str, overrides: &[(String, String)]) {
    match Document::parse_with(text, "fuzz.toml", &support::registry(), overrides) {
        Ok(document) => {
            for beam in &document.beams {
                assert!(beam.line.length().is_finite() && beam.properties(&document, 0.5, 1.0).is_some());
                assert!(beam.frame(0.5).iter().all(|entry| entry.is_finite()));
            }
        }
        Err(report) => {
            assert!(report.has_errors());
            assert!(!report.render(false).is_empty());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn random_bytes_are_answered(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        answer(&String::from_utf8_lossy(&bytes), &[]);
    }

    #[test]
    fn random_lines_are_answered(text in "lissom = 1\n([\\[\\]a-z.=\"0-9{},\n ]{0,60}\n){0,5}") {
        answer(&text, &[]);
    }

    #[test]
    fn damaged_models_are_answered(
        file in 0..4_usize,
        damages in proptest::collection::vec((any::<prop::sample::Index>(), 0..4_u8, 0..STRANGERS.len()), 1..4),
    ) {
        let files = good_files();
        let mut tokens = tokens(&files[file % files.len()]);
        for (place, damage, stranger) in damages {
            if tokens.is_empty() {
                break;
            }
            let index = place.index(tokens.len());
            let damage = match damage {
                0 => Damage::Remove,
                1 => Damage::Double,
                2 => Damage::Swap((index * 7 + stranger * 13) % tokens.len()),
                _ => Damage::Replace(STRANGERS[stranger]),
            };
            damage.apply(&mut tokens, index);
        }
        let text = tokens.concat();
        answer(&text, &[]);
        let answered = answers::of_model(&text, &support::registry());
        prop_assert!(!matches!(answered, Answer::Badly(_)), "{answered:?}");
    }

    #[test]
    fn damaged_expressions_are_answered(draws in proptest::collection::vec(any::<u16>(), 64)) {
        let known = ["if(t < 1, -k*(arm.rotation - 0.5*sin(t))^2, max(1e-3, T))", "1.6*(1-cos(2*pi*t/1.6))"];
        let mut draws = draws.into_iter().cycle();
        let mut below = |count: usize| draws.next().map_or(0, usize::from) % count;
        let text = damaged_expression(&known.map(expression_words), &mut below);
        let answered = answers::of_expression(&text, &BTreeMap::from([("T".to_owned(), 1.6)]));
        prop_assert!(!matches!(answered, Answer::Badly(_)), "{text}: {answered:?}");
    }

    #[test]
    fn damaged_values_are_answered(
        file in 0..4_usize,
        place in any::<prop::sample::Index>(),
        stranger in 0..STRANGERS.len(),
    ) {
        // Only numbers are replaced, so that most of these texts are still TOML.
        let files = good_files();
        let mut tokens = tokens(&files[file % files.len()]);
        let numbers: Vec<usize> = (0..tokens.len()).filter(|index| tokens[*index].parse::<f64>().is_ok()).collect();
        Damage::Replace(STRANGERS[stranger]).apply(&mut tokens, numbers[place.index(numbers.len())]);
        answer(&tokens.concat(), &[]);
    }

    #[test]
    fn random_overrides_are_answered(path in "[a-z.\"]{0,12}|analysis\\.[a-z]{0,5}|beams\\.beam\\.[a-z]{1,8}", value in any::<String>()) {
        answer(&good_files()[3], &[(path, value)]);
    }
}

#[test]
fn deep_and_long_texts_are_answered() {
    let deep = format!("lissom = 1\na = {}{}", "[".repeat(50_000), "]".repeat(50_000));
    answer(&deep, &[]);
    answer(&format!("lissom = 1\n[{}]\n", "a.".repeat(50_000) + "b"), &[]);
    answer(&format!("lissom = 1\n[parameters]\na = \"{}\"", "(".repeat(100_000)), &[]);
    answer(&"[a]\n".repeat(10_000), &[]);
    let points: Vec<String> = (0..3000).map(|i| format!("p{i} = [0, 0]\n")).collect();
    answer(&format!("lissom = 1\n[points]\n{}", points.concat()), &[]);
}
