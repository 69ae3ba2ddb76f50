//! Sliders along flexible beams: Coriolis force, a moving mass, energy and momentum, ends, restarts.

mod flying;
mod oriented;

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::support::refused;
use crate::support::runs::{column, run, session};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// A stiff, light bar that turns about the origin in the plane x-y at 2 rad/s; a bead of 0.7 kg slides outwards from 0.5 m.
const TURNING: &str = r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e9, 1e9, 1e9, 1e8, 1e8, 1e8]
mass = { per_length = 1e-3, inertia = [2e-6, 1e-6, 1e-6] }
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [2, 0, 0]
elements = 5
order = ORDER
[joints.pin]
kind = "revolute"
base = "ground"
tip = "bar.start"
axis = [0, 0, 1]
[joints.motor]
kind = "prescribed_rotation"
joint = "pin"
rotation = "2*t"
[point_masses.bead]
mass = 0.7
position = [0.5, 0, 0]
velocity = [0, 1, 0]
[joints.slide]
kind = "slider"
beams = ["bar"]
tip = "bead"
[initial]
angular_velocity = [0, 0, 2]
[outputs.slide]
kind = "relative"
of = "slide"
[outputs.acceleration]
kind = "relative_acceleration"
of = "slide"
[outputs.force]
kind = "reaction"
of = "slide"
[outputs.bead]
kind = "position"
of = "bead"
[analysis]
kind = "dynamics"
end = 0.9
step = 5e-3
"#;

/// s = s₀ cosh ω t, and across the bar the force 2 m ω ṡ.
#[test]
fn a_bead_on_a_turning_bar_feels_the_coriolis_force() {
    for order in ["1", "2", "3"] {
        let text = TURNING.replace("ORDER", order);
        for scheme in SCHEMES {
            let fine = scheme == "generalized-alpha" || scheme == "hht";
            let record = run(
                &text,
                &[("analysis.scheme", scheme), ("analysis.step", if fine { "1e-3" } else { "5e-3" })],
            );
            for (row, &time) in record.times.iter().enumerate() {
                let (place, rate) = (0.5 * (2.0 * time).cosh(), (2.0 * time).sinh());
                let at = |output, component| column(&record, output, component)[row];
                assert!((at("slide", "displacement") - place).abs() < 1e-5, "{scheme} {order} t = {time}");
                assert!((at("slide", "velocity") - rate).abs() < 2e-4, "{scheme} {order} t = {time}");
                let (sine, cosine) = (2.0 * time).sin_cos();
                assert!((at("bead", "x") - place * cosine).abs() < 1e-5, "{scheme} {order} t = {time}");
                let across = -at("force", "f1") * sine + at("force", "f2") * cosine;
                let wanted = 2.0 * 0.7 * 2.0 * rate;
                // Multipliers of Radau IIA are of the first order in the step; they grow to 8 N.
                assert!((across - wanted).abs() < 0.08, "{scheme} {order} t = {time}: {across} {wanted}");
                let along = at("force", "f1") * cosine + at("force", "f2") * sine;
                assert!(along.abs() < 0.08, "{scheme} {order} t = {time}: {along}");
            }
        }
    }
    let text = TURNING.replace("ORDER", "1");
    let controlled = run(&text, &[("analysis.relative_tolerance", "1e-6")]);
    for (row, &time) in controlled.times.iter().enumerate() {
        let place = column(&controlled, "slide", "displacement")[row];
        assert!((place - 0.5 * (2.0 * time).cosh()).abs() < 1e-5, "t = {time}: {place}");
    }
}

/// A beam of 4 m on two supports. Bending in the plane x-z.
const BRIDGE: &str = r#"
lissom = 1
gravity = [0, 0, -GRAVITY]
[sections.bar]
shape = "general"
stiffness = [4e6, 4e6, 4e6, 1e4, 4e3, 4e3]
mass = { per_length = 12, inertia = [2e-6, 1e-6, 1e-6] }
[beams.bridge]
section = "bar"
from = [0, 0, 0]
to = [4, 0, 0]
elements = ELEMENTS
order = 3
[joints.left]
kind = "revolute"
base = "ground"
tip = "bridge.start"
axis = [0, 1, 0]
[joints.right]
kind = "generic"
base = "ground"
tip = "bridge.end"
locked = ["y", "z", "rx", "rz"]
[point_masses.car]
mass = 20
position = [0, 0, 0]
velocity = [5, 0, 0]
[joints.contact]
kind = "slider"
beams = ["bridge"]
tip = "car"
MOTION
[outputs.middle]
kind = "displacement"
of = "bridge@0.5"
[outputs.car]
kind = "position"
of = "car"
[outputs.contact]
kind = "relative"
of = "contact"
[outputs.force]
kind = "reaction"
of = "contact"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 0.76
step = 2e-3
"#;

