//! The models that are run again and again where something is measured over all of them: scenes, examples, models of the
//! verification and random mechanisms. Independent of mechanics.

use std::path::Path;

use lissom::{Model, Override};
use lissom_model::document::AnalysisKind;

use crate::case::Case;
use crate::random;
use crate::scenes;
use crate::verify::{self, VerifyError, root};

/// Schemes that scenes are run with beside their own.
const FURTHER_SCHEMES: [&str; 2] = ["radau-iia", "energy-decaying"];
/// How much longer than a scene's own the steps are that are tried as well: those that resolve little are hard.
const LONGER: [f64; 2] = [10.0, 50.0];
/// Scenes that every scheme and longer steps are tried on: the others take long.
const SHORT: [&str; 6] = ["chain-s-10", "chain-r-10", "soft-beam-8", "tip-crank-1e-3", "rotor", "andrews"];
/// Seed of the random mechanisms; none that anything was fitted to.
const SEED: u64 = 11;

/// Step of random mechanisms that are to be hard: four times what they are made for [s].
const HARD_STEP: &str = "4e-3";

/// A model that is run again and again.
pub(crate) struct Subject {
    /// Name of the model in tables.
    pub(crate) name: String,
    /// The model.
    pub(crate) model: Model,
    /// Changes in it.
    pub(crate) overrides: Vec<Override>,
}

impl Subject {
    fn new(name: String, model: Model) -> Self {
        Self { name, model, overrides: Vec::new() }
    }
}

/// Scenes with their own and with further schemes, some of them with longer steps as well.
pub(crate) fn with_further_schemes() -> Vec<Subject> {
    let mut all = Vec::new();
    for name in scenes::KEPT {
        let Some(scene) = scenes::scene(name) else { continue };
        let add = |all: &mut Vec<Subject>, scheme: Option<&str>| {
            let text = match scheme {
                None => scene.text.clone(),
                Some(scheme) => scene.text.replace(
                    "scheme = \"generalized-alpha\"\nspectral_radius = 0.8",
                    &format!("scheme = \"{scheme}\""),
                ),
            };
            let name = scheme.map_or((*name).to_owned(), |scheme| format!("{name} {scheme}"));
            let model = Model::from_text(&name, &text);
            if SHORT.contains(&scene.name.as_str()) {
                for longer in LONGER {
                    all.extend(with_longer_steps(&name, &model, longer));
                }
            }
            all.push(Subject::new(name, model));
        };
        add(&mut all, None);
        if SHORT.contains(name) {
            for scheme in FURTHER_SCHEMES {
                add(&mut all, Some(scheme));
            }
        }
    }
    all
}

/// The short scenes.
pub(crate) fn short() -> Vec<Subject> {
    let scenes = SHORT.iter().filter_map(|name| scenes::scene(name));
    scenes.map(|scene| Subject::new(scene.name.clone(), Model::from_text(&scene.name, &scene.text))).collect()
}

/// The examples.
pub(crate) fn examples() -> Result<Vec<Subject>, VerifyError> {
    let mut all = Vec::new();
    for path in files(&root().join("examples"))? {
        let name = path.file_stem().map_or_else(String::new, |stem| format!("example {}", stem.display()));
        if let Ok(model) = Model::read(&path) {
            all.push(Subject::new(name, model));
        }
    }
    Ok(all)
}

/// So many random mechanisms.
pub(crate) fn random(count: u64) -> Vec<Subject> {
    let text = |index| random::text(SEED, index);
    (0..count)
        .map(|index| Subject::new(format!("random {index}"), Model::from_text("random", &text(index))))
        .collect()
}

/// So many random mechanisms with steps that resolve little, by schemes in turn.
pub(crate) fn hard_random(count: u64) -> Vec<Subject> {
    random_with(count, ("step", HARD_STEP))
}

/// So many random mechanisms with steps that are chosen, by schemes in turn.
pub(crate) fn chosen_random(count: u64) -> Vec<Subject> {
    let mut all = random_with(count, ("relative_tolerance", "1e-5"));
    for subject in &mut all {
        subject.name.push_str(", chosen steps");
    }
    all
}

fn random_with(count: u64, (key, value): (&str, &str)) -> Vec<Subject> {
    let schemes = ["generalized-alpha", "radau-iia", "energy-decaying"];
    let mut all = random(count);
    for (subject, scheme) in all.iter_mut().zip(schemes.iter().cycle()) {
        subject.overrides.push(("analysis.scheme".to_owned(), format!("\"{scheme}\"")));
        subject.overrides.push((format!("analysis.{key}"), value.to_owned()));
        subject.overrides.push(("analysis.output_every".to_owned(), "1".to_owned()));
    }
    all
}

/// The models of the quick verification.
pub(crate) fn cases() -> Result<Vec<Subject>, VerifyError> {
    let mut all = Vec::new();
    for folder in verify::folders(&root().join("verification"))? {
        let case = Case::read(&folder)?;
        if case.needs.is_some() || case.open.is_some() || !case.quick {
            continue;
        }
        for (name, run) in &case.runs {
            let model = run.model(&case.folder)?;
            let overrides = run.overrides(&std::collections::BTreeMap::new());
            let Ok(document) = model.with_overrides(&overrides).document() else { continue };
            if matches!(document.analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. })
            {
                all.push(Subject { name: format!("{} {name}", case.name), model, overrides });
            }
        }
    }
    Ok(all)
}

/// This model with steps that are so many times as long, each of them recorded.
fn with_longer_steps(name: &str, model: &Model, longer: f64) -> Option<Subject> {
    let document = model.document().ok()?;
    let AnalysisKind::Dynamics { step, .. } = document.analysis.kind else { return None };
    let set = |path: &str, value: String| (format!("analysis.{path}"), value);
    let overrides =
        vec![set("step", format!("{:e}", longer * step.value)), set("output_every", "1".to_owned())];
    Some(Subject { name: format!("{name} x{longer}"), model: model.clone(), overrides })
}

/// Model files of a folder, in order.
fn files(folder: &Path) -> Result<Vec<std::path::PathBuf>, VerifyError> {
    let entries = std::fs::read_dir(folder).map_err(VerifyError::file(folder))?;
    let mut files: Vec<_> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    files.sort();
    Ok(files)
}
