//! Rules of the house that a search can see.

use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Identifiers of a source without its comments and strings, with their line numbers.
fn identifiers(text: &str) -> Vec<(usize, String)> {
    let mut result = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or("");
        // Every second piece between quotation marks is a string.
        for piece in code.split('"').step_by(2) {
            for word in piece.split(|c: char| !(c.is_alphanumeric() || c == '_')) {
                result.push((number + 1, word.to_owned()));
            }
        }
    }
    result
}

/// The crates of the core with their sources, as names from `src` on.
fn core_sources() -> Vec<(&'static str, String, PathBuf)> {
    let mut all = Vec::new();
    for crate_name in
        ["lissom-mechanics", "lissom-flexible", "lissom-contact", "lissom-system", "lissom-core"]
    {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(crate_name).join("src");
        let mut files = Vec::new();
        sources(&root, &mut files);
        assert!(files.len() > 9, "the search must see the sources");
        all.extend(files.into_iter().map(|file| {
            let name = file.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
            (crate_name, name, file)
        }));
    }
    all
}

fn offences(allowed: &[&str], words: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for (crate_name, name, file) in core_sources() {
        if allowed.iter().any(|prefix| name.starts_with(prefix)) {
            continue;
        }
        let text = fs::read_to_string(&file).expect("readable");
        for (line, word) in identifiers(&text) {
            if words.contains(&word.as_str()) {
                found.push(format!("{crate_name}/src/{name}:{line}: `{word}`"));
            }
        }
    }
    found
}

/// The crates of what is simulated, part by part.
const OF_MECHANICS: [&str; 3] = ["lissom-mechanics", "lissom-flexible", "lissom-contact"];

/// Mechanics holds no step: no field of a struct is one, by what its docstring says.
#[test]
fn no_struct_of_mechanics_holds_a_step() {
    // What the energy-decaying scheme shows to elements, and the exact time since the start of a step.
    let allowed = ["kinematics/step_stages.rs", "kinematics/motion.rs"];
    let of_mechanics =
        core_sources().into_iter().filter(|(crate_name, ..)| OF_MECHANICS.contains(crate_name));
    for (_, name, file) in of_mechanics.filter(|(_, name, _)| !allowed.contains(&name.as_str())) {
        let text = fs::read_to_string(&file).expect("readable");
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for (number, pair) in lines.windows(2).enumerate() {
            let is_field = pair[1].ends_with("f64,") && !pair[1].contains('(');
            let says = pair[0].strip_prefix("///").is_some_and(|words| words.contains("[s]"));
            assert!(!is_field || !says || !pair[0].contains("step"), "{name}:{}: {}", number + 2, pair[1]);
        }
    }
}

/// The claim of the method as code structure: only the scaling, and what takes steps, know the step size.
#[test]
fn only_scaling_and_what_takes_steps_know_the_step_size() {
    let allowed = [
        "scaling.rs",
        "settings",
        "consistent/",
        "integrator/",
        "control/",
        "simulation/",
        "differentiation/",
        "path/",
        "studies/",
    ];
    let found = offences(&allowed, &["h", "dt", "step_size", "time_step", "penalty"]);
    assert!(found.is_empty(), "step size or penalty outside {allowed:?}:\n{}", found.join("\n"));
}

/// Tolerances of round-off stand in one file, by purpose.
#[test]
fn round_off_tolerances_stand_in_one_file() {
    let words = ["ROUND_OFF", "EPS", "ROUNDOFF", "MACHINE_EPSILON"];
    let found = offences(&["round_off.rs"], &words);
    assert!(
        found.is_empty(),
        "name it by purpose in lissom-mechanics/src/round_off.rs:\n{}",
        found.join("\n")
    );
}

/// Names of constants state a meaning.
#[test]
fn constants_have_names_with_a_meaning() {
    let words =
        ["SMALL", "SAME", "BESIDE", "BEYOND", "APART", "NEAR", "FAR", "UNEQUAL", "STILL", "TO_COME", "SLOW"];
    let found = offences(&[], &words);
    assert!(found.is_empty(), "constants without a meaning:\n{}", found.join("\n"));
}

#[test]
fn the_search_finds_what_it_looks_for() {
    assert!(!offences(&["integrator/"], &["h"]).is_empty(), "scaling.rs holds `h`");
}

/// The core opens no file, prints nothing and reads no clock.
#[test]
fn the_core_has_no_contact_with_the_outside() {
    let words = ["fs", "File", "println", "eprintln", "print", "Instant", "SystemTime", "env", "stdin"];
    let found = offences(&[], &words);
    assert!(found.is_empty(), "contact with the outside:\n{}", found.join("\n"));
}

/// Pages of the manual below a folder.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
}

