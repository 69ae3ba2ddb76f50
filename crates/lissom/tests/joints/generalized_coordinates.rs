//! Matrices M, D, K on coordinates against the exponential of the linear system, and what is rejected.

use std::f64::consts::TAU;

use lissom::analyses::modes::{ModeRequest, modes};
use lissom::{Model, Record};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix};

use crate::support::refused;
use crate::support::runs::{column, run};

const MASS: [[f64; 3]; 3] = [[2.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.5]];
/// With gyroscopic and circulatory parts.
const DAMPING: [[f64; 3]; 3] = [[0.3, 0.2, 0.0], [-0.2, 0.1, 0.0], [0.0, 0.0, 0.2]];
const STIFFNESS: [[f64; 3]; 3] = [[30.0, -10.0, 0.0], [-14.0, 40.0, -20.0], [0.0, -20.0, 25.0]];
const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];
const FORCE: f64 = 3.0;
const FREQUENCY: f64 = 4.0;

fn oscillator(damping: &str) -> String {
    format!(
        r#"
lissom = 1
[joints.x]
kind = "generalized_coordinates"
start = [0.1, 0, 0]
rate = [0, 0.5, 0]
[springs.matrices]
kind = "coordinate_dynamics"
coordinates = ["x"]
mass = {MASS:?}
damping = {damping}
stiffness = {STIFFNESS:?}
rest = [0, 0, 0.02]
[loads.push]
kind = "joint_force"
joint = "x"
coordinate = 2
force = "{FORCE}*sin({FREQUENCY}*t)"
[outputs.x]
kind = "relative"
of = "x"
[outputs.a]
kind = "relative_acceleration"
of = "x"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 3
step = 0.01
"#
    )
}

fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

/// Positions, rates and accelerations at `time` by the exponential of the system with [x, v, sin, cos, 1].
fn exact(time: f64) -> [f64; 9] {
    let inverse = matrix(MASS).try_inverse().unwrap();
    let mut system = SMatrix::<f64, 9, 9>::zeros();
    system.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
    system.fixed_view_mut::<3, 3>(3, 0).copy_from(&(-inverse * matrix(STIFFNESS)));
    system.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-inverse * matrix(DAMPING)));
    system.fixed_view_mut::<3, 1>(3, 6).copy_from(&(FORCE * inverse.column(1)));
    (system[(6, 7)], system[(7, 6)]) = (FREQUENCY, -FREQUENCY);
    let rest = nalgebra::Vector3::new(0.0, 0.0, 0.02);
    system.fixed_view_mut::<3, 1>(3, 8).copy_from(&(inverse * matrix(STIFFNESS) * rest));
    let start = DVector::from_vec(vec![0.1, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 1.0]);
    let dense = DMatrix::from_fn(9, 9, |i, j| system[(i, j)]);
    let state = (&dense * time).exp() * start;
    let slope = &dense * &state;
    std::array::from_fn(|k| if k < 6 { state[k] } else { slope[k - 3] })
}

/// The largest error of positions, rates and accelerations.
fn error(record: &Record) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for (row, &time) in record.times.iter().enumerate().step_by(10) {
        let wanted = exact(time);
        for k in 0..3 {
            let found = [
                column(record, "x", &format!("displacement{}", k + 1))[row],
                column(record, "x", &format!("velocity{}", k + 1))[row],
                column(record, "a", &format!("a{}", k + 1))[row],
            ];
            for (of, found) in found.into_iter().enumerate() {
                worst[of] = worst[of].max((found - wanted[3 * of + k]).abs());
            }
        }
    }
    worst
}

#[test]
fn an_oscillator_of_three_coordinates_follows_the_exponential_with_the_order_of_each_scheme() {
    let text = oscillator(&format!("{DAMPING:?}"));
    for (scheme, order, allowed) in [
        ("radau-iia", 3, 2e-5),
        ("radau-iia-5", 5, 1e-8),
        ("generalized-alpha", 2, 3e-3),
        ("hht", 2, 3e-3),
        ("energy-decaying", 3, 2e-5),
    ] {
        let errors = ["0.01", "0.005"]
            .map(|step| error(&run(&text, &[("analysis.scheme", scheme), ("analysis.step", step)])));
        assert!(errors[0][0] < allowed && errors[0][1] < 10.0 * allowed, "{scheme}: {errors:?}");
        assert!(errors[0][2] < 100.0 * allowed, "{scheme}: {errors:?}");
        let found = (errors[0][0] / errors[1][0]).log2();
        assert!((found - f64::from(order)).abs() < 0.2, "{scheme}: order {found}, {errors:?}");
    }
    let controlled = error(&run(&text, &[("analysis.relative_tolerance", "1e-7")]));
    assert!(controlled[0] < 1e-5, "{controlled:?}");
}