/// Deflections of the middle and below a mass that crosses a beam at constant speed, downwards, and the force between them:
/// the series of sines with the inertia of the mass [Fryba 1999, chapter 8], integrated by the classical Runge-Kutta method.
fn moving_mass(gravity: f64, times: &[f64]) -> Vec<[f64; 3]> {
    const MODES: usize = 40;
    let (length, speed, mass, per_length, bending) = (4.0_f64, 5.0_f64, 20.0_f64, 12.0_f64, 4e3_f64);
    let wave = |n: usize| (n + 1) as f64 * PI / length;
    // Accelerations of the modes, and the force.
    let accelerations = |time: f64, state: &DVector<f64>| {
        let shape = DVector::from_fn(MODES, |n, _| (wave(n) * speed * time).sin());
        let slope = DVector::from_fn(MODES, |n, _| wave(n) * (wave(n) * speed * time).cos());
        let bent = DVector::from_fn(MODES, |n, _| -wave(n).powi(2) * (wave(n) * speed * time).sin());
        let (place, rate) = (state.rows(0, MODES), state.rows(MODES, MODES));
        let known = gravity - 2.0 * speed * slope.dot(&rate) - speed * speed * bent.dot(&place);
        let modal = 0.5 * per_length * length;
        let matrix = DMatrix::from_diagonal_element(MODES, MODES, modal) + mass * &shape * shape.transpose();
        let right = DVector::from_fn(MODES, |n, _| {
            mass * known * shape[n] - 0.5 * length * bending * wave(n).powi(4) * place[n]
        });
        let solved = matrix.lu().solve(&right).unwrap();
        let force = mass * (known - shape.dot(&solved));
        (solved, force)
    };
    let slope = |time: f64, state: &DVector<f64>| {
        let (accelerations, _) = accelerations(time, state);
        DVector::from_fn(
            2 * MODES,
            |k, _| if k < MODES { state[MODES + k] } else { accelerations[k - MODES] },
        )
    };
    let (mut time, mut state) = (0.0, DVector::zeros(2 * MODES));
    let mut found = Vec::new();
    for &wanted in times {
        // The fastest mode has 1.8e4 rad/s.
        let steps = ((wanted - time) / 5e-5).ceil().max(1.0) as usize;
        let step = (wanted - time) / steps as f64;
        for _ in 0..steps {
            let a = slope(time, &state);
            let b = slope(time + 0.5 * step, &(&state + 0.5 * step * &a));
            let c = slope(time + 0.5 * step, &(&state + 0.5 * step * &b));
            let d = slope(time + step, &(&state + step * &c));
            state += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            time += step;
        }
        let at = |x: f64| (0..MODES).map(|n| state[n] * (wave(n) * x).sin()).sum::<f64>();
        found.push([at(0.5 * length), at(speed * wanted), accelerations(wanted, &state).1]);
    }
    found
}

#[test]
fn a_mass_that_crosses_a_bridge_follows_the_series() {
    let motion =
        "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"contact\"\ndisplacement = \"5*t\"";
    // Small deflections, as in the series: gravity as weak as that, and tiny.
    let text = BRIDGE.replace("GRAVITY", "0.01").replace("ELEMENTS", "8").replace("MOTION", motion);
    // Its own weight bends the bridge as well: without it, from the difference of two cars' weights.
    let text = text.replace("gravity = [0, 0, -0.01]", "gravity = [0, 0, 0]");
    let weight = "[loads.weight]\nkind = \"force\"\non = \"car\"\nvector = [0, 0, -0.2]\n[analysis]";
    let text = text.replace("[analysis]", weight);
    // Every twentieth of the steps, which are the same with all schemes.
    let times: Vec<f64> = (0..19).map(|sample| 2e-3 * f64::from(1 + 20 * sample)).collect();
    let series = moving_mass(0.01, &times);
    for (scheme, tolerance) in [
        ("radau-iia", 0.004),
        ("radau-iia-5", 0.004),
        ("energy-decaying", 0.004),
        ("generalized-alpha", 0.006),
        ("hht", 0.006),
    ] {
        let record = run(&text, &[("analysis.scheme", scheme)]);
        let most = series.iter().fold(0.0_f64, |most, own| most.max(own[0].abs()));
        for (time, [middle, below, _]) in times.iter().zip(&series) {
            let row = record.times.iter().position(|known| (known - time).abs() < 1e-9).unwrap();
            let found = [-column(&record, "middle", "u3")[row], -column(&record, "car", "z")[row]];
            for (found, wanted) in found.iter().zip([middle, below]) {
                assert!(
                    (found - wanted).abs() < tolerance * most,
                    "{scheme} t = {time}: {found} {wanted} of {most}"
                );
            }
        }
    }
}

