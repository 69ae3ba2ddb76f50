//! A model: its text with overrides, checked when it is created.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::num::NonZero;
use std::sync::{Arc, OnceLock};

use lissom::pictures::picture::Camera;
use lissom::start::lower_with_units;
use lissom::{Document, Model, SessionError};
use lissom_model::document::AnalysisKind;
use pyo3::prelude::*;

use crate::errors::{of_report, of_session};

/// A checked model.
#[derive(Clone)]
#[pyclass(frozen, module = "lissom._lissom")]
pub(crate) struct NativeModel {
    pub(crate) model: Model,
    /// Draws its simulations; from the first picture on.
    camera: OnceLock<Arc<Camera>>,
}

impl NativeModel {
    pub(crate) fn checked(model: Model) -> PyResult<Self> {
        let document = model.document().map_err(|report| of_report(&report))?;
        lower_with_units(&document).map_err(|report| of_report(&report))?;
        Ok(Self { model, camera: OnceLock::new() })
    }

    /// The checked document.
    pub(crate) fn document(&self) -> PyResult<Document> {
        self.model.document().map_err(|report| of_report(&report))
    }

    pub(crate) fn camera(&self) -> PyResult<&Camera> {
        if self.camera.get().is_none() {
            let camera = Camera::of(&self.document()?).map_err(|report| of_report(&report))?;
            // Another thread may have been first, with an equal one.
            let _ = self.camera.set(Arc::new(camera));
        }
        Ok(self.camera.wait())
    }

    /// A number that distinguishes models by all their inputs: text, overrides, included files.
    pub(crate) fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (self.model.text(), self.model.overrides(), self.model.included(), lissom::VERSION).hash(&mut hasher);
        hasher.finish()
    }

    /// Rejects a model whose analysis has no time history.
    pub(crate) fn in_time(document: &Document) -> PyResult<()> {
        match document.analysis.kind {
            AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. } => Ok(()),
            _ => Err(of_session(&SessionError::NotInTime(document.analysis.kind.name()))),
        }
    }
}

/// This number of threads, or one per processor.
pub(crate) fn threads_or_all(threads: Option<NonZero<usize>>) -> NonZero<usize> {
    threads.unwrap_or_else(|| std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN))
}
