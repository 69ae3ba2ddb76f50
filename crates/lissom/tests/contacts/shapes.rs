//! Contacts of solids with edges, outlines, meshes and height fields; resistance to rolling.

use lissom::Record;

use crate::support::refused::refused;
use crate::support::runs::run;
use crate::support::series::{last, series};

/// A body that falls on the ground, with their shapes.
fn falling(ground: &str, shape: &str, rest: &str) -> String {
    format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {ground}\n[bodies.part]\nmass = 1\n\
         inertia = [0.004, 0.004, 0.004]\nshape = {shape}\n{rest}\n[contacts.floor]\nbase = \"ground\"\ntip = \"part\"\n\
         stiffness = 1e5\n[outputs.floor]\nkind = \"contact_force\"\nof = \"floor\"\n[outputs.energy]\nkind = \"energy\"\n\
         [outputs.part]\nkind = \"position\"\nof = \"part\"\n[analysis]\nkind = \"dynamics\"\nend = 2\n"
    )
}

fn largest(record: &Record, column: &str) -> f64 {
    series(record, column).iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// Boxes, hulls and capsules fall on a box, lose energy only, and rest on it.
#[test]
fn solids_with_edges_come_to_rest_on_each_other() {
    let pose = "position = [0, 0, 0.3]\nrotation = [0.3, 0.4, 0.1]";
    let points = "[[0.1, 0, -0.05], [-0.06, 0.08, -0.05], [-0.06, -0.08, -0.05], [0, 0, 0.1]]";
    for shape in [
        "{ box = [0.2, 0.2, 0.1] }".to_owned(),
        format!("{{ kind = \"hull\", points = {points} }}"),
        "{ kind = \"capsule\", radius = 0.04, length = 0.2, axis = \"x\" }".to_owned(),
    ] {
        let text = falling("{ box = [1, 1, 0.1], position = [0, 0, -0.05] }", &shape, pose).replace(
            "stiffness = 1e5",
            "stiffness = 1e5\nrestitution = 0.3\nfriction = 0.5\nrolling_friction = 0.002",
        );
        let record = run(&text, &[]);
        let start = series(&record, "energy.total")[0];
        assert!(largest(&record, "energy.total") < start * (1.0 + 1e-5), "{shape}");
        assert!(
            (last(&record, "floor.normal") - 9.81).abs() < 1e-3,
            "{shape} {}",
            last(&record, "floor.normal")
        );
        let z = last(&record, "part.z");
        assert!(z > 0.03 && z < 0.12 && last(&record, "floor.gap") > -1e-3, "{shape} {z}");
    }
}

/// Where edges cross, boxes touch once, between the directions of their faces.
#[test]
fn crossing_edges_touch_once() {
    let quarter = std::f64::consts::FRAC_PI_4;
    let ground = format!("{{ box = [1, 0.1, 0.1], rotation = [{quarter}, 0, 0] }}");
    // The distance of the edges when they touch, of which rounding takes a part.
    let (half, rounding) = (0.05_f64, 0.002_f64);
    let touching = 2.0 * ((half - rounding) * 2.0_f64.sqrt() + rounding);
    let pose = format!("position = [0, 0, {}]\nrotation = [0, {quarter}, 0]\n", touching - 2e-5);
    let text = falling(&ground, "{ box = [0.1, 1, 0.1] }", &pose)
        .replace("[contacts.floor]", "[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"part\"\naxis = \"z\"\n[contacts.floor]")
        .replace("kind = \"dynamics\"\nend = 2", "kind = \"statics\"");
    let record = run(&text, &[]);
    // An edge of the one, at both.
    let depth = 9.81 / 1e5;
    assert!((last(&record, "floor.normal") - 9.81).abs() < 1e-6);
    assert!((last(&record, "floor.gap") + depth).abs() < 1e-3 * depth, "{}", last(&record, "floor.gap"));
    assert!((touching - last(&record, "part.z") - depth).abs() < 1e-9, "{}", last(&record, "part.z"));
}

/// A ball rolls and spins against moments in proportion to the normal force.
#[test]
fn rolling_and_torsional_friction_stop_a_ball() {
    let (lever, radius) = (0.005, 0.1);
    let rest = "position = [0, 0, 0.0999902]\nvelocity = [1, 0, 0]\nangular_velocity = [0, 10, 0]";
    let text = falling("{ kind = \"plane\" }", "{ sphere = 0.1 }", rest)
        .replace(
            "stiffness = 1e5",
            "stiffness = 1e6\ndissipation = 1\nfriction = 0.5\nrolling_friction = 0.005",
        )
        .replace("end = 2", "end = 4");
    let record = run(&text, &[]);
    // m a = -F,  J α = F R - N ρ,  a = α R: with J = 2/5 m R².
    let slowing = 9.81 * lever / radius / 1.4;
    let wanted = 0.5 / slowing;
    let found = last(&record, "part.x");
    assert!((found - wanted).abs() < 2e-3 * wanted, "{found} {wanted}");
    assert!((last(&record, "energy.kinetic")).abs() < 1e-12, "{}", last(&record, "energy.kinetic"));

    let spinning = text
        .replace("velocity = [1, 0, 0]\nangular_velocity = [0, 10, 0]", "angular_velocity = [0, 0, 5]")
        .replace("rolling_friction = 0.005", "torsional_friction = 0.005")
        .replace("end = 4", "end = 0.2");
    let record = run(&format!("{spinning}[outputs.spin]\nkind = \"angular_velocity\"\nof = \"part\"\n"), &[]);
    let wanted = 5.0 - 0.2 * 9.81 * 0.005 / 0.004;
    assert!((last(&record, "spin.w3") - wanted).abs() < 5e-3, "{} {wanted}", last(&record, "spin.w3"));
}

/// A rattleback reverses its spin in one direction and keeps it in the other.
#[test]
fn a_rattleback_reverses() {
    let stone = "{ kind = \"ellipsoid\", semi_axes = [0.2, 0.03, 0.02] }";
    let of = |spin: f64| {
        let text = falling("{ kind = \"plane\" }", stone, "position = [0, 0, 0.02]")
            .replace(
                "inertia = [0.004, 0.004, 0.004]",
                "inertia = [[0.002, -8e-4, 0], [-8e-4, 0.016, 0], [0, 0, 0.017]]",
            )
            .replace(
                "position = [0, 0, 0.02]",
                &format!("position = [0, 0, 0.02]\nangular_velocity = [0, 0.1, {spin}]"),
            )
            .replace("stiffness = 1e5", "stiffness = 1e6\ndissipation = 1\nfriction = 1")
            .replace("end = 2", "end = 8");
        let record = run(&format!("{text}[outputs.spin]\nkind = \"angular_velocity\"\nof = \"part\"\n"), &[]);
        assert!(largest(&record, "energy.total") < series(&record, "energy.total")[0] * (1.0 + 1e-5));
        last(&record, "spin.w3")
    };
    let (reversed, kept) = (of(-5.0), of(5.0));
    assert!(reversed > 4.5 && kept > 4.5, "{reversed} {kept}");
}

/// A ball on a mesh, on a hull and on heights moves as on the solids that they are.
#[test]
fn meshes_hulls_and_heights_are_the_solids_that_they_describe() {
    let corners = "[[-0.5, -0.5, -0.1], [0.5, -0.5, -0.1], [-0.5, 0.5, -0.1], [0.5, 0.5, -0.1], [-0.5, -0.5, 0], \
                   [0.5, -0.5, 0], [-0.5, 0.5, 0], [0.5, 0.5, 0]]";
    let rest = "position = [0.3, 0.1, 0.3]\nvelocity = [0.6, 0.1, 0]";
    let of = |ground: &str| {
        let text = falling(ground, "{ sphere = 0.1 }", rest)
            .replace("stiffness = 1e5", "stiffness = 1e5\nrestitution = 0.7\nfriction = 0.3")
            .replace("end = 2", "end = 0.6");
        let record = run(&text, &[]);
        ["x", "y", "z"].map(|axis| last(&record, &format!("part.{axis}")))
    };
    let on_box = of("{ box = [1, 1, 0.1], position = [0, 0, -0.05] }");
    let on_hull = of(&format!("{{ kind = \"hull\", points = {corners} }}"));
    // Over its edge and down.
    assert!(on_box[0] > 0.6 && on_box[2] < 0.3, "{on_box:?}");
    for (one, other) in on_box.iter().zip(on_hull) {
        assert!((one - other).abs() < 1e-6, "{on_box:?} {on_hull:?}");
    }
    let plane = of("{ kind = \"plane\" }");
    let heights = of("{ kind = \"height_field\", extent = [9, 9], heights = [[0, 0, 0], [0, 0, 0]] }");
    for (one, other) in plane.iter().zip(heights) {
        assert!((one - other).abs() < 1e-6, "{plane:?} {heights:?}");
    }
}

/// A ball in a bowl of heights rolls to and fro without a gain of energy, and its period is that of the curvature.
#[test]
fn a_ball_swings_in_a_bowl_of_heights() {
    let rows: Vec<String> = (-10..=10)
        .map(|j| {
            let row: Vec<String> =
                (-10..=10).map(|i| format!("{}", f64::from(i * i + j * j) * 0.1 * 0.1 / 2.0 / 4.0)).collect();
            format!("[{}]", row.join(", "))
        })
        .collect();
    let ground = format!("{{ kind = \"height_field\", extent = [2, 2], heights = [{}] }}", rows.join(", "));
    // Radius of curvature 4 m: the centre of the ball moves on one of 3.9 m.
    let quarter = std::f64::consts::FRAC_PI_2 * (3.9_f64 / 9.81).sqrt();
    let text = falling(&ground, "{ sphere = 0.1 }", "position = [0.02, 0, 0.10005]")
        .replace("stiffness = 1e5", "stiffness = 1e6\ndissipation = 10")
        .replace("end = 2", &format!("end = {}", 3.0 * quarter));
    let record = run(&text, &[]);
    assert!(last(&record, "part.x").abs() < 3e-4, "{}", last(&record, "part.x"));
}

/// A cam of the profile 0.05 + 0.01 (1 - cos θ) with a roller.
fn cam(speed: f64, end: f64) -> String {
    let points: Vec<String> = (0..72)
        .map(|k| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(k) / 72.0).sin_cos();
            let radius = 0.05 + 0.01 * (1.0 - cosine);
            format!("[{}, {}]", radius * cosine, radius * sine)
        })
        .collect();
    format!(
        "lissom = 1\n[bodies.cam]\nmass = 1\ninertia = [1e-3, 1e-3, 1e-3]\nposition = [0, 0, 0]\n\
         shape = {{ kind = \"outline\", smooth = true, length = 0.02, points = [{}] }}\n\
         [bodies.follower]\nmass = 0.5\ninertia = [1e-4, 1e-4, 1e-4]\nshape = {{ cylinder = [0.01, 0.02] }}\n\
         position = [0.06, 0, 0]\n[joints.shaft]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"cam\"\naxis = \"z\"\n\
         [joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"shaft\"\nrotation = \"{speed}*t\"\n\
         [joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"follower\"\naxis = \"x\"\n\
         [springs.back]\nkind = \"axial\"\njoint = \"guide\"\nstiffness = 2000\npreload = 40\n\
         [contacts.cam]\nbase = \"cam\"\ntip = \"follower\"\nstiffness = 1e8\ndissipation = 1\n\
         [outputs.cam]\nkind = \"contact_force\"\nof = \"cam\"\n[outputs.follower]\nkind = \"position\"\nof = \"follower\"\n\
         [analysis]\nkind = \"dynamics\"\nend = {end}\n",
        points.join(", ")
    )
}

