//! Damping of solids in proportion to their stiffness.

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};

use super::CANTILEVER;
use crate::support::runs::{column, run};

fn damped(time: f64, law: &str) -> String {
    let keys = format!("material = \"soft\"\nmodel = \"{law}\"\ndamping = {time}");
    CANTILEVER
        .replace("material = \"soft\"", &keys)
        .replace("divisions = [10, 2, 2]", "divisions = [5, 1, 1]")
}

/// The damping ratio of a mode is τ ω/2, also of rubber that is almost incompressible, whose dilatation is damped by the mean of an element.
#[test]
fn damping_ratios_are_proportional_to_frequencies() {
    for (law, poisson) in [("st-venant-kirchhoff", "nu = 0.3"), ("neo-hookean", "nu = 0.4999")] {
        let text = damped(1e-3, law).replace("nu = 0", poisson);
        let text = text.replace("kind = \"statics\"\nend = 1\nsteps = 1", "kind = \"modes\"");
        let request =
            ModeRequest { count: Some(3), about: Some(OperatingPoint::Undeformed), ..ModeRequest::default() };
        let found = modes(&Model::from_text("model.toml", &text), &request).expect("modes").modes;
        for mode in &found {
            let exact = 0.5e-3 * std::f64::consts::TAU * mode.frequency;
            assert!((mode.damping / exact - 1.0).abs() < 1e-6, "{law}: {} {exact}", mode.damping);
        }
    }
}

/// A kick gives energy, which never grows afterwards.
#[test]
fn a_damped_solid_loses_energy() {
    for (law, scheme) in [("st-venant-kirchhoff", "generalized-alpha"), ("neo-hookean", "radau-iia")] {
        let text = damped(0.2, law)
            .replace("vector = [0, 0, 1]", "vector = [0, 0, 100]\nscale = \"step(0.5 - t)\"")
            .replace("[analysis]", "[outputs.energy]\nkind = \"energy\"\n[analysis]")
            .replace("kind = \"statics\"\nend = 1\nsteps = 1", "kind = \"dynamics\"\nend = 8\nstep = 0.05");
        let text = format!("{text}scheme = \"{scheme}\"\n");
        let record = run(&text, &[]);
        let energy = column(&record, "energy", "total");
        let most = energy.iter().copied().fold(0.0, f64::max);
        assert!(most > 0.5 && energy[energy.len() - 1] < 0.5 * most, "{law}: {most} {:?}", energy.last());
        let after = &energy[11..];
        assert!(after.windows(2).all(|pair| pair[1] < pair[0] * (1.0 + 1e-6)), "{law}");
    }
}
