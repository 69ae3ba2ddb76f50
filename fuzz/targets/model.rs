//! Model files: whatever the text, it is read or refused with a line.

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use lissom_model::lower::registry::registry;
use lissom_model::registry::Registry;

#[path = "../../crates/lissom-model/tests/support/answers.rs"]
#[allow(dead_code, reason = "the other target asks for the rest")]
mod answers;

static REGISTRY: LazyLock<Registry> = LazyLock::new(registry);

fuzz_target!(|text: &str| {
    if let answers::Answer::Badly(words) = answers::of_model(text, &REGISTRY) {
        panic!("{words}");
    }
});
