//! Tests of `sections::torsion`, a module of it.

use super::*;

#[test]
fn known_values() {
    // Square of side a: J = 0.140 577 0 a⁴; 2 : 1: J = 0.228 68 h w³; a thin strip: h w³/3 (1 - 0.630 249 w/h).
    assert!((rectangle_torsion_constant(1.0, 1.0) - 0.140_577_0).abs() < 1e-7);
    assert!((rectangle_torsion_constant(2.0, 1.0) / 2.0 - 0.228_68).abs() < 1e-5);
    let strip = rectangle_torsion_constant(0.0025, 0.1);
    let wanted = 0.1 * 0.0025_f64.powi(3) / 3.0 * (1.0 - 0.630_248_876 * 0.025);
    assert!((strip / wanted - 1.0).abs() < 1e-8);
    assert_eq!(strip, rectangle_torsion_constant(0.1, 0.0025));
}
