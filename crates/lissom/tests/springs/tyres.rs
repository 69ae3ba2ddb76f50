//! Tyres: slip curves against the brush model, build-up, standstill, a vehicle in a turn.

use lissom::Model;
use lissom::analyses::tyre_curves::TyreCurves;
use lissom::core::elements::tyre::magic_formula::MagicFormula;
use lissom::core::errors::Warning;
use lissom::model::files::tyre_file::tyre_file;
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

/// Coefficients of a tyre, and their file.
const FILE: &str = include_str!("../../../../examples/parts/passenger-car.tir");

/// Slip, slip angle, camber and normal force with the forces, moments and relaxation lengths of the formulas as a program of its own evaluates them.
#[test]
fn the_magic_formula_is_that_of_an_independent_program() {
    let file = tyre_file(FILE).expect("a tyre property file");
    assert!(file.unused.is_empty(), "{:?}", file.unused);
    let law = MagicFormula::new(&file.coefficients, false).expect("a tyre");
    let mirrored = MagicFormula::new(&file.coefficients, true).expect("a tyre");
    for (slip, load, wanted) in [
        (
            [0.0, 0.0, 0.0],
            4000.0,
            [-77.993_742_9, -80.189_074_8, 2.533_003_16, -13.421_125_6, -1.996_208_09, 0.6023, 0.565_216_981],
        ),
        (
            [0.05, 0.0, 0.0],
            4000.0,
            [3_562.111_61, -12.703_368_2, 3.602_651_61, -15.728_952_4, 33.080_231_2, 0.6023, 0.565_216_981],
        ),
        (
            [-0.1, 0.03, 0.02],
            3000.0,
            [
                -3_434.074_94,
                -1_247.121_13,
                -25.286_152_4,
                -8.470_027_57,
                -24.531_796_9,
                0.456_139_958,
                0.467_959_527,
            ],
        ),
        (
            [0.0, 0.05, 0.0],
            5000.0,
            [
                -72.121_143_6,
                -2_740.079_93,
                -49.532_833_7,
                -16.781_061,
                85.073_010_5,
                0.744_426_202,
                0.623_768_87,
            ],
        ),
        (
            [0.0, -0.08, -0.05],
            6000.0,
            [-65.755_120_9, 4_379.447_76, 176.397_37, -20.143_327_3, -135.1398, 0.882_012_894, 0.638_417_213],
        ),
        (
            [0.2, -0.1, 0.04],
            2500.0,
            [
                2_488.744_07,
                1_456.530_91,
                -5.383_740_66,
                -9.405_273_34,
                35.554_816_9,
                0.381_730_988,
                0.404_301_876,
            ],
        ),
        (
            [-1.0, 0.2, 0.0],
            4000.0,
            [-2_820.984_74, -602.129_323, -5.739_749_77, -11.682_069_3, -28.585_678_1, 0.6023, 0.565_216_981],
        ),
    ] {
        let forces = law.forces(slip, load, 20.0);
        let lengths = law.relaxation(load, slip[2].sin());
        for (found, wanted) in forces.iter().chain(&lengths).zip(wanted) {
            assert!((found - wanted).abs() < 2e-8 * (1.0 + wanted.abs()), "{slip:?}: {found} for {wanted}");
        }
        // On the other side of the vehicle.
        let [along, across, overturning, resisting, aligning] =
            mirrored.forces([slip[0], -slip[1], -slip[2]], load, 20.0);
        assert_eq!([along, -across, -overturning, resisting, -aligning], forces);
    }
}

/// Where a model is that names the file.
const BESIDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/model.toml");

/// The rig with a tyre property file.
fn of_file(set: &str) -> String {
    let (before, after) = RIG.split_once("radius = 0.3\n").expect("data of a brush");
    let (_, after) = after.split_once("longitudinal_relaxation_length = 0.2\n").expect("data of a brush");
    format!("{before}magic_formula = {{ file = \"parts/passenger-car.tir\"{set} }}\n{after}[outputs.tyre]\nkind = \"tyre\"\nof = \"tyre\"\n").replace("0.3*cos(camber)", "0.317*cos(camber)")
}

