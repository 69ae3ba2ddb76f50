//! Equilibria of solids.

use super::{BLOCK, CANTILEVER};
use crate::support::runs::{last, run, run_without_warnings};

/// St. Venant-Kirchhoff in tension: P = E λ (λ² - 1)/2, and across λ'² = 1 - ν (λ² - 1).
#[test]
fn a_uniform_stretch_is_exact() {
    let record = run_without_warnings(BLOCK, &[]);
    let stretch = 1.0 + last(&record, "end", "u1") / 2.0;
    let square = stretch * stretch - 1.0;
    assert!((0.5e6 * stretch * square / 1e5 - 1.0).abs() < 1e-9, "{stretch}");
    let across = (1.0 - 0.3 * square).sqrt();
    for component in ["u2", "u3"] {
        assert!((last(&record, "end", component) - (across - 1.0)).abs() < 1e-10);
    }
    assert!((last(&record, "middle", "u1") - 1.5 * (stretch - 1.0)).abs() < 1e-10);
    assert!((last(&record, "middle", "u3") - (across - 1.0)).abs() < 1e-10);
    // Force per present area.
    let stress = 1e5 / (across * across);
    for component in ["s11", "mises", "principal"] {
        assert!((last(&record, "stress", component) / stress - 1.0).abs() < 1e-9);
    }
    for component in ["s22", "s33", "s12", "s13", "s23"] {
        assert!(last(&record, "stress", component).abs() < 1e-9 * stress);
    }
    assert!((last(&record, "wall", "f1") + 1e5).abs() < 1e-4);
}

/// Rubber in tension by a half: P = μ (λ - λ⁻²) where it does not change its volume.
#[test]
fn rubber_has_the_stress_of_its_law() {
    let text = BLOCK
        .replace("material = \"soft\"", "material = \"soft\"\nmodel = \"neo-hookean\"")
        .replace("nu = 0.3", "nu = 0.4999");
    let record = run(&text.replace("[1e5, 0, 0]", "[3e5, 0, 0]"), &[]);
    let stretch = 1.0 + last(&record, "end", "u1") / 2.0;
    let shear = 1e6 / (2.0 * 1.4999);
    let law = shear * (stretch - 1.0 / (stretch * stretch));
    assert!(stretch > 1.3 && (law / 3e5 - 1.0).abs() < 1e-3, "{stretch}, {law}");
    let across = 1.0 + last(&record, "end", "u2");
    assert!((stretch * across * across - 1.0).abs() < 1e-3, "{across}");
}

/// P = 2 (c10 + c01/λ)(λ - λ⁻²) where rubber does not change its volume.
#[test]
fn the_second_constant_of_mooney_and_rivlin_softens_tension() {
    let text = BLOCK
        .replace("material = \"soft\"", "material = \"soft\"\nmodel = \"mooney-rivlin\"\nc01 = 5e4")
        .replace("nu = 0.3", "nu = 0.4999");
    let record = run(&text.replace("[1e5, 0, 0]", "[3e5, 0, 0]"), &[]);
    let stretch = 1.0 + last(&record, "end", "u1") / 2.0;
    let first = 1e6 / (4.0 * 1.4999) - 5e4;
    let law = 2.0 * (first + 5e4 / stretch) * (stretch - 1.0 / (stretch * stretch));
    assert!(stretch > 1.4 && (law / 3e5 - 1.0).abs() < 1e-3, "{stretch}, {law}");
}

/// A pressure on three sides follows their areas: the block shrinks equally by a pressure K (1 - J) of the law of volumes.
#[test]
fn pressure_acts_on_the_present_area() {
    let text = BLOCK
        .replace("material = \"soft\"", "material = \"soft\"\nmodel = \"neo-hookean\"\npressure = { east = 1e5, north = 1e5, top = \"1e5*t\" }")
        .replace("[loads.pull]\nkind = \"force\"\non = \"block.east\"\nvector = [1e5, 0, 0]\n", "");
    let record = run(&text, &[]);
    // p = K (1 - J), K = E/(3 (1 - 2 ν)).
    let volume: f64 = 1.0 - 1e5 / (1e6 / 1.2);
    let length = volume.cbrt();
    assert!(
        (last(&record, "end", "u1") - 2.0 * (length - 1.0)).abs() < 1e-8,
        "{}",
        last(&record, "end", "u1")
    );
    assert!((last(&record, "end", "u3") - (length - 1.0)).abs() < 1e-8);
    assert!((last(&record, "stress", "s11") + 1e5).abs() < 1e-3);
}

