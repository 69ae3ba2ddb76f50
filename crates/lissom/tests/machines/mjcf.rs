//! Robots from MJCF files against closed forms: frames, masses of shapes, every kind of joint and what resists it, joints of
//! several coordinates; what is omitted and what is rejected.

use std::f64::consts::PI;

use lissom::exchange::import::{
    LinkInertia, Options, Pose, Robot, Root, Unsupported, from_description, model_text, omissions,
};
use lissom_motion::{Matrix3, Motion, Rotation, Vector3};

use crate::support::runs::{column, last, run};

const SHORT: [(&str, &str); 2] = [("analysis.end", "1e-3"), ("analysis.step", "1e-4")];

fn robot(world: &str) -> Robot {
    described(&format!("<mujoco><compiler angle='radian'/><worldbody>{world}</worldbody></mujoco>"))
}

fn described(text: &str) -> Robot {
    from_description(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The model at values and rates of joints, without contacts.
fn model(robot: &Robot, values: &[(&str, f64)], rates: &[(&str, f64)]) -> String {
    let by_name =
        |all: &[(&str, f64)]| all.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let pose = Pose { values: by_name(values), rates: by_name(rates), ..Pose::default() };
    let options = Options { contacts: false, ..Options::default() };
    model_text(robot, &pose, options).unwrap_or_else(|error| panic!("{error}"))
}

/// Accelerations of the coordinates of a joint at the start.
fn accelerations(text: &str, joint: &str) -> Vec<f64> {
    let text =
        format!("{text}\n[outputs.acceleration]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n");
    let record = run(&text, &SHORT);
    ["a", "a1", "a2"].iter().filter_map(|name| Some(record.column("acceleration", name)?[0])).collect()
}

fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() < 1e-9 * (1.0 + wanted.abs())
}

#[test]
fn the_same_arm_in_both_formats_moves_alike() {
    let here = described(
        "<mujoco model='two_links'><option timestep='0.01'/><default><joint axis='0 1 0' limited='true' range='-172 172'/></default>
         <worldbody><body name='upper'><inertial pos='0.35 0 0' mass='2.5' diaginertia='0.01 0.12 0.12'/><joint name='shoulder'/>
          <body name='lower' pos='0.8 0 0'>
           <inertial pos='0.2 0 0' euler='90 0 0' mass='1.2' fullinertia='0.004 0.03 0.03 0 0 0'/><joint name='elbow'/>
          </body></body></worldbody></mujoco>",
    );
    let there = described(include_str!("robots/two_links.urdf"));
    let fall = |robot: &Robot| {
        let text = model(robot, &[("shoulder", 0.3), ("elbow", -0.8)], &[("shoulder", 1.0), ("elbow", -2.0)]);
        run(&text, &[("analysis.end", "0.5"), ("analysis.step", "1e-3")])
    };
    let (here, there) = (fall(&here), fall(&there));
    for joint in ["shoulder", "elbow"] {
        let (here, there) = (column(&here, joint, "angle"), column(&there, joint, "angle"));
        let most = here.iter().zip(there).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(most < 1e-11 && (here[0] - here[500]).abs() > 0.1, "{joint}: {most:e}");
    }
}

/// A hinge off the body's origin with everything at it: (I + a) q'' = m g l cos(q - q₀) - d q' - k (q - r), the bar along x at q₀.
#[test]
fn a_hinge_has_its_spring_damper_armature_and_reference() {
    let (mass, inertia, length) = (1.5, 0.02, 0.4);
    let robot = robot(
        "<body pos='1 2 3'><inertial pos='0.1 0 0' mass='1.5' diaginertia='0.01 0.02 0.02'/>
         <joint name='hinge' pos='-0.3 0 0' axis='0 2 0' ref='0.2' springref='0.5' stiffness='3' damping='0.4' armature='0.1'/>
         <geom type='box' size='1 1 1' mass='7'/></body>",
    );
    let (value, rate) = (0.9, -1.3);
    let text = model(&robot, &[("hinge", value)], &[("hinge", rate)]);
    let moment: f64 = mass * 9.81 * length * f64::cos(value - 0.2) - 0.4 * rate - 3.0 * (value - 0.5);
    let wanted = moment / (inertia + mass * length * length + 0.1);
    let found = accelerations(&text, "hinge");
    assert!(near(found[0], wanted), "{found:?} {wanted}");
    // At its reference value the body is where the description has it, and so is the start that is not named.
    let record = run(&model(&robot, &[], &[]), &SHORT);
    assert!((column(&record, "hinge", "angle")[0] - 0.2).abs() < 1e-12);
}

/// A slide with armature against gravity: (m + a) x'' = -m g - k (x - r), over a second in closed form.
#[test]
fn a_slide_oscillates_with_its_armature() {
    let robot = robot(
        "<body><inertial pos='0 0 0' mass='2' diaginertia='1 1 1'/>
         <joint name='lift' type='slide' axis='0 0 1' stiffness='90' springref='0.1' armature='0.5'/></body>",
    );
    let text = model(&robot, &[], &[]);
    let record = run(&text, &[("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3")]);
    let (rest, omega) = (0.1 - 2.0 * 9.81 / 90.0, (90.0 / 2.5_f64).sqrt());
    let found = last(&record, "lift", "displacement");
    assert!((found - rest * (1.0 - omega.cos())).abs() < 1e-7, "{found}");
}

/// Inertia of shapes: by formulas of others, and of the capsule by slices.
#[test]
fn shapes_have_the_mass_of_homogeneous_solids() {
    let of = |geom: &str| {
        let robot = robot(&format!("<body><joint/><geom {geom}/></body>"));
        robot.links[1].inertia.expect("a mass")
    };
    let diagonal = |inertia: &LinkInertia| {
        let j = inertia.inertia;
        assert!((j - Matrix3::from_diagonal(&j.diagonal())).amax() < 1e-12 * j.amax());
        [j[(0, 0)], j[(1, 1)], j[(2, 2)]]
    };
    let check = |geom: &str, mass: f64, wanted: [f64; 3]| {
        let found = of(geom);
        assert!((found.mass / mass - 1.0).abs() < 1e-12, "{geom}: {} {mass}", found.mass);
        for (found, wanted) in diagonal(&found).iter().zip(wanted) {
            assert!((found / wanted - 1.0).abs() < 1e-9, "{geom}: {found} {wanted}");
        }
    };
    let ball = 4.0 / 3.0 * PI * 0.008 * 1000.0;
    check("size='0.2'", ball, [0.4 * ball * 0.04; 3]);
    let [a, b, c] = [0.2_f64, 0.6, 1.0];
    let sides = |m: f64| [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| m * sum / 12.0);
    check("type='box' size='0.1 0.3 0.5' density='500'", 60.0, sides(60.0));
    check("type='box' size='0.1 0.3 0.5' mass='3' density='500'", 3.0, sides(3.0));
    let cylinder = PI * 0.01 * 0.5 * 1000.0;
    let across = cylinder * (3.0 * 0.01 + 0.25) / 12.0;
    check("type='cylinder' size='0.1 0.25'", cylinder, [across, across, cylinder * 0.005]);
    check(
        "type='cylinder' size='0.1' fromto='0 -0.25 0 0 0.25 0'",
        cylinder,
        [across, cylinder * 0.005, across],
    );
    check("type='ellipsoid' size='0.1 0.2 0.3' mass='5'", 5.0, [0.13, 0.1, 0.05]);
    // A capsule in slices: discs of radius r(z).
    let (radius, half, slices) = (0.1_f64, 0.2_f64, 400_000);
    let step = 2.0 * (half + radius) / f64::from(slices);
    let (mut mass, mut along, mut about) = (0.0, 0.0, 0.0);
    for slice in 0..slices {
        let z = -half - radius + (f64::from(slice) + 0.5) * step;
        let beyond = (z.abs() - half).max(0.0);
        let squared = radius * radius - beyond * beyond;
        let disc = 1000.0 * PI * squared * step;
        mass += disc;
        along += 0.5 * disc * squared;
        about += disc * (0.25 * squared + z * z);
    }
    let found = of("type='capsule' size='0.1 0.2'");
    assert!((found.mass / mass - 1.0).abs() < 1e-8);
    for (found, wanted) in diagonal(&found).iter().zip([about, about, along]) {
        assert!((found / wanted - 1.0).abs() < 1e-8, "{found} {wanted}");
    }
    // Several shapes about their common centre; planes and those of groups that do not count have none.
    let robot = described(
        "<mujoco><compiler inertiagrouprange='0 1'/><worldbody><body><joint/>
         <frame pos='1 0 0'><geom size='0.1' mass='2' pos='0 1 0'/></frame><geom size='0.1' mass='6' pos='1 -1 0'/>
         <geom type='plane' size='1 1 1'/><geom type='mesh' mesh='a' group='2'/><geom type='mesh' mesh='a' mass='0'/></body>
         </worldbody></mujoco>",
    );
    let both = robot.links[1].inertia.expect("a mass");
    assert!((both.mass - 8.0).abs() < 1e-14 && (both.centre - Vector3::new(1.0, -0.5, 0.0)).norm() < 1e-14);
    let apart = 2.0 * 1.5 * 1.5 + 6.0 * 0.5 * 0.5;
    assert!(
        (both.inertia - Matrix3::from_diagonal(&[apart, 0.0, apart].into()) - Matrix3::identity() * 0.032)
            .amax()
            < 1e-12
    );
}

#[test]
fn orientations_are_those_of_the_format() {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let turn = Rotation::about_axis;
    let placed = |compiler: &str, orientation: &str| {
        let text = format!(
            "<mujoco><compiler {compiler}/><worldbody><body {orientation}><joint/><geom size='1'/></body></worldbody></mujoco>"
        );
        described(&text).joints[0].origin
    };
    let [a, b, c] = [0.3, -0.8, 1.9];
    let degrees = [a, b, c].map(f64::to_degrees);
    let euler = format!("euler='{} {} {}'", degrees[0], degrees[1], degrees[2]);
    for (compiler, orientation, wanted) in [
        ("", euler.as_str(), turn(&x, a) * turn(&y, b) * turn(&z, c)),
        ("eulerseq='XYZ'", &euler, turn(&z, c) * turn(&y, b) * turn(&x, a)),
        ("eulerseq='zyx'", &euler, turn(&z, a) * turn(&y, b) * turn(&x, c)),
        ("angle='radian'", "axisangle='0 2 0 0.7'", turn(&y, 0.7)),
        ("angle='degree'", "quat='2 0 2 0'", turn(&y, PI / 2.0)),
        ("", "xyaxes='0 1 0 -1 3 0'", turn(&z, PI / 2.0)),
        ("", "zaxis='0 0 -3'", turn(&x, PI)),
        ("", "zaxis='1 0 0'", turn(&y, PI / 2.0)),
    ] {
        let found = placed(compiler, &format!("pos='1 2 3' {orientation}"));
        let wanted = Motion::new(wanted, Vector3::new(1.0, 2.0, 3.0));
        let missed = (found.rotation.matrix() - wanted.rotation.matrix()).amax();
        let missed = missed.max((found.position - wanted.position).norm());
        assert!(missed < 1e-12, "{compiler} {orientation}: {missed:e}");
    }
}

/// Classes within classes, that of a body for what it carries, and an element's own.
#[test]
fn classes_give_defaults() {
    let robot = described(
        "<mujoco><compiler angle='radian'/><default><joint damping='1' armature='0.1'/><geom size='0.1' density='0'/>
          <default class='leg'><joint damping='2' axis='1 0 0'/><default class='foot'><joint damping='3'/></default></default>
         </default><worldbody><body name='a'><joint name='j1'/><geom mass='1'/>
          <body name='b' childclass='leg'><joint name='j2'/><geom mass='1'/>
           <body name='c'><joint name='j3' class='foot'/><geom mass='1'/>
            <body name='d'><joint name='j4' damping='5' class='main'/><geom mass='1'/></body></body></body></body>
         </worldbody></mujoco>",
    );
    let of = |key: fn(&lissom::exchange::import::RobotJoint) -> f64| {
        robot.joints.iter().map(key).collect::<Vec<_>>()
    };
    assert_eq!(of(|joint| joint.damping), [1.0, 2.0, 3.0, 5.0]);
    assert_eq!(of(|joint| joint.axis.x), [0.0, 1.0, 1.0, 0.0]);
    assert_eq!(of(|joint| joint.armature), [0.1; 4]);
}

/// Two hinges that cross: (m l² cos² b + J) a'' = 2 m l² cos b sin b a' b' - m g l cos b sin a - d a' - k a and
/// (m l² + J) b'' = -m l² cos b sin b a'² - m g l sin b cos a.
#[test]
fn two_hinges_that_cross_move_as_a_universal_joint() {
    let robot = robot(
        "<body><inertial pos='0 0 -0.5' mass='2' diaginertia='0.03 0.03 0.03'/>
         <joint name='roll' axis='1 0 0' damping='0.2' stiffness='4'/><joint name='pitch' axis='0 1 0' range='-2 2'/></body>",
    );
    let (a, b, ra, rb) = (0.4_f64, -0.7_f64, 1.1, 0.6);
    let text = model(&robot, &[("roll", a), ("pitch", b)], &[("roll", ra), ("pitch", rb)]);
    let (m, l, own, g) = (2.0, 0.5, 0.03, 9.81);
    let ml = m * l * l;
    let wanted = [
        (2.0 * ml * b.cos() * b.sin() * ra * rb - m * g * l * b.cos() * a.sin() - 0.2 * ra - 4.0 * a)
            / (ml * b.cos().powi(2) + own),
        (-ml * b.cos() * b.sin() * ra * ra - m * g * l * b.sin() * a.cos()) / (ml + own),
    ];
    let found = ["roll", "pitch"].map(|joint| accelerations(&text, joint)[0]);
    assert!(near(found[0], wanted[0]) && near(found[1], wanted[1]), "{found:?} {wanted:?}");
    // The coordinates are those of the description, and so are the limits.
    assert!(text.contains("range = [-2.0, 2.0]") && text.contains("angle = -0.7"), "{text}");
}

/// A body in a plane, as walking robots have it: it falls, and its spring turns it.
#[test]
fn slides_in_a_plane_with_a_hinge_move_as_a_planar_joint() {
    let robot = robot(
        "<body pos='0 0 1'><inertial pos='0 0 0' mass='2' diaginertia='0.1 0.2 0.3'/>
         <joint name='rootx' type='slide' axis='1 0 0'/><joint name='rootz' type='slide' axis='0 0 1' ref='1'/>
         <joint name='rooty' axis='0 1 0' stiffness='5' armature='0.05'/></body>",
    );
    let text = model(&robot, &[("rooty", 0.3), ("rootx", 0.2)], &[("rootx", 0.7)]);
    let found = accelerations(&text, "rooty");
    assert!(near(found[0], -5.0 * 0.3 / 0.25), "{found:?}");
    let placed = format!("{text}\n[outputs.at]\nkind = \"position\"\nof = \"body1\"\n");
    let record =
        run(&placed, &[("analysis.end", "0.2"), ("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3")]);
    let at = ["x", "y", "z"].map(|letter| last(&record, "at", letter));
    let wanted = [0.2 + 0.7 * 0.2, 0.0, 1.0 - 0.5 * 9.81 * 0.04];
    assert!(at.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9), "{at:?} {wanted:?}");
}

