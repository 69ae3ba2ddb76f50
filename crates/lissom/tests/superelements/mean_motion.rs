//! Parts of a mesh, reduced to bodies with the mean motion of their sides.

use super::*;

const BAR: &str = r#"
lissom = 1
[materials.steel]
E = 2e11
nu = 0.3
density = 7850
[solids.bar]
size = [1, 0.1, 0.06]
divisions = [6, 2, 1]
origin = [0, -0.05, -0.03]
material = "steel"
[bodies.hub]
mass = 0.5
inertia = [1e-3, 1e-3, 1e-3]
position = [0, 0, 0]
[bodies.end]
mass = 0.5
inertia = [1e-3, 1e-3, 1e-3]
position = [1, 0, 0]
[joints.first]
kind = "mean_motion"
base = "bar.west"
tip = "hub"
[joints.last]
kind = "mean_motion"
base = "bar.east"
tip = "end"
"#;

/// With the first body held, the lowest frequencies of the reduced part are those of the mesh.
#[test]
fn a_mesh_is_reduced_to_bodies_that_follow_its_sides() {
    let analysis = MODES;
    let report = reduced_to_modes(&format!("{BAR}{analysis}"), &["hub", "end"], 12);
    assert!((report.mass - 48.1).abs() < 1e-9, "{}", report.mass);
    let held = "[joints.wall]\nkind = \"clamp\"\nbase = \"ground\"\ntip = ";
    let whole = Model::from_text("model.toml", &format!("{BAR}{held}\"hub\"\n{analysis}"));
    let part = using(&report, &format!("{held}\"part.hub\"\n{analysis}"));
    let [whole, part] = [whole, part].map(|model| frequencies(&model, 4));
    for (own, exact) in part.iter().zip(&whole) {
        assert!((own / exact - 1.0).abs() < 2e-3, "{part:?} {whole:?}");
    }
    // A clamped side is stiffer.
    let clamped = format!("{BAR}{held}\"hub\"\n{analysis}").replace("mean_motion", "clamp");
    let clamped = frequencies(&Model::from_text("model.toml", &clamped), 1)[0];
    assert!(clamped > 1.002 * whole[0], "{clamped} {whole:?}");
}

/// With modes of the free part the frequencies of the free part are those of the mesh, to round-off.
#[test]
fn free_modes_are_exact_for_the_free_part() {
    let text = format!("{BAR}{MODES}");
    let request = ReduceRequest { free_modes: true, ..request(&["hub", "end"], 5) };
    let report =
        reduce(&Model::from_text("model.toml", &text), &request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((report.frequencies.len(), report.corrections), (5, 0));
    let own = frequencies(&using(&report, MODES), 11);
    let exact = frequencies(&Model::from_text("model.toml", &text), 11);
    for (own, exact) in own.iter().zip(&exact).skip(6) {
        assert!((own / exact - 1.0).abs() < 1e-7, "{own} {exact}");
    }
    let with_fixed = frequencies(&using(&reduced_to_modes(&text, &["hub", "end"], 5), MODES), 11);
    assert!((with_fixed[10] / exact[10] - 1.0).abs() > 1e-7, "{with_fixed:?} {exact:?}");
}

/// Stresses and displacements recovered from a reduced bar under a moment are those of the mesh.
#[test]
fn outputs_of_the_mesh_are_recovered() {
    let outputs = "[outputs.stress]\nkind = \"solid_stress\"\nof = \"bar@0.5,0.5,0\"\n\
                   [outputs.place]\nkind = \"displacement\"\nof = \"bar@0.5,0.5,0\"\n";
    let request = ReduceRequest {
        recover: ["stress", "place"].map(str::to_owned).to_vec(),
        corrections: false,
        ..request(&["hub", "end"], 4)
    };
    let text = format!("{BAR}{outputs}{MODES}");
    let report =
        reduce(&Model::from_text("model.toml", &text), &request).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.recovered.len(), 9);
    assert_eq!(report.recovered[0], ("stress.s11".to_owned(), "Pa".to_owned()));
    let rest = |hub: &str, end: &str, outputs: &str| {
        format!(
            "[joints.wall]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{hub}\"\n\
             [loads.turn]\nkind = \"moment\"\non = \"{end}\"\nvector = [0, 10, 0]\n{outputs}\
             [analysis]\nkind = \"statics\"\nend = 1\n"
        )
    };
    let recovered = "[outputs.all]\nkind = \"recovered\"\nof = \"part\"\n";
    let part = ran(&using(&report, &rest("part.hub", "part.end", recovered)), &[]);
    let whole = ran(&Model::from_text("model.toml", &format!("{BAR}{}", rest("hub", "end", outputs))), &[]);
    for (row, (output, component), size) in [(1, ("stress", "s11"), 1e4), (9, ("place", "u3"), 1e-6)] {
        let (own, exact) = (last(&part, "all", &format!("r{row}")), last(&whole, output, component));
        assert!(exact.abs() > size && (own / exact - 1.0).abs() < 1e-3, "{output}: {own} {exact}");
    }
}
