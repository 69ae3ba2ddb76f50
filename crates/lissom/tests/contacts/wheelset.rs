//! Wheels on rails: the wheelset of Simeon, Fuehrer and Rentrop 1991 with its published digits, all schemes, stability, and what
//! is reported where the model of one contact ends.

use lissom::analyses::modes::{ModeReport, ModeRequest, OperatingPoint, modes};
use lissom::{Model, Record};
use lissom_core::linearized::ModeKind;

use crate::support::on_one_line::refused_on_one_line;
use crate::support::runs::{overrides, session};

const MODEL: &str = include_str!("../../../../verification/wheelset/model.toml");

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

fn run(text: &str, set: &[(&str, &str)]) -> (Record, Vec<String>) {
    let mut session = session(text, set);
    let record = session.run().unwrap_or_else(|error| panic!("{set:?}: {error:?}")).into_record();
    let warnings = session.warnings().map(ToString::to_string).collect();
    (record, warnings)
}

fn values(record: &Record, row: usize) -> [f64; 17] {
    let of = |output: &str, component: &str| {
        record.column(output, component).unwrap_or_else(|| panic!("{output}.{component}"))[row]
    };
    let pressed = |side: &str| -of(side, "normal") * (of(side, "rail") / 0.06 - 0.0262).cos() / 1e4;
    [
        of("centre", "x"),
        of("centre", "y"),
        of("centre", "z"),
        of("theta", "value"),
        of("phi", "value"),
        of("velocity", "v1"),
        of("velocity", "v2"),
        of("velocity", "v3"),
        of("theta_rate", "value"),
        of("phi_rate", "value"),
        of("beta", "value"),
        of("right", "shift"),
        -0.1506 - of("right", "wheel"),
        -of("left", "shift"),
        0.1506 + of("left", "wheel"),
        pressed("left"),
        pressed("right"),
    ]
}

/// At t = 10 s: positions x, y, z, θ, φ, their rates, β, ψ and ξ of the right and of the left wheel, multipliers over 10⁴.
const PUBLISHED: [f64; 17] = [
    8.635_538_696_581_1e-3,
    1.303_828_102_272_7e-5,
    -9.363_578_401_681_8e-5,
    -1.364_229_980_403_3e-2,
    1.529_289_500_542_2e-3,
    -7.698_537_414_266_6e-2,
    -2.515_110_642_920_7e-4,
    2.054_118_807_953_9e-3,
    -2.390_483_770_369_2e-1,
    -1.363_346_845_417_3e-2,
    -2.442_137_766_113_1e-1,
    -3.366_675_197_219_6e-4,
    -1.594_942_568_402_2e-1,
    3.783_961_438_696_9e-4,
    1.417_321_496_461_3e-1,
    -1.012_404_490_320_1e-2,
    -5.628_563_057_375_3e-3,
];

#[test]
fn the_end_of_ten_seconds_has_the_published_digits() {
    let (record, warnings) = run(MODEL, &[("analysis.relative_tolerance", "3e-7")]);
    assert!(warnings.is_empty(), "{warnings:?}");
    let found = values(&record, record.times.len() - 1);
    for (k, (found, wanted)) in found.into_iter().zip(PUBLISHED).enumerate() {
        // Multipliers converge with a lower order.
        let digits = if k < 15 { 1e-5 } else { 3e-5 };
        assert!(
            (found / wanted - 1.0).abs() < digits,
            "{k}: {found:e} {wanted:e}: {:e}",
            found / wanted - 1.0
        );
    }
}

