//! Deformations of superelements with several interfaces and every floating interface: what is recovered against positions and axes of
//! the interfaces, and the energy over long steps.

use lissom_motion::{Rotation, Vector3};

use super::*;

/// Interfaces of the part, and their positions along the bar [m].
const INTERFACES: [(&str, f64); 3] = [("bar_start", 0.0), ("bar_0_5", 0.5), ("bar_end", 1.0)];

/// A soft bar with three interfaces and two modes that flies, turns and bends. The recovery matrix is the identity.
fn flying(floating: &str, scheme: &str, step: f64, end: f64) -> Model {
    let soft = beam(MODES).replace("[1e6, 4e5, 4e5, 100, 200, 300]", "[3e4, 4e4, 4e4, 20, 30, 40]");
    let request = ReduceRequest { corrections: false, ..request(&["bar.start", "bar@0.5", "bar.end"], 2) };
    let report =
        reduce(&Model::from_text("model.toml", &soft), &request).unwrap_or_else(|error| panic!("{error}"));
    // Matrices of second order belong to the interface that was held.
    let report = if floating == INTERFACES[0].0 { report } else { bare(&report) };
    let (_, table) = report.files.last().expect("the table");
    let mut texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
    let size = 6 * INTERFACES.len() + 2;
    let mut identity = format!("%%MatrixMarket matrix array real general\n{size} {size}\n");
    for entry in 0..size * size {
        identity += if entry % (size + 1) == 0 { "1\n" } else { "0\n" };
    }
    texts.insert("recovery.mtx".to_owned(), identity);
    let nodes: String = INTERFACES
        .iter()
        .flat_map(|(name, _)| {
            ["position", "quaternion"]
                .map(|kind| format!("[outputs.{kind}_{name}]\nkind = \"{kind}\"\nof = \"part.{name}\"\n"))
        })
        .collect();
    let rest = format!(
        "recovery = \"recovery.mtx\"\nfloating = \"{floating}\"\n{nodes}\
         [bodies.end]\nmass = 0.4\ninertia = [2e-3, 3e-3, 4e-3]\nposition = [1, 0, 0.1]\n\
         [joints.end]\nkind = \"clamp\"\nbase = \"part.bar_end\"\ntip = \"end\"\n\
         [outputs.modes]\nkind = \"modal\"\nof = \"part\"\n[outputs.seen]\nkind = \"recovered\"\nof = \"part\"\n\
         [outputs.energy]\nkind = \"energy\"\n[outputs.momentum]\nkind = \"momentum\"\n\
         [initial]\nvelocity = [0.2, 0, 0.1]\nangular_velocity = [3, 2, 2]\nabout = [0.5, 0, 0]\n\
         [analysis]\nkind = \"dynamics\"\nend = {end}\nstep = {step}\nscheme = \"{scheme}\"\n"
    );
    Model::from_text("model.toml", &format!("{table}{rest}")).with_known(texts)
}

fn vector(record: &lissom::Record, output: &str, names: [&str; 3], row: usize) -> Vector3 {
    Vector3::from(
        names.map(|name| record.column(output, name).unwrap_or_else(|| panic!("{output}.{name}"))[row]),
    )
}

fn axes(record: &lissom::Record, interface: &str, row: usize) -> Rotation {
    let output = format!("quaternion_{interface}");
    let axis = vector(record, &output, ["q1", "q2", "q3"], row);
    let (sine, cosine) = (axis.norm(), record.column(&output, "q0").expect("it is recorded")[row]);
    if sine == 0.0 {
        Rotation::IDENTITY
    } else {
        Rotation::exponential(&(2.0 * sine.atan2(cosine) / sine * axis))
    }
}

#[test]
fn deformations_are_seen_from_the_floating_interface() {
    for (floating, at) in INTERFACES {
        let record = ran(&flying(floating, "radau-iia", 1e-3, 0.2), &[]);
        let seen =
            |number: usize, row: usize| record.column("seen", &format!("r{number}")).expect("recorded")[row];
        let mut most = [0.0_f64; 2];
        for row in 0..record.times.len() {
            let position = |name: &str| vector(&record, &format!("position_{name}"), ["x", "y", "z"], row);
            let base = axes(&record, floating, row);
            for (index, (name, along)) in INTERFACES.iter().enumerate() {
                let place = base.apply_inverse(&(position(name) - position(floating)));
                let moved = place - Vector3::new(along - at, 0.0, 0.0);
                let turned = (base.inverse() * axes(&record, name, row)).logarithm();
                for (kind, wanted) in [moved, turned].into_iter().enumerate() {
                    let found =
                        Vector3::from([0, 1, 2].map(|axis| seen(6 * index + 3 * kind + 1 + axis, row)));
                    assert!((found - wanted).norm() < 1e-10, "{floating}, {name}: {found} {wanted}");
                    most[kind] = most[kind].max(wanted.norm());
                }
            }
            for mode in 1..=2 {
                let own = record.column("modes", &format!("q{mode}")).expect("recorded")[row];
                assert!(
                    (seen(18 + mode, row) - own).abs() < 1e-12 * own.abs().max(1e-3),
                    "{floating}, mode {mode}"
                );
            }
        }
        assert!(most[0] > 1e-4 && most[1] > 1e-3, "it bends: {most:?}");
    }
}

/// Steps over which the part turns by up to 0.04 rad: the scheme without dissipation preserves the energy except for the inertia of the
/// deformed part, which is that of the stages; whatever interface floats.
#[test]
fn energy_is_preserved_over_long_steps_whatever_interface_floats() {
    for (floating, _) in INTERFACES {
        for (step, allowed) in [(2e-3, 2e-8), (8e-3, 3e-7)] {
            let model = flying(floating, "energy-decaying", step, 0.2);
            let record = ran(&model, &[set("analysis.spectral_radius", "1.0")]);
            let energy = column(&record, "energy", "total");
            let change = energy.iter().map(|value| (value - energy[0]).abs()).fold(0.0, f64::max);
            assert!(change < allowed, "{floating}, {step}: {change:e}");
            assert!(column(&record, "energy", "strain").iter().any(|strain| *strain > 1e-4), "it bends");
        }
    }
}