/// F l³/(3 E I) + F l/(κ G A), with κ = 5/6 and ν = 0, and the stress 6 M/(b h²).
#[test]
fn a_cantilever_bends_like_a_beam() {
    let record = run_without_warnings(CANTILEVER, &[]);
    let exact = 1000.0 / (3.0 * 1e6 / 12.0) + 10.0 / (5.0 / 6.0 * 0.5e6);
    let tip = last(&record, "tip", "u3");
    assert!((tip / exact - 1.0).abs() < 1e-3, "{tip}, {exact}");
    assert!((last(&record, "root", "f3") + 1.0).abs() < 1e-8);
    assert!((last(&record, "root", "m2") - 10.0).abs() < 0.01, "{}", last(&record, "root", "m2"));
    let stress = last(&record, "stress", "s11");
    assert!((stress / -30.0 - 1.0).abs() < 2e-3, "{stress}");
}

/// Without locking in bending for rubber, in one layer of elements too: E I is that of ν = 1/2.
#[test]
fn rubber_bends_as_softly_as_its_modulus_says() {
    let rubber = CANTILEVER
        .replace("nu = 0\n", "nu = 0.4999\n")
        .replace("material = \"soft\"", "material = \"soft\"\nmodel = \"neo-hookean\"");
    let exact = 1000.0 / (3.0 * 1e6 / 12.0) + 10.0 / (5.0 / 6.0 * 1e6 / 3.0);
    for (divisions, error) in [("[5, 1, 1]", 0.03), ("[10, 2, 2]", 0.02)] {
        let tip = last(&run(&rubber, &[("solids.bar.divisions", divisions)]), "tip", "u3");
        assert!((tip / exact - 1.0).abs() < error, "{divisions}: {tip}, {exact}");
    }
}

/// The torsion constant of a square is 0.1406 a⁴; both ends are held plane, which is stiffer by about 2 %.
#[test]
fn a_square_bar_is_twisted_as_by_saint_venant() {
    let text = CANTILEVER.replace(
        "[loads.end]\nkind = \"force\"\non = \"bar.east\"\nvector = [0, 0, 1]",
        "[bodies.end]\nmass = 1\ninertia = [1, 1, 1]\nposition = [10, 0.5, 0.5]\n[joints.end]\nkind = \"clamp\"\nbase = \"bar.east\"\ntip = \"end\"\n\
         [outputs.end]\nkind = \"rotation\"\nof = \"end\"\n[loads.twist]\nkind = \"moment\"\non = \"end\"\nvector = [10, 0, 0]",
    );
    let angle = last(&run(&text, &[]), "end", "r1");
    let exact = 10.0 * 10.0 / (0.1406 * 0.5e6);
    assert!((angle / exact - 0.98).abs() < 0.02, "{angle}, {exact}");
}

/// A thin cantilever whose end rises by two thirds of its length, as computed with fine meshes of shells: -3.290 and 6.700 m.
#[test]
fn a_thin_cantilever_bends_far() {
    let text = CANTILEVER
        .replace("size = [10, 1, 1]", "size = [10, 1, 0.1]")
        .replace("E = 1e6", "E = 1.2e6")
        .replace("vector = [0, 0, 1]", "vector = [0, 0, 4]")
        .replace("steps = 1", "steps = 4");
    let record = run(&text, &[("solids.bar.divisions", "[16, 1, 1]")]);
    let (along, up) = (last(&record, "tip", "u1"), last(&record, "tip", "u3"));
    assert!((along / -3.290 - 1.0).abs() < 5e-3 && (up / 6.700 - 1.0).abs() < 3e-3, "{along}, {up}");
}

