//! Model files: whatever the text, it is read, or rejected with a line number.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| lissom_fuzz::model(text));