/// A coordinate with mass, geared to a hinge, is inertia of the hinge: (J + m i²) φ'' = -k i² φ.
#[test]
fn matrices_act_on_coordinates_of_joints_too() {
    let (inertia, mass, ratio, stiffness) = (3.0_f64, 2.0_f64, 0.5_f64, 8.0_f64);
    let text = |through: &str| {
        format!(
            r#"
lissom = 1
[bodies.disc]
mass = 1
inertia = [1, 1, {inertia}]
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "disc"
axis = [0, 0, 1]
[initial.disc]
parts = ["disc"]
angular_velocity = [0, 0, 2]
{through}
[outputs.hinge]
kind = "relative"
of = "hinge"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 4
step = 0.005
"#
        )
    };
    let geared = format!(
        "[joints.rack]\nkind = \"generalized_coordinates\"\nstart = [0]\nrate = [{}]\n\
         [joints.gear]\nkind = \"gear\"\njoint = \"hinge\"\nother = \"rack\"\nratio = {ratio}\n\
         [springs.rack]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"rack.displacement\"]\nmass = {mass}\n\
         stiffness = {stiffness}",
        2.0 * ratio
    );
    let direct = format!(
        "[springs.inertia]\nkind = \"coordinate_dynamics\"\ncoordinates = [\"hinge.angle\"]\nmass = {}\nstiffness = {}",
        mass * ratio * ratio,
        stiffness * ratio * ratio
    );
    let frequency = (stiffness * ratio * ratio / (inertia + mass * ratio * ratio)).sqrt();
    for (through, scheme) in [&geared, &direct].into_iter().flat_map(|text| SCHEMES.map(|own| (text, own))) {
        let record = run(&text(through), &[("analysis.scheme", scheme)]);
        let energy = column(&record, "energy", "total");
        for (row, &time) in record.times.iter().enumerate() {
            let wanted = 2.0 / frequency * (frequency * time).sin();
            let found = column(&record, "hinge", "angle")[row];
            assert!((found - wanted).abs() < 1e-4, "{scheme} {through} t = {time}: {found}, {wanted}");
            assert!((energy[row] / energy[0] - 1.0).abs() < 1e-4, "{scheme}: energy {}", energy[row]);
        }
        let wanted = 0.5 * (inertia + mass * ratio * ratio) * 4.0;
        assert!((energy[0] - wanted).abs() < 1e-9, "{scheme}: {} for {wanted}", energy[0]);
    }
}

#[test]
fn modes_are_those_of_the_matrices() {
    let text = oscillator("0").replace(&format!("{STIFFNESS:?}"), "[30, 40, 25]");
    let request = ModeRequest::default();
    let report = modes(&Model::from_text("model.toml", &text), &request).unwrap();
    // 2ω² - 30 and ω² - 40, coupled by 0.5 ω²: 1.75 ω⁴ - 110 ω² + 1200 = 0; 1.5 ω² = 25.
    let root = (110.0_f64 * 110.0 - 4.0 * 1.75 * 1200.0).sqrt();
    let mut wanted = [(110.0 - root) / 3.5, 25.0 / 1.5, (110.0 + root) / 3.5];
    wanted.sort_by(f64::total_cmp);
    assert_eq!(report.modes.len(), 3);
    for (mode, square) in report.modes.iter().zip(wanted) {
        let frequency = square.sqrt() / TAU;
        assert!((mode.frequency / frequency - 1.0).abs() < 1e-12, "{} {frequency}", mode.frequency);
    }
}

/// Negative damping puts energy in, which is work and no surplus.
#[test]
fn negative_damping_is_a_drive() {
    let mut session = Model::from_text("model.toml", &oscillator("-0.5")).session().unwrap();
    let record = session.run().unwrap();
    let energy = column(&record, "energy", "total");
    assert!(energy[energy.len() - 1] > 2.0 * energy[0]);
    let energy_balance = session.simulation().energy_balance();
    assert!(energy_balance.surplus < 1e-3 * energy_balance.turned_over, "{energy_balance:?}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |from: &str, to: &str, wanted: &str| {
        let text = oscillator(&format!("{DAMPING:?}"));
        assert!(text.contains(from), "{from}");
        let message = refused::refused(&text.replace(from, to));
        assert!(message.contains(wanted), "{message}");
    };
    let mass = format!("mass = {MASS:?}");
    refused(
        &mass,
        "mass = [[1, 1, 0], [1, 1, 0], [0, 0, 1]]",
        "`x.displacement2`; it has no resistance in this position",
    );
    refused(&mass, "", "`x.displacement1`; it has no resistance in this position");
    refused(&mass, "mass = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]", "must not have negative eigenvalues");
    refused(&mass, "mass = [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]", "must be symmetric");
    refused(&mass, "mass = [1, 1]", "is of 2 coordinates, but `coordinates` names 3");
    refused("rest = [0, 0, 0.02]", "rest = [0]", "has 1 numbers, but `coordinates` names 3");
    refused("rate = [0, 0.5, 0]", "rate = [0]", "has 1 numbers, but `start` has 3");
    refused("[\"x\"]", "[\"x\", \"x.displacement1\"]", "twice");
    refused("[\"x\"]", "[\"x.velocity1\"]", "has no coordinate `velocity1`");
    refused("[\"x\"]", "[\"y\"]", "names joint `y`, which does not exist");
    // An entry with a circulatory part consists of two elements, none of which has its power.
    let power = "[outputs.power]\nkind = \"power\"\nof = \"matrices\"\n[analysis]";
    refused("[analysis]", power, "`matrices` has no power to record");
    let symmetric = oscillator("0.1").replace("-14", "-10").replace("[analysis]", power);
    let power = run(&symmetric, &[]);
    assert!(column(&power, "power", "power").iter().any(|value| value.abs() > 1e-3));
}

#[test]
fn an_entry_acts_on_a_hundred_coordinates_at_most() {
    let model = |count: usize| {
        let names: Vec<String> = (0..count).map(|k| format!("\"x.displacement{}\"", k + 1)).collect();
        let zeros = vec![0; count];
        format!(
            "lissom = 1\n[joints.x]\nkind = \"generalized_coordinates\"\nstart = {zeros:?}\n\
             [springs.all]\nkind = \"coordinate_dynamics\"\ncoordinates = [{}]\nmass = 1\nstiffness = 2\n\
             [analysis]\nkind = \"dynamics\"\nend = 0.1\nstep = 0.01\n",
            names.join(", ")
        )
    };
    assert!(Model::from_text("model.toml", &model(100)).session().is_ok());
    let message = refused::refused(&model(101));
    assert!(message.contains("names 101 coordinates; an entry has at most 100"), "{message}");
}