/// A thick tube under internal pressure in plane strain [Lamé 1852]: quarter of radii 1 and 2 m.
#[test]
fn a_thick_tube_widens_as_by_lame() {
    let tube = |poisson: f64, model: &str, error: f64| {
        let text = format!(
            "lissom = 1\n[materials.m]\nE = 1e9\nnu = {poisson}\ndensity = 1000\n[solids.tube]\n\
             volume = [\"(1 + u)*cos(pi/2*v)\", \"(1 + u)*sin(pi/2*v)\", \"0.5*w\"]\ndivisions = [4, 6, 1]\nmaterial = \"m\"\n{model}\n\
             pressure = {{ west = 1e3 }}\n\
             [joints.x]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"tube.north\"\naxis = \"x\"\n\
             [joints.y]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"tube.south\"\naxis = \"y\"\n\
             [joints.bottom]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"tube.bottom\"\naxis = \"z\"\n\
             [joints.top]\nkind = \"point_in_plane\"\nbase = \"ground\"\ntip = \"tube.top\"\naxis = \"z\"\n\
             [outputs.inner]\nkind = \"displacement\"\nof = \"tube@0,0,0\"\n[outputs.outer]\nkind = \"displacement\"\nof = \"tube@1,0,0\"\n\
             [outputs.stress]\nkind = \"solid_stress\"\nof = \"tube@0.5,0,0\"\n[analysis]\nkind = \"statics\"\nend = 1\nsteps = 1\n"
        );
        let record = run(&text, &[]);
        // p a²(1 + ν)/(E (b² - a²)) ((1 - 2 ν) r + b²/r).
        let exact = |r: f64| 1e-6 * (1.0 + poisson) / 3.0 * ((1.0 - 2.0 * poisson) * r + 4.0 / r);
        for (place, r) in [("inner", 1.0), ("outer", 2.0)] {
            let found = last(&record, place, "u1");
            assert!((found / exact(r) - 1.0).abs() < error, "{poisson} {place}: {found:e}, {:e}", exact(r));
        }
        // p a²/(b² - a²) (1 ± b²/r²) at r = 1.5.
        let (radial, hoop) = (last(&record, "stress", "s11"), last(&record, "stress", "s22"));
        assert!((hoop - 1e3 / 3.0 * (1.0 + 4.0 / 2.25)).abs() < 20.0, "{hoop}");
        assert!((radial - 1e3 / 3.0 * (1.0 - 4.0 / 2.25)).abs() < 20.0, "{radial}");
    };
    tube(0.3, "", 2e-3);
    tube(0.4999, "model = \"neo-hookean\"", 3e-3);
}

/// Rotation of a body turns the nodes that are clamped to it.
#[test]
fn a_driven_body_carries_its_end() {
    let text = CANTILEVER.replace("base = \"ground\"", "base = \"hub\"").replace(
        "[loads.end]\nkind = \"force\"\non = \"bar.east\"\nvector = [0, 0, 1]",
        "[bodies.hub]\nmass = 1\ninertia = [1, 1, 1]\n[joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"hub\"\naxis = \"y\"\n\
         [joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"axle\"\nrotation = \"pi/2*t\"",
    );
    let record = run(&text, &[("analysis.steps", "4")]);
    // Without a load it stays straight and unstressed: from (10, 0.5, 0.5) to (0.5, 0.5, -10).
    assert!((last(&record, "tip", "u1") + 9.5).abs() < 1e-7, "{}", last(&record, "tip", "u1"));
    assert!((last(&record, "tip", "u3") + 10.5).abs() < 1e-7);
    assert!(last(&record, "stress", "mises") < 1e-3);
}

/// The weight of a curved solid acts at its centre of mass: a third of a ring, held at one end, of two elements. The centre of the interpolated
/// volume differs from that of the sector by what a parabola misses of an arc.
#[test]
fn the_weight_of_a_curved_solid_acts_at_its_centre() {
    let text = "lissom = 1\ngravity = [0, 0, -10]\n[materials.m]\nE = 2e11\nnu = 0.3\ndensity = 8000\n[solids.arc]\n\
                volume = [\"(1 + u)*cos(2*pi/3*v)\", \"(1 + u)*sin(2*pi/3*v)\", \"0.3*w\"]\ndivisions = [1, 2, 1]\nmaterial = \"m\"\n\
                [joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"arc.south\"\n[outputs.root]\nkind = \"reaction\"\nof = \"root\"\n\
                [analysis]\nkind = \"statics\"\nsteps = 1\n";
    let record = run(text, &[]);
    let angle = std::f64::consts::TAU / 3.0;
    let weight = 8000.0 * 10.0 * 0.3 * 0.5 * angle * 3.0;
    // First moments of the sector about the axes x and y, and of the moment about the middle of the clamped face at x = 1.5.
    let first = 8000.0 * 10.0 * 0.3 * (8.0 - 1.0) / 3.0;
    let (about_x, about_y) = (first * (1.0 - angle.cos()), first * angle.sin() - 1.5 * weight);
    let found = ["f3", "m1", "m2"].map(|component| last(&record, "root", component));
    assert!((found[0] / weight - 1.0).abs() < 3e-3, "{found:?}, {weight}");
    assert!((found[1] / about_x - 1.0).abs() < 5e-3, "{found:?}, {about_x}");
    assert!((found[2] / -about_y - 1.0).abs() < 5e-3, "{found:?}, {about_y}");
}

