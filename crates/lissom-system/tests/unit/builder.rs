//! Tests of `builder`, a module of it.

use super::*;

/// A contribution that was built before other coordinates were added would act on the wrong coordinates.
#[test]
#[should_panic(expected = "the model that it was made for")]
fn contributions_are_added_to_the_model_they_were_made_for() {
    let mut builder = Builder::new();
    let mut early = Contribution::to(builder.model());
    early.add_state("early".to_owned(), 0.0, 1.0);
    builder.add_state("late", 0.0, 1.0);
    builder.add(early);
}
