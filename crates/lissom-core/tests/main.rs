//! All tests of the crate that need no process of their own, in one program: it is linked once.

#[path = "../../lissom-system/tests/derivatives/configuration.rs"]
#[expect(dead_code, reason = "the tests of the system use the rest")]
mod configuration;
mod constraints;
mod dynamics;
mod house_rules;
mod mobility;
#[path = "../../lissom-system/tests/derivatives/ports.rs"]
#[expect(dead_code, reason = "the tests of the system use the rest")]
mod ports;
mod prose;
mod words;