#[test]
fn a_slide_along_a_hinge_moves_as_a_cylindrical_joint() {
    let robot = robot(
        "<body><inertial pos='0 0 0' mass='2' diaginertia='0.1 0.1 0.3'/>
         <joint name='along' type='slide' damping='3'/><joint name='about' stiffness='6'/></body>",
    );
    let text = model(&robot, &[("along", 0.1), ("about", 0.5)], &[("along", -0.4)]);
    let found = ["about", "along"].map(|joint| accelerations(&text, joint)[0]);
    assert!(near(found[0], -6.0 * 0.5 / 0.3) && near(found[1], -9.81 + 3.0 * 0.4 / 2.0), "{found:?}");
}

/// A ball joint holds its point, free bodies fall, and what hangs on the world stands.
#[test]
fn balls_hold_and_free_bodies_fall() {
    let robot = described(
        "<mujoco><option gravity='0 0 -5'/><worldbody><geom type='plane' size='1 1 1'/>
         <body name='post'><geom size='0.1'/>
          <body name='bob' pos='0 0 1'><joint type='ball' pos='0 0 -0.5' stiffness='2'/><inertial pos='0.3 0 0' mass='1'
           diaginertia='0.1 0.1 0.1'/></body></body>
         <body name='stone' pos='3 0 0'><freejoint/><geom type='box' size='0.1 0.1 0.1'/></body></worldbody></mujoco>",
    );
    let without = omissions(&robot, Options { contacts: false, ..Options::default() });
    assert!(without.iter().any(|what| what.contains("contacts")), "{without:?}");
    let text = model(&robot, &[], &[])
        + "\n[outputs.bob]\nkind = \"acceleration\"\nof = \"bob\"\n[outputs.stone]\nkind = \"position\"\nof = \"stone\"\n";
    let record = run(&text, &[("analysis.scheme", "radau-iia")]);
    assert!((last(&record, "stone", "z") + 2.5).abs() < 1e-9);
    // About the ball's point: the centre at (0.3, 0, 0.5), J = 0.1 + m r² across; α = J⁻¹ (r × m g) about y.
    let alpha = 0.3 * 5.0 / (0.1 + 0.34);
    let found = ["a1", "a2", "a3"].map(|name| column(&record, "bob", name)[0]);
    // The body's frame is 0.5 above the point.
    assert!(near(found[0], alpha * 0.5) && found[1].abs() < 1e-9 && found[2].abs() < 1e-9, "{found:?}");
}