/// A block that is held along one edge can rotate about it, whatever the direction of its weight.
#[test]
fn a_solid_on_a_hinge_has_no_resistance() {
    for gravity in ["[3, 0, -9.81]", "[0, 0, -9.81]"] {
        let text = format!(
            "lissom = 1\ngravity = {gravity}\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 2000\n[solids.b]\nsize = [0.3, 0.7, 0.2]\n\
             divisions = [2, 3, 1]\nmaterial = \"m\"\n[solids.b.sets]\nedge = {{ from = [-1e-3, -1, -1e-3], to = [1e-3, 2, 1e-3] }}\n\
             [joints.hinge]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b.edge\"\n[outputs.u]\nkind = \"displacement\"\nof = \"b@1,1,1\"\n\
             [analysis]\nkind = \"statics\"\n"
        );
        let result =
            lissom::Model::from_text("model.toml", &text).session().map_err(|error| error.to_string());
        let message = match result {
            Ok(mut session) => session.run().expect_err("free to rotate").to_string(),
            Err(message) => message,
        };
        assert!(message.contains("no resistance"), "{message}");
    }
}

/// The same plate bends the same way under the same pressure on its upper face as a shell and as a solid.
#[test]
fn pressure_on_a_shell_and_a_solid_has_one_sign() {
    let rest = "material = \"m\"\n[joints.r]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"p.west\"\n[outputs.o]\nkind = \"displacement\"\n";
    let head = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0\ndensity = 1000\n";
    let shell = format!(
        "{head}[shells.p]\ncorners = [[0, 0, 0], [1, 0, 0], [1, 0.5, 0], [0, 0.5, 0]]\ndivisions = [8, 4]\nthickness = 0.05\npressure_on_top = 500\n{rest}of = \"p@1,0.5\"\n"
    );
    let solid = format!(
        "{head}[solids.p]\nsize = [1, 0.5, 0.05]\ndivisions = [8, 4, 1]\npressure = {{ top = 500 }}\n{rest}of = \"p@1,0.5,1\"\n"
    );
    // q L⁴/(8 E I).
    let expected = -500.0 / (8.0 * 1e9 * 0.05_f64.powi(3) / 12.0);
    for text in [shell, solid] {
        let record = run(&format!("{text}[analysis]\nkind = \"statics\"\nsteps = 1\n"), &[]);
        let found = last(&record, "o", "u3");
        assert!((found / expected - 1.0).abs() < 0.02, "{found}, {expected}");
    }
}

/// A bar of rubber that is twisted by half a turn: few steps however small its compressibility is, and the same moment.
#[test]
fn nearly_incompressible_rubber_takes_few_steps() {
    let bar = |poisson: &str| {
        format!(
            "lissom = 1\n[materials.rubber]\nE = 5e6\nnu = {poisson}\ndensity = 1000\n[solids.bar]\nsize = [1, 1, 6]\n\
             origin = [-0.5, -0.5, 0]\ndivisions = [2, 2, 6]\nmaterial = \"rubber\"\nmodel = \"neo-hookean\"\n\
             [joints.bottom]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"bar.bottom\"\n\
             [bodies.cap]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 6]\n\
             [joints.glue]\nkind = \"clamp\"\nbase = \"cap\"\ntip = \"bar.top\"\n\
             [joints.top]\nkind = \"prescribed_motion\"\nbase = \"ground\"\ntip = \"cap\"\nrz = \"pi*t\"\n\
             [outputs.bottom]\nkind = \"reaction\"\nof = \"bottom\"\n[analysis]\nkind = \"statics\"\nend = 1\n"
        )
    };
    let moments = ["0.49", "0.4999"].map(|poisson| {
        let record = run(&bar(poisson), &[]);
        assert!(record.times.len() < 20, "{poisson}: {} rows", record.times.len());
        last(&record, "bottom", "m3").abs()
    });
    // G J π/l for small angles, J = 0.1406 of a square.
    let small = 5e6 / (2.0 * 1.4999) * 0.1406 * std::f64::consts::PI / 6.0;
    assert!((moments[0] / moments[1] - 1.0).abs() < 0.02, "{moments:?}");
    assert!((0.9..1.2).contains(&(moments[1] / small)), "{moments:?} {small}");
}