/// A car that rolls freely over the sagging, swinging bridge: nothing puts energy in or takes it out.
#[test]
fn energy_stays_while_a_car_rolls_over_the_bridge() {
    let text = BRIDGE.replace("GRAVITY", "9.81").replace("ELEMENTS", "6").replace("MOTION", "");
    let mut ends = Vec::new();
    for (scheme, tolerance) in [
        ("radau-iia", 1e-4),
        ("radau-iia-5", 1e-4),
        ("energy-decaying", 1e-4),
        ("generalized-alpha", 2e-3),
        ("hht", 2e-3),
    ] {
        let set = [("analysis.scheme", scheme), ("analysis.step", "1e-3"), ("analysis.end", "0.7")];
        let record = run(&text, &set);
        let energy = column(&record, "energy", "total");
        let kinetic = column(&record, "energy", "kinetic")[0];
        for (row, own) in energy.iter().enumerate() {
            let change = (own - energy[0]).abs() / kinetic;
            assert!(change < tolerance, "{scheme} t = {}: {change}", record.times[row]);
        }
        ends.push(column(&record, "contact", "displacement")[energy.len() - 1]);
    }
    // More than four of six elements were passed, alike with all schemes.
    assert!(ends.iter().all(|end| (3.0..3.6).contains(end) && (end - ends[0]).abs() < 2e-4), "{ends:?}");
}

#[test]
fn a_run_goes_on_from_the_middle_to_the_last_bit() {
    let text = BRIDGE.replace("GRAVITY", "9.81").replace("ELEMENTS", "6").replace("MOTION", "");
    for scheme in SCHEMES {
        let set = [("analysis.scheme", scheme)];
        let mut whole = session(&text, &set);
        whole.step_to(0.3).unwrap();
        let snapshot = whole.snapshot();
        whole.step_to(0.6).unwrap();
        let mut again = session(&text, &set);
        again.restore(&snapshot).unwrap();
        again.step_to(0.6).unwrap();
        let (mut values, mut others) = (Vec::new(), Vec::new());
        whole.values(&mut values);
        again.values(&mut others);
        assert_eq!(values, others, "{scheme}");
    }
}

/// The end of the beam ends the run, with the time and the joint; a step before it an event can do so in order.
#[test]
fn the_end_of_the_beam_is_reported() {
    let text = TURNING.replace("ORDER", "2").replace("end = 0.9", "end = 2");
    for set in [vec![], vec![("analysis.relative_tolerance", "1e-5")]] {
        let (record, report) = session(&text, &set).run().unwrap_or_else(lissom::Results::from).into_parts();
        assert!(!report.is_complete());
        let message = report.error().unwrap().to_string();
        assert!(message.contains("`slide`") && message.contains("end of its beam"), "{message}");
        // cosh 2t = 4.
        let time = record.times[record.times.len() - 1];
        assert!((time - 0.5 * 4.0_f64.acosh()).abs() < 0.02, "{time}");
    }
    let event = "[events.end]\nzero_of = \"slide.displacement - 1.9\"\nstop = true\n[analysis]";
    let mut session = session(&text.replace("[analysis]", event), &[]);
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none());
    let place = column(&record, "slide", "displacement");
    assert!((place[place.len() - 1] - 1.9).abs() < 1e-6);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |from: &str, to: &str, wanted: &str| {
        let text = TURNING.replace("ORDER", "2");
        assert!(text.contains(from), "{from}");
        let message = refused::refused(&text.replace(from, to));
        assert!(message.contains(wanted), "{message}");
    };
    refused("position = [0.5, 0, 0]", "position = [0.5, 0, 0.1]", "is 0.1 m away from it");
    refused("tip = \"bead\"", "tip = \"bar@0.4\"", "is a node of the beam that it slides on");
    refused("tip = \"bead\"", "tip = \"bead\"\norientation = \"tangent\"", "with free rotation in space");
    refused("tip = \"bead\"", "tip = \"bead\"\norientation = \"along\"", "orientation");
    refused("beams = [\"bar\"]", "beams = [\"bat\"]", "which does not exist");
    refused("beams = [\"bar\"]", "beams = []", "is empty");
    refused("beams = [\"bar\"]", "beams = [\"bar\", \"bar\"]", "does not start at the end of");
}

