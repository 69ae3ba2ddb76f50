//! Numbers in other units and other slips that a model file may contain without being wrong.

use lissom::Model;

use crate::support::refused::refused;
use crate::support::runs::session;

/// A pendulum on the ground, of two bodies.
const PENDULUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.arm]
mass = 2
inertia = [0.02, 0.02, 0.02]
position = [0.5, 0, 0]
[bodies.bob]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [1, 0, 0]
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "arm"
axis = "y"
at = [0, 0, 0]
[joints.elbow]
kind = "revolute"
base = "arm"
tip = "bob"
axis = "y"
at = [1, 0, 0]
[analysis]
kind = "dynamics"
end = 1
"#;

fn warnings(text: &str) -> String {
    let text = Model::from_text("model.toml", text).document().unwrap().warnings.render(false);
    text.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

#[test]
fn slips_are_named_with_the_unit_that_is_read() {
    assert_eq!(warnings(PENDULUM), "");
    let material = |modulus: &str, density: &str| {
        format!("[materials.steel]\nE = {modulus}\nnu = 0.3\ndensity = {density}\n[bodies.arm]")
    };
    let drive =
        "[joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"hinge\"\nrotation = \"360*t\"\n[analysis]";
    for (from, to, words) in [
        ("-9.81", "-9810", "gravity is 9810 m/s²"),
        ("[bodies.arm]", &*material("2.1e11", "7.85e-9"), "density of 7.85e-9 kg/m³"),
        (
            "[0.02, 0.02, 0.02]",
            "[2e4, 2e4, 2e4]",
            "body `arm` of 2 kg has an inertia as if its mass were 100.000 m from its centre",
        ),
        ("position = [1, 0, 0]", "position = [1000, 0, 0]", "and the heaviest, `arm`, has 2 kg"),
        ("at = [1, 0, 0]", "at = [1000, 0, 0]", "`elbow` is 999.500 m from `arm`, which it holds"),
        ("[analysis]", drive, "`motor` turns by 57.3 revolutions per second: angles are in radians"),
    ] {
        let found = warnings(&PENDULUM.replacen(from, to, 1));
        assert!(found.contains(words), "{words}: {found}");
    }
}

/// Numbers of the fields beside mechanics, each in the unit that is used there.
#[test]
fn numbers_in_units_of_the_trade_are_named() {
    let tank = "[hydraulics.tank]\nkind = \"pressure\"\n[hydraulics.supply]\nkind = \"pressure\"\npressure = 160e5\n";
    let valve = "[hydraulics.orifice]\nkind = \"orifice\"\na = \"supply\"\nb = \"tank\"\nrated_flow = 5e-4\nrated_drop = 35e5\n";
    let tyre = "[springs.tyre]\nkind = \"tyre\"\nbase = \"ground\"\ntip = \"bob\"\nnormal = [0, 0, 1]\nwheel_axis = [0, 1, 0]\nat_base = [0, 0, -0.3]\n\
        radius = 0.31\nstiffness = 2e5\nslip_stiffness = 20\ncornering_stiffness = 15\n";
    let rope = "[springs.rope]\nkind = \"rope\"\nalong = [{ on = \"ground\", at = [1, 0, 2] }, { on = \"bob\" }]\nstiffness = 1e5\n";
    let signal = "[signals.sampled]\nvalue = \"hinge.angle\"\nsample = 0.01\n";
    let model = format!("{PENDULUM}{tank}{valve}{tyre}{rope}{signal}");
    assert_eq!(warnings(&model), "");
    for (from, to, words) in [
        ("160e5", "160", "`pressure` of hydraulic part `supply` is 160 Pa, usual is 1000 to 1e9"),
        ("rated_flow = 5e-4", "rated_flow = 30", "is 30 m³/s, usual is at most 1"),
        ("rated_drop = 35e5", "rated_drop = 35", "`rated_drop` of hydraulic part `orifice` is 35 Pa"),
        ("radius = 0.31", "radius = 310", "`radius` of spring `tyre` is 310 m"),
        ("stiffness = 2e5", "stiffness = 200", "convert it if it is in N/mm"),
        (
            "cornering_stiffness = 15",
            "cornering_stiffness = 60000",
            "in N/rad, and not over the normal force",
        ),
        ("stiffness = 1e5", "damping = 10", "rope `rope` has no `stiffness`: it carries nothing"),
        ("sample = 0.01", "sample = 10", "`sampled` is sampled every 10 s, and the motion ends at 1 s"),
    ] {
        let found = warnings(&model.replacen(from, to, 1));
        assert!(found.contains(words), "{words}: {found}");
    }
}

/// A worm whose wheel has more inertia than it can stop: I₁ + (2 - 1/η) I₂ r² < 0.
#[test]
fn a_worm_that_jams_is_named() {
    let shaft = |name: &str, inertia: f64| {
        format!(
            "[bodies.{name}]\nmass = 1\ninertia = [{inertia}, {inertia}, {inertia}]\n[joints.of_{name}]\nkind = \"revolute\"\nbase = \"ground\"\n\
             tip = \"{name}\"\naxis = \"z\"\n"
        )
    };
    let gear = |efficiency: f64| {
        format!(
            "lissom = 1\n{}{}[joints.worm]\nkind = \"gear\"\njoint = \"of_a\"\nother = \"of_b\"\nratio = 0.1\nefficiency = {efficiency}\n\
             [loads.drive]\nkind = \"joint_torque\"\njoint = \"of_a\"\ntorque = 1\n[analysis]\nkind = \"dynamics\"\nend = 1\n",
            shaft("a", 0.001),
            shaft("b", 10.0)
        )
    };
    // 1/(2 + 0.001/0.1)
    let found = warnings(&gear(0.49));
    assert!(found.contains("gear `worm` jams") && found.contains("above 0.498"), "{found}");
    assert_eq!(warnings(&gear(0.499)), "");
}

/// Whatever the kinds of its joints; an equation may begin to move them later.
#[test]
fn a_model_without_a_cause_of_motion_is_named() {
    let law =
        |equation: &str| format!("[joints.law]\nkind = \"equation\"\nequation = \"{equation}\"\n[analysis]");
    let weightless = PENDULUM.replace("gravity = [0, 0, -9.81]", "");
    for (from, to, is_named) in [
        ("axis", "axis", true),
        ("kind = \"revolute\"\nbase = \"arm\"", "kind = \"screw\"\nlead = 0.01\nbase = \"arm\"", true),
        ("[analysis]", &law("hinge.angle + elbow.angle"), true),
        ("[analysis]", &law("hinge.angle - 1 + cos(t)"), false),
    ] {
        let session = session(&weightless.replace(from, to), &[]);
        let found = session.warnings().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert_eq!(found.contains("nothing sets the parts in motion"), is_named, "{to}: {found}");
    }
}

#[test]
fn a_hinge_at_the_centre_of_mass_and_points_in_body_axes_are_named() {
    let flap = "lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.flap]\nmass = 3\ninertia = [0.1, 0.2, 0.1]\nposition = [0, 2, 1]\n\
        [joints.hinge]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"flap\"\naxis = \"x\"\n\
        [analysis]\nkind = \"dynamics\"\nend = 1\n";
    let words = "joint `hinge` is at the centre of mass of `flap`: its weight has no moment there";
    assert!(warnings(flap).contains(words), "{}", warnings(flap));
    for (from, to) in [
        ("axis = \"x\"", "axis = \"x\"\nat = [0, 1.8, 1]"),
        ("axis = \"x\"", "axis = \"x\"\nrate = 3"),
        ("gravity = [0, 0, -9.81]", ""),
        ("[analysis]", "[loads.push]\nkind = \"force\"\non = \"flap\"\nvector = [0, 0, 1]\n[analysis]"),
    ] {
        assert_eq!(warnings(&flap.replacen(from, to, 1)), "", "{to}");
    }
    let output = |point: &str| {
        let entry = format!("[outputs.tip]\nkind = \"position\"\nof = \"flap\"\npoint = {point}\n[analysis]");
        warnings(
            &flap.replace("[analysis]", &entry).replace("axis = \"x\"", "axis = \"x\"\nat = [0, 1.8, 1]"),
        )
    };
    assert_eq!(output("[0, 2.3, 1]"), "");
    let found = output("[0, 0.3, 0]");
    assert!(found.contains("the point of output `tip` is 1.972 m from `flap`"), "{found}");
    assert!(found.contains("write `point = [0.000000, 2.300000, 1.000000]`"), "{found}");
}

/// A four-bar linkage with one hinge across the others moves nowhere, without violating anything.
#[test]
fn a_wrong_axis_in_a_loop_is_named() {
    let link =
        |name: &str, at: &str| format!("[bodies.{name}]\nmass = 1\ninertia = [1, 1, 1]\nposition = {at}\n");
    let hinge = |name: &str, base: &str, tip: &str, at: &str, axis: &str| {
        format!(
            "[joints.{name}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {at}\naxis = \"{axis}\"\n"
        )
    };
    let linkage = |axis: &str| {
        [
            "lissom = 1\ngravity = [0, -9.81, 0]\n".to_owned(),
            link("crank", "[0, 0.5, 0]"),
            link("rod", "[0.7, 1, 0]"),
            link("rocker", "[1.4, 0.5, 0]"),
            hinge("a", "ground", "crank", "[0, 0, 0]", "z"),
            hinge("b", "crank", "rod", "[0, 1, 0]", "z"),
            hinge("c", "rod", "rocker", "[1.4, 1, 0]", axis),
            hinge("d", "ground", "rocker", "[1.4, 0, 0]", "z"),
            "[analysis]\nkind = \"dynamics\"\nend = 0.1\n".to_owned(),
        ]
        .concat()
    };
    let of = |axis: &str| {
        let session = session(&linkage(axis), &[]);
        session.warnings().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    assert!(!of("z").contains("degrees of freedom"), "{}", of("z"));
    let found = of("y");
    assert!(
        found.contains("0 degrees of freedom: the axis of `c` is not parallel to those of `a`, `b`, `d`"),
        "{found}"
    );
}

/// Twelve kinks in each period of an oscillation: most steps end at one, and the load with the kinks is named.
#[test]
fn laws_that_end_most_steps_are_named() {
    let terms: Vec<String> = (1..=6).map(|k| format!("abs(z - {})", 0.03 * f64::from(k))).collect();
    let text = format!(
        "lissom = 1\n[bodies.a]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0.3]\n[springs.s]\nkind = \"point\"\n\
         base = \"ground\"\ntip = \"a\"\nat_base = [0, 0, -1]\nstiffness = 1000\nlength = 1\n[local_loads.wind]\non = \"a\"\n\
         axes = \"global\"\nvariables = {{ size = \"{}\" }}\nforce = [0, 0, \"1e-3*size\"]\n\
         [analysis]\nkind = \"dynamics\"\nend = 25\nrelative_tolerance = 1e-4\n",
        terms.join(" + ")
    );
    let mut session = session(&text, &[]);
    session.run().unwrap();
    let warnings = session.warnings().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(
        warnings.contains("steps ended at kinks or jumps of laws: variable `size` of local load `wind`"),
        "{warnings}"
    );
    let laws = session.simulation().laws_that_end_steps(5);
    assert!(laws.len() == 1 && laws[0].1 > 1000, "{laws:?}");
}

#[test]
fn a_slack_rope_is_named_with_its_slack() {
    let text = "lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.a]\nmass = 1\ninertia = [1, 1, 1]\n[springs.r]\nkind = \"rope\"\n\
                along = [{ on = \"ground\", at = [0, 0, 5] }, { on = \"a\", at = [0, 0, 0] }]\nstiffness = 1e4\nlength = LENGTH\n\
                [analysis]\nkind = \"dynamics\"\nend = 0.1\n";
    let of = |length: &str| {
        let session = session(&text.replace("LENGTH", length), &[]);
        session.warnings().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    assert!(of("18.1").contains("the rope on `a` is slack by 13.100 m"), "{}", of("18.1"));
    assert_eq!(of("5.1"), "");
    assert!(of("4.0").contains("the rope on `a` is stretched by 1.000 m"), "{}", of("4.0"));
}

#[test]
fn a_node_far_from_its_part_is_an_error() {
    let text = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n[solids.part]\nvolume = [\"u\", \"0.5*v\", \"0.2*w\"]\n\
        divisions = [2, 1, 1]\nmaterial = \"m\"\nsets = { p = { near = [50, 30, 80] } }\n[joints.foot]\nkind = \"clamp\"\n\
        base = \"ground\"\ntip = \"part.p\"\n[analysis]\nkind = \"statics\"\n";
    let found = refused(text);
    assert!(found.contains("the whole part is only 1.136 m large"), "{found}");
}
