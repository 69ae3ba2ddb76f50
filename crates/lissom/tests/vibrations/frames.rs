//! Natural modes of a cantilever with a tip body and of a hinged frame against transfer matrices.

use std::f64::consts::TAU;

use lissom::Model;
use lissom::analyses::modes::{ModeReport, ModeRequest, OperatingPoint, modes};

fn find(text: &str, about: OperatingPoint, count: usize) -> ModeReport {
    let request = ModeRequest { count: Some(count), about: Some(about), ..ModeRequest::default() };
    modes(&Model::from_text("model.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
}

/// u, w, θ, N, M, V of a bar in its plane: along it, across it, rotation, and the forces that belong to them.
type State = [f64; 6];

const EXTENSION: f64 = 2e4;
const SHEAR: f64 = 4e4;
const BENDING: f64 = 100.0;
const INERTIA: f64 = 1e-3;
const BAR: &str = "shape = \"general\"\nstiffness = [2e4, 4e4, 4e4, 300, 100, 100]\n\
                   mass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }\n";

/// The state at the end of a bar of unit mass per length that oscillates with `omega`, by the series of its solution over short
/// parts: u' = N/EA, w' = θ + V/GA, θ' = M/EI, N' = -ω²u, M' = -V - ω²J θ, V' = -ω² w.
fn along(length: f64, omega: f64, start: State) -> State {
    let square = omega * omega;
    let parts = 64;
    let part = length / f64::from(parts);
    let rate = |[u, w, angle, axial, moment, shear]: State| -> State {
        [
            axial / EXTENSION,
            angle + shear / SHEAR,
            moment / BENDING,
            -square * u,
            -shear - square * INERTIA * angle,
            -square * w,
        ]
    };
    let mut state = start;
    for _ in 0..parts {
        let mut term = state;
        for k in 1..20 {
            term = rate(term).map(|value| value * part / f64::from(k));
            for (sum, add) in state.iter_mut().zip(term) {
                *sum += add;
            }
        }
    }
    state
}

fn determinant(mut rows: Vec<Vec<f64>>) -> f64 {
    let size = rows.len();
    let mut product = 1.0;
    for k in 0..size {
        let pivot = (k..size).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).unwrap();
        if pivot != k {
            rows.swap(k, pivot);
            product = -product;
        }
        product *= rows[k][k];
        for i in k + 1..size {
            let factor = rows[i][k] / rows[k][k];
            for j in k..size {
                rows[i][j] -= factor * rows[k][j];
            }
        }
    }
    product
}

/// The determinant of the conditions that unknowns, one after the other set to 1, leave unmet.
fn of_conditions(unknowns: usize, unmet: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
    let columns: Vec<Vec<f64>> = (0..unknowns)
        .map(|k| unmet(&(0..unknowns).map(|j| if j == k { 1.0 } else { 0.0 }).collect::<Vec<_>>()))
        .collect();
    determinant(columns)
}

/// The first roots in angular frequency, as frequencies.
fn roots(count: usize, at: impl Fn(f64) -> f64) -> Vec<f64> {
    let (mut roots, mut omega) = (Vec::new(), 0.5);
    while roots.len() < count {
        let (mut low, mut high) = (omega, omega + 0.5);
        if at(low) * at(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(low) * at(middle) <= 0.0 { high = middle } else { low = middle }
            }
            roots.push(low / TAU);
        }
        omega += 0.5;
    }
    roots
}

fn all_are_found(exact: &[f64], found: &ModeReport, tolerance: f64) {
    for exact in exact {
        let least =
            found.modes.iter().map(|mode| (mode.frequency / exact - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(least < tolerance, "{exact} Hz: {least:e} in {}", found.csv());
    }
}

#[test]
fn a_cantilever_with_a_tip_body_has_the_frequencies_of_its_transfer_matrix() {
    let (mass, inertia) = (0.7, 0.05);
    let text = format!(
        r#"
lissom = 1
[sections.bar]
{BAR}
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 12
order = 3
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[bodies.tip]
mass = {mass:?}
inertia = [0.01, {inertia:?}, {inertia:?}]
position = [1, 0, 0]
[joints.tip]
kind = "clamp"
base = "bar.end"
tip = "tip"
[analysis]
kind = "modes"
"#
    );
    let exact = roots(3, |omega| {
        let square = omega * omega;
        of_conditions(2, |unknown| {
            let [_, w, angle, _, moment, shear] =
                along(1.0, omega, [0.0, 0.0, 0.0, 0.0, unknown[0], unknown[1]]);
            vec![moment - square * inertia * angle, shear - square * mass * w]
        })
    });
    let found = find(&text, OperatingPoint::Undeformed, 12);
    all_are_found(&exact, &found, 1e-7);
    // The section bends alike both ways.
    let twice = found.modes.iter().filter(|mode| (mode.frequency / exact[0] - 1.0).abs() < 1e-7).count();
    assert_eq!(twice, 2, "{}", found.csv());
}

#[test]
fn a_hinged_frame_has_the_frequencies_of_its_transfer_matrices() {
    // A column from a clamp, a hinge at the corner, a beam to a pin.
    let text = format!(
        r#"
lissom = 1
[sections.bar]
{BAR}
[beams.column]
section = "bar"
from = [0, 0, 0]
to = [0, 1, 0]
up = [0, 0, 1]
elements = 12
order = 3
[beams.beam]
section = "bar"
from = [0, 1, 0]
to = [0.8, 1, 0]
up = [0, 0, 1]
elements = 10
order = 3
[joints.foot]
kind = "clamp"
base = "ground"
tip = "column.start"
[joints.corner]
kind = "revolute"
base = "column.end"
tip = "beam.start"
axis = [0, 0, 1]
[joints.pin]
kind = "revolute"
base = "ground"
tip = "beam.end"
axis = [0, 0, 1]
[analysis]
kind = "modes"
"#
    );
    let exact = roots(4, |omega| {
        of_conditions(4, |unknown| {
            let top = along(1.0, omega, [0.0, 0.0, 0.0, unknown[0], unknown[1], unknown[2]]);
            let [u, w, _, axial, moment, shear] = top;
            // What is across the column is along the beam, in the other sense.
            let end = along(0.8, omega, [-w, u, unknown[3], -shear, 0.0, axial]);
            vec![moment, end[0], end[1], end[4]]
        })
    });
    all_are_found(&exact, &find(&text, OperatingPoint::Undeformed, 16), 1e-6);
}