/// Section forces under a slider that is between nodes: what the warning says of them. Its deflection is right.
#[test]
fn sections_beside_a_slider_err_as_the_warning_says() {
    let (force, length) = (0.1, 4.0);
    let parts = [0.1, 0.3, 0.5, 0.8];
    let cases = [(1, 8, 0.19), (2, 8, 0.1), (3, 8, 0.07), (3, 4, 0.07)];
    for ((order, elements, share), part) in cases.into_iter().flat_map(|case| parts.map(|part| (case, part)))
    {
        let element = length / f64::from(elements);
        let place = 2.0 + part * element;
        let reach = if order == 1 { 3.0 } else { 2.0 };
        let sections: String = (0..40)
            .map(|k| {
                let at = 0.0125 + 0.025 * f64::from(k);
                format!(
                    "[outputs.moment{k}]\nkind = \"section_moment\"\nof = \"bridge@{at}\"\n[outputs.shear{k}]\n\
                     kind = \"section_force\"\nof = \"bridge@{at}\"\n"
                )
            })
            .collect::<Vec<_>>()
            .concat();
        let motion = format!(
            "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"contact\"\ndisplacement = \"{place}\"\n\
             [loads.weight]\nkind = \"force\"\non = \"car\"\nvector = [0, 0, -{force}]\n{sections}"
        );
        let text = BRIDGE
            .replace("GRAVITY", "0")
            .replace("ELEMENTS", &elements.to_string())
            .replace("order = 3", &format!("order = {order}"))
            .replace("position = [0, 0, 0]\nvelocity = [5, 0, 0]", &format!("position = [{place}, 0, 0]"))
            .replace("MOTION", &motion)
            .replace("kind = \"dynamics\"\nend = 0.76\nstep = 2e-3", "kind = \"statics\"\nsteps = 1");
        let record = run(&text, &[]);
        let last = record.times.len() - 1;
        let (mut beside, mut away) = ([0.0_f64; 2], [0.0_f64; 2]);
        for k in 0..40 {
            let x = length * (0.0125 + 0.025 * f64::from(k));
            let moment = force * x.min(place) * (length - x.max(place)) / length;
            let shear = force * if x < place { length - place } else { place } / length;
            let found = column(&record, &format!("moment{k}"), "m2")[last].abs();
            let missed = [
                (found - moment).abs() / (force * element),
                (column(&record, &format!("shear{k}"), "f3")[last].abs() - shear).abs() / force,
            ];
            let worst = if (x - place).abs() <= reach * element { &mut beside } else { &mut away };
            for (worst, missed) in worst.iter_mut().zip(missed) {
                *worst = worst.max(missed);
            }
        }
        assert!(beside[0] < share && beside[1] < 0.6, "{order} {elements}: {beside:?}");
        if part == 0.5 {
            assert!(beside[0] > 0.3 * share && beside[1] > 0.3, "{order} {elements}: {beside:?}");
        }
        assert!(away[0] < 1e-6 && away[1] < 1e-6, "{order} {elements}: {away:?}");
        // P a² b²/(3 E I L), and the shear's share, which is small.
        let (a, b) = (place, length - place);
        let wanted = force * a * a * b * b / (3.0 * 4e3 * length) + force * a * b / (length * 4e6);
        let found = -column(&record, "car", "z")[last];
        assert!((found / wanted - 1.0).abs() < 0.04, "{order} {elements}: {found} {wanted}");
    }
}