/// Paths in backticks that begin with a folder of the repository or of a crate, with their line numbers. Patterns such as
/// `examples/<name>.toml` are omitted.
fn quoted_paths(text: &str, folders: &[String]) -> Vec<(usize, String)> {
    let is_pattern = |piece: &str| piece.contains(|c: char| c.is_whitespace() || "<>*…{}()[]$=".contains(c));
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        // Every second piece between backticks is quoted.
        for piece in line.split('`').skip(1).step_by(2) {
            let path = piece.split([':', '#']).next().unwrap_or("");
            let is_path =
                path.split_once('/').is_some_and(|(first, _)| folders.iter().any(|own| own == first));
            if is_path && !is_pattern(piece) {
                found.push((number + 1, path.to_owned()));
            }
        }
    }
    found
}

/// Names of the folders in `root` and of the usual folders of crates.
fn folders_of(root: &Path) -> Vec<String> {
    let entries = fs::read_dir(root).expect("readable").map(|entry| entry.expect("readable"));
    let folders = entries.filter(|entry| entry.path().is_dir());
    let names = folders.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let of_crates = ["src", "tests", "python"].map(str::to_owned);
    names.filter(|name| name != "target" && name != "out").chain(of_crates).collect()
}

#[test]
fn paths_in_the_documentation_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = folders_of(&root);
    let mut files = ["ARCHITECTURE.md", "CONTRIBUTING.md", "README.md"].map(|name| root.join(name)).to_vec();
    pages(&root.join("docs"), &mut files);
    // Some pages name paths within the crate of which they speak.
    let crates =
        fs::read_dir(root.join("crates")).expect("readable").map(|entry| entry.expect("readable").path());
    let bases: Vec<PathBuf> = std::iter::once(root.clone()).chain(crates).collect();
    let (mut count, mut missing) = (0, Vec::new());
    for file in files {
        let text = fs::read_to_string(&file).expect("readable");
        for (line, path) in quoted_paths(&text, &folders) {
            count += 1;
            if !bases.iter().any(|base| base.join(&path).exists()) {
                let name = file.strip_prefix(&root).expect("below the root").display();
                missing.push(format!("{name}:{line}: `{path}`"));
            }
        }
    }
    assert!(count > 100, "the search must see the paths: {count}");
    assert!(missing.is_empty(), "paths that do not exist:\n{}", missing.join("\n"));
}

/// Names in backticks that are no path: `function_name`, `Type::function`, `CamelCase`; the last part of each.
fn quoted_names(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        for piece in line.split('`').skip(1).step_by(2) {
            let is_name = |part: &str| {
                part.starts_with(|c: char| c.is_ascii_alphabetic())
                    && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            };
            let looks_like_code = piece.contains("::")
                || piece.contains('_')
                || piece.trim_start_matches(|c: char| c.is_ascii_uppercase()) != piece;
            if looks_like_code && piece.split("::").all(is_name) {
                found.push((number + 1, piece.rsplit("::").next().unwrap_or(piece).to_owned()));
            }
        }
    }
    found
}

/// Functions and types that ARCHITECTURE.md names are in the sources.
#[test]
fn names_in_the_architecture_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = fs::read_to_string(root.join("ARCHITECTURE.md")).expect("readable");
    let mut files = Vec::new();
    sources(&root.join("crates"), &mut files);
    let known: std::collections::HashSet<String> = files
        .iter()
        .flat_map(|file| identifiers(&fs::read_to_string(file).expect("readable")))
        .map(|(_, word)| word)
        .collect();
    let names = quoted_names(&text);
    assert!(names.len() > 20, "the search must see the names: {}", names.len());
    let missing: Vec<&(usize, String)> = names.iter().filter(|(_, name)| !known.contains(name)).collect();
    assert!(missing.is_empty(), "ARCHITECTURE.md names what does not exist: {missing:?}");
}

/// Short paths of sources in backticks, such as `simulation/sequence.rs`, end the path of a source.
#[test]
fn short_paths_of_sources_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (mut known, mut files) = (Vec::new(), Vec::new());
    for folder in ["crates", "xtask", "benches", "fuzz"] {
        sources(&root.join(folder), &mut known);
    }
    files.extend(["ARCHITECTURE.md", "CONTRIBUTING.md", "README.md"].map(|name| root.join(name)));
    pages(&root.join("docs"), &mut files);
    let (mut count, mut missing) = (0, Vec::new());
    for file in files {
        let text = fs::read_to_string(&file).expect("readable");
        for (number, line) in text.lines().enumerate() {
            for piece in line.split('`').skip(1).step_by(2) {
                let is_source = Path::new(piece).extension().is_some_and(|extension| extension == "rs");
                if is_source && !piece.contains(['<', '*', ' ', '{']) {
                    count += 1;
                    if !known.iter().any(|source| source.ends_with(piece)) {
                        let name = file.strip_prefix(&root).expect("below the root").display();
                        missing.push(format!("{name}:{}: `{piece}`", number + 1));
                    }
                }
            }
        }
    }
    assert!(count > 50, "the search must see the paths: {count}");
    assert!(missing.is_empty(), "sources that do not exist:\n{}", missing.join("\n"));
}

