//! Bearings of rotors beside closed forms: onset of whirl, squeeze-film damping; bushings that are the same from both sides.

use lissom::analyses::campbell::{CampbellRequest, campbell};
use lissom::{Model, Record};

use crate::support::refused::refused;
use crate::support::runs::run_without_warnings as run;

/// Largest displacements between a fifth and two fifths of the time, and in the last fifth.
fn amplitudes(record: &Record) -> [f64; 2] {
    let [y, z] = ["u2", "u3"].map(|component| record.column("rotor", component).unwrap());
    let end = record.times.last().unwrap();
    [0.2, 0.8].map(|from| {
        let rows = (0..y.len()).filter(|&k| (from * end..=(from + 0.2) * end).contains(&record.times[k]));
        rows.map(|k| y[k].hypot(z[k])).fold(0.0, f64::max)
    })
}

/// A rigid rotor that moves in a plane and is driven at a constant speed.
const ROTOR: &str = r#"
lissom = 1
[parameters]
omega = 300
mass = 20
weight = 0
[bodies.rotor]
mass = "mass"
inertia = [0.05, 0.05, 0.05]
angular_velocity = ["omega", 0, 0]
[joints.plane]
kind = "planar"
base = "ground"
tip = "rotor"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_rotation"
joint = "plane"
rotation = "omega*t"
[loads.weight]
kind = "force"
on = "rotor"
vector = [0, 0, -1]
scale = "weight"
[outputs.rotor]
kind = "displacement"
of = "rotor"
[analysis]
kind = "dynamics"
end = 2
relative_tolerance = 1e-7
"#;

/// With cross-coupled stiffness α s a rotor whirls beyond s = c ω/α, ω² = k/m.
#[test]
fn a_bearing_with_cross_coupling_that_grows_with_the_speed_whirls_beyond_its_onset() {
    let bearing = "[springs.bearing]\nkind = \"bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nstiffness = 8e4\ndamping = 100\n\
        k23 = \"50*speed\"\nk32 = \"-50*speed\"\n";
    let text = ROTOR.replace("[analysis]", &format!("{bearing}[analysis]"));
    // c ω/α = 100·63.2/50 = 126.5 rad/s.
    let onset = 100.0 * (8e4_f64 / 20.0).sqrt() / 50.0;
    for (factor, grows) in [(0.95, false), (1.05, true)] {
        let speed = format!("{:?}", factor * onset);
        let set = [
            ("parameters.omega", speed.as_str()),
            ("bodies.rotor.velocity", "[0, 0.01, 0]"),
            ("analysis.end", "4"),
        ];
        let [first, last] = amplitudes(&run(&text, &set));
        // Real part (q/ω - c)/(2 m) = ±0.05·100/40.
        let wanted = (0.125_f64 * if grows { 1.0 } else { -1.0 } * 2.4).exp();
        assert!((last / first - wanted).abs() < 0.02 * wanted, "{factor}: {first} {last} {wanted}");
    }
}

/// The same onset in a Campbell diagram: the damping of forward whirl changes its sign.
#[test]
fn a_campbell_diagram_has_the_onset_of_whirl() {
    let bearing = "[springs.bearing]\nkind = \"bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nstiffness = 8e4\ndamping = 100\n\
        k23 = \"50*speed\"\nk32 = \"-50*speed\"\n";
    let text = ROTOR.replace("[analysis]", &format!("{bearing}[analysis]"));
    let request = CampbellRequest {
        vary: "parameters.omega=120:132:5".parse().unwrap(),
        count: 4,
        shift: None,
        averaged: false,
        rays: vec![1],
    };
    let found = campbell(&Model::from_text("model.toml", &text), &request).unwrap_or_else(|e| panic!("{e}"));
    for point in &found.points {
        let least = point.modes.iter().map(|own| own.mode.damping).fold(f64::INFINITY, f64::min);
        // 126.49 rad/s.
        assert_eq!(least < 0.0, point.value > 126.49, "{}: {least}", point.value);
    }
}