/// A roller follows a cam and leaves it above the speed at which its spring accelerates it less than the cam does.
#[test]
fn a_roller_follows_a_cam_until_it_lifts_off() {
    let half = std::f64::consts::PI / 20.0;
    let record = run(&cam(20.0, half), &[]);
    // On its top, at half a revolution.
    assert!((last(&record, "follower.x") - 0.08).abs() < 2e-6, "{}", last(&record, "follower.x"));
    // There its spring pulls with 40 N + 2000 N/m 0.02 m. The centre of the roller moves on the offset of the cam's curve, as the
    // slider of a crank from the cam's centre to that of curvature, e, with a rod of the radius of curvature ρ, and
    // x'' = -ω² (e + e²/ρ). The curvature of the cam is (r - r'')/r².
    let offset = 1.0 / (0.08 / 0.07 / 0.07) + 0.01;
    let eccentricity = 0.08 - offset;
    let acceleration = eccentricity + eccentricity * eccentricity / offset;
    let normal = |speed: f64| 80.0 - 0.5 * speed * speed * acceleration;
    let found = last(&record, "cam.normal");
    assert!((found - normal(20.0)).abs() < 0.02 * normal(20.0), "{found} {}", normal(20.0));
    let critical = (160.0 / acceleration).sqrt();
    for (speed, leaves) in [(0.9 * critical, false), (1.1 * critical, true)] {
        let record = run(&cam(speed, std::f64::consts::TAU / speed), &[]);
        let gap = largest(&record, "cam.gap");
        assert_eq!(gap > 1e-5, leaves, "{speed}: {gap}");
    }
}

