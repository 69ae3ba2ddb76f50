//! Motions of solids.

use super::CANTILEVER;
use crate::support::runs::{SCHEMES, column, goes_on_from_a_snapshot, run};

/// A block that flies and spins freely.
const FREE: &str = r#"
lissom = 1
[materials.m]
E = 1e7
nu = 0.3
density = 1000
[solids.block]
size = [0.6, 0.2, 0.1]
divisions = [3, 1, 1]
material = "m"
[initial]
velocity = [1, 2, 3]
angular_velocity = [5, 3, 8]
about = [0.3, 0.1, 0.05]
[outputs.momentum]
kind = "momentum"
[outputs.energy]
kind = "energy"
[outputs.corner]
kind = "position"
of = "block@1,1,1"
[analysis]
kind = "dynamics"
end = 0.2
step = 1e-3
"#;

fn rubber() -> String {
    FREE.replace("material = \"m\"", "material = \"m\"\nmodel = \"neo-hookean\"")
        .replace("nu = 0.3", "nu = 0.49")
}

#[test]
fn a_block_in_free_flight_keeps_its_momenta() {
    for scheme in SCHEMES {
        let record = run(FREE, &[("analysis.scheme", &format!("\"{scheme}\""))]);
        for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
            let values = column(&record, "momentum", component);
            let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let changed = values.iter().fold(0.0_f64, |most, value| most.max((value - values[0]).abs()));
            // Momentum is a sum of velocities in global axes; angular momentum is quadratic in the motion.
            let allowed = if component.starts_with('p') { 1e-9 } else { 2e-3 };
            assert!(changed < allowed * largest, "{scheme} {component}: {changed:e} of {largest:e}");
        }
        let energy = column(&record, "energy", "total");
        let risen = energy.iter().fold(0.0_f64, |most, value| most.max(value - energy[0]));
        assert!(risen < 2e-3 * energy[0], "{scheme}: {risen:e}");
    }
}

/// A bar of one element has the energy and the momenta of a rigid one.
#[test]
fn a_block_of_one_element_spins_as_a_rigid_one() {
    let (mass, spin) = (1000.0 * 0.6 * 0.2 * 0.1, [5.0, 3.0, 8.0]);
    let [a, b, c] = [0.6_f64, 0.2, 0.1].map(|size| mass * size * size / 12.0);
    let inertia = [b + c, a + c, a + b];
    for divisions in ["[1, 1, 1]", "[3, 1, 2]"] {
        let record = run(&FREE.replace("[3, 1, 1]", divisions), &[("analysis.end", "1e-3")]);
        let kinetic = column(&record, "energy", "kinetic")[0];
        let expected = 0.5 * (mass * 14.0 + (0..3).map(|k| inertia[k] * spin[k] * spin[k]).sum::<f64>());
        assert!((kinetic / expected - 1.0).abs() < 1e-12, "{divisions}: {kinetic}, {expected}");
        let (center, velocity) = ([0.3, 0.1, 0.05], [1.0, 2.0, 3.0]);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let orbit = mass * (center[i] * velocity[j] - center[j] * velocity[i]);
            let found = column(&record, "momentum", &format!("l{}", k + 1))[0];
            let expected = orbit + inertia[k] * spin[k];
            assert!((found - expected).abs() < 1e-12 * mass, "{divisions} l{}: {found}, {expected}", k + 1);
        }
    }
}

/// Whatever the step and the law.
#[test]
fn the_energy_decaying_scheme_gains_none_with_large_steps() {
    for text in [FREE.to_owned(), rubber()] {
        let record = run(
            &text,
            &[("analysis.scheme", "\"energy-decaying\""), ("analysis.step", "1e-2"), ("analysis.end", "0.5")],
        );
        let energy = column(&record, "energy", "total");
        let rise = energy.windows(2).fold(0.0_f64, |most, pair| most.max(pair[1] - pair[0]));
        assert!(rise < 1e-9 * energy[0], "{rise:e}");
        assert!(energy.last().is_some_and(|end| *end > 0.9 * energy[0]), "{energy:?}");
        for component in ["l1", "l2", "l3"] {
            let values = column(&record, "momentum", component);
            let changed = values.iter().fold(0.0_f64, |most, value| most.max((value - values[0]).abs()));
            assert!(changed < 2e-2 * values[0].abs(), "{component}: {changed:e} of {:e}", values[0]);
        }
    }
}

#[test]
fn restarts_are_exact_to_the_last_bit() {
    goes_on_from_a_snapshot(FREE, [0.02, 0.04]);
    goes_on_from_a_snapshot(&rubber(), [0.02, 0.04]);
}

/// A bar that is held at one end: bending at (1.8751/l)² √(EI/ρA)/2π, and as a rod at √(E/ρ)/(4 l).
#[test]
fn modes_of_a_bar_are_those_of_a_beam_and_of_a_rod() {
    use lissom::Model;
    use lissom::analyses::modes::{ModeRequest, modes};
    let text =
        CANTILEVER.replace("[loads.end]\nkind = \"force\"\non = \"bar.east\"\nvector = [0, 0, 1]\n", "");
    let model = Model::from_text("model.toml", &text);
    let request = ModeRequest { count: Some(8), ..ModeRequest::default() };
    let found: Vec<f64> =
        modes(&model, &request).expect("modes").modes.iter().map(|mode| mode.frequency).collect();
    let bending = (1.875_104_f64 / 10.0).powi(2) * (1e3_f64 / 12.0).sqrt() / std::f64::consts::TAU;
    // Shear and rotary inertia lower it by 1 %.
    assert!((found[0] / bending - 0.99).abs() < 0.01, "{found:?}, {bending}");
    let rod = 1e3_f64.sqrt() / 40.0;
    assert!(found.iter().any(|own| (own / rod - 1.0).abs() < 2e-3), "{found:?}, {rod}");
}
