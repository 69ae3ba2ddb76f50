//! Tyres: slip curves against the brush model, build-up, standstill, a vehicle in a turn.

use lissom::Model;
use lissom::model::output::Record;

fn run(text: &str, set: &[(&str, f64)]) -> Record {
    let mut model = Model::from_text("model.toml", text);
    for &(path, value) in set {
        model = model.with(path, value);
    }
    let mut session = model.session().unwrap_or_else(|error| panic!("{error}"));
    session.run().unwrap_or_else(|error| panic!("{error}")).into_record()
}

fn last(record: &Record, name: &str, component: &str) -> f64 {
    *record.column(name, component).expect("a column").last().expect("rows")
}

/// A wheel whose axle moves at `speed`, rolls freely or at `rate`, and is inclined to the motion by `angle` and to the road by `camber`.
const RIG: &str = r#"
lissom = 1
[parameters]
speed = 10.0
angle = 0.0
camber = 0.0
load = 3000.0
[bodies.carriage]
mass = 100
inertia = [1, 1, 1]
position = [0, 0, "0.3*cos(camber) - load/2e5"]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "carriage"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_displacement"
joint = "rail"
displacement = "speed*t"
[bodies.wheel]
mass = 10
inertia = [0.4, 0.6, 0.4]
position = [0, 0, "0.3*cos(camber) - load/2e5"]
[joints.axle]
kind = "revolute"
base = "carriage"
tip = "wheel"
axis = ["sin(angle)*cos(camber)", "cos(angle)*cos(camber)", "sin(camber)"]
[initial.wheel]
parts = ["wheel"]
velocity = ["speed", 0, 0]
about = [0, 0, "0.3*cos(camber) - load/2e5"]
angular_velocity = ["speed/0.295*sin(angle)", "speed/0.295*cos(angle)", 0]
[springs.tyre]
kind = "tyre"
base = "ground"
tip = "wheel"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = ["sin(angle)*cos(camber)", "cos(angle)*cos(camber)", "sin(camber)"]
radius = 0.3
stiffness = 2e5
friction_coefficient = 0.9
slip_stiffness = 20
cornering_stiffness = 15
camber_stiffness = 0.8
pneumatic_trail = 0.03
relaxation_length = 0.4
longitudinal_relaxation_length = 0.2
[outputs.force]
kind = "spring_force"
of = "tyre"
[outputs.spin]
kind = "relative"
of = "axle"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1
step = 2e-3
"#;

/// The force of a brush per normal force for an adhesion q without limit.
fn brush(q: f64, friction: f64) -> f64 {
    let part = q.abs() / (3.0 * friction);
    if part >= 1.0 { friction * q.signum() } else { q * (3.0 - 3.0 * part + part * part) / 3.0 }
}

#[test]
fn the_side_force_over_the_slip_angle_is_that_of_a_brush() {
    for angle in [0.01_f64, 0.05, 0.1, 0.3] {
        let record = run(RIG, &[("parameters.angle", angle)]);
        let force = ["f1", "f2", "f3"].map(|component| last(&record, "force", component));
        // The wheel's axis points to the side on which the velocity leaves it.
        let side = force[0] * angle.sin() + force[1] * angle.cos();
        let wanted = -3000.0 * brush(15.0 * angle.tan(), 0.9);
        // The transport velocity is larger than the rolling velocity by a fourth power of the slip.
        let tolerance = if angle > 0.2 { 0.01 } else { 1e-4 };
        assert!((side / wanted - 1.0).abs() < tolerance, "{angle}: {side} for {wanted}");
        assert!((force[2] - 3000.0).abs() < 1e-6, "{force:?}");
    }
}

#[test]
fn a_side_force_builds_up_over_the_relaxation_length() {
    let angle = 0.002_f64;
    let record = run(RIG, &[("parameters.angle", angle), ("analysis.end", 0.2), ("analysis.step", 2e-4)]);
    let force = |component| record.column("force", component).unwrap();
    let (x, y) = (force("f1"), force("f2"));
    for (k, &time) in record.times.iter().enumerate().filter(|(_, time)| **time > 0.02) {
        let side = x[k] * angle.sin() + y[k] * angle.cos();
        // The damping of the tread is not negligible: 5 ms/(1 + 10) of 40 ms.
        let slip = angle.tan() * (1.0 - (-10.0 * time / 0.4).exp() * (1.0 - 0.005 / 11.0 * 10.0 / 0.4));
        let wanted = -3000.0 * brush(15.0 * slip, 0.9);
        assert!((side / wanted - 1.0).abs() < 2e-3, "{time}: {side} for {wanted}");
    }
}

#[test]
fn the_longitudinal_force_over_the_slip_is_that_of_a_brush_and_of_a_locked_wheel_the_friction() {
    for slip in [0.01, 0.05, -0.05, -0.12] {
        let effective = 0.3 - 0.015 / 3.0;
        let rate = 10.0 * (1.0 + slip) / effective;
        let driven = format!(
            "{RIG}[joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"axle\"\nrotation = \"{rate}*t\"\n"
        );
        let driven = driven.replace("speed/0.295", &format!("{rate}"));
        let record = run(&driven, &[]);
        let pull = last(&record, "force", "f1");
        let wanted = 3000.0 * brush(20.0 * slip, 0.9);
        assert!((pull / wanted - 1.0).abs() < 2e-3, "{slip}: {pull} for {wanted}");
    }
    let locked = RIG.replace("kind = \"revolute\"", "kind = \"clamp\"").replace(
        "axis = [\"sin(angle)*cos(camber)\", \"cos(angle)*cos(camber)\", \"sin(camber)\"]\n[initial",
        "[initial",
    );
    let locked = locked.replace("[\"speed/0.295*sin(angle)\", \"speed/0.295*cos(angle)\", 0]", "[0, 0, 0]");
    let locked = locked.replace("[outputs.spin]\nkind = \"relative\"\nof = \"axle\"\n", "");
    let record = run(&locked, &[]);
    assert!((last(&record, "force", "f1") + 0.9 * 3000.0).abs() < 1e-3);
}

