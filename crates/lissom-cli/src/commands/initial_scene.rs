//! The scene of a model in its initial state, and which analyses compute a motion.

use std::path::Path;

use lissom::model::document::AnalysisKind;
use lissom::model::scene::Scene;
use lissom::motion::MotionRecorder;
use lissom::pictures::view::Notice;
use lissom::start::{lower_with_units, warnings_of};
use lissom::{Override, Session};

use super::model_arguments;
use super::outcome::{Exit, Failure, show_warnings};
use super::results::writing_failed;

/// Scene of a model in its initial state.
pub(super) struct InitialScene {
    /// Name of the model.
    pub(super) name: String,
    /// One line of description; empty for none.
    pub(super) title: String,
    /// Drawing of the scene.
    pub(super) scene: Scene,
    /// A motion file of one frame.
    pub(super) motion: Vec<u8>,
    /// Warnings of the model.
    pub(super) warnings: Vec<Notice>,
}

impl InitialScene {
    /// Reads a model and computes its initial state.
    pub(super) fn of(path: &Path, set: &[Override], quiet: bool) -> Result<Self, Failure> {
        let model = model_arguments::read(path, set, &[])?;
        let document = model.document()?;
        if !quiet {
            show_warnings(&document);
        }
        let lowered = lower_with_units(&document)?;
        let scene = Scene::of(&document, &lowered.placed());
        let mut motion = Vec::new();
        let mut recorder = MotionRecorder::new(&lowered, None, &mut motion);
        // If the model starts from equilibrium, the initial state is the equilibrium.
        let start = if document.starts_in_equilibrium() {
            let again = lower_with_units(&document)?;
            let session = Session::start(again).map_err(|error| Failure::new(Exit::Failed, &error))?;
            session.simulation().state().clone()
        } else {
            lowered.state.clone()
        };
        recorder.write_still(&start.kinematics).map_err(writing_failed)?;
        let title = document.title.clone().unwrap_or_default();
        let warnings = warnings_of(&document.warnings).chain(lowered.warnings);
        let warnings = warnings.map(|warning| Notice::of(&warning)).collect();
        Ok(Self { name: model.name().to_owned(), title, scene, motion, warnings })
    }
}

/// Rejects buckling analyses, which have a table of their own and no motion.
pub(super) fn refuse_what_does_not_move(path: &Path, set: &[Override]) -> Result<(), Failure> {
    let model = model_arguments::read(path, set, &[])?;
    let kind = model.document()?.analysis.kind;
    match kind {
        AnalysisKind::Dynamics { .. }
        | AnalysisKind::Statics { .. }
        | AnalysisKind::Modes { .. }
        | AnalysisKind::Path { .. } => Ok(()),
        AnalysisKind::Buckling { .. } => {
            let message = format!("an analysis of kind `{}` computes no motion", kind.name());
            Err(Failure::request(format!("{message}; `--initial` shows the model in its initial state")))
        }
    }
}
