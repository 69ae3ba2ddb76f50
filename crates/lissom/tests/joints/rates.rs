//! Recorded rates are the derivatives of recorded positions: for every kind of joint, coordinate, spring and observer, and for bodies
//! on beams.

use std::fmt::Write;

use lissom::start::lower;
use lissom::{Model, Record};
use lissom_motion::{Rotation, Vector3};

use super::kinds::EVERY_KIND;
use crate::support::runs::run;

/// Sliders of all orientations on an arc that swings and twists under its weight.
const SLIDERS: &str = r#"
lissom = 1
gravity = [0, 2, -9.81]
[sections.bar]
shape = "general"
stiffness = [4e4, 2e4, 2e4, 60, 80, 60]
mass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }
[beams.arc]
section = "bar"
curve = ["2*cos(s*pi/2)", "2*sin(s*pi/2)", "0.4*s^2"]
elements = 4
order = 3
[joints.wall]
kind = "revolute"
base = "ground"
tip = "arc.start"
axis = [0.3, 1, 0.5]
[bodies.car]
mass = 0.7
inertia = [0.02, 0.03, 0.04]
position = ["2*cos(0.5)", "2*sin(0.5)", "0.4*(1/pi)^2"]
[joints.slide]
kind = "slider"
beams = ["arc"]
tip = "car"
orientation = "ORIENTATION"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.2
step = 1e-3
"#;

/// First row that is compared: what is not consistent at the start has decayed by then.
const FIRST: usize = 100;

/// Derivative of a column at a row, by the central difference of the fourth order.
fn derivative(record: &Record, column: &[f64], row: usize) -> f64 {
    let step = (record.times[row + 2] - record.times[row - 2]) / 4.0;
    (column[row - 2] - 8.0 * column[row - 1] + 8.0 * column[row + 1] - column[row + 2]) / (12.0 * step)
}

/// Asserts that one column is the derivative of another one.
fn is_rate(record: &Record, of: &[f64], rate: &[f64], tolerance: f64, shown: &str) {
    let rows = FIRST..record.times.len() - 2;
    let scale = rows.clone().map(|row| rate[row].abs()).fold(0.0, f64::max).max(1e-3);
    for row in rows {
        let wanted = derivative(record, of, row);
        assert!(
            (rate[row] - wanted).abs() < tolerance * scale,
            "{shown}, t = {}: {} instead of {wanted}, of at most {scale}",
            record.times[row],
            rate[row]
        );
    }
}

fn columns<'r, const N: usize>(record: &'r Record, output: &str, names: [&str; N]) -> [&'r [f64]; N] {
    names.map(|name| record.column(output, name).unwrap_or_else(|| panic!("{output}.{name}")))
}

fn vector(columns: &[&[f64]; 3], row: usize) -> Vector3 {
    Vector3::from(columns.map(|column| column[row]))
}

/// Name of the output with the axes of a part.
fn axes_of(part: &str) -> String {
    format!("axes_{}", part.replace('.', "_"))
}

fn rotation(record: &Record, part: &str, row: usize) -> Rotation {
    let quaternion = columns(record, &axes_of(part), ["q0", "q1", "q2", "q3"]).map(|column| column[row]);
    let axis = Vector3::new(quaternion[1], quaternion[2], quaternion[3]);
    let sine = axis.norm();
    if sine == 0.0 {
        return Rotation::IDENTITY;
    }
    Rotation::exponential(&(2.0 * sine.atan2(quaternion[0]) / sine * axis))
}

