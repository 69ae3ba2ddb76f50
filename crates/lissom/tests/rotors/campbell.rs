//! Campbell diagrams against closed forms: frequencies of rotors over their speed, whirl, critical speeds.

use std::f64::consts::TAU;
use std::fmt::Write;

use lissom::Model;
use lissom::analyses::AnalysisReport;
use lissom::analyses::campbell::{CampbellError, CampbellReport, CampbellRequest, Variation, campbell};
use lissom::analyses::modes::{ModeRequest, ModesError, OperatingPoint, modes};

fn request(path: &str, from: f64, to: f64, values: usize, count: usize, rays: &[u32]) -> CampbellRequest {
    CampbellRequest {
        vary: Variation { path: path.to_owned(), from, to, values },
        count,
        shift: None,
        averaged: false,
        rays: rays.to_vec(),
    }
}

fn find(text: &str, request: &CampbellRequest) -> CampbellReport {
    campbell(&Model::from_text("model.toml", text), request).unwrap_or_else(|error| panic!("{error}"))
}

/// Rows of `campbell.csv` as text, without the heading.
fn rows(found: &CampbellReport) -> Vec<Vec<String>> {
    let csv = found.csv();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some("value,rotation,line,frequency,damping,kind,whirl,frequency_at_rest,likeness")
    );
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// A disc on a turning universal joint with equal springs, ahead of it by an arm.
const OVERHUNG: &str = concat!(
    r#"
lissom = 1
[parameters]
speed = 10.0
[initial]
angular_velocity = ["speed", 0, 0]
"#,
    include_str!("../support/rotor.toml"),
    r#"stiffness = 2000
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#
);

const SHAFT: &str = r#"
lissom = 1
[parameters]
speed = 1000.0
A = "pi*0.1^2/4"
I = "pi*0.1^4/64"
E = 210e9
G = "E/2.6"
rho = 7800.0
[initial]
angular_velocity = ["speed", 0, 0]
[sections.round]
shape = "general"
stiffness = ["E*A", "0.9*G*A", "0.9*G*A", "2*G*I", "E*I", "E*I"]
mass = { per_length = "rho*A", inertia = ["2*rho*I", "rho*I", "rho*I"] }
[beams.shaft]
section = "round"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 6
order = 3
up = [0, 0, 1]
[joints.left]
kind = "spherical"
base = "ground"
tip = "shaft.start"
[bodies.slider]
mass = 1e-3
inertia = [1e-6, 1e-6, 1e-6]
position = [1, 0, 0]
angular_velocity = [0, 0, 0]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "slider"
axis = [1, 0, 0]
[joints.right]
kind = "spherical"
base = "slider"
tip = "shaft.end"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

/// A slender blade of length 1 with EI/(m l⁴) = 100 on a hub that is driven.
const BLADE: &str = r#"
lissom = 1
[parameters]
speed = 0.0
[initial]
angular_velocity = [0, 0, "speed"]
[sections.bar]
shape = "general"
stiffness = [1e9, 1e9, 1e9, 300, 100, 100]
mass = { per_length = 1, inertia = [2e-7, 1e-7, 1e-7] }
[bodies.hub]
mass = 1
inertia = [1, 1, 1]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "bearing"
rotation = "speed*t"
[beams.blade]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 8
order = 3
up = [0, 0, 1]
[joints.root]
kind = "clamp"
base = "hub"
tip = "blade.start"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