/// In steady rolling the forces are those of the formulas at the recorded slip, and the slip angle is that of the axle.
#[test]
fn a_tyre_with_a_file_rolls_with_the_forces_of_its_coefficients() {
    for (set, angle, camber) in [("", 0.05, 0.0), ("", -0.08, 0.03), (", LMUY = 0.5, RBX1 = 0", 0.1, 0.0)] {
        let mut model = Model::from_text(BESIDE, &of_file(set));
        for (path, value) in [("parameters.angle", angle), ("parameters.camber", camber)] {
            model = model.with(path, value);
        }
        let mut session = model.session().unwrap_or_else(|error| panic!("{error}"));
        let record = session.run().unwrap_or_else(|error| panic!("{error}")).into_record();
        let mut coefficients = tyre_file(FILE).expect("a tyre property file").coefficients;
        if !set.is_empty() {
            coefficients.insert("LMUY".to_owned(), 0.5);
            coefficients.insert("RBX1".to_owned(), 0.0);
        }
        let law = MagicFormula::new(&coefficients, false).expect("a tyre");
        let [slip, alpha, pull, side, load, aligning] =
            ["slip", "slip_angle", "longitudinal", "lateral", "normal", "aligning"]
                .map(|name| last(&record, "tyre", name));
        assert!((alpha - angle).abs() < 1e-6, "{alpha} for {angle}");
        let rolling = 10.0 * angle.cos();
        let [along, across, overturning, _, moment] = law.forces([slip, alpha, camber], load, rolling);
        for (found, wanted) in [(pull, along), (side, across), (aligning, moment)] {
            // Moments fade with the velocity, by 5e-4 here.
            assert!(
                (found - wanted).abs() < 1e-6 * load + 5e-4 * moment.abs(),
                "{set} {angle}: {found} for {wanted}"
            );
        }
        // About the centre of the wheel, in global axes.
        let [m1, m2, m3] = ["m1", "m2", "m3"].map(|name| last(&record, "force", name));
        let ahead = [angle.cos(), -angle.sin(), 0.0];
        let roll = m1 * ahead[0] + m2 * ahead[1] + m3 * ahead[2];
        // The arm from the centre of the wheel to the road.
        let height = 0.317 * f64::cos(camber) - load / 2e5;
        let wanted = overturning + across * height + load * height * camber.tan();
        assert!((roll - wanted).abs() < 0.02 * load * height, "{roll} for {wanted}");
    }
}

#[test]
fn a_vehicle_that_stops_with_locked_wheels_swings_back_by_the_tread_alone() {
    let page = include_str!("../../../../docs/tyres.md");
    let model = page.split("```toml\n").find(|part| part.starts_with("lissom = 1")).expect("a model");
    let record = run(model.split("```").next().expect("a model"), &[("analysis.end", 4.0)]);
    let speed = record.column("car", "v1").expect("a column");
    // The energy of the tread as a spring of the slip stiffness over the relaxation length, F²/(2 C), as kinetic energy.
    let (force, stiffness): (f64, f64) = (0.8 * 320.0 * 9.81, 20.0 * 320.0 * 9.81 / 0.15);
    let bound = force / (stiffness * 320.0).sqrt();
    let least = speed.iter().copied().fold(0.0, f64::min);
    assert!(least > -bound, "{least}, {bound}");
    assert!(speed.last().expect("rows").abs() < 1e-3);
}

/// A locked wheel with a quarter of a car at a speed until it stands, on a tyre of the file.
fn stop(speed: f64, scheme: &str) -> Record {
    let text = format!(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.car]
mass = 320
inertia = [10, 50, 50]
position = [0, 0, 0.301304]
[joints.plane]
kind = "generic"
base = "ground"
tip = "car"
locked = ["y", "rx", "ry", "rz"]
[springs.tyre]
kind = "tyre"
base = "ground"
tip = "car"
at_base = [0, 0, 0]
normal = [0, 0, 1]
wheel_axis = [0, 1, 0]
magic_formula = "parts/passenger-car.tir"
[initial]
velocity = [{speed}, 0, 0]
[outputs.car]
kind = "displacement"
of = "car"
[outputs.speed]
kind = "velocity"
of = "car"
[outputs.tyre]
kind = "tyre"
of = "tyre"
[analysis]
kind = "dynamics"
scheme = "{scheme}"
end = 4
relative_tolerance = 1e-6
"#
    );
    let mut session = Model::from_text(BESIDE, &text).session().unwrap_or_else(|error| panic!("{error}"));
    session.run().unwrap_or_else(|error| panic!("{error}")).into_record()
}