/// Outputs of bodies, coordinates and springs of a model, and what is checked of them.
fn check(text: &str, parts: &[&str], observers: [&str; 2], springs: &[&str], tolerance: f64) {
    let document = Model::from_text("model.toml", text).document().unwrap();
    let names = lower(&document).expect("a model").names;
    let counts = names.coordinates.iter().map(|(name, own)| (name.clone(), own.len()));
    let coordinates: Vec<(String, usize)> = counts.filter(|(_, count)| *count > 0).collect();
    let mut text = text.to_owned();
    let [frame, axes] = observers;
    let views = [
        ("plain", String::new()),
        ("relative", format!("relative_to = \"{frame}\"\n")),
        ("turned", format!("relative_to = \"{frame}\"\nin = \"{axes}\"\n")),
        ("reported", format!("in = \"{axes}\"\n")),
    ];
    for part in parts.iter().chain(&[frame, axes]) {
        writeln!(text, "[outputs.{}]\nkind = \"quaternion\"\nof = \"{part}\"", axes_of(part)).unwrap();
    }
    for part in parts {
        for (view, keys) in &views {
            for kind in ["position", "displacement", "velocity", "acceleration", "angular_velocity"] {
                let point = if kind == "angular_velocity" { "" } else { "point = [0.7, -0.4, 0.3]\n" };
                writeln!(
                    text,
                    "[outputs.{kind}_{view}_{part}]\nkind = \"{kind}\"\nof = \"{part}\"\n{point}{keys}"
                )
                .unwrap();
            }
        }
    }
    for (name, _) in &coordinates {
        for kind in ["relative", "relative_acceleration"] {
            writeln!(text, "[outputs.{kind}_{name}]\nkind = \"{kind}\"\nof = \"{name}\"").unwrap();
        }
    }
    for name in springs {
        for kind in ["spring", "power", "work"] {
            writeln!(text, "[outputs.{kind}_{name}]\nkind = \"{kind}\"\nof = \"{name}\"").unwrap();
        }
    }
    let record = run(
        &text,
        &[("analysis.scheme", "radau-iia"), ("analysis.step", "2.5e-4"), ("analysis.end", "0.07")],
    );
    for part in parts {
        for (view, _) in &views[..2] {
            let [positions, displacements, velocities, accelerations] = [
                ("position", ["x", "y", "z"]),
                ("displacement", ["u1", "u2", "u3"]),
                ("velocity", ["v1", "v2", "v3"]),
                ("acceleration", ["a1", "a2", "a3"]),
            ]
            .map(|(kind, names)| columns(&record, &format!("{kind}_{view}_{part}"), names));
            for axis in 0..3 {
                let shown = format!("{view} {part} {axis}");
                is_rate(
                    &record,
                    positions[axis],
                    velocities[axis],
                    tolerance,
                    &format!("velocity of {shown}"),
                );
                is_rate(
                    &record,
                    velocities[axis],
                    accelerations[axis],
                    tolerance,
                    &format!("acceleration of {shown}"),
                );
                for (moved, position) in displacements[axis].iter().zip(positions[axis]) {
                    let change = position - positions[axis][0] - (moved - displacements[axis][0]);
                    assert!(change.abs() < 1e-12 && displacements[axis][0] == 0.0, "{shown}: {change}");
                }
            }
        }
        angular_velocities(&record, part, frame, tolerance);
        turned_views(&record, part, observers);
    }
    for (name, count) in &coordinates {
        let [relative, accelerations] =
            ["relative", "relative_acceleration"].map(|kind| all_columns(&record, &format!("{kind}_{name}")));
        assert_eq!([relative.len(), accelerations.len()], [2 * count, *count], "{name}");
        for (own, acceleration) in accelerations.iter().enumerate() {
            let [value, rate] = [relative[2 * own], relative[2 * own + 1]];
            is_rate(&record, value, rate, tolerance, &format!("rate {own} of {name}"));
            is_rate(&record, rate, acceleration, tolerance, &format!("acceleration {own} of {name}"));
        }
    }
    for name in springs {
        let [motion, power, work] =
            ["spring", "power", "work"].map(|kind| all_columns(&record, &format!("{kind}_{name}")));
        is_rate(&record, motion[0], motion[1], tolerance, &format!("rate of {name}"));
        is_rate(&record, work[0], power[0], tolerance, &format!("power of {name}"));
    }
}

/// All columns of an output.
fn all_columns<'r>(record: &'r Record, output: &str) -> Vec<&'r [f64]> {
    let of = record.columns.iter().zip(&record.values).filter(|(column, _)| column.output == output);
    of.map(|(_, values)| values.as_slice()).collect()
}

/// Angular velocities turn the axes: of a part, and as the observer sees it.
fn angular_velocities(record: &Record, part: &str, frame: &str, tolerance: f64) {
    let names = ["w1", "w2", "w3"];
    let [plain, relative] =
        ["plain", "relative"].map(|view| columns(record, &format!("angular_velocity_{view}_{part}"), names));
    for row in FIRST..record.times.len() - 2 {
        let step = (record.times[row + 2] - record.times[row - 2]) / 4.0;
        let axes = |row| rotation(record, part, row);
        let seen = |row| rotation(record, frame, row).inverse() * axes(row);
        let rate = |of: &dyn Fn(usize) -> Rotation| {
            let turn = |ahead: usize| (of(row + ahead) * of(row - ahead).inverse()).logarithm();
            (8.0 * turn(1) - turn(2)) / (12.0 * step)
        };
        for (found, wanted) in [(vector(&plain, row), rate(&axes)), (vector(&relative, row), rate(&seen))] {
            assert!((found - wanted).norm() < tolerance * wanted.norm().max(0.1), "{part}: {found} {wanted}");
        }
    }
}

/// Vectors in other axes are the same vectors.
fn turned_views(record: &Record, part: &str, [frame, axes]: [&str; 2]) {
    for (kind, names) in [
        ("position", ["x", "y", "z"]),
        ("displacement", ["u1", "u2", "u3"]),
        ("velocity", ["v1", "v2", "v3"]),
        ("acceleration", ["a1", "a2", "a3"]),
        ("angular_velocity", ["w1", "w2", "w3"]),
    ] {
        let of = |view: &str| columns(record, &format!("{kind}_{view}_{part}"), names);
        let [plain, relative, turned, reported] = ["plain", "relative", "turned", "reported"].map(of);
        for row in 0..record.times.len() {
            let [frame, axes] = [frame, axes].map(|name| rotation(record, name, row));
            let near = |found: Vector3, wanted: Vector3| {
                assert!(
                    (found - wanted).norm() < 1e-12 * wanted.norm().max(1.0),
                    "{kind} {part}: {found} {wanted}"
                );
            };
            near(vector(&reported, row), axes.apply_inverse(&vector(&plain, row)));
            near(vector(&turned, row), axes.apply_inverse(&frame.apply(&vector(&relative, row))));
        }
    }
}

#[test]
fn rates_of_all_kinds_are_derivatives() {
    let parts = ["a", "d", "f", "on_table", "bead", "nut", "hoop"];
    check(EVERY_KIND, &parts, ["b", "c"], &["push", "pull", "twist", "band", "tackle"], 2e-2);
}

#[test]
fn rates_of_sliders_are_derivatives() {
    for orientation in ["free", "tangent", "section"] {
        check(&SLIDERS.replace("ORIENTATION", orientation), &["car"], ["arc.end", "arc.start"], &[], 1e-2);
    }
}
