//! A mechanism passes through a position where it could branch, and goes on as it came. Near that position each step has a solution
//! on either branch: which one is found depends on where its iterations begin.

use std::path::Path;

use lissom::Model;

/// The largest change of the total energy [J].
fn change_of_energy(step_size: &str, spectral_radius: &str) -> f64 {
    let path = format!("{}/../../verification/four-bar-n2/model.toml", env!("CARGO_MANIFEST_DIR"));
    let model = Model::read(Path::new(&path)).unwrap();
    let overrides = [("analysis.step", step_size), ("analysis.spectral_radius", spectral_radius)]
        .map(|(path, value)| (path.to_owned(), value.to_owned()));
    let mut session = model.with_overrides(&overrides).session().unwrap();
    let (_, report) = session.run().unwrap().into_parts();
    report.energy.largest
}

#[test]
fn flat_windows_unfold_as_they_folded() {
    for step_size in ["2e-3", "1.2e-3", "6e-4", "3e-4"] {
        for spectral_radius in ["0.7", "0.8", "0.85", "0.9"] {
            let change = change_of_energy(step_size, spectral_radius);
            assert!(change < 5e-2, "h = {step_size} s, spectral radius {spectral_radius}: {change:e} J");
        }
    }
}
