//! Tests of `kinematics::subject`, a module of it.

use super::*;

#[test]
fn names_may_contain_what_sentences_are_made_of() {
    let subject = Subject::new("node", "a`; b = c").component("translation 1");
    assert_eq!(subject.to_string(), "translation 1 of node `a`; b = c`");
    assert_eq!(subject.entry(), Some("a`; b = c"));
    let both = Subject::list(vec![subject, Subject::new("joint", "j")]);
    assert_eq!(both.to_string(), "translation 1 of node `a`; b = c`, joint `j`");
    assert_eq!(both.entry(), Some("a`; b = c"));
    assert_eq!(Subject::nameless("a force").entry(), None);
}