/// The wheel of a Geneva drive turns by a quarter in each revolution of the crank, and waits in between.
#[test]
fn a_geneva_drive_turns_by_quarters() {
    let record = run(include_str!("../../../../examples/geneva-drive.toml"), &[]);
    let angles = series(&record, "wheel.angle");
    for (turn, time) in [(1.0, 1.5), (2.0, 3.1), (3.0, 4.7), (4.0, 6.1)] {
        let index = record.times.iter().position(|&own| own > time).expect("within the run");
        // The pin has a clearance of 0.2 mm on each side at 50 mm.
        let quarter = -turn * std::f64::consts::FRAC_PI_2;
        assert!((angles[index] - quarter).abs() < 0.01, "{time}: {} {quarter}", angles[index]);
    }
}

#[test]
fn wrong_shapes_are_rejected_with_a_remedy() {
    let ball = "{ sphere = 0.1 }";
    let plane = "{ kind = \"plane\" }";
    for (ground, shape, message) in [
        (
            "{ kind = \"hull\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] }",
            ball,
            "enclose no solid",
        ),
        ("{ kind = \"outline\", length = 1, points = [[0, 0], [1, 0]] }", ball, "enclose no area"),
        ("{ kind = \"height_field\", extent = [1, 1], heights = [[0, 0]] }", ball, "at least two rows"),
        ("{ kind = \"ellipsoid\", semi_axes = [1, 0, 1] }", ball, "is not a valid solid"),
        (
            "{ kind = \"ellipsoid\", semi_axes = [1, 2, 1] }",
            "{ kind = \"ellipsoid\", semi_axes = [1, 2, 1] }",
            "an ellipsoid against an ellipsoid is not available",
        ),
        ("{ kind = \"hull\", points = [[0, 0], [1, 0]] }", ball, "points"),
        (
            "{ kind = \"tube\", radius = 1, inner_radius = 0.5, length = 1 }",
            "{ box = [1, 1, 1] }",
            "is not available",
        ),
        (plane, plane, "a plane against a plane is not available"),
    ] {
        let found = refused(&falling(ground, shape, ""));
        assert!(found.contains(message), "{message}: {found}");
    }
}