#[test]
fn quoted_paths_are_found() {
    let folders = ["crates".to_owned(), "docs".to_owned()];
    let text = "`crates/x/src/a.rs:12` and `docs/<name>.md`\n`crates/none` beside `other/x` and docs/y.md";
    let expected = [(1, "crates/x/src/a.rs".to_owned()), (2, "crates/none".to_owned())];
    assert_eq!(quoted_paths(text, &folders), expected);
}

/// Every file of tests is a module of the program of its crate or of a source, or a program of its own: nobody would miss a file that is
/// not built.
#[test]
fn files_of_tests_are_built() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (mut count, mut missing) = (0, Vec::new());
    for entry in fs::read_dir(root).expect("readable") {
        let folder = entry.expect("readable").path();
        let (tests, manifest) =
            (folder.join("tests"), fs::read_to_string(folder.join("Cargo.toml")).expect("readable"));
        let mut files = Vec::new();
        if tests.join("main.rs").exists() {
            sources(&tests, &mut files);
        }
        for file in files {
            let parent = file.parent().expect("below the folder");
            let stem = |path: &Path| path.file_stem().expect("a name").to_string_lossy().into_owned();
            let (own, above) = if file.ends_with("mod.rs") {
                (stem(parent), parent.parent().expect("below"))
            } else {
                (stem(&file), parent)
            };
            if own == "main" || parent == tests && manifest.contains(&format!("[[test]]\nname = \"{own}\"")) {
                continue;
            }
            // A module of a source names it.
            if let Ok(unit) = file.strip_prefix(tests.join("unit")) {
                let source = fs::read_to_string(folder.join("src").join(unit)).unwrap_or_default();
                let source = source.replace("\npub(crate) mod tests;", "\nmod tests;");
                if !source.contains(&format!("tests/unit/{}\"]\nmod tests;", unit.display())) {
                    missing.push(file.display().to_string());
                }
                continue;
            }
            let declares = [above.join("main.rs"), above.join("mod.rs"), above.with_extension("rs")]
                .iter()
                .filter_map(|path| fs::read_to_string(path).ok())
                .any(|text| {
                    text.lines().any(|line| line.trim_start_matches("pub(crate) ") == format!("mod {own};"))
                });
            count += 1;
            if !declares {
                missing.push(file.display().to_string());
            }
        }
    }
    assert!(count > 80, "the search must see the files: {count}");
    assert!(missing.is_empty(), "files that are no module of the tests:\n{}", missing.join("\n"));
}

/// Folders and files of the mechanics, and what of their crate they may name.
const FLOORS: [(&str, &[&str]); 17] = [
    ("number.rs", &["number"]),
    ("round_off.rs", &[]),
    ("instants.rs", &["round_off"]),
    ("units.rs", &[]),
    ("kinematics/", &["kinematics", "round_off", "units"]),
    ("dual.rs", &[]),
    ("law.rs", &[]),
    ("relation.rs", &["law"]),
    ("registry.rs", &["kinematics", "law", "relation"]),
    ("diagnostics/", &["diagnostics", "kinematics", "number", "registry"]),
    ("ports.rs", &["kinematics", "registry"]),
    ("compliance.rs", &["round_off"]),
    ("wheels/", &["dual", "kinematics", "registry", "round_off", "wheels"]),
    (
        "signals/",
        &["diagnostics", "dual", "instants", "kinematics", "law", "number", "round_off", "signals", "units"],
    ),
    ("joints/", &["joints", "kinematics", "law", "ports", "registry", "relation", "round_off", "wheels"]),
    ("evaluation/", &["evaluation", "joints", "kinematics", "law", "round_off", "signals"]),
    (
        "elements/",
        &[
            "compliance",
            "dual",
            "elements",
            "evaluation",
            "joints",
            "kinematics",
            "law",
            "number",
            "ports",
            "registry",
            "round_off",
            "signals",
            "wheels",
        ],
    ),
];

/// Elements and joints know no system: every import of the lower floors stays on its floor or goes down.
#[test]
fn the_lower_floors_import_nothing_from_above() {
    let (mut found, mut seen) = (Vec::new(), 0);
    for (crate_name, name, file) in core_sources() {
        if crate_name != "lissom-mechanics" || name == "lib.rs" {
            continue;
        }
        let Some((_, allowed)) = FLOORS.iter().find(|(floor, _)| name.starts_with(floor)) else {
            found.push(format!("{name} is on no floor"));
            continue;
        };
        let text = fs::read_to_string(&file).expect("readable");
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or("");
        for (number, line) in code.lines().enumerate() {
            let line = line.split("//").next().unwrap_or("");
            for (start, _) in line.match_indices("crate::") {
                seen += 1;
                let path = &line[start..];
                let first =
                    path["crate::".len()..].split(|c: char| !(c.is_alphanumeric() || c == '_')).next();
                if !first.is_some_and(|first| allowed.contains(&first)) {
                    found.push(format!("{name}:{}: {}", number + 1, line.trim()));
                }
            }
        }
    }
    assert!(seen > 100, "the search must see the imports");
    assert!(found.is_empty(), "imports from above:\n{}", found.join("\n"));
}
