//! What moments and forces across do to the stiffness of superelements, which no matrices know.

use super::*;

/// Displacement and rotation of the end of a cantilever under loads there, and the warnings with their codes.
fn bent(model: &Model, [y, z, torque]: [f64; 3]) -> ([f64; 6], Vec<(String, f64)>) {
    let set = |name: &str, value: f64| set(&format!("parameters.{name}"), &format!("{value:?}"));
    let overrides = [set("y", y), set("z", z), set("torque", torque)];
    let mut session = model.with_overrides(&overrides).session().unwrap_or_else(|error| panic!("{error}"));
    let record = session.run().unwrap();
    let of = |output: &str, component: &str| last(&record, output, component);
    let found = ["u1", "u2", "u3"].map(|component| of("end", component));
    let turned = ["r1", "r2", "r3"].map(|component| of("turn", component));
    // Large loads bend beyond the linear range as well.
    let others = session.warnings().filter(|warning| warning.code() != "beyond-linear");
    let warnings = others.map(|warning| match warning {
        lissom_core::errors::Warning::MomentStiffness { largest, .. } => {
            (warning.code().to_owned(), 0.005 * largest)
        }
        other => (other.code().to_owned(), 0.0),
    });
    let warnings = warnings.collect();
    ([found[0], found[1], found[2], turned[0], turned[1], turned[2]], warnings)
}

/// The beam and its superelement under forces across and a torque at the end.
fn loaded(interfaces: [&str; 2], text: &str) -> String {
    let rest = format!(
        "{}[loads.force]\nkind = \"force\"\non = \"{1}\"\nvector = [0, \"y\", \"z\"]\n\
         [loads.torque]\nkind = \"moment\"\non = \"{1}\"\nvector = [\"torque\", 0, 0]\nfollower = true\n\
         [outputs.end]\nkind = \"displacement\"\nof = \"{1}\"\n[outputs.turn]\nkind = \"rotation\"\nof = \"{1}\"\n\
         [analysis]\nkind = \"statics\"\nsteps = 4\n",
        clamp(interfaces[0]),
        interfaces[1]
    );
    text.replace("lissom = 1\n", "lissom = 1\n[parameters]\ny = 0\nz = 0\ntorque = 0\n").replace(MODES, "")
        + &rest
}

/// Bending in two planes, and bending with torque, over loads: an error of 1 % causes a warning, and one of 0.2 % does not. Of it up to 0.5 % is
/// that of forces which move along with the end, and no moments.
#[test]
fn stiffness_that_moments_change_is_reported() {
    let exact = Model::from_text("model.toml", &loaded(["bar.start", "bar.end"], &beam(MODES)));
    let report = reduced(&beam(MODES), &["bar.start", "bar.end"], 8);
    let own = {
        let report = bare(&report);
        let (_, table) = report.files.last().expect("the table");
        let texts: BTreeMap<String, String> = report.files.iter().cloned().collect();
        Model::from_text("model.toml", &loaded(["part.bar_start", "part.bar_end"], table)).with_known(texts)
    };
    let mut sides = [0, 0];
    for direction in
        [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.3, 1.0, 0.3], [0.0, 0.0, 1.0]]
    {
        for size in [1.0, 3.0, 10.0, 20.0] {
            let loads = direction.map(|part| size * part);
            let (exact, none) = bent(&exact, loads);
            assert!(none.is_empty(), "{none:?}");
            let (found, warnings) = bent(&own, loads);
            let largest = exact.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let error_of = |found: &[f64; 6], first: usize| {
                (first..6).map(|k| (found[k] - exact[k]).abs()).fold(0.0, f64::max) / largest
            };
            // Without matrices of second order the shortening is missed as well, which moments do not make.
            let error = error_of(&found, 1);
            match warnings.as_slice() {
                [] => assert!(error < 0.01, "{loads:?}: {error} without a warning"),
                [(code, part)] => {
                    assert_eq!(code, "moment-stiffness", "{loads:?}");
                    assert!(
                        error > 0.002 && (0.7..1.8).contains(&(part / error)),
                        "{loads:?}: {error} {part}"
                    );
                }
                more => panic!("{loads:?}: {more:?}"),
            }
            sides[usize::from(error > 0.005)] += 1;
        }
    }
    assert!(sides[0] > 5 && sides[1] > 5, "{sides:?}");
}