#[test]
fn a_pinned_shaft_whirls_as_timoshenko_with_gyroscopic_terms() {
    let found = find(SHAFT, &request("parameters.speed", 0.0, 5000.0, 6, 8, &[1]));
    // (speed, whirl, rate) from the closed form.
    let exact = [
        (0.0, "none", 1_265.252_786_665_797),
        (0.0, "none", 4_895.358_453_704_809),
        (1000.0, "backward", 1_259.345_279_007_77),
        (1000.0, "forward", 1_271.186_045_763_526),
        (1000.0, "backward", 4_874.282_454_524_622),
        (1000.0, "forward", 4_916.500_644_197_979),
        (5000.0, "backward", 1_235.973_776_405_949),
        (5000.0, "forward", 1_295.175_457_538_834),
        (5000.0, "backward", 4_790.652_106_871_153),
        (5000.0, "forward", 5_001.719_076_910_756),
    ];
    let rows = rows(&found);
    assert!(rows.iter().all(|row| row[5] != "oscillation" || row[6] != "mixed"), "{rows:#?}");
    for (speed, whirl, rate) in exact {
        let least = rows
            .iter()
            .filter(|row| row[0].parse::<f64>().unwrap() == speed && row[6] == whirl)
            .filter_map(|row| row[7].parse::<f64>().ok())
            .map(|seen| (seen * TAU / rate - 1.0).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(least < 2e-5, "{whirl} {rate} at {speed}: {least:e} in {rows:#?}");
    }
    // Lines go on: a line has one whirl from the second speed on.
    let turning: Vec<_> = rows.iter().filter(|row| row[0] != "0.0" && row[5] == "oscillation").collect();
    for row in &turning {
        for other in turning.iter().filter(|other| other[2] == row[2]) {
            assert_eq!(other[6], row[6], "{row:?} {other:?}");
        }
    }
    // Critical speeds: the same equation with the rate of whirl that of the rotation, forward or against it.
    let (area, second) = (std::f64::consts::PI * 0.01 / 4.0, std::f64::consts::PI * 1e-4 / 64.0);
    let (density, young) = (7800.0, 210e9);
    let shear = 0.9 * young / 2.6 * area;
    let critical = |number: f64, sign: f64| {
        let k = number * std::f64::consts::PI;
        let left = |w: f64| {
            (density * area * w * w - shear * k * k)
                * (density * second * w * w * (1.0 - 2.0 * sign) - young * second * k * k - shear)
                - (shear * k).powi(2)
        };
        let (mut low, mut high) = (number * number * 1000.0, number * number * 1300.0);
        assert!(left(low) * left(high) < 0.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if left(low) * left(middle) <= 0.0 { high = middle } else { low = middle }
        }
        low
    };
    for (whirl, expected) in
        [("forward", vec![critical(1.0, 1.0)]), ("backward", vec![critical(1.0, -1.0), critical(2.0, -1.0)])]
    {
        let own = found.crossings.iter().filter(|crossing| crossing.whirl == whirl);
        let mut values: Vec<f64> = own.map(|crossing| crossing.value).collect();
        values.sort_by(f64::total_cmp);
        assert_eq!(values.len(), expected.len(), "{:?}", found.crossings);
        for (value, exact) in values.iter().zip(expected) {
            assert!((value / exact - 1.0).abs() < 2e-5, "{whirl}: {value} for {exact}");
        }
    }
}

#[test]
fn an_overhung_disc_whirls_forward_and_backward_as_in_closed_form() {
    // Inclination θ = θ₁ + iθ₂ in axes at rest: I_t θ'' - i I_p Ω θ' + k θ = 0 about the centre of the joint.
    let driven = "[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"bearing\"\nrotation = \"speed*t\"\n[bodies.disc]";
    let text = OVERHUNG.replace("[bodies.disc]", driven);
    let found = find(&text, &request("parameters.speed", 25.0, 200.0, 8, 4, &[1]));
    let (across, along, stiffness) = (0.15 + 5.0 * 0.3 * 0.3, 0.3_f64, 2000.0_f64);
    let rows = rows(&found);
    for speed in [50.0, 100.0, 150.0, 200.0] {
        let root = ((along * speed).powi(2) + 4.0 * across * stiffness).sqrt();
        for (whirl, rate) in [("forward", root + along * speed), ("backward", root - along * speed)] {
            let rate = rate / (2.0 * across);
            let seen: Vec<f64> = rows
                .iter()
                .filter(|row| row[0].parse::<f64>().unwrap() == speed && row[6] == whirl)
                .filter_map(|row| row[7].parse::<f64>().ok())
                .map(|seen| seen * TAU)
                .collect();
            let least = seen.iter().map(|seen| (seen / rate - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-8, "{whirl} {rate} at {speed}: {seen:?} in {rows:#?}");
        }
    }
}

#[test]
fn an_overhung_rotor_that_turns_freely_whirls_like_one_that_is_driven() {
    // Torques about the axis are of second order: the free rotation adds a rigid mode and changes no other.
    let found = find(OVERHUNG, &request("parameters.speed", 50.0, 200.0, 4, 5, &[1]));
    let (across, along, stiffness) = (0.15 + 5.0 * 0.3 * 0.3, 0.3_f64, 2000.0_f64);
    let rows = rows(&found);
    for speed in [50.0, 100.0, 150.0, 200.0] {
        let own: Vec<_> = rows.iter().filter(|row| row[0].parse::<f64>().unwrap() == speed).collect();
        assert_eq!(own.iter().filter(|row| row[5] == "rigid").count(), 1, "{own:#?}");
        let root = ((along * speed).powi(2) + 4.0 * across * stiffness).sqrt();
        for (whirl, rate) in [("forward", root + along * speed), ("backward", root - along * speed)] {
            let rate = rate / (2.0 * across);
            let seen = own.iter().filter(|row| row[6] == whirl).filter_map(|row| row[7].parse::<f64>().ok());
            let least = seen.map(|seen| (seen * TAU / rate - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-8, "{whirl} {rate} at {speed}: {own:#?}");
        }
    }
}

#[test]
fn a_blade_on_a_wide_hub_flaps_and_lags_as_published() {
    // A hub as wide as the blade is long: μ = ω √(m l⁴/EI) of a rotating Euler-Bernoulli cantilever by power series [Wright, Smith,
    // Thresher and Wang 1982 have five digits]; lag: the square less that of the rotation.
    let text =
        BLADE.replace("from = [0, 0, 0]", "from = [1, 0, 0]").replace("to = [1, 0, 0]", "to = [2, 0, 0]");
    let found = find(&text, &request("parameters.speed", 0.0, 120.0, 5, 6, &[1]));
    let exact: [(f64, [f64; 2]); 4] = [
        (3.0, [6.081_749_684_998, 24.927_745_241_135]),
        (6.0, [10.443_865_869_460, 32.027_243_982_645]),
        (9.0, [15.054_077_058_518, 41.115_408_160_182]),
        (12.0, [19.721_541_935_255, 51.070_134_014_271]),
    ];
    for (eta, flaps) in exact {
        let point = found.points.iter().find(|point| (point.value - 10.0 * eta).abs() < 1e-9).unwrap();
        let rates: Vec<f64> = point.modes.iter().map(|of| of.mode.eigenvalue.im / 10.0).collect();
        for exact in flaps.into_iter().flat_map(|flap| [flap, (flap * flap - eta * eta).sqrt()]) {
            let least = rates.iter().map(|rate| (rate / exact - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-4, "{exact} at {eta}: {rates:?}");
        }
    }
}

#[test]
fn a_blade_is_stiffened_by_its_rotation() {
    // A slender blade on a hub of radius 0.5: flap of a rotating cantilever, against the two-term formula of Southwell with the
    // exact value at rest; and lag, which is softer by the square of the rotation.
    let found = find(BLADE, &request("parameters.speed", 0.0, 120.0, 5, 4, &[1, 3]));
    // Rotating Euler-Bernoulli cantilever without hub radius, flap: η = Ω √(ρA l⁴/EI) = 12 gives 13.1702, 6 gives 7.3604
    // (Wright et al. 1982); lag: square less that of the rotation.
    for (speed, flap) in [(60.0, 7.3604), (120.0, 13.1702)] {
        let point = found.points.iter().find(|point| point.value == speed).unwrap();
        let rates: Vec<f64> = point.modes.iter().map(|of| of.mode.eigenvalue.im / 10.0).collect();
        let eta = speed / 10.0;
        let lag = (flap * flap - eta * eta).sqrt();
        for exact in [flap, lag] {
            let least = rates.iter().map(|rate| (rate / exact - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-4, "{exact} at {speed}: {rates:?}");
        }
    }
}

/// Three blades on a hub that turns freely, at 20 rad/s; one is struck at its tip after 0.2 s.
pub(super) fn turbine() -> String {
    let mut text = r#"
lissom = 1
[parameters]
speed = 20.0
[initial]
angular_velocity = [0, 0, "speed"]
steady_rotation = true
[sections.bar]
shape = "general"
stiffness = [1e6, 1e6, 1e6, 30, 60, 150]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
[bodies.hub]
mass = 2
inertia = [0.3, 0.3, 0.5]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [0, 0, 1]
[loads.strike]
kind = "force"
on = "blade0.end"
vector = [0, 0.3, 0.3]
scale = "exp(-((t-0.2)/0.02)^2)"
[outputs.tip]
kind = "position"
of = "blade0.end"
relative_to = "hub"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 12
step = 4e-3
"#
    .to_owned();
    for k in 0..3 {
        let (sine, cosine) = (f64::from(k) * TAU / 3.0).sin_cos();
        let [x, y] = [0.2, 1.2].map(|r| (r * cosine, r * sine)).map(|(x, y)| format!("{x:?}, {y:?}"));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "[beams.blade{k}]\nsection = \"bar\"\nfrom = [{x}, 0]\nto = [{y}, 0]\nelements = 3\nup = [0, 0, 1]\n\
             [joints.root{k}]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"blade{k}.start\"\n"
        );
    }
    text
}

/// The rate near `rate` at which a signal of equal steps, weighed with Hann's window, is strongest, and how strong it is there and
/// a twelfth beside it.
pub(super) fn peak(signal: &[f64], step: f64, rate: f64) -> (f64, [f64; 2]) {
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let strength = |rate: f64| {
        let (mut real, mut imaginary) = (0.0, 0.0);
        for (k, value) in signal.iter().enumerate() {
            let window = 1.0 - (TAU * k as f64 / (signal.len() - 1) as f64).cos();
            let (sine, cosine) = (rate * step * k as f64).sin_cos();
            real += window * (value - mean) * cosine;
            imaginary += window * (value - mean) * sine;
        }
        real.hypot(imaginary)
    };
    let (mut low, mut high) = (rate * 0.985, rate * 1.015);
    for _ in 0..40 {
        let third = (high - low) / 3.0;
        if strength(low + third) < strength(high - third) { low += third } else { high -= third }
    }
    (0.5 * (low + high), [strength(low), strength(rate * 13.0 / 12.0)])
}

#[test]
fn a_three_bladed_rotor_decays_with_the_frequencies_of_its_diagram() {
    let text = turbine();
    let ask = ModeRequest { count: Some(9), about: Some(OperatingPoint::Rotation), ..ModeRequest::default() };
    let model = Model::from_text("model.toml", &text);
    let found = modes(&model, &ask).unwrap_or_else(|error| panic!("{error}"));
    let mut session = model.session().unwrap();
    let record = session.run().unwrap();
    let from = record.times.iter().position(|&time| time > 0.4).unwrap();
    // Flap is along the axis, lag across blade and axis; the first of each has no other near it but that of all blades
    // together, which turns the hub as well.
    for (component, index) in [("z", 2), ("y", 1)] {
        let signal = &record.column("tip", component).unwrap()[from..];
        let own = |mode: &&lissom_core::linearized::Mode| {
            let at = found.modes.iter().position(|known| known.eigenvalue == mode.eigenvalue).unwrap();
            let tip = found.shapes[at].iter().find(|shape| shape.node == "blade0.end").unwrap();
            let sizes = tip.displacement.map(num_complex::Complex64::norm);
            mode.frequency > 0.0
                && sizes[index] > 0.9 * sizes.iter().fold(0.0_f64, |most, size| most.max(*size))
        };
        let rate = found.modes.iter().find(own).unwrap().eigenvalue.im;
        let (seen, [there, beside]) = peak(signal, 4e-3, rate);
        assert!((seen / rate - 1.0).abs() < 2e-3, "{component}: {seen} for {rate} in {}", found.csv());
        assert!(there > 10.0 * beside, "{component}: {there} {beside}");
    }
}

#[test]
fn modes_of_two_blades_on_a_support_that_yields_one_way_are_left_out_with_the_reason() {
    let text = r#"
lissom = 1
[initial]
angular_velocity = [0, 0, 10]
[bodies.support]
mass = 5
inertia = [1, 1, 1]
angular_velocity = [0, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "support"
axis = [1, 0, 0]
[springs.support]
kind = "axial"
joint = "slide"
stiffness = 5000
[bodies.hub]
mass = 1
inertia = [0.1, 0.1, 0.1]
[joints.bearing]
kind = "revolute"
base = "support"
tip = "hub"
axis = [0, 0, 1]
[bodies.blade1]
mass = 1
inertia = [0.01, 0.1, 0.1]
position = [0.6, 0, 0]
[bodies.blade2]
mass = 1
inertia = [0.01, 0.1, 0.1]
position = [-0.6, 0, 0]
[joints.hinge1]
kind = "revolute"
base = "hub"
tip = "blade1"
at = [0.1, 0, 0]
axis = [0, 0, 1]
[joints.hinge2]
kind = "revolute"
base = "hub"
tip = "blade2"
at = [-0.1, 0, 0]
axis = [0, 0, 1]
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;
    let ask = ModeRequest { count: Some(4), about: Some(OperatingPoint::Rotation), ..ModeRequest::default() };
    let found = modes(&Model::from_text("model.toml", text), &ask).expect("some modes are constant");
    let words = found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    for part in ["omitted", "coefficients change as the model rotates", "Floquet"] {
        assert!(words.contains(part), "{words}");
    }
}

#[test]
fn what_is_not_constant_is_refused() {
    // The rotor of the overhung disc on a support that yields: coefficients of the support's axes change with the angle.
    let text =
        OVERHUNG.replace("base = \"ground\"\ntip = \"hub\"", "base = \"support\"\ntip = \"hub\"").replace(
            "[bodies.disc]",
            r#"[bodies.support]
mass = 2
inertia = [0.1, 0.1, 0.1]
angular_velocity = [0, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "support"
axis = [0, 1, 0]
[springs.support]
kind = "axial"
joint = "slide"
stiffness = 1e5
[bodies.disc]"#,
        );
    let model = Model::from_text("model.toml", &text);
    let ask = request("parameters.speed", 50.0, 100.0, 2, 3, &[1]);
    match campbell(&model, &ask) {
        Err(CampbellError::Modes { error, .. }) => {
            assert!(matches!(*error, ModesError::Periodic { .. }), "{error}");
        }
        other => panic!("{other:?}"),
    }
    // At rest it has modes: they are reported, and what is missing.
    let found = campbell(&model, &request("parameters.speed", 0.0, 100.0, 3, 3, &[1]))
        .expect("a part of the diagram");
    assert_eq!(
        (found.points.len(), found.failed.iter().map(|own| own.0).collect::<Vec<_>>()),
        (1, vec![50.0, 100.0])
    );
    let missing = found.missing().expect("a reason");
    assert!(missing.code == "periodic-coefficients" && missing.cause.contains("1 other"), "{missing}");
    assert!(missing.cause.contains("`parameters.speed` = 50"), "{missing}");
    // Nothing turns.
    let ask = ModeRequest { count: Some(2), about: Some(OperatingPoint::Rotation), ..ModeRequest::default() };
    let still = OVERHUNG.replace("speed = 10.0", "speed = 0.0");
    let error = modes(&Model::from_text("model.toml", &still), &ask).expect_err("it is at rest");
    assert!(error.to_string().contains("nothing rotates"), "{error}");
    // Gravity across the axis.
    let heavy = OVERHUNG.replace("[parameters]", "gravity = [0, 0, -9.81]\n[parameters]");
    let found = modes(&Model::from_text("model.toml", &heavy), &ask);
    assert!(found.is_err(), "{found:?}");
}

const TURBINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/turbine-rotor.toml");

#[test]
fn a_rotor_that_turns_freely_needs_no_gravity_across_its_axis() {
    let turbine = Model::read(std::path::Path::new(TURBINE)).unwrap();
    let of_speed = request("parameters.speed", 0.1, 4.0, 4, 8, &[3]);
    // At some azimuths the weights of the blades are in balance: not even there is the rotation steady.
    let refused = campbell(&turbine, &of_speed).unwrap_err();
    let CampbellError::Modes { error, value: 0.1, .. } = &refused else { panic!("{refused}") };
    assert!(matches!(**error, ModesError::SteadyHereAlone { .. }), "{refused}");
    let reported = refused.to_string();
    assert!(reported.contains("--unset gravity") && !reported.contains("  "), "{reported}");

    let weightless = [("gravity".to_owned(), "[0, 0, 0]".to_owned())];
    let found = campbell(&turbine.with_overrides(&weightless), &of_speed).unwrap();
    let lowest = |point: usize, mode: usize| found.points[point].modes[mode].mode.frequency;
    for point in 0..4 {
        // The free rotation, and three blades that bend about their soft axis, two of them alike.
        assert_eq!(lowest(point, 0), 0.0);
        assert!((lowest(point, 2) / lowest(point, 1) - 1.0).abs() < 1e-6);
        assert!(lowest(point, 3) > lowest(point, 2));
        // Centrifugal forces stiffen them (Southwell): ω² = ω₀² + k Ω², with the same k at every speed.
        let rise = |point: usize| lowest(point, 1).powi(2) - lowest(0, 1).powi(2);
        let expected = (found.points[point].spin.powi(2) - found.points[0].spin.powi(2))
            / (found.points[3].spin.powi(2) - found.points[0].spin.powi(2))
            * rise(3);
        assert!((rise(point) - expected).abs() <= 1e-2 * rise(3), "{} for {expected}", rise(point));
    }
    assert!(lowest(3, 1) > lowest(0, 1));
}

/// Numbers that turn nothing are reported.
#[test]
fn a_diagram_over_a_number_that_turns_nothing_says_so() {
    let still = OVERHUNG.replace("angular_velocity = [\"speed\", 0, 0]", "angular_velocity = [0, 0, 0]");
    let found = find(&still, &request("parameters.speed", 0.0, 100.0, 2, 2, &[1]));
    let warned = found.warnings().iter().any(|warning| warning.code == "campbell-nothing-rotates");
    assert!(warned, "{:?}", found.warnings());
    let turning = find(OVERHUNG, &request("parameters.speed", 0.0, 100.0, 2, 2, &[1]));
    assert!(turning.warnings().iter().all(|warning| warning.code != "campbell-nothing-rotates"));
}

/// A heavy rotor on a tower, which its thrust bends by 3 degrees: the axis of the rotation tilts with the tower.
const ON_A_TOWER: &str = r#"
lissom = 1
[parameters]
speed = 4.0
thrust = 4e4
[materials.steel]
E = 2.1e11
nu = 0.3
density = 7850
[sections.tower]
shape = "tube"
material = "steel"
outer_radius = 0.3
thickness = 0.02
[beams.tower]
section = "tower"
from = [0, 0, 0]
to = [0, 0, 20]
elements = 4
up = "x"
[bodies.nacelle]
mass = 1000
inertia = [500, 900, 900]
position = [0, 0, 20]
[bodies.hub]
mass = 800
inertia = [4000, 2000, 2000]
position = [1, 0, 20]
[joints.foot]
kind = "clamp"
base = "ground"
tip = "tower.start"
[joints.top]
kind = "clamp"
base = "tower.end"
tip = "nacelle"
[joints.shaft]
kind = "revolute"
base = "nacelle"
tip = "hub"
axis = "x"
at = [1, 0, 20]
[local_loads.thrust]
on = "hub"
force = ["thrust", 0, 0]
[initial.rotor]
parts = ["hub"]
angular_velocity = ["speed", 0, 0]
about = [1, 0, 20]
[initial]
STEADY
[outputs.nacelle]
kind = "position"
of = "nacelle"
[outputs.shaft]
kind = "relative"
of = "shaft"
[analysis]
kind = "dynamics"
end = 2
"#;

/// It stays where the steady rotation is, and has a diagram whose frequencies change little with the thrust.
#[test]
fn a_rotor_on_a_tower_turns_steadily_under_thrust() {
    let steady = ON_A_TOWER.replace("STEADY", "steady_rotation = true");
    let record = Model::from_text("model.toml", &steady).session().unwrap().run().unwrap().into_record();
    let (along, up) = (record.column("nacelle", "x").unwrap(), record.column("nacelle", "z").unwrap());
    assert!(along[0] > 0.3 && up[0] < 20.0, "{} {}", along[0], up[0]);
    for (x, z) in along.iter().zip(up) {
        assert!(
            (x - along[0]).abs() < 1e-5 && (z - up[0]).abs() < 1e-5,
            "{x} {z} from {} {}",
            along[0],
            up[0]
        );
    }
    let rate = record.column("shaft", "rate").unwrap()[0];
    assert!((rate - 4.0).abs() < 1e-9, "{rate}");
    let text = ON_A_TOWER.replace("STEADY", "velocity = [0, 0, 0]");
    let diagram = |thrust: &str| {
        let text = text.replace("thrust = 4e4", thrust);
        find(&text, &request("parameters.speed", 1.0, 4.0, 2, 4, &[1]))
    };
    let frequencies = |found: &CampbellReport| -> Vec<f64> {
        found.points.iter().flat_map(|point| &point.modes).map(|own| own.mode.frequency).collect()
    };
    let (with, without) = (frequencies(&diagram("thrust = 4e4")), frequencies(&diagram("thrust = 0")));
    assert_eq!(with.len(), without.len());
    for (with, without) in with.iter().zip(&without) {
        assert!((with - without).abs() < 0.05 * without.max(0.05), "{with} {without}");
    }
}

/// A tower bends by its load at every speed alike, also above its own frequencies: a balanced rotor moves with the axis that bends with it.
#[test]
fn a_rotor_turns_steadily_above_the_frequencies_of_its_tower() {
    let at = |speed: f64| {
        let text = ON_A_TOWER
            .replace("STEADY", "steady_rotation = true")
            .replace("speed = 4.0", &format!("speed = {speed}"))
            .replace("end = 2", "end = 0.1");
        let record = Model::from_text("model.toml", &text).session().unwrap().run().unwrap().into_record();
        let of = |component| record.column("nacelle", component).unwrap();
        [of("x")[0], of("z")[0], of("x")[of("x").len() - 1]]
    };
    let slow = at(0.5);
    let still = ON_A_TOWER.replace("STEADY", "velocity = [0, 0, 0]");
    let diagram = find(&still, &request("parameters.speed", 0.5, 1.0, 2, 3, &[1]));
    let elastic = diagram.points[0].modes.iter().map(|own| own.mode.frequency).filter(|own| *own > 1e-3);
    let lowest = TAU * elastic.fold(f64::INFINITY, f64::min);
    for share in [0.9, 1.1, 2.0, 8.0] {
        let fast = at(share * lowest);
        for (fast, slow) in fast.iter().zip(slow) {
            assert!((fast - slow).abs() < 1e-6, "{share}: {fast} {slow}");
        }
    }
}

/// The modes nearest to a frequency, which are the last ones of a longer list.
#[test]
fn a_diagram_of_the_modes_nearest_to_a_frequency() {
    let all = find(SHAFT, &request("parameters.speed", 100.0, 200.0, 2, 8, &[1]));
    let high = all.points[0].modes[2].mode.frequency;
    let near = CampbellRequest { shift: Some(high), ..request("parameters.speed", 100.0, 200.0, 2, 2, &[1]) };
    let found = find(SHAFT, &near);
    let nearest = found.points[0].modes.iter().map(|own| (own.mode.frequency - high).abs());
    assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-6 * high);
    assert!(
        found.points[0].modes.iter().all(|own| own.mode.frequency > 0.5 * high),
        "without the rigid mode"
    );
    let wrong = CampbellRequest { shift: Some(-1.0), ..near };
    assert!(campbell(&Model::from_text("model.toml", SHAFT), &wrong).is_err());
}
