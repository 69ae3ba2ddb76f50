//! Expressions: whatever the text, it is read or refused with its place.

#![no_main]

use std::collections::BTreeMap;

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/lissom-model/tests/support/answers.rs"]
#[allow(dead_code, reason = "the other target asks for the rest")]
mod answers;

fuzz_target!(|text: &str| {
    let parameters = BTreeMap::from([("T".to_owned(), 1.6), ("k".to_owned(), -2.0)]);
    if let answers::Answer::Badly(words) = answers::of_expression(text, &parameters) {
        panic!("{words}");
    }
});
