//! What the targets check: a text is read, or rejected with its position.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use lissom_model::lower::registry::registry;
use lissom_model::registry::Registry;

#[path = "../../crates/lissom-model/tests/support/answers.rs"]
mod answers;

use answers::Answer;

static REGISTRY: LazyLock<Registry> = LazyLock::new(registry);

/// A model file.
///
/// # Panics
/// If it is answered badly.
pub fn model(text: &str) {
    demand(answers::of_model(text, &REGISTRY));
}

/// An expression.
///
/// # Panics
/// If it is answered badly.
pub fn expression(text: &str) {
    let parameters = BTreeMap::from([("T".to_owned(), 1.6), ("k".to_owned(), -2.0)]);
    demand(answers::of_expression(text, &parameters));
}

fn demand(answer: Answer) {
    if let Answer::Badly(words) = answer {
        panic!("{words}");
    }
}
