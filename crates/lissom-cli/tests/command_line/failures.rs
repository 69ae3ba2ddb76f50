//! Every way in which a run, statics, a path or modes end with exit code 2 or 3: the message names the part, the time, the
//! likely cause and a remedy. Each model in `failures/` says in its first lines what it is to end with.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::support::{Folder, lissom, summary};

/// What a model's first lines say, by word.
type Wanted = BTreeMap<String, String>;

fn models() -> Vec<(PathBuf, Wanted)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/failures");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let wanted = |path: &Path| {
        let text = fs::read_to_string(path).unwrap();
        let head = text.lines().map_while(|line| line.strip_prefix("# ")).map(|line| {
            let (word, rest) = line.split_once(": ").unwrap_or_else(|| panic!("{}: {line}", path.display()));
            (word.to_owned(), rest.to_owned())
        });
        head.collect()
    };
    paths.into_iter().map(|path| (path.clone(), wanted(&path))).collect()
}

#[test]
fn every_failure_names_part_time_cause_and_remedy() {
    let models = models();
    assert!(models.len() >= 35, "{} models", models.len());
    let mut wrong: Vec<String> = Vec::new();
    for (path, wanted) in &models {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let folder = Folder::new(name);
        let run =
            lissom(&["run", path.to_str().unwrap(), "--out", "out", "--no-plots", "--quiet"], folder.path());
        // Excerpts are wrapped.
        let words = run.errors.replace(['│', '\n'], " ");
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut miss = |what: &str| wrong.push(format!("{name}: {what}\n{}", run.errors));
        if run.code.to_string() != wanted["exit"] {
            miss(&format!("exit code {}", run.code));
        }
        for what in ["cause", "remedy"] {
            if !words.contains(&wanted[what]) {
                miss(&format!("no {what}: {}", wanted[what]));
            }
        }
        let part = wanted.get("part");
        if part.is_some_and(|part| !words.contains(&format!("`{part}`")) && !words.contains(part.as_str())) {
            miss("no part");
        }
        let Some(time) = wanted.get("time") else { continue };
        let facts = &summary(&folder.path().join("out"))["failure"];
        let time: f64 = time.parse().unwrap();
        if facts["time"].as_f64().is_none_or(|found| (found - time).abs() > 0.01 * time) {
            miss(&format!("time {} in the summary, not {time}", facts["time"]));
        }
        if facts["part"].as_str() != part.map(String::as_str) {
            miss(&format!("part {} in the summary", facts["part"]));
        }
        let variant = lissom::catalogue().find(|entry| Some(entry.code) == facts["code"].as_str());
        let variant = variant.map(|entry| entry.variant);
        if wraps_nothing(&wanted["error"]) && variant != Some(&wanted["error"]) {
            miss(&format!("code {} in the summary", facts["code"]));
        }
        if !facts["remedy"].as_str().is_some_and(|remedy| remedy.contains(&wanted["remedy"])) {
            miss(&format!("remedy {} in the summary", facts["remedy"]));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Whether an error of a step or a start is one of the catalogue's own, and not the name of what contains another one.
fn wraps_nothing(error: &str) -> bool {
    lissom::catalogue().any(|entry| entry.variant == error)
}

/// Errors for which there is no model here, with the reason.
const WITHOUT_MODEL: [(&str, &str); 15] = [
    ("StepError::NoTime", "a session is asked for it, no model can"),
    ("StepError::Interrupted", "Ctrl-C: tests of the command line"),
    ("StepError::Diverges", "the tests of Python have unstable loops"),
    ("StepError::Unit", "its unit is compiled by command_line/units.rs"),
    ("InitialError::Unit", "its unit is compiled by command_line/units.rs"),
    ("StepError::NotFinite", "a load or signal behind it is named instead; this is what is left"),
    ("StepError::TooInaccurate", "no model found since steps end at jumps"),
    ("StepError::LoopIsSingular", "no model found: contradictions are reported before"),
    ("StepError::NegativeKineticEnergy", "its matrices are too large for a file here: tests/superelements"),
    ("InitialError::ZeroPivot", "the reader rejects parts without mass"),
    ("InitialError::DelayInStatics", "the reader rejects delays there"),
    ("InitialError::NormalForces", "no model found, with friction coefficients up to 100 and 0.3 rad of yaw"),
    ("InitialError::ContactForces", "no model found: motions that drives prescribe contradict a contact"),
    ("InitialError::NotFinite", "the reader rejects functions that are not finite at the start"),
    ("AssemblyError::UpsideDown", "tests/assembly.rs"),
];

#[test]
fn every_error_of_steps_starts_and_assemblies_has_a_model() {
    let models = models();
    let of_runs = |variant: &&str| variant.starts_with("StepError") || variant.starts_with("InitialError");
    let variants = lissom::catalogue().map(|entry| entry.variant).filter(of_runs);
    let variants = variants.chain(["AssemblyError::Open", "AssemblyError::UpsideDown"]);
    let missing: Vec<&str> = variants
        .filter(|variant| {
            let has_model = models.iter().any(|(_, wanted)| wanted["error"] == *variant);
            let has_reason = WITHOUT_MODEL.iter().any(|(known, _)| known == variant);
            has_model == has_reason
        })
        .collect();
    assert!(missing.is_empty(), "neither a model nor a reason, or both: {missing:?}");
}
