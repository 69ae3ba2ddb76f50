//! Tests of `sweep::sampling::normal`, a module of it.

use super::*;

#[test]
fn quantiles_are_those_of_tables() {
    let known = [
        (0.5, 0.0),
        (0.75, 0.674_489_750_196_081_7),
        (0.975, 1.959_963_984_540_054),
        (0.001, -3.090_232_306_167_813_5),
        (1e-10, -6.361_340_902_404_056),
        (1e-20, -9.262_340_089_798_408),
    ];
    for (u, x) in known {
        let found = normal_quantile(u);
        assert!((found - x).abs() <= 4e-15 * x.abs().max(1.0), "{u}: {found} for {x}");
    }
}