/// Whatever the speed, not more comes back than the tread stores: F²/(2 C), C = 134 kN/m slip stiffness over relaxation length.
#[test]
fn a_locked_wheel_with_a_file_swings_back_by_the_tread_alone() {
    let law = MagicFormula::new(&tyre_file(FILE).expect("a tyre property file").coefficients, false);
    let law = law.expect("a tyre");
    let load = 320.0 * 9.81;
    let pull = |slip: f64| law.forces([slip, 0.0, 0.0], load, 10.0)[0];
    let stiffness = (pull(1e-4) - pull(-1e-4)) / 2e-4 / law.relaxation(load, 0.0)[0];
    for (speed, scheme) in [(15.0, "radau-iia-9"), (3.0, "radau-iia-9"), (1.0, "radau-iia")] {
        let record = stop(speed, scheme);
        let column = |name, component| record.column(name, component).expect("a column");
        let (place, back) = (column("car", "u1"), column("speed", "v1"));
        let largest =
            column("tyre", "longitudinal").iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        let least = back.iter().copied().fold(0.0, f64::min);
        assert!(least > -largest / (stiffness * 320.0).sqrt(), "{speed}: {least}");
        let furthest = place.iter().copied().fold(f64::MIN, f64::max);
        let at_end = *place.last().expect("rows");
        // The tread slides at its largest deflection, which is somewhat beyond the force over the stiffness.
        assert!(furthest - at_end < 1.4 * largest / stiffness, "{speed}: {furthest} {at_end}");
    }
}

/// The sign of PTX3 is that of the format of the file, whatever its FITTYP; other values of a model have the signs of its file.
#[test]
fn files_of_mf_tyre_have_another_sign_of_the_relaxation_length() {
    let lengths = |format: &str| {
        let text = FILE.replace("PROPERTY_FILE_FORMAT = 'PAC2002'", format);
        let mut file = tyre_file(&text).expect("a tyre property file");
        file.coefficients.insert("PTX3".to_owned(), 0.6);
        let law = MagicFormula::new(&file.coefficients, false).expect("a tyre");
        [2000.0, 4000.0, 6000.0].map(|load| law.relaxation(load, 0.0)[0])
    };
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?} for {wanted:?}");
    };
    for number in [5, 6, 52] {
        let format = format!("PROPERTY_FILE_FORMAT = 'MF-TYRE'\nFITTYP = {number}");
        near(lengths(&format), [0.374, 0.602, 0.722]);
    }
    for format in ["PROPERTY_FILE_FORMAT = 'PAC2002'", "PROPERTY_FILE_FORMAT = 'PAC2002'\nFITTYP = 6"] {
        near(lengths(format), [0.205, 0.602, 1.316]);
    }
}

#[test]
fn friction_with_a_negative_sign_is_the_same_tyre() {
    let law = |from: [&str; 2], to: [&str; 2]| {
        let text = FILE.replace(from[0], to[0]).replace(from[1], to[1]);
        MagicFormula::new(&tyre_file(&text).expect("a tyre property file").coefficients, false)
            .expect("a tyre")
    };
    let [first, second] = ["PDY1 = 1.0", "PDY2 = -0.13"];
    let [usual, negative] =
        [[first, second], ["PDY1 = -1.0", "PDY2 = 0.13"]].map(|to| law([first, second], to));
    for slip in [[0.0, 0.05, 0.02], [0.1, -0.2, 0.0]] {
        assert_eq!(usual.forces(slip, 5000.0, 20.0), negative.forces(slip, 5000.0, 20.0));
    }
}

