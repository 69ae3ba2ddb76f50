//! Tests of `commands::study::convergence`, a module of it.

use super::*;

#[test]
fn references_are_read() {
    let (scheme, step) = parse_reference("hht(-0.3) : 1e-5").unwrap();
    assert_eq!((scheme.as_str(), step.as_str()), ("hht(-0.3)", "1e-5"));
    for wrong in ["radau-iia", ":1e-4", "radau-iia:"] {
        assert!(parse_reference(wrong).is_err(), "{wrong}");
    }
}
