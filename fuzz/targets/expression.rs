//! Expressions: whatever the text, it is read or refused with its place.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| lissom_fuzz::expression(text));
