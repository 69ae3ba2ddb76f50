//! Starts of motions.

use crate::support::runs::{SCHEMES, last, run};

/// A force that exists from the start on only, as that of a wind from a file: x = 50 (4/15 ((t + c)^(5/2) - c^(5/2)) - 2/3 c^(3/2) t).
#[test]
fn forces_may_begin_with_the_motion() {
    let text = "lissom = 1\n[bodies.b]\nmass = 2\ninertia = [1, 1, 1]\n[joints.j]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"b\"\n\
        axis = [1, 0, 0]\n[local_loads.air]\non = \"b\"\naxes = \"global\"\nforce = [\"100*sqrt(t + 0.001)\", 0, 0]\n\
        [outputs.b]\nkind = \"position\"\nof = \"b\"\n[analysis]\nkind = \"dynamics\"\nstep = 0.01\nend = 1\n";
    let c = 1e-3_f64;
    let exact = 50.0 * (4.0 / 15.0 * ((1.0 + c).powf(2.5) - c.powf(2.5)) - 2.0 / 3.0 * c.powf(1.5));
    for scheme in SCHEMES {
        let place = last(&run(text, &[("analysis.scheme", scheme)]), "b", "x");
        assert!((place / exact - 1.0).abs() < 1e-3, "{scheme}: {place}, {exact}");
    }
}
