//! Data of an equilibrium path for pictures: a motion with a frame for every equilibrium, and the scene along it.

use std::io::{self, Write};

use crate::start::Lowered;
use lissom_core::kinematics::Kinematics;
use lissom_model::Document;
use lissom_model::scene::{PathValues, Scene};

use crate::motion::MotionRecorder;
use crate::run::state_writer::StateWriter;

/// Records equilibria for pictures.
pub(super) struct PathPictures {
    scene: Scene,
    passed: PathValues,
    /// Whether the load factor is the varied quantity.
    scales_loads: bool,
    recorder: MotionRecorder<Box<dyn Write + Send>>,
}

impl PathPictures {
    /// Without equilibria and without a file.
    pub(super) fn new(document: &Document, lowered: &Lowered) -> Self {
        let nowhere: Box<dyn Write + Send> = Box::new(io::sink());
        Self {
            scene: Scene::of(document, &lowered.placed()),
            passed: PathValues::default(),
            scales_loads: true,
            recorder: MotionRecorder::new(lowered, None, nowhere),
        }
    }

    /// Pictures along a path with this name of the varied quantity.
    pub(super) fn along(self, name: &str, scales_loads: bool) -> Self {
        Self { passed: PathValues::new(name), scales_loads, ..self }
    }

    /// Pictures that are written to `to`.
    pub(super) fn writing_to(self, to: Box<dyn Write + Send>) -> Self {
        Self { recorder: self.recorder.writing_to(to), ..self }
    }

    /// Uses section forces of the elements of another model from now on.
    pub(super) fn read_elements_of(&mut self, lowered: &Lowered) {
        self.recorder.read_elements_of(lowered);
    }

    /// Adds an equilibrium at an arc length of the path.
    pub(super) fn push(&mut self, (length, value): (f64, f64), at: &Kinematics) -> io::Result<()> {
        self.passed.push(length, value);
        self.recorder.write_next(&Kinematics { time: length, ..at.clone() })
    }

    pub(super) fn flush(&mut self) -> io::Result<()> {
        self.recorder.flush()
    }

    /// The scene of the model along the path so far.
    pub(super) fn scene(&self) -> Scene {
        self.scene.clone().along(self.passed.clone(), self.scales_loads)
    }
}