#[test]
fn a_wheel_that_leans_is_pushed_to_that_side() {
    let record = run(RIG, &[("parameters.camber", 0.05)]);
    // The axis points upwards on the side of +y: the wheel leans to -y.
    let wanted = -3000.0 * brush(0.8 * 0.05_f64.sin(), 0.9);
    let side = last(&record, "force", "f2");
    assert!((side / wanted - 1.0).abs() < 1e-3, "{side} for {wanted}");
}

/// A wheel with its brake locked on a slope of ten degrees: after it has settled it does not creep.
#[test]
fn a_locked_wheel_stands_on_a_slope_for_a_minute() {
    let text = r#"
lissom = 1
gravity = ["9.81*sin(10*pi/180)", 0, "-9.81*cos(10*pi/180)"]
[bodies.wheel]
mass = 300
inertia = [10, 10, 10]
position = [0, 0, "0.3 - 300*9.81*cos(10*pi/180)/2e5"]
[joints.guide]
kind = "generic"
base = "ground"
tip = "wheel"
locked = ["y", "rx", "ry", "rz"]
[springs.tyre]
kind = "tyre"
base = "ground"
tip = "wheel"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = [0, 1, 0]
radius = 0.3
stiffness = 2e5
damping = 2000
friction_coefficient = 0.9
slip_stiffness = 20
cornering_stiffness = 15
[outputs.wheel]
kind = "displacement"
of = "wheel"
[outputs.force]
kind = "spring_force"
of = "tyre"
[analysis]
kind = "dynamics"
end = 60
relative_tolerance = 1e-5
"#;
    let record = run(text, &[]);
    let place = record.column("wheel", "u1").unwrap();
    let settled = record.times.iter().position(|&time| time > 20.0).unwrap();
    let (then, at_end) = (place[settled], *place.last().unwrap());
    assert!((at_end - then).abs() < 1e-7, "{then} {at_end}");
    // The stiffness of the tread is c N/σ at first; it crept a little while it moved.
    let wanted = 0.15 * 10.0_f64.to_radians().tan() / 20.0;
    assert!(at_end > wanted && at_end < 1.2 * wanted, "{at_end} for {wanted}");
    let holding = last(&record, "force", "f1");
    assert!((holding + 300.0 * 9.81 * 10.0_f64.to_radians().sin()).abs() < 1e-3, "{holding}");
}

/// A vehicle with one wheel on each axle, steered by a small angle, turns as the linear single-track model: r/V = δ/(L + K V²).
#[test]
fn a_single_track_vehicle_turns_as_its_linear_model() {
    let wheel = |name: &str, x: f64, angle: f64, stiffness: f64| {
        format!(
            "[bodies.{name}]\nmass = 1\ninertia = [0.01, 0.01, 0.01]\nposition = [{x}, 0, 0.28]\n\
             [joints.axle_{name}]\nkind = \"revolute\"\nbase = \"chassis\"\ntip = \"{name}\"\naxis = [{}, {}, 0]\n\
             [springs.tyre_{name}]\nkind = \"tyre\"\nbase = \"ground\"\ntip = \"{name}\"\nat_base = [0, 0, 0]\nnormal = [0, 0, 1]\n\
             wheel_axis = [{}, {}, 0]\nradius = 0.3\nstiffness = 2e5\nfriction_coefficient = 2\nslip_stiffness = 20\n\
             cornering_stiffness = {stiffness}\npneumatic_trail = 0\n",
            -angle.sin(),
            angle.cos(),
            -angle.sin(),
            angle.cos(),
        )
    };
    let (front, rear, steer) = (1.2, 1.4, 2e-4_f64);
    let text = format!(
        "lissom = 1\n[bodies.chassis]\nmass = 998\ninertia = [300, 1000, 1200]\nposition = [0, 0, 0.5]\n\
         [joints.plane]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"chassis\"\nlocked = [\"z\", \"rx\", \"ry\"]\n{}{}\
         [initial.car]\nparts = [\"chassis\", \"front\", \"rear\"]\nvelocity = [20, 0, 0]\n\
         [outputs.yaw]\nkind = \"angular_velocity\"\nof = \"chassis\"\n[outputs.speed]\nkind = \"velocity\"\nof = \"chassis\"\n\
         [analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 4\nstep = 4e-3\n",
        wheel("front", front, steer, 12.0),
        wheel("rear", -rear, 0.0, 16.0),
    );
    let record = run(&text, &[]);
    let yaw = last(&record, "yaw", "w3");
    let speed = last(&record, "speed", "v1").hypot(last(&record, "speed", "v2"));
    let (normal, length) = (4000.0, front + rear);
    let gradient = 1000.0 / length * (rear / (12.0 * normal) - front / (16.0 * normal));
    let wanted = steer / (length + gradient * speed * speed);
    assert!((yaw / speed / wanted - 1.0).abs() < 2e-3, "{} for {wanted} at {speed}", yaw / speed);
}
