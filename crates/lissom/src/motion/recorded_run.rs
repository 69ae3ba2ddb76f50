//! A run with its motion.

use lissom_model::output::Record;
use lissom_model::scene::Scene;

use super::Motion;

/// A run with its motion, read back from a folder of results.
#[derive(Clone, Debug)]
pub struct RecordedRun {
    /// One line about the model; empty for none.
    pub title: String,
    /// The scene of the model.
    pub scene: Scene,
    /// Motion of the model.
    pub motion: Motion,
    /// The table of results.
    pub record: Record,
}
