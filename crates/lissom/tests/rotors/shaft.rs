//! A shaft with a disc at mid-span: its critical speed and its whirl, also where the shaft weighs nearly nothing.

use std::f64::consts::TAU;

use lissom::Model;
use lissom::analyses::campbell::{CampbellReport, CampbellRequest, Variation, campbell};

fn find(text: &str, (from, to): (f64, f64), values: usize) -> CampbellReport {
    let request = CampbellRequest {
        vary: Variation { path: "parameters.speed".to_owned(), from, to, values },
        count: 8,
        shift: None,
        averaged: false,
        rays: vec![1],
    };
    campbell(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
}

/// Rates of whirl at rest [rad/s] that go `whirl` at the speed.
fn seen(found: &CampbellReport, speed: f64, whirl: &str) -> Vec<f64> {
    let csv = found.csv();
    let rows = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let own = rows.filter(|row| row[0].parse::<f64>().is_ok_and(|value| value == speed) && row[6] == whirl);
    own.filter_map(|row| row[7].parse::<f64>().ok().map(|frequency| frequency * TAU)).collect()
}

/// The rotor of Bauchau et al. 2016 without its unbalance: a tube of 6 m, clamped to its bearings across the axis, with a disc at
/// mid-span.
const DISC: &str = r#"
lissom = 1
[parameters]
speed = 0.0
density = 7800.0
A = "pi*(0.05^2 - 0.045^2)"
J = "pi*(0.05^4 - 0.045^4)/4"
[initial]
angular_velocity = ["speed", 0, 0]
[sections.tube]
shape = "general"
stiffness = [313.4e6, 60.5e6, 60.5e6, 272.7e3, 354.5e3, 354.5e3]
mass = { per_length = "density*A", inertia = ["2*density*J", "density*J", "density*J"] }
[beams.shaft]
section = "tube"
from = [0, 0, 0]
to = [6, 0, 0]
elements = 8
up = [0, 0, 1]
[bodies.disc]
mass = 70.573
inertia = ["70.573*0.24^2/2", "70.573*(0.24^2/4 + 0.05^2/12)", "70.573*(0.24^2/4 + 0.05^2/12)"]
position = [3, 0, 0]
[joints.hub]
kind = "clamp"
base = "shaft@0.5"
tip = "disc"
[joints.left]
kind = "revolute"
base = "ground"
tip = "shaft.start"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_rotation"
joint = "left"
rotation = "speed*t"
[joints.right]
kind = "cylindrical"
base = "ground"
tip = "shaft.end"
axis = [1, 0, 0]
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

/// What is left at the disc, which moves across the axis without tilting, at the rate of whirl `whirl` and the speed `speed`, with
/// the shaft's density: zero where both belong together. Timoshenko's equations with gyroscopic terms over half the shaft:
/// w' = θ + Q/GA, θ' = M/EI, M' = -Q - ρI (ω² - 2Ωω) θ, Q' = -ρA ω² w, and 2Q + m ω² w = 0 at the disc.
fn half_shaft(whirl: f64, speed: f64, density: f64) -> f64 {
    const STEPS: usize = 400;
    let area = std::f64::consts::PI * (0.05_f64.powi(2) - 0.045_f64.powi(2));
    let second = std::f64::consts::PI * (0.05_f64.powi(4) - 0.045_f64.powi(4)) / 4.0;
    let step = 3.0 / STEPS as f64;
    let rates = |[w, angle, moment, shear]: [f64; 4]| {
        let turning = density * second * (whirl * whirl - 2.0 * speed * whirl);
        [
            angle + shear / 60.5e6,
            moment / 354.5e3,
            -shear - turning * angle,
            -density * area * whirl * whirl * w,
        ]
    };
    let go = |mut state: [f64; 4]| {
        for _ in 0..STEPS {
            let moved = |rate: [f64; 4], part: f64| std::array::from_fn(|i| state[i] + part * step * rate[i]);
            let one = rates(state);
            let two = rates(moved(one, 0.5));
            let three = rates(moved(two, 0.5));
            let four = rates(moved(three, 1.0));
            for i in 0..4 {
                state[i] += step / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]);
            }
        }
        state
    };
    let (a, b) = (go([0.0, 0.0, 1e5, 0.0]), go([0.0, 0.0, 0.0, 1e5]));
    let force = |state: [f64; 4]| 2.0 * state[3] - 70.573 * whirl * whirl * state[0];
    a[1] * force(b) - b[1] * force(a)
}

fn root(mut low: f64, mut high: f64, at: impl Fn(f64) -> f64) -> f64 {
    assert!(at(low) * at(high) < 0.0, "{} and {}", at(low), at(high));
    let is_low = at(low) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (at(middle) > 0.0) == is_low { low = middle } else { high = middle }
    }
    low
}

#[test]
fn the_published_shaft_has_its_critical_speed() {
    let exact = root(40.0, 80.0, |speed| half_shaft(speed, speed, 7800.0));
    // About 60 rad/s, as published; the disc passes it between 48 and 72 rad/s.
    assert!((55.0..60.0).contains(&exact), "{exact}");
    let found = find(DISC, (10.0, 80.0), 8);
    let forward = found.crossings.iter().filter(|crossing| crossing.whirl == "forward");
    let nearest = forward.map(|crossing| (crossing.value / exact - 1.0).abs()).fold(f64::INFINITY, f64::min);
    // Interpolated between the speeds of the diagram.
    assert!(nearest < 1e-6, "{nearest:e} from {exact}: {:?}", found.crossings);
    // Forward and backward whirl at a speed.
    for (whirl, sense) in [("forward", 1.0), ("backward", -1.0)] {
        let rate = root(40.0, 80.0, |rate| half_shaft(rate, sense * 50.0, 7800.0));
        let seen = seen(&found, 50.0, whirl);
        let least = seen.iter().map(|seen| (seen / rate - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(least < 1e-6, "{whirl} {rate}: {least:e} in {seen:?}");
    }
}

#[test]
fn a_shaft_may_be_far_lighter_than_its_disc() {
    for density in [7.8, 7.8e-3] {
        let text = DISC.replace("density = 7800.0", &format!("density = {density:e}"));
        let found = find(&text, (10.0, 50.0), 3);
        for (whirl, sense) in [("forward", 1.0), ("backward", -1.0)] {
            let rate = root(40.0, 80.0, |rate| half_shaft(rate, sense * 50.0, density));
            let seen = seen(&found, 50.0, whirl);
            let least = seen.iter().map(|seen| (seen / rate - 1.0).abs()).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-7, "{density} {whirl} {rate}: {least:e} in {seen:?}");
        }
    }
}
