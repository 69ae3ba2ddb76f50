//! Ordinary machines, whose parts act as their words say, or are rejected.

use crate::defects::results::{Results, model, near};
use crate::support::{Folder, lissom};

/// `lissom check` of a model with these options rejects it with these words.
fn rejected(file: &str, options: &[&str], words: &[&str]) {
    let folder = Folder::new(&format!("defects-rejected-{file}"));
    let model = model(file);
    let ended = lissom(&[&["check", model.as_str()], options].concat(), folder.path());
    assert_eq!(ended.code, 2, "{file} {options:?}: {}", ended.errors);
    for word in words {
        assert!(ended.errors.contains(word), "{file} {options:?} lacks `{word}`: {}", ended.errors);
    }
}

// Point masses.

/// What is clamped or linked has the motion of a body of negligible inertia.
#[test]
fn point_masses_are_carried() {
    let results = Results::clean("point-masses-carried.toml", &[]);
    for name in ["pod", "bob"] {
        for component in ["u1", "u2", "u3"] {
            let [point, body] = [1, 2].map(|k| results.column(&format!("{name}{k}.{component}")));
            assert!(component != "u3" || body.iter().any(|value| value.abs() > 0.2), "{name} moves");
            for (point, body) in point.iter().zip(&body) {
                near(&format!("{name}.{component}"), *point, *body, 1e-4);
            }
        }
    }
    results.assert_last("fixed", &["u1", "u2", "u3"], &[0.0; 3], 1e-12);
    results.assert_last("towed", &["u1", "u2", "u3"], &[0.016, 0.0, 0.0], 1e-9);
}

#[test]
fn point_masses_have_no_rotation() {
    let file = "point-mass-on-a-joint.toml";
    let rotation = ["point mass", "no rotation", "make it a body", "`distance`"];
    let two_axes = ["--set", "joints.pivot.second_axis=\"x\""];
    for kind in
        ["revolute", "prismatic", "cylindrical", "screw", "planar", "parallel_axes", "constant_velocity"]
    {
        let kind = format!("joints.pivot.kind=\"{kind}\"");
        let lead = ["--set", "joints.pivot.lead=0.1"];
        let lead = if kind.contains("screw") { &lead[..] } else { &[] };
        rejected(file, &[&["--set", kind.as_str()], lead].concat(), &rotation);
        let at_bob = ["--set", kind.as_str(), "--unset", "joints.pivot.at"];
        rejected(file, &[&at_bob, lead].concat(), &rotation);
    }
    for kind in ["universal", "perpendicular_axes"] {
        let kind = format!("joints.pivot.kind=\"{kind}\"");
        rejected(file, &[&["--set", kind.as_str()], &two_axes[..]].concat(), &rotation);
    }
    let generic = "joints.pivot={ kind = \"generic\", base = \"ground\", tip = \"bob\", locked = [\"x\", \"y\", \"rx\"] }";
    rejected(file, &["--set", generic], &rotation);
    // Away from the location, joints that leave the rotation free also need one.
    for kind in ["spherical", "point_on_line", "point_in_plane"] {
        let kind = format!("joints.pivot.kind=\"{kind}\"");
        let without_axis = ["--unset", "joints.pivot.axis"];
        let unset = if kind.contains("spherical") { &without_axis[..] } else { &[] };
        rejected(file, &[&["--set", kind.as_str()], unset].concat(), &["1.0000 m away", "no rotation"]);
    }
    // The axes of a base are those of a body.
    let base =
        ["--set", "joints.pivot={ kind = \"point_on_line\", base = \"bob\", tip = \"arm\", axis = \"x\" }"];
    rejected(file, &base, &rotation);
    let link = "joints.pivot={ kind = \"rigid_link\", base = \"other\", tip = \"bob\" }";
    rejected(file, &["--set", link], &["1.0000 m away", "`distance`"]);
    let turned =
        "joints.pivot={ kind = \"prescribed_motion\", base = \"ground\", tip = \"bob\", rx = \"0.1*t\" }";
    rejected(file, &["--set", turned], &["rotation of a point mass"]);
    for entry in [
        "loads.l={ kind = \"moment\", on = \"bob\", vector = [0, 1, 0] }",
        "loads.l={ kind = \"gyrostat\", on = \"bob\", axis = \"x\", inertia = 1, spin = 9 }",
        "loads.l={ kind = \"force\", on = \"bob\", at = [1, 0, 1], vector = [1, 0, 0] }",
        "loads.l={ kind = \"force\", on = \"bob\", vector = [1, 0, 0], follower = true }",
        "springs.s={ kind = \"bushing\", base = \"arm\", tip = \"bob\", stiffness = [1, 1, 1, 1, 1, 1] }",
        "springs.s={ kind = \"point\", base = \"arm\", tip = \"bob\", at_tip = [1, 0, 1], stiffness = 1 }",
        "springs.s={ kind = \"rope\", along = [{ on = \"ground\" }, { on = \"bob\", at = [1, 1, 1] }], stiffness = 1 }",
        "local_loads.l={ on = \"bob\", at = [1, 0, 1], force = [\"1\", \"0\", \"0\"] }",
        "local_loads.l={ on = \"bob\", moment = [\"1\", \"0\", \"0\"] }",
    ] {
        let distance = "joints.pivot={ kind = \"distance\", base = \"ground\", tip = \"bob\" }";
        rejected(file, &["--set", distance, "--set", entry], &["point mass", "no rotation"]);
    }
}