/// `lissom tyre`: what the file has no data for is a warning, and what has no finite value an error.
#[test]
fn curves_of_a_tyre_are_finite_and_within_its_data() {
    let file = tyre_file(FILE).expect("a tyre property file");
    let curves = |loads: &[f64], camber| TyreCurves::new("car", &file, loads, camber);
    let warning = |load| curves(&[load], 0.0).expect("curves").warning();
    assert_eq!(warning(4000.0), None);
    assert!(warning(20000.0).is_some_and(|text| text.contains("20000.0 N") && text.contains("9000 N")));
    assert!(warning(100.0).is_some_and(|text| text.contains("200 to")));
    for (load, camber) in [(f64::NAN, 0.0), (f64::INFINITY, 0.0), (1e300, 0.0), (4000.0, f64::NAN)] {
        assert!(curves(&[load], camber).is_err(), "{load} {camber}");
    }
}

/// A step of the road within the contact is no plane.
#[test]
fn a_step_of_the_road_within_the_contact_is_reported() {
    let codes = |road: &str| {
        let text = RIG.replace("radius = 0.3\n", &format!("radius = 0.3\nroad = \"{road}\"\n"));
        let mut session = Model::from_text("model.toml", &text).session().expect("a session");
        // The step is too high for some runs.
        let _ = session.run();
        session.warnings().map(Warning::code).collect::<Vec<_>>()
    };
    assert!(codes("0.15*smoothstep((x - 0.5)/0.02)").contains(&"road-beyond-contact"));
    assert!(!codes("0.15*smoothstep((x - 0.5)/1.5)").contains(&"road-beyond-contact"));
}

/// On a slope that is a road the plane of the tyre is the slope, also across it.
#[test]
fn a_road_that_is_plane_has_the_forces_of_a_plane() {
    let plane = RIG.replace("normal = [0, 0, 1]", "normal = [\"-0.1\", \"-0.05\", 1]");
    let road = RIG.replace("radius = 0.3\n", "radius = 0.3\nroad = \"0.1*x + 0.05*y\"\n");
    let road = run(&road, &[("analysis.end", 0.1)]);
    let plane = run(&plane, &[("analysis.end", 0.1)]);
    for component in ["f1", "f2", "f3", "m1", "m2", "m3"] {
        let [wanted, found] = [&plane, &road].map(|record| last(record, "force", component));
        assert!((wanted - found).abs() < 1e-6 * 3000.0, "{component}: {found} for {wanted}");
    }
}

/// A free wheel on a wavy road: over waves that are longer than the contact the axle of a light wheel follows the mean height under it.
#[test]
fn a_wave_is_averaged_over_the_contact() {
    for wave in [4.0_f64, 0.5] {
        let text = RIG.replace(
            "radius = 0.3\n",
            &format!("radius = 0.3\ncontact_length = 0.2\nroad = \"0.002*cos(2*pi*x/{wave})\"\n"),
        );
        let record =
            run(&text, &[("parameters.speed", 0.01), ("analysis.end", 0.05), ("analysis.step", 1e-2)]);
        let load = last(&record, "force", "f3");
        let mean: f64 = [-0.1, -0.05, 0.0, 0.05, 0.1]
            .iter()
            .map(|l| (std::f64::consts::TAU * l / wave).cos() / 5.0)
            .sum();
        assert!((load - (3000.0 + 2e5 * 0.002 * mean)).abs() < 0.05, "{wave}: {load}");
    }
}

#[test]
fn a_road_may_be_a_sum_of_expressions_and_tables() {
    let height = |road: &str| {
        let text = RIG.replace("radius = 0.3\n", &format!("radius = 0.3\nroad = {road}\n"));
        let record = run(&text, &[("parameters.speed", 0.0), ("analysis.end", 2e-3)]);
        (last(&record, "force", "f3") - 3000.0) / 2e5
    };
    assert!((height("[\"0.001\", { table = [[-1, 0.002], [1, 0.002]] }]") - 0.003).abs() < 1e-9);
}
