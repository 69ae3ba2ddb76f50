//! Solids from files: distorted meshes of first order, which get nodes at the middles of their edges, pass the patch test.

use std::path::Path;

use lissom::{Model, Override};

use crate::support::runs::{last, record, set};

/// The closed form of `verification/solid-patch`: tension by 5 %.
#[test]
fn distorted_meshes_pass_the_patch_test() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/solid-patch/model.toml");
    let model = Model::read(&path).expect("a model");
    let across = (1.0_f64 - 0.3 * 0.1025).sqrt();
    for (mesh, scale) in
        [("hexahedra.inp", 1.0), ("tetrahedra.inp", 1.0), ("wedges.inp", 1.0), ("hexahedra.inp", 0.5)]
    {
        let overrides: Vec<Override> = vec![
            set("solids.block.mesh", &format!("\"{mesh}\"")),
            set("solids.block.scale", &scale.to_string()),
            // Forces are proportional to areas.
            set("parameters.force", &(53_812.5 * scale * scale).to_string()),
        ];
        let record = record(&mut model.with_overrides(&overrides).session().expect("a good model"));
        let wanted = [("u1", 0.1 * scale), ("u2", (across - 1.0) * scale), ("u3", (across - 1.0) * scale)];
        for (component, wanted) in wanted {
            let found = last(&record, "corner", component);
            assert!((found - wanted).abs() < 1e-10, "{mesh} {scale} {component}: {found}, {wanted}");
        }
        let stress = 53_812.5 / (across * across);
        assert!((last(&record, "stress", "mises") / stress - 1.0).abs() < 1e-9, "{mesh}");
    }
}
