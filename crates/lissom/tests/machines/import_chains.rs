//! Imported joints of several coordinates and loops: several hinges or slides of one body against the equations of Newton and
//! Euler, free flight, planar joints of URDF, connected bodies.

use lissom::exchange::import::{Options, Pose, Robot, from_description, model_text};
use lissom_motion::{Matrix3, Rotation, Vector3};

use crate::support::runs::{SCHEMES, column, last, run};

const SHORT: [(&str, &str); 2] = [("analysis.end", "1e-3"), ("analysis.step", "1e-4")];

fn model(text: &str, values: &[(&str, f64)], rates: &[(&str, f64)]) -> String {
    let robot = from_description(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let by_name =
        |all: &[(&str, f64)]| all.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let pose = Pose { values: by_name(values), rates: by_name(rates), ..Pose::default() };
    model_text(&robot, &pose, Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Three hinges through one point with springs, dampers and rotors.
struct Hip {
    axes: [Vector3; 3],
    mass: f64,
    /// Centre of mass from the point, and inertia about it, in the axes of the leg.
    centre: Vector3,
    inertia: Vector3,
    stiffness: [f64; 3],
    rest: [f64; 3],
    damping: [f64; 3],
    armature: [f64; 3],
}

const HIP: Hip = Hip {
    axes: [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 1.0), Vector3::new(0.0, 0.8, 0.6)],
    mass: 2.0,
    centre: Vector3::new(0.05, -0.02, -0.25),
    inertia: Vector3::new(0.03, 0.032, 0.005),
    stiffness: [10.0, 0.0, 5.0],
    rest: [0.2, 0.0, -0.3],
    damping: [0.1, 0.3, 0.05],
    armature: [0.0, 0.02, 0.01],
};

impl Hip {
    fn description(&self) -> String {
        let joint = |k: usize| {
            let [x, y, z]: [f64; 3] = self.axes[k].into();
            format!(
                "<joint name='h{k}' axis='{x} {y} {z}' stiffness='{}' springref='{}' damping='{}' armature='{}' range='-2 2'/>",
                self.stiffness[k], self.rest[k], self.damping[k], self.armature[k]
            )
        };
        let ([x, y, z], [a, b, c]): ([f64; 3], [f64; 3]) = (self.centre.into(), self.inertia.into());
        format!(
            "<mujoco><compiler angle='radian'/><worldbody><body name='leg' pos='0 0 1'>{}{}{}\
             <inertial pos='{x} {y} {z}' mass='{}' diaginertia='{a} {b} {c}'/></body></worldbody></mujoco>",
            joint(0),
            joint(1),
            joint(2),
            self.mass
        )
    }

    /// Accelerations of the angles: M q'' = τ - b, with the directions e of the axes, the lever r of the centre of mass and
    /// M_ij = m (e_i×r)·(e_j×r) + e_i·J e_j + a_i δ_ij.
    fn accelerations(&self, q: [f64; 3], v: [f64; 3]) -> [f64; 3] {
        let first = Rotation::about_axis(&self.axes[0], q[0]);
        let second = first * Rotation::about_axis(&self.axes[1], q[1]);
        let whole = second * Rotation::about_axis(&self.axes[2], q[2]);
        let e = [self.axes[0], first.apply(&self.axes[1]), second.apply(&self.axes[2])];
        let r = whole.apply(&self.centre);
        let turn = whole.matrix();
        let inertia = turn * Matrix3::from_diagonal(&self.inertia) * turn.transpose();
        let omega = v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
        let alpha = v[0] * v[1] * e[0].cross(&e[1]) + (v[0] * e[0] + v[1] * e[1]).cross(&(v[2] * e[2]));
        let apparent = alpha.cross(&r) + omega.cross(&omega.cross(&r)) - Vector3::new(0.0, 0.0, -9.81);
        let moment = inertia * alpha + omega.cross(&(inertia * omega));
        let matrix = Matrix3::from_fn(|i, j| {
            self.mass * e[i].cross(&r).dot(&e[j].cross(&r))
                + e[i].dot(&(inertia * e[j]))
                + if i == j { self.armature[i] } else { 0.0 }
        });
        let forces = Vector3::from_fn(|i, _| {
            -self.stiffness[i] * (q[i] - self.rest[i])
                - self.damping[i] * v[i]
                - self.mass * e[i].cross(&r).dot(&apparent)
                - e[i].dot(&moment)
        });
        (matrix.try_inverse().expect("regular") * forces).into()
    }

    /// Angles after a second, by the classical Runge-Kutta method.
    fn after_a_second(&self, mut q: [f64; 3], mut v: [f64; 3]) -> [f64; 3] {
        let (count, mut state) = (4000, [q[0], q[1], q[2], v[0], v[1], v[2]]);
        let step = 1.0 / f64::from(count);
        let slope = |state: &[f64; 6]| {
            let [a, b, c] =
                self.accelerations([state[0], state[1], state[2]], [state[3], state[4], state[5]]);
            [state[3], state[4], state[5], a, b, c]
        };
        let moved = |state: &[f64; 6], slope: &[f64; 6], by: f64| -> [f64; 6] {
            std::array::from_fn(|k| state[k] + by * slope[k])
        };
        for _ in 0..count {
            let one = slope(&state);
            let two = slope(&moved(&state, &one, 0.5 * step));
            let three = slope(&moved(&state, &two, 0.5 * step));
            let four = slope(&moved(&state, &three, step));
            let mean = std::array::from_fn(|k| (one[k] + 2.0 * two[k] + 2.0 * three[k] + four[k]) / 6.0);
            state = moved(&state, &mean, step);
        }
        (q, v) = ([state[0], state[1], state[2]], [state[3], state[4], state[5]]);
        assert!(v.iter().all(|rate| rate.is_finite()));
        q
    }
}

#[test]
fn three_hinges_of_a_body_move_as_newton_and_euler_say() {
    let (q, v) = ([0.3, -0.4, 0.5], [1.0, -2.0, 1.5]);
    let named = |values: [f64; 3]| [("h0", values[0]), ("h1", values[1]), ("h2", values[2])];
    let output =
        |joint| format!("\n[outputs.a_{joint}]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n");
    let text = model(&HIP.description(), &named(q), &named(v)) + &["h0", "h1", "h2"].map(output).concat();
    let record = run(&text, &SHORT);
    for (k, wanted) in HIP.accelerations(q, v).into_iter().enumerate() {
        let found = column(&record, &format!("a_h{k}"), "a")[0];
        assert!((found - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "{k}: {found} {wanted}");
        assert!((column(&record, &format!("h{k}"), "angle")[0] - q[k]).abs() < 1e-12);
    }
    let wanted = HIP.after_a_second(q, v);
    let error = |scheme: &str, step: &str| {
        let record = run(&text, &[("analysis.scheme", scheme), ("analysis.step", step)]);
        let found = |k: usize| (last(&record, &format!("h{k}"), "angle") - wanted[k]).abs();
        found(0).max(found(1)).max(found(2))
    };
    let errors = ["2e-3", "1e-3"].map(|step| error("radau-iia", step));
    assert!(errors[1] < 1e-6 && errors[0] / errors[1] > 6.0, "{errors:?}");
    for scheme in SCHEMES {
        let error = error(scheme, "1e-3");
        assert!(error < 1e-3, "{scheme}: {error}");
    }
}

/// Three slides and a ball are a free body whose displacements have dampers: m x'' = -d x'.
#[test]
fn slides_with_a_ball_fly() {
    let text = model(
        "<mujoco><worldbody><body name='b' pos='0 0 1'><joint name='x' type='slide' axis='1 0 0' damping='0.5'/>
         <joint name='y' type='slide' axis='0 1 0'/><joint name='z' type='slide'/><joint type='ball'/>
         <geom size='0.1' mass='2'/></body></worldbody></mujoco>",
        &[],
        &[("x", 3.0), ("y", -1.0)],
    );
    let record = run(&text, &[("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3")]);
    let found = ["x", "y", "z"].map(|joint| last(&record, joint, "displacement"));
    let wanted = [3.0 * 4.0 * (1.0 - f64::exp(-0.25)), -1.0, -0.5 * 9.81];
    assert!(
        found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-8),
        "{found:?} {wanted:?}"
    );
}

#[test]
fn two_slides_have_their_dampers() {
    let text = model(
        "<mujoco><worldbody><body name='b'><joint name='x' type='slide' axis='1 0 0' damping='1'/>
         <joint name='y' type='slide' axis='0.6 0.8 0' damping='2'/><geom size='0.1' mass='2'/></body></worldbody></mujoco>",
        &[],
        &[("x", 1.0), ("y", 1.0)],
    );
    // M = m [1 0.6; 0.6 1], forces (-1, -2).
    let determinant = 2.0 * (1.0 - 0.36);
    let wanted = [(-1.0 + 0.6 * 2.0) / determinant, (-2.0 + 0.6) / determinant];
    for (joint, wanted) in ["x", "y"].into_iter().zip(wanted) {
        let text = format!("{text}\n[outputs.a]\nkind = \"relative_acceleration\"\nof = \"{joint}\"\n");
        let found = column(&run(&text, &SHORT), "a", "a")[0];
        assert!((found - wanted).abs() < 1e-9, "{joint}: {found} {wanted}");
    }
}

/// A planar joint about a tilted normal: gravity accelerates along the plane only.
#[test]
fn planar_joints_of_urdf_slide_in_their_plane() {
    let text = model(
        "<robot name='r'><link name='base'/><link name='cart'><inertial><mass value='1'/>
         <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>
         <joint name='j' type='planar'><parent link='base'/><child link='cart'/><axis xyz='0.6 0 0.8'/></joint></robot>",
        &[],
        &[("j", 0.7), ("j_y", 0.2)],
    ) + "\n[outputs.at]\nkind = \"position\"\nof = \"cart\"\n";
    let record = run(&text, &[("analysis.scheme", "radau-iia"), ("analysis.step", "1e-3")]);
    let at = ["x", "y", "z"].map(|letter| last(&record, "at", letter));
    // g - (g·n) n for n = (0.6, 0, 0.8).
    let wanted = [0.5 * 9.81 * 0.48, 0.2, -0.5 * 9.81 * 0.36];
    assert!(at.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-8), "{at:?} {wanted:?}");
    assert!((last(&record, "j", "angle") - 0.7).abs() < 1e-9);
}

/// A body that is connected to the world at a point is a pendulum, and one that is welded stays.
#[test]
fn connected_bodies_hang_and_welded_ones_stay() {
    let of = |equality: &str| {
        let text = model(
            &format!(
                "<mujoco><worldbody><body name='b' pos='0 0 1'><freejoint/>
                 <inertial pos='0.3 0 0' mass='1' diaginertia='0.1 0.1 0.1'/></body></worldbody>
                 <equality>{equality}</equality></mujoco>"
            ),
            &[],
            &[],
        ) + "\n[outputs.b]\nkind = \"acceleration\"\nof = \"b\"\n";
        let record = run(&text, &SHORT);
        ["a1", "a2", "a3"].map(|name| column(&record, "b", name)[0])
    };
    let found = of("<connect body1='b' anchor='-0.5 0 0'/>");
    let alpha = 9.81 * 0.8 / (0.1 + 0.64);
    assert!((found[2] + 0.5 * alpha).abs() < 1e-9 && found[0].abs() < 1e-9, "{found:?} {alpha}");
    let found = of("<weld body1='b'/>");
    assert!(found.iter().all(|value| value.abs() < 1e-9), "{found:?}");
}

#[test]
fn open_loops_and_unknown_bodies_are_refused() {
    let text = "<mujoco><worldbody><body name='a'><joint name='j' axis='0 1 0'/><geom size='0.1' pos='0.5 0 0'/></body></worldbody>
        <equality><connect name='pin' body1='a' anchor='0.5 0 0'/></equality></mujoco>";
    let robot = from_description(text).expect("a robot");
    let pose = Pose { values: [("j".to_owned(), 0.3)].into(), ..Pose::default() };
    let refused = model_text(&robot, &pose, Options::default()).unwrap_err().to_string();
    assert!(refused.contains("line 2: the loop of `pin` is open"), "{refused}");
    let robot = from_description(&text.replace("body1='a'", "body1='c'")).expect("a robot");
    let refused = model_text(&robot, &Pose::default(), Options::default()).unwrap_err().to_string();
    assert!(refused.contains("there is no body `c`"), "{refused}");
}

/// A chain of 2,000 links whose joints are listed from its end, with followers of followers and a link without mass in the middle.
#[test]
fn long_chains_are_read_in_any_order() {
    let count = 2000;
    let links = (0..count).map(|k| {
        let mass = "<inertial><mass value='0.1'/><inertia ixx='1e-3' iyy='1e-3' izz='1e-3'/></inertial>";
        format!("<link name='l{k}'>{}</link>", if k == 1000 { "" } else { mass })
    });
    let joints = (0..count).rev().map(|k| {
        let parent = if k == 0 { "base".to_owned() } else { format!("l{}", k - 1) };
        let axis = ["1 0 0", "0 1 0"][k % 2];
        let mimic = if k < 2 { String::new() } else { format!("<mimic joint='j{}' multiplier='-1' offset='0.1'/>", k - 2) };
        format!(
            "<joint name='j{k}' type='revolute'><origin xyz='0 0 -0.1'/><parent link='{parent}'/><child link='l{k}'/>\
             <axis xyz='{axis}'/><limit lower='-0.5' upper='0.5' effort='1' velocity='1'/>{mimic}</joint>"
        )
    });
    let all: String = links.chain(joints).collect();
    let robot =
        from_description(&format!("<robot name='r'>{all}<link name='base'/></robot>")).expect("a robot");
    assert_eq!((robot.links[0].name.as_str(), robot.links.len()), ("base", count + 1));
    for (k, joint) in robot.joints.iter().enumerate() {
        assert_eq!((joint.name.clone(), joint.parent, joint.child), (format!("j{k}"), k, k + 1));
        assert_eq!(robot.links[k + 1].name, format!("l{k}"));
    }
    let pose = Pose { values: [("j0".to_owned(), 0.3), ("j1".to_owned(), 0.2)].into(), ..Pose::default() };
    let text = model_text(&robot, &pose, Options::default()).unwrap_or_else(|error| panic!("{error}"));
    assert!(text.contains("[bodies.l1000]\nmass = 0\n"), "a link without mass between joints");
    // Each second joint follows by 0.1 - q: 0.3, 0.2, -0.2, -0.1, 0.3, …
    let of = |joint: usize| {
        let entry = text.split(&format!("\n[joints.j{joint}]\n")).nth(1).expect("there");
        let line = entry.lines().find(|line| line.starts_with("angle")).expect("not zero");
        line.split(' ').next_back().and_then(|value| value.parse::<f64>().ok()).expect("a number")
    };
    for (joint, wanted) in [(0, 0.3), (2, -0.2), (3, -0.1), (1996, 0.3), (1998, -0.2), (1999, -0.1)] {
        assert!((of(joint) - wanted).abs() < 1e-12, "{joint}: {}", of(joint));
    }
    assert!(lissom::Model::from_text("chain.toml", &text).session().is_ok());
    // Two massless neighbours whose axes are parallel move without moving a mass.
    let parallel = all_parallel(&robot);
    let found = model_text(&parallel, &Pose::default(), Options { mimic: false, ..Options::default() });
    let found = found.unwrap_err().message;
    assert!(found.contains("the joints `j1000`, `j1001` can move together"), "{found}");
}

/// A chain with parallel axes through one point at its link without mass.
fn all_parallel(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints[1000..1002] {
        joint.axis = Vector3::z();
    }
    robot
}

/// Limits of which one end is infinite exclude positions beyond the other one.
#[test]
fn limits_with_one_end_exclude_positions() {
    let text = "<robot name='r'><link name='base'/><link name='arm'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
        </link><joint name='j' type='continuous'><parent link='base'/><child link='arm'/></joint></robot>";
    let mut robot = from_description(text).expect("a robot");
    robot.joints[0].range = Some([f64::NEG_INFINITY, 0.5]);
    let at = |value: f64| {
        let pose = Pose { values: [("j".to_owned(), value)].into(), ..Pose::default() };
        model_text(&robot, &pose, Options::default())
    };
    assert!(at(0.6).unwrap_err().message.contains("starts at 0.6, outside of its limits -inf … 0.5"));
    run(&at(-7.0).expect("within"), &SHORT);
}
