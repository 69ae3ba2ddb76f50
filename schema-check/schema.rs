//! The schema accepts all good model files and examples, and rejects what a schema can reject. `LISSOM_PROGRAM` names the program
//! that prints it; by default the one that `cargo build --release` has built.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use jsonschema::Validator;
use serde_json::{Value, json};

/// The folder of the project.
fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// What judges by the schema that users see.
fn validator() -> Validator {
    let program = std::env::var_os("LISSOM_PROGRAM")
        .map_or_else(|| project().join("target/release/lissom"), PathBuf::from);
    let printed = Command::new(&program).arg("schema").output().unwrap_or_else(|error| {
        panic!(
            "{}: {error}: build it by `cargo build --release`, or name another in LISSOM_PROGRAM",
            program.display()
        )
    });
    assert!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
    jsonschema::validator_for(&serde_json::from_slice(&printed.stdout).unwrap()).unwrap()
}

/// Names and texts of the model files of a folder.
fn folder(path: &str) -> Vec<(String, String)> {
    fs::read_dir(project().join(path))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .map(|path| {
            (path.file_stem().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(path).unwrap())
        })
        .collect()
}

fn json_of(text: &str) -> Option<Value> {
    fn convert(value: toml::Value) -> Value {
        match value {
            toml::Value::String(text) => json!(text),
            toml::Value::Integer(number) => json!(number),
            toml::Value::Float(number) => json!(number),
            toml::Value::Boolean(flag) => json!(flag),
            toml::Value::Datetime(date) => json!({ "date": date.to_string() }),
            toml::Value::Array(list) => list.into_iter().map(convert).collect(),
            toml::Value::Table(table) => {
                Value::Object(table.into_iter().map(|(key, value)| (key, convert(value))).collect())
            }
        }
    }
    text.parse::<toml::Table>().ok().map(|table| convert(toml::Value::Table(table)))
}

#[test]
fn good_files_fit_the_schema() {
    let validator = validator();
    for (name, text) in folder("crates/lissom-model/tests/good").into_iter().chain(folder("examples")) {
        let errors: Vec<String> = validator
            .iter_errors(&json_of(&text).unwrap())
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert!(errors.is_empty(), "{name}: {errors:#?}");
    }
}

#[test]
fn typical_mistakes_do_not_fit_the_schema() {
    let validator = validator();
    // What is wrong with these shows in one value alone, without looking anything up.
    let seen = [
        "unknown_",
        "missing_",
        "type_",
        "vector_too_short",
        "number_negative",
        "number_zero",
        "elements_",
        "order_four",
        "version_",
        "step_zero",
        "alpha_outside",
        "radius_outside",
        "penalty_negative",
        "tolerance_zero",
        "no_analysis",
        "stations_outside",
        "stiffness_five",
        "mass_lacks_inertia",
        "table_too_short",
        "table_row_length",
        "plane_wrong",
        "steps_in_dynamics",
        "output_energy_of",
        "gravity_length",
        "title_number",
        "many_errors",
    ];
    let hidden = [
        "unknown_material",
        "unknown_section",
        "unknown_point",
        "unknown_point_only",
        "unknown_part",
        "unknown_joint",
        "unknown_joint_output",
        "unknown_shear_theory",
        "missing_nu",
        "missing_from",
        "missing_section",
    ];
    let mut checked = 0;
    for (name, text) in folder("crates/lissom-model/tests/bad") {
        if hidden.contains(&name.as_str()) || !seen.iter().any(|start| name.starts_with(start)) {
            continue;
        }
        if let Some(instance) = json_of(&text) {
            assert!(!validator.is_valid(&instance), "{name} fits the schema");
            checked += 1;
        }
    }
    assert!(checked >= 40, "{checked}");
}