/// From the equations of 1991 with the multipliers that keep their constraints; the published ones have five digits, and the published
/// accelerations follow from these. Positions of contact are the published ones.
#[test]
fn accelerations_and_normal_forces_at_the_start_are_those_of_the_equations() {
    let (record, _) = run(MODEL, &[("analysis.end", "1e-3")]);
    for (component, wanted) in
        [("a1", -1.975_257_157_911_888), ("a2", -1.066_580_003e-3), ("a3", 7.883_940_446_7e-2)]
    {
        let found = record.column("acceleration", component).expect("there")[0];
        assert!((found - wanted).abs() < 1e-8, "{component}: {found} {wanted}");
    }
    let start = values(&record, 0);
    for (k, wanted) in [
        (11, -7.412_238_035_766_714e-6),
        (12, -0.152_136_429_612_124_8),
        (13, 7.563_440_639_517_294e-6),
        (14, 0.149_063_571_473_381_9),
        (15, -8.359_184_018_251_93e-3),
        (16, -7.414_552_841_370_28e-3),
    ] {
        assert!((start[k] / wanted - 1.0).abs() < 1e-7, "{k}: {} {wanted}", start[k]);
    }
}

#[test]
fn all_schemes_find_the_same_motion() {
    let set = |scheme| [("analysis.scheme", scheme), ("analysis.end", "0.2"), ("analysis.step", "1e-4")];
    let reference = run(MODEL, &set("radau-iia")).0;
    let wanted = values(&reference, reference.times.len() - 1);
    for scheme in SCHEMES {
        let (record, warnings) = run(MODEL, &set(scheme));
        assert!(warnings.is_empty(), "{scheme}: {warnings:?}");
        let found = values(&record, record.times.len() - 1);
        for k in [0, 1, 3, 4, 12, 14, 15, 16] {
            assert!((found[k] / wanted[k] - 1.0).abs() < 2e-3, "{scheme} {k}: {} {}", found[k], wanted[k]);
        }
    }
    let chosen = [("analysis.relative_tolerance", "1e-7"), ("analysis.end", "0.2")];
    let record = run(MODEL, &chosen).0;
    let found = values(&record, record.times.len() - 1);
    for k in [0, 1, 3, 4, 12, 14, 15, 16] {
        assert!((found[k] / wanted[k] - 1.0).abs() < 1e-3, "chosen steps {k}: {} {}", found[k], wanted[k]);
    }
}

/// The same wheelset seen from the ground, with a body that turns with its wheels: nothing but the description differs.
#[test]
fn a_body_that_turns_and_goes_along_moves_as_one_in_axes_that_run_with_it() {
    let set = [("analysis.end", "0.1"), ("analysis.step", "1e-5")];
    let free = MODEL.replace("velocity = [0, 0, \"speed\"]\n", "").replace("wheel_spin = \"spin\"\n", "");
    let from = free.find("[loads.spin]").expect("there");
    let to = free.find("[joints.left]").expect("there");
    let free = free[..from].to_owned() + &free[to..];
    let free = free.replace(
        "[bodies.wheelset]\n",
        "[bodies.wheelset]\nvelocity = [0, 0, \"speed\"]\nangular_velocity = [\"spin\", 0, 0]\n",
    );
    let free = free.replace("-2*stiffness*centre.z", "-2*stiffness*(centre.z - speed*t)");
    let (still, moving) = (run(MODEL, &set).0, run(&free, &set).0);
    let last = still.times.len() - 1;
    let (still, moving) = (values(&still, last), values(&moving, last));
    // Normal forces of steps as short as a body needs that turns so fast are found to a hundredth only.
    for k in [0, 1, 3, 4, 5, 8, 9, 12, 14] {
        assert!(
            (moving[k] - still[k]).abs() < 2e-5 * (1e-3 + still[k].abs()),
            "{k}: {} {}",
            moving[k],
            still[k]
        );
    }
}

