//! Reductions of blades that nothing holds, along every axis.

use super::*;

/// A blade of 20 m and 10 t, from the origin along an axis.
fn blade(axis: char, is_tapered: bool, is_twisted: bool) -> String {
    let [to, up] = match axis {
        'x' => ["[20, 0, 0]", "[0, 0, 1]"],
        'y' => ["[0, 20, 0]", "[0, 0, 1]"],
        _ => ["[0, 0, 20]", "[1, 0, 0]"],
    };
    let sections = if is_tapered {
        "stations = [{ at = 0, section = \"root\" }, { at = 1, section = \"end\" }]"
    } else {
        "section = \"root\""
    };
    let end = "[sections.end]\nshape = \"rectangle\"\nmaterial = \"glass\"\nwidth = 0.3\nheight = 0.08\n";
    let (end, twist) =
        (if is_tapered { end } else { "" }, if is_twisted { "twist = \"0.15*(1 - s)\"\n" } else { "" });
    format!(
        "lissom = 1\n[materials.glass]\nE = 30e9\nnu = 0.3\ndensity = 1900\n\
         [sections.root]\nshape = \"rectangle\"\nmaterial = \"glass\"\nwidth = 0.9\nheight = 0.3\n{end}\
         [beams.blade]\nfrom = [0, 0, 0]\nto = {to}\nup = {up}\n{sections}\n{twist}elements = 8\n"
    )
}

fn reduced_blade(blade: &str, modes: usize, corrections: bool) -> ReduceReport {
    let request = ReduceRequest {
        corrections,
        name: "blade".to_owned(),
        ..request(&["blade.start", "blade.end"], modes)
    };
    reduce(&Model::from_text("model.toml", &format!("{blade}{MODES}")), &[], &request)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Free blades along every axis can be reduced: residuals of rigid motions are compared with the norm of the stiffness.
#[test]
fn free_blades_are_reduced_along_every_axis() {
    for axis in ['x', 'y', 'z'] {
        for (is_tapered, is_twisted) in [(false, false), (true, false), (true, true)] {
            let text = blade(axis, is_tapered, is_twisted);
            let report = reduced_blade(&text, 4, true);
            let mass = if is_tapered { 5586.0 } else { 10260.0 };
            assert!((report.mass - mass).abs() < 1.0, "{axis}: {}", report.mass);
        }
    }
}
