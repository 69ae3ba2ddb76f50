//! Tests of `expression::smoothness`, a module of it.

use std::collections::BTreeMap;

use super::super::Formula;

#[test]
fn kinks_and_jumps_are_found_and_smooth_switches_pass() {
    let kink = |text: &str| Formula::parse(text, &BTreeMap::new()).unwrap().first_kink();
    for kinked in [
        "abs(x)",
        "y - max(0, x)",
        "max(x*y - 3, 0)",
        "abs(sin(3*x))",
        "if(x < 120, 0, 2)",
        "if(x < 1, 0, 2*(x - 1))",
        "1e6*x^2 + abs(x)",
        "x*sign(y - t)",
        "floor(x)",
        "mod(x, y)",
        "clamp(x, -1, 1)",
        "min(x, min(y, t))",
    ] {
        assert!(kink(kinked).is_some(), "{kinked}");
    }
    let at = kink("abs(x - 0.25)").unwrap();
    assert!((at.arguments[0] - 0.25).abs() < 1e-9);
    for smooth in [
        "x*y - t",
        "max(0, x)^3",
        "x*abs(x)",
        "if(x < 1, 0, (x - 1)^2)",
        "smoothstep(x - 0.5)",
        "if(x < 2, 4*(x - 1), x^2)",
        "y*max(0, t - 1)^2",
    ] {
        assert_eq!(kink(smooth), None, "{smooth}");
    }
}