/// `others` makes every two of several parts touch, as contacts of their own would.
#[test]
fn groups_are_all_their_pairs() {
    let ball = |name: &str, x: f64, v: f64| {
        format!(
            "[bodies.{name}]\nmass = 1\ninertia = {{ sphere = 0.1 }}\nposition = [{x}, {}, 0.1]\nvelocity = [{v}, 0, 0]\n\
             shape = {{ sphere = 0.1 }}\n[outputs.{name}]\nkind = \"velocity\"\nof = \"{name}\"\n",
            0.03 * x
        )
    };
    let law = "stiffness = 1e6\nexponent = 1.5\nrestitution = 0.8\nfriction = 0.3\n";
    let parts = format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {{ kind = \"plane\" }}\n{}{}{}[analysis]\nkind = \"dynamics\"\nend = 1\n",
        ball("a", -0.5, 2.0),
        ball("b", 0.0, 0.0),
        ball("c", 0.25, 0.0)
    );
    let names = ["ground", "a", "b", "c"];
    let pairs = (1..4).flat_map(|tip| (0..tip).map(move |base| (base, tip)));
    let each: Vec<String> = pairs
        .map(|(base, tip)| {
            format!("[contacts.p{base}{tip}]\nbase = \"{}\"\ntip = \"{}\"\n{law}", names[base], names[tip])
        })
        .collect();
    let group = format!("[contacts.all]\nbase = \"ground\"\ntip = \"a\"\nothers = [\"b\", \"c\"]\n{law}");
    let [of_each, of_group] = [each.concat(), group].map(|contacts| run(&format!("{parts}{contacts}"), &[]));
    for column in ["a.v1", "a.v2", "b.v1", "c.v1", "c.v2"] {
        let (one, other) = (last(&of_each, column), last(&of_group, column));
        assert!((one - other).abs() < 1e-9, "{column}: {one} {other}");
    }
    assert!(last(&of_group, "c.v1") > 0.5);
    let twice = format!("{parts}[contacts.all]\nbase = \"ground\"\ntip = \"a\"\nothers = [\"a\"]\n{law}");
    assert!(refused(&twice).contains("names `a` twice"), "{}", refused(&twice));
}