/// Coefficients of a short bearing at the relative eccentricity e, over κ s/c and κ/c, along the eccentricity and across it [Ocvirk 1952].
fn coefficients(e: f64) -> ([f64; 2], [[f64; 2]; 2], [[f64; 2]; 2]) {
    let pi = std::f64::consts::PI;
    let rest = 1.0 - e * e;
    let force = [2.0 * e * e / rest.powi(2), 0.5 * pi * e / rest.powf(1.5)];
    let stiffness = [
        [4.0 * e * (1.0 + e * e) / rest.powi(3), force[1] / e],
        [-0.5 * pi * (1.0 + 2.0 * e * e) / rest.powf(2.5), force[0] / e],
    ];
    let damping = [
        [pi * (1.0 + 2.0 * e * e) / rest.powf(2.5), -2.0 * force[0] / e],
        [-2.0 * force[0] / e, 2.0 * force[1] / e],
    ];
    (force, stiffness, damping)
}

/// On a ruptured film in equilibrium with its weight a rigid rotor is stable up to the mass k/ν²:
///
/// ```text
/// k = (K₁₁ C₂₂ + K₂₂ C₁₁ - K₁₂ C₂₁ - K₂₁ C₁₂)/(C₁₁ + C₂₂)
/// ν² = ((k - K₁₁)(k - K₂₂) - K₁₂ K₂₁)/(C₁₁ C₂₂ - C₁₂ C₂₁)
/// ```
#[test]
fn a_rotor_on_a_fluid_film_whirls_beyond_its_critical_mass() {
    let (radius, length, clearance, viscosity, speed, e) = (0.05, 0.02, 1e-4, 0.02, 300.0, 0.4);
    let factor = 0.5 * viscosity * radius * f64::powi(length, 3) / f64::powi(clearance, 2);
    let (force, stiffness, damping) = coefficients(e);
    let [k, c] = [(stiffness, factor * speed / clearance), (damping, factor / clearance)]
        .map(|(matrix, scale)| matrix.map(|row| row.map(|own| scale * own)));
    let effective =
        (k[0][0] * c[1][1] + k[1][1] * c[0][0] - k[0][1] * c[1][0] - k[1][0] * c[0][1]) / (c[0][0] + c[1][1]);
    let square = ((effective - k[0][0]) * (effective - k[1][1]) - k[0][1] * k[1][0])
        / (c[0][0] * c[1][1] - c[0][1] * c[1][0]);
    let critical = effective / square;
    let weight = factor * speed * force[0].hypot(force[1]);
    let angle = force[1].atan2(force[0]) - std::f64::consts::FRAC_PI_2;
    let rest = [e * clearance * angle.cos(), e * clearance * angle.sin()];
    let bearing = format!(
        "[springs.bearing]\nkind = \"journal_bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nat_base = [0, {:?}, {:?}]\n\
         radius = {radius}\nlength = {length}\nclearance = {clearance}\nviscosity = {viscosity}\n",
        -rest[0], -rest[1]
    );
    let text = ROTOR.replace("[analysis]", &format!("{bearing}[analysis]"));
    for (relative, grows) in [(0.9, false), (1.1, true)] {
        let [omega, mass, weight] = [speed, relative * critical, weight].map(|value| format!("{value:?}"));
        let set = [
            ("parameters.omega", omega.as_str()),
            ("parameters.mass", &mass),
            ("parameters.weight", &weight),
            ("bodies.rotor.velocity", "[0, 1e-5, 0]"),
            ("analysis.end", "3"),
        ];
        let [first, last] = amplitudes(&run(&text, &set));
        assert!(first < 5e-6, "{first}");
        assert!(if grows { last > 1.2 * first } else { last < 0.8 * first }, "{relative}: {first} {last}");
    }
}

