//! Forces and moments of springs, bushings and bearings on their tip, against equilibrium.

use crate::support::on_one_line::refused_on_one_line as refused;
use crate::support::runs::{column, last, run};

/// A block on a mount 0.3 m beside its centre of mass, and a spring that pulls at another one.
const MOUNT: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]

[bodies.block]
mass = 2
inertia = [0.02, 0.03, 0.04]
position = [0.3, 0, 0]

[point_masses.ballast]
mass = 1
position = [2, 0, 0]

[springs.mount]
kind = "bushing"
base = "ground"
tip = "block"
at_base = [0, 0, 0]
at_tip = [0, 0, 0]
axis = "z"
second_axis = "x"
stiffness = [4e3, 5e3, 6e3, 700, 800, 900]
damping = [40, 50, 60, 7, 8, 9]

[springs.rope]
kind = "point"
base = "ground"
tip = "ballast"
at_base = [2, 0, 3]
stiffness = 1e3
damping = 20
preload = 9.81

[outputs.mount]
kind = "spring_force"
of = "mount"

[outputs.in_base]
kind = "spring_force"
of = "mount"
axes = "base"

[outputs.rope]
kind = "spring_force"
of = "rope"

[outputs.block]
kind = "position"
of = "block"

[outputs.foot]
kind = "position"
of = "block"
point = [0, 0, 0]

[analysis]
kind = "statics"
"#;

/// The forces balance the weights, the moment about the mount's point on the block that of the weight.
#[test]
fn forces_on_tips_balance_weights() {
    let record = run(MOUNT, &[]);
    let at = |output, component| last(&record, output, component);
    let near = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-9, "{found} for {exact}");
    near(at("mount", "f3"), 2.0 * 9.81);
    near(at("mount", "f1"), 0.0);
    let arm = at("block", "x") - at("foot", "x");
    assert!(arm < 0.299_999, "the mount turns: {arm}");
    near(at("mount", "m2"), -arm * 2.0 * 9.81);
    // The axes of the base are z, x and y.
    near(at("in_base", "f1"), 2.0 * 9.81);
    near(at("in_base", "m3"), -arm * 2.0 * 9.81);
    near(at("rope", "f3"), 9.81);
    near(at("rope", "m1"), 0.0);
}

/// A bearing carries half of a shaft, a journal bearing with a film the moving shaft: its force is the inertia less the weight.
#[test]
fn forces_of_bearings_balance_shafts() {
    let shaft = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.shaft]
mass = 3
inertia = [0.01, 0.2, 0.2]
angular_velocity = [60, 0, 0]
[springs.left]
KIND
base = "ground"
tip = "shaft"
at_base = [0, 0, 0]
at_tip = [0, 0, 0]
[outputs.left]
kind = "spring_force"
of = "left"
axes = "base"
[outputs.shaft]
kind = "acceleration"
of = "shaft"
[analysis]
kind = "dynamics"
end = 0.02
relative_tolerance = 1e-7
"#;
    let film = "kind = \"journal_bearing\"\nradius = 0.02\nlength = 0.02\nclearance = 1e-4\nviscosity = 0.03";
    for kind in ["kind = \"bearing\"\nstiffness = [[1e5, 4e4], [-4e4, 1e5]]\ndamping = 300", film] {
        let record = run(&shaft.replace("KIND", kind), &[]);
        for (force, acceleration, weight) in [("f2", "a2", 0.0), ("f3", "a3", 3.0 * 9.81)] {
            let forces = column(&record, "left", force);
            for (force, acceleration) in forces.iter().zip(column(&record, "shaft", acceleration)) {
                let balance = 3.0 * acceleration + weight;
                assert!(
                    (force - balance).abs() < 2e-4 * (1.0 + balance.abs()),
                    "{kind}: {force} for {balance}"
                );
            }
        }
        assert!(
            column(&record, "left", "f3").iter().any(|force| force.abs() > 5.0),
            "{kind}: something acts"
        );
    }
}

/// A load of the size of the mount's force, which is read between the steps' ends too.
#[test]
fn signals_depend_on_forces_on_tips() {
    let fed = format!(
        "{}\n[signals]\nlift = \"in_base.f1 + 0*mount.m2\"\n[outputs.lift]\nkind = \"signal\"\nof = \"lift\"\n",
        MOUNT.replace("kind = \"statics\"", "kind = \"dynamics\"\nend = 0.5\nstep = 1e-3")
    );
    let record = run(&fed, &[]);
    let (lift, force) = (column(&record, "lift", "value"), column(&record, "mount", "f3"));
    for (lift, force) in lift.iter().zip(force) {
        assert!((lift - force).abs() < 1e-3, "{lift} for {force}");
    }
    assert!(force.iter().copied().fold(0.0, f64::max) > 30.0, "it oscillates");
}

#[test]
fn springs_without_one_tip_have_no_force_on_it() {
    let rope = "kind = \"rope\"\nalong = [{ on = \"ground\" }, { on = \"block\" }, { on = \"ballast\" }]\nstiffness = 1e3\n[outputs";
    let text = MOUNT.replacen("[outputs", &format!("[springs.hoist]\n{rope}"), 1);
    let message = refused(&text.replace("of = \"rope\"", "of = \"hoist\""));
    assert!(message.contains("spring `hoist` has no single tip on which it acts"), "{message}");
}