/// The results of a run that ends well with a warning that has these words.
fn warned(file: &str, options: &[&str], words: &[&str]) -> Results {
    let results = Results::of("run", file, &[options, &["--no-plots"]].concat());
    results.assert_done();
    for word in words {
        let errors = &results.ended.errors;
        assert!(errors.contains(word), "{file} lacks `{word}`: {errors}");
    }
    results
}

// Joints, tables and gears.

/// Per turn the follower rises to 10 mm at half a turn, and rests after 5.3 rad.
#[test]
fn cam_by_a_table_of_one_turn() {
    let file = "cam-by-a-table-of-one-turn.toml";
    warned(file, &[], &["beyond-table", "`lift`", "period"]);
    Results::clean(file, &["--set", "joints.lift.profile.extrapolation=\"constant\""]);
    let step =
        ["--set", "analysis.output_step=7.853981634e-3", "--set", "joints.lift.profile.period=\"2*pi\""];
    for more in [&[][..], &["--set", "joints.lift.profile.interpolation=\"spline\""]] {
        let results = Results::clean(file, &[&step[..], more].concat());
        let lift = results.column("y.displacement");
        // Records at eighths of a turn.
        for (k, lift) in lift.iter().enumerate().take(25) {
            let expected = [Some(0.0), None, None, None, Some(0.01), None, None, Some(0.0)][k % 8];
            if let Some(expected) = expected {
                near(&format!("record {k}"), *lift, expected, 4e-4);
            }
        }
    }
    let linear = ["--set", "joints.lift.profile.interpolation=\"linear\""];
    rejected(file, &[&step[2..], &linear].concat(), &["smooth", "spline"]);
    rejected(file, &["--set", "joints.lift.profile.period=5"], &["longer than its period"]);
}

#[test]
fn gear_on_two_housings() {
    let file = "gear-on-two-housings.toml";
    warned(file, &[], &["`sun_planet`", "`ground`", "`carrier`", "`equation`"]);
    Results::clean(file, &["--set", "joints.sun_planet.relative=true"]);
    let mesh =
        "joints.sun_planet={ kind = \"equation\", equation = \"18*(s.angle - c.angle) + 12*p.angle\" }";
    near("carrier", Results::clean(file, &["--set", mesh]).last("c.angle"), 3.0, 1e-6);
    // Housings that are fixed to each other.
    let fixed = "joints.c={ kind = \"clamp\", base = \"ground\", tip = \"carrier\" }";
    let unused = ["--unset", "joints.ring", "--unset", "outputs.c"];
    Results::clean(file, &[&["--set", fixed], &unused[..]].concat());
}