#[test]
fn films_that_are_not_short_and_journals_beside_their_bearing_are_refused() {
    let film = |keys: &str| {
        let keys = format!(
            "[springs.film]\nkind = \"journal_bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nviscosity = 0.02\nclearance = 1e-4\n{keys}\n[analysis]"
        );
        let report = refused(&ROTOR.replace("[analysis]", &keys));
        report.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
    };
    assert!(film("radius = 0.02\nlength = 0.05").contains("is greater than the diameter"));
    let beside = film("radius = 0.02\nlength = 0.01\nat_base = [0, 0.1, 0]");
    assert!(
        beside.contains("is 0.1 m from the axis of the journal") && beside.contains("centre of the bearing"),
        "{beside}"
    );
}

/// A full film around a shaft that does not rotate is a damper with c = π μ R L³/C³ for small motions.
#[test]
fn a_squeeze_film_damps_as_its_coefficient() {
    let text = ROTOR.replace(
        "[analysis]",
        "[springs.film]\nkind = \"journal_bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nradius = 0.05\nlength = 0.02\nclearance = 2e-4\n\
         viscosity = 0.02\nfilm = \"full\"\n[springs.cage]\nkind = \"bearing\"\nbase = \"ground\"\ntip = \"rotor\"\nstiffness = 2e6\n[analysis]",
    );
    let set =
        [("parameters.omega", "0"), ("bodies.rotor.velocity", "[0, 3e-4, 0]"), ("analysis.end", "0.05")];
    let record = run(&text, &set);
    let damping = std::f64::consts::PI * 0.02 * 0.05 * 8e-6 / 8e-12;
    let (decay, rate) = (damping / 40.0, 2e6_f64 / 20.0);
    let ringing = (rate - decay * decay).sqrt();
    for (time, found) in record.times.iter().zip(record.column("rotor", "u2").unwrap()) {
        let wanted = 3e-4 / ringing * (-decay * time).exp() * (ringing * time).sin();
        assert!((found - wanted).abs() < 2e-9, "{time}: {found} {wanted}");
    }
}

const MOUNT: &str = r#"
lissom = 1
[bodies.a]
mass = 1
inertia = [0.01, 0.02, 0.03]
angular_velocity = [3, 0, 1]
[bodies.b]
mass = 2
inertia = [0.03, 0.02, 0.02]
position = [0.3, 0.1, 0]
velocity = [0.2, -0.5, 0.4]
angular_velocity = [0, -4, 2]
[springs.mount]
kind = "bushing"
base = "a"
tip = "b"
stiffness = [300, 200, 100, 6, 5, 4]
form = "screw"
[outputs.a]
kind = "position"
of = "a"
[outputs.b]
kind = "position"
of = "b"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 1
relative_tolerance = 1e-9
"#;

#[test]
fn a_bushing_as_a_screw_is_the_same_from_both_sides() {
    let swapped = [("springs.mount.base", "\"b\""), ("springs.mount.tip", "\"a\"")];
    let [one, other] = [run(MOUNT, &[]), run(MOUNT, &swapped)];
    let base_axes = run(&MOUNT.replace("form = \"screw\"", ""), &swapped);
    let last = |record: &Record, part: &str, component: &str| {
        *record.column(part, component).unwrap().last().unwrap()
    };
    let mut difference = 0.0_f64;
    for part in ["a", "b"] {
        for component in ["x", "y", "z"] {
            let [p, q] = [&one, &other].map(|record| last(record, part, component));
            assert!((p - q).abs() < 1e-7, "{part} {component}: {p} {q}");
            difference = difference.max((last(&base_axes, part, component) - p).abs());
        }
    }
    assert!(difference > 1e-3, "the other form depends on the side: {difference}");
    let energy = one.column("energy", "total").unwrap();
    assert!((energy.last().unwrap() / energy[0] - 1.0).abs() < 1e-6);
}
