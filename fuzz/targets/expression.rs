//! Expressions: whatever the text, it is read, or rejected with its position.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| lissom_fuzz::expression(text));
