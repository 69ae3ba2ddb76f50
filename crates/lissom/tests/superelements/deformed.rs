//! Deformations of superelements with several interfaces and every floating interface: what is recovered against positions and axes of
//! the interfaces, and the energy over long steps.

use lissom_motion::{Rotation, Vector3};

use super::*;

/// Interfaces of the part, and their positions along the bar [m].
const INTERFACES: [(&str, f64); 3] = [("bar_start", 0.0), ("bar_0_5", 0.5), ("bar_end", 1.0)];

/// A soft bar with three interfaces and two modes that flies, turns and bends. The recovery matrix is the identity.
fn flying(floating: &str, scheme: &str, step: f64, end: f64) -> Model {
    let soft = beam(MODES).replace("[1e6, 4e5, 4e5, 100, 200, 300]", "[3e3, 4e3, 4e3, 2, 3, 4]");
    let request = ReduceRequest { corrections: false, ..request(&["bar.start", "bar@0.5", "bar.end"], 2) };
    let report = reduce(&Model::from_text("model.toml", &soft), &[], &request)
        .unwrap_or_else(|error| panic!("{error}"));
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
         [initial]\nvelocity = [0.2, 0, 0.1]\nangular_velocity = [4, 3, 2]\nabout = [0.5, 0, 0]\n\
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
                for (first, wanted, most) in [(1, moved, &mut most[0]), (4, turned, &mut most[1])] {
                    let found = Vector3::from([0, 1, 2].map(|axis| seen(6 * index + first + axis, row)));
                    assert!((found - wanted).norm() < 1e-10, "{floating}, {name}: {found} {wanted}");
                    *most = most.max(wanted.norm());
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
        assert!(most[0] > 1e-3 && most[1] > 1e-2, "it bends: {most:?}");
    }
}

/// Steps over which the deformation turns by a few hundredths of a radian: the energy never increases, its loss is that of the third order,
/// and the motion does not depend on the floating interface more than on the step.
#[test]
fn energy_decays_over_long_steps_whatever_interface_floats() {
    for (floating, _) in INTERFACES {
        let losses: Vec<f64> = [2e-3, 4e-3, 8e-3]
            .into_iter()
            .map(|step| {
                let record = ran(&flying(floating, "energy-decaying", step, 0.2), &[]);
                let energy = column(&record, "energy", "total");
                for pair in energy.windows(2) {
                    assert!(pair[1] <= pair[0] + 1e-9 * energy[0], "{floating}, {step}: {pair:?}");
                }
                for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
                    let values = column(&record, "momentum", component);
                    let change = values.iter().map(|value| (value - values[0]).abs()).fold(0.0, f64::max);
                    println!("{floating} {step} {component} {change:e}");
                }
                println!("{floating} {step} {energy:?}");
                1.0 - energy[energy.len() - 1] / energy[0]
            })
            .collect();
        println!("{floating} {losses:?}");
    }
    panic!();
}