#[test]
fn joints_that_follow_others_do() {
    let text = |polynomial: &str| {
        format!(
            "<mujoco><worldbody><body><joint name='a' ref='10'/><geom size='0.1' pos='0.2 0 0'/></body>
             <body pos='0 0 1'><joint name='b' axis='0 1 0'/><geom size='0.1' pos='0.3 0 0'/></body></worldbody>
             <equality><joint joint1='b' joint2='a' polycoef='{polynomial}'/></equality></mujoco>"
        )
    };
    let robot = described(&text("0 -2 0 0 0"));
    let record = run(&model(&robot, &[], &[]), &[("analysis.end", "0.3")]);
    let [a, b] = ["a", "b"].map(|joint| last(&record, joint, "angle"));
    assert!((b + 2.0 * (a - 10_f64.to_radians())).abs() < 1e-9 && b > 0.05, "{a} {b}");
    let refused =
        model_text(&described(&text("0 1 1 0 0")), &Pose::default(), Options::default()).unwrap_err();
    assert!(refused.to_string().contains("<joint> (line 3) of <equality>"), "{refused}");
}

#[test]
fn what_cannot_be_said_is_reported() {
    let said = |text: &str| match from_description(text) {
        Ok(robot) => model_text(&robot, &Pose::default(), Options::default()).unwrap_err().to_string(),
        Err(error) => error.to_string(),
    };
    let body =
        |inside: &str| format!("<mujoco><worldbody><body name='b'>{inside}</body></worldbody></mujoco>");
    let mass = "<geom size='0.1'/>";
    for (text, words) in [
        ("<svg/>".to_owned(), "neither URDF, MJCF nor SDF"),
        (body("<joint/>"), "link `b` moves, but neither it"),
        (body("<joint/><geom type='mesh' mesh='a'/>"), "there is no <mesh> `a`"),
        (body(&format!("<joint type='hing'/>{mass}")), "`hing`"),
        (body(&format!("<joint axis='0 0 0'/>{mass}")), "no direction"),
        (body(&format!("<joint dampng='1'/>{mass}")), "`dampng` is not supported"),
        (body(&format!("<joint type='ball' frictionloss='1'/>{mass}")), "--without friction"),
        (body(&format!("<joint type='ball' range='0 1'/>{mass}")), "--without limits"),
        (body(&format!("<joint range='3 1'/>{mass}")), "is above"),
        (body(&format!("<joint springdamper='1 1'/>{mass}")), "springdamper"),
        (body(&format!("<joint/><joint/>{mass}")), "the joints `b_joint1`, `b_joint2` can move together"),
        (body(&format!("<joint class='x'/>{mass}")), "no default class `x`"),
        (body(&format!("<joint/>{mass}<composite type='grid'/>")), "<composite>"),
        (body(&format!("<joint/>{mass}<body quat='1 0 0 0' euler='0 0 0'/>")), "at once"),
        (
            body(&format!("<joint name='a'/>{mass}<body><joint name='a'/>{mass}</body>")),
            "two joints are called `a`",
        ),
        (format!("<mujoco><option density='1.2'/>{}", &body(mass)[8..]), "`density` of <option>"),
        (format!("<mujoco><include file='a.xml'/>{}", &body(mass)[8..]), "`a.xml` is not read"),
        (
            "<mujoco><worldbody><body><joint/><geom size='1' adhesion='2'/></body></worldbody></mujoco>"
                .to_owned(),
            "the adhesion of <geom>",
        ),
        (
            body(mass).replace("</mujoco>", "<tendon><fixed name='t' stiffness='3'/></tendon></mujoco>"),
            "the tendon `t`",
        ),
        (
            body(mass).replace("</mujoco>", "<equality><tendon tendon1='t'/></equality></mujoco>"),
            "<tendon> (line 1) of <equality>",
        ),
    ] {
        let found = said(&text);
        assert!(found.contains(words), "{text}\n{found}");
    }
    // What is omitted on purpose is in the model.
    let robot = described(&body(&format!("<joint/>{mass}<site/><site/>")).replace(
        "</mujoco>",
        "<equality><tendon tendon1='t'/></equality><actuator><motor joint='j'/></actuator></mujoco>",
    ));
    let options = Options { unsupported: Unsupported::LeftOut, ..Options::default() };
    let text = model_text(&robot, &Pose::default(), options).expect("a model");
    for words in ["# Omitted: <tendon> (line 1) of <equality>.", "1 <motor>", "2 <site>"] {
        assert!(text.contains(words), "{text}");
    }
    let floating = Options { root: Root::Floating, ..options };
    let refused = model_text(&robot, &Pose::default(), floating).unwrap_err().to_string();
    assert!(refused.contains("the world, which cannot move"), "{refused}");
}

/// Default classes give an armature to the free joint of a robot whose hinges are meant: it is reported as left out.
#[test]
fn the_armature_of_a_free_joint_is_left_out() {
    let file = "<mujoco><default><joint armature='0.01'/></default><worldbody><body name='base' pos='0 0 1'>\
        <joint name='float' type='free'/><geom type='box' size='0.1 0.1 0.1' mass='5'/><body name='leg' pos='0.1 0 0'>\
        <joint name='hip' axis='0 1 0'/><geom type='capsule' size='0.02 0.1' mass='0.5'/></body></body></worldbody></mujoco>";
    let robot = described(file);
    assert!(
        robot.left_out.iter().any(|words| words.contains("the armature 0.01 of `float`")),
        "{:?}",
        robot.left_out
    );
    let text = model(&robot, &[], &[]);
    assert!(text.contains("[springs.hip_armature]") && !text.contains("[springs.float_armature]"), "{text}");
}
