//! Campbell diagrams against closed forms: frequencies of rotors over their speed, whirl, critical speeds.

use std::f64::consts::TAU;

use lissom::Model;
use lissom::campbell::{CampbellError, CampbellReport, CampbellRequest, campbell};
use lissom::modes::{About, ModeRequest, ModesError, modes};

fn request(path: &str, from: f64, to: f64, values: usize, count: usize, rays: &[u32]) -> CampbellRequest {
    CampbellRequest { path: path.to_owned(), from, to, values, count, rays: rays.to_vec() }
}

fn find(text: &str, request: &CampbellRequest) -> CampbellReport {
    campbell(&Model::from_text("model.toml", text), &[], request).unwrap_or_else(|error| panic!("{error}"))
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
const OVERHUNG: &str = r#"
lissom = 1
[parameters]
speed = 10.0
[initial]
angular_velocity = ["speed", 0, 0]
[bodies.hub]
mass = 1
inertia = [0.1, 0.1, 0.1]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [1, 0, 0]
[bodies.disc]
mass = 5
inertia = [0.3, 0.15, 0.15]
position = [0.3, 0, 0]
[joints.cross]
kind = "universal"
base = "hub"
tip = "disc"
at = [0, 0, 0]
axis = [0, 1, 0]
second_axis = [0, 0, 1]
[springs.one]
kind = "torsional"
joint = "cross"
stiffness = 2000
[springs.two]
kind = "torsional"
joint = "cross"
coordinate = 2
stiffness = 2000
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

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
fn a_blade_is_stiffened_by_its_rotation() {
    // A slender blade on a hub of radius 0.5: flap of a rotating cantilever, against the two-term formula of Southwell with the
    // exact value at rest; and lag, which is softer by the square of the rotation.
    let text = r#"
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
    let found = find(text, &request("parameters.speed", 0.0, 120.0, 5, 4, &[1, 3]));
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
    match campbell(&model, &[], &ask) {
        Err(CampbellError::Modes { error, .. }) => {
            assert!(matches!(*error, ModesError::Periodic { .. }), "{error}");
        }
        other => panic!("{other:?}"),
    }
    // Nothing turns.
    let ask = ModeRequest { count: Some(2), about: Some(About::Rotation), shift: None };
    let still = OVERHUNG.replace("speed = 10.0", "speed = 0.0");
    let error = modes(&Model::from_text("model.toml", &still), &[], &ask).expect_err("it is at rest");
    assert!(error.to_string().contains("nothing turns"), "{error}");
    // Gravity across the axis.
    let heavy = OVERHUNG.replace("[parameters]", "gravity = [0, 0, -9.81]\n[parameters]");
    let found = modes(&Model::from_text("model.toml", &heavy), &[], &ask);
    assert!(found.is_err(), "{found:?}");
}