#[test]
fn stop_outside_its_range() {
    let file = "stop-outside-its-range.toml";
    warned(file, &[], &["beyond-stop", "`h.angle`"]);
    warned(file, &["--set", "springs.s.range=[0.5, inf]"], &["beyond-stop", "`h.angle`"]);
    Results::clean(file, &["--set", "springs.s.range=[-0.5, 1.0]"]);
    Results::clean(file, &["--set", "springs.s.range=[0.001, 1.0]"]);
}

/// The force of a spring reverses where its ends meet, unless it vanishes there.
#[test]
fn point_spring_through_zero() {
    let file = "point-spring-through-zero.toml";
    warned(file, &[], &["spring-through-zero", "`ground`", "`m`", "`axial`"]);
    Results::clean(file, &["--set", "springs.s.length=0"]);
    Results::clean(file, &["--set", "joints.rail.axis=\"y\""]);
}

// Parts and ropes.

/// The wind of the model, and with `axes = "part"` that of a part that is upside down.
#[test]
fn wind_in_a_part() {
    let file = "wind-in-a-part.toml";
    near("global", Results::clean(file, &[]).first("f.f3"), 10.0, 1e-9);
    let section = ["--set", "parts.p.local_loads.air.axes=\"section\""];
    near("section", Results::clean(file, &section).first("f.f3"), 10.0, 1e-9);
    let part = ["--set", "parts.p.local_loads.air.axes=\"part\""];
    near("part", Results::clean(file, &part).first("f.f3"), -10.0, 1e-9);
    let height = ["--set", "parts.p.local_loads.air.force=[0, 0, \"z\"]"];
    near("height", Results::clean(file, &height).first("f.f3"), 100.0, 1e-9);
    near("own height", Results::clean(file, &[part, height].concat()).first("f.f3"), 0.0, 1e-9);
}

#[test]
fn drum_and_its_bearing() {
    let file = "drum-and-its-bearing.toml";
    warned(file, &[], &["reaction of `axle`", "tension of `rope`"]);
    Results::clean(file, &["--set", "outputs.bearing.of=\"guide\""]);
}

#[test]
fn force_between_two_bodies() {
    Results::clean("force-between-two-bodies.toml", &[]);
}

#[test]
fn delay_below_every_step() {
    rejected("delay-below-every-step.toml", &[], &["1e-9 s requires 1e9 steps"]);
}

/// Against the rotation of the chain beyond each joint.
#[test]
fn positions_of_turned_frames() {
    for (shift, expected) in [
        ("0", [-0.486_989_065_307, -0.245_894_121_313, -0.481_449_404_179]),
        ("0.6", [-0.134_011_221_073, -0.730_490_822_720, -0.457_518_702_875]),
    ] {
        let shift = format!("joints.j0.displacement={shift}");
        let results = Results::clean("positions-of-turned-frames.toml", &["--set", &shift]);
        results.assert_last("p", &["x", "y", "z"], &expected, 1e-9);
    }
}

/// Counted from the model file, where the tip is at 10.5 m.
#[test]
fn displacement_after_steady_rotation() {
    let results = Results::clean("displacement-after-steady-rotation.toml", &[]);
    let [x, y, z] = ["x", "y", "z"].map(|name| results.first(&format!("place.{name}")));
    assert!(x.hypot(y) > 1e-3, "the tip is bent: {x} {y} {z}");
    for (name, expected) in [("tip.u1", x), ("tip.u2", y), ("tip.u3", z - 10.5)] {
        near(name, results.first(name), expected, 1e-12);
    }
}

// False words.

#[test]
fn driven_chain_statics() {
    let results = Results::clean("driven-chain-statics.toml", &[]);
    near("moment", results.last("m.moment"), -19.0145, 1e-3);
}