/// A run that is stopped in the middle goes on to the last bit.
#[test]
fn a_snapshot_in_the_middle_changes_nothing() {
    let set = overrides(&[("analysis.end", "0.05"), ("analysis.step", "5e-4")]);
    let model = Model::from_text("wheelset.toml", MODEL);
    let open = || model.with_overrides(&set).session().map_err(|_| "valid").expect("valid");
    let mut whole = open();
    let mut first = open();
    for _ in 0..40 {
        whole.advance().expect("a solution");
        first.advance().expect("a solution");
    }
    let snapshot = first.snapshot();
    let mut second = open();
    second.restore(&snapshot).expect("the same model");
    for _ in 0..30 {
        whole.advance().expect("a solution");
        second.advance().expect("a solution");
    }
    assert_eq!(whole.state().kinematics, second.state().kinematics);
    assert_eq!(whole.state().multipliers, second.state().multipliers);
}

/// Warnings where one contact is no model of a wheel, and refusals of what says nothing.
#[test]
fn what_the_model_does_not_know_is_reported() {
    let short = [("analysis.end", "0.02"), ("analysis.step", "1e-3")];
    let narrow = MODEL.replace("head_radius = 0.06", "head_radius = 0.06\ntread = [-1e-3, 1e-3]");
    let (_, warnings) = run(&narrow, &short);
    assert!(warnings.iter().any(|warning| warning.contains("beyond its tread")), "{warnings:?}");
    let lifted = MODEL.replace("gravity = [0, -9.81, 0]", "gravity = [0, 1, 0]");
    let (_, warnings) = run(&lifted, &short);
    assert!(warnings.iter().any(|warning| warning.contains("pulls its wheel")), "{warnings:?}");
    for (from, to, wanted) in [
        ("radius = \"radius\"", "radius = 0.11", "from the rail at the start"),
        ("head_radius = 0.06", "", "must say what the rail's head is"),
        ("cone_angle = \"cone\"", "wheel_profile = \"-0.02*y\"", "must be given with `wheel_profile`"),
        ("friction_coefficient = 0.12", "", "need `friction_coefficient`"),
        ("velocity = [0, 0, \"speed\"]", "velocity = [1, 0, \"speed\"]", "must go along the rail"),
        ("head_radius = 0.06", "rail_profile = \"0.1 - y^2\"", "must be 0 at y = 0"),
        ("head_radius = 0.06", "head_radius = 0.06\nrail_profile = \"-y^2\"", "remove one of them"),
        ("axle = [\"cos(yaw)*cos(roll)\", \"sin(roll)\"", "axle = [0.57, 1", "within 60 degrees"),
        ("axle = [\"cos(yaw)*cos(roll)\", \"sin(roll)\"", "axle = [-0.57, 1", "within 60 degrees"),
        ("axle = [\"cos(yaw)*cos(roll)\", \"sin(roll)\"", "axle = [0, 1", "within 60 degrees"),
        ("cone_angle = \"cone\"", "cone_angle = 1.01", "between -1 and 1 rad"),
        ("cone_angle = \"cone\"", "cone_angle = -1.01", "between -1 and 1 rad"),
        ("cone_angle = \"cone\"", "cone_angle = \"cone\"\ncant = -1.01", "between -1 and 1 rad"),
        ("head_radius = 0.06", "head_radius = 0.06\ntread = [0.01, 0.02]", "contain the nominal circle"),
        ("head_radius = 0.06", "head_radius = 0.06\ntread = [-0.02, -0.01]", "contain the nominal circle"),
        ("kalker = [4.72772197,", "kalker = [-4.72772197,", "must not be negative"),
        ("poisson_number = 0.28", "poisson_number = 0.51", "must not be larger than 0.5"),
        ("ellipse = [1.3537956, 0.7115218]", "ellipse = [1.3537956, 0]", "two positive numbers"),
    ] {
        assert!(MODEL.contains(from), "{from}");
        let found = refused_on_one_line(&MODEL.replace(from, to));
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
}

/// Profiles that are given are those of the cone and of the circle where they say the same.
#[test]
fn profiles_may_be_expressions() {
    let set = [("analysis.end", "0.1"), ("analysis.step", "5e-4")];
    let expressions = MODEL
        .replace("cone_angle = \"cone\"\nhead_radius = 0.06", "wheel_profile = \"-tan(cone)*y\"\ntread = [-0.05, 0.05]\nrail_profile = \"sqrt(0.06^2 - (y - 0.06*sin(cone))^2) - 0.06*cos(cone)\"");
    assert_ne!(expressions, MODEL);
    let (one, other) = (run(MODEL, &set).0, run(&expressions, &set).0);
    for name in ["x", "y", "z"] {
        let (one, other) =
            (one.column("centre", name).expect("there"), other.column("centre", name).expect("there"));
        for (a, b) in one.iter().zip(other) {
            assert!((a - b).abs() < 1e-11, "{name}: {a} {b}");
        }
    }
}

/// The run in the middle of the track.
fn steady(set: &[(&str, &str)]) -> ModeReport {
    let middle = ["x0", "y0", "z0", "yaw", "roll"].map(|name| format!("parameters.{name}"));
    let middle = middle.iter().map(|path| (path.as_str(), "0"));
    let all: Vec<_> = middle.chain(set.iter().copied()).collect();
    let request = ModeRequest { about: Some(OperatingPoint::Time(0.0)), ..ModeRequest::default() };
    modes(&Model::from_text("wheelset.toml", MODEL).with_overrides(&overrides(&all)), &request)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Wavelength of the hunting mode [m], that of lateral position and yaw together, and its damping ratio: the other oscillation is that
/// along the track, which is hardly damped.
fn hunting(speed: f64, report: &ModeReport) -> (f64, f64) {
    let is_hunting = |mode: &&lissom_core::linearized::Mode| {
        matches!(mode.kind, ModeKind::Oscillation | ModeKind::Flutter) && mode.damping.abs() < 0.5
    };
    let mode =
        report.modes.iter().filter(is_hunting).max_by(|a, b| a.damping.abs().total_cmp(&b.damping.abs()));
    let mode = mode.expect("it hunts");
    (speed / mode.frequency, mode.damping)
}

/// Klingel 1883: a slow free wheelset hunts with the wavelength 2π (r b/tan γ)^½, for small angles γ of the cone.
#[test]
fn a_slow_wheelset_hunts_with_klingels_wavelength() {
    for (cone, tolerance) in [("1e-3", 5e-4), ("2e-3", 1e-3), ("1e-2", 4e-3)] {
        let set = [("parameters.speed", "0.5"), ("parameters.stiffness", "1e-3"), ("parameters.cone", cone)];
        let (found, _) = hunting(0.5, &steady(&set));
        let angle: f64 = cone.parse().expect("a number");
        let wanted = std::f64::consts::TAU * (0.1 * 0.1506 / angle.tan()).sqrt();
        assert!((found / wanted - 1.0).abs() < tolerance, "{cone}: {found} {wanted}");
    }
}

/// Hunting decays below the critical speed and grows above it, in modes as in motion.
#[test]
fn beyond_the_critical_speed_hunting_grows() {
    let at = |speed: f64| hunting(speed, &steady(&[("parameters.speed", &speed.to_string())])).1;
    assert!(at(15.0) > 0.05 && at(24.0) > 0.0 && at(26.0) < 0.0 && at(30.0) < -0.05);
    for (speed, grows) in [("20", false), ("30", true)] {
        let set = [
            ("parameters.speed", speed),
            ("parameters.x0", "1e-5"),
            ("parameters.y0", "0"),
            ("parameters.z0", "0"),
            ("parameters.yaw", "0"),
            ("parameters.roll", "0"),
            ("analysis.end", "1"),
            ("analysis.step", "1e-3"),
        ];
        // The radius that touches at the start: the wheelset does not stand quite in the middle.
        let text = MODEL.replace("radius = \"radius\"\n", "");
        let record = run(&text, &set).0;
        let places = record.column("centre", "x").expect("there");
        let largest = |rows: &[f64]| rows.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let (first, last) = (largest(&places[..250]), largest(&places[750..]));
        assert_eq!(last > first, grows, "{speed} m/s: {first} {last}");
    }
}
