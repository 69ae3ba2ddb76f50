//! Natural modes with their shapes, read back from a folder of results, as motions for pictures.

use std::f64::consts::TAU;
use std::path::Path;

use lissom_model::files;
use lissom_model::scene::Scene;

use super::folder::{FolderError, MODES, MOTION, ResultFolder, SCENE, SHAPES, SUMMARY};
use super::page::{foreign, read_scene};
use crate::motion::{Motion, MotionError};
use crate::pictures::view::modes::{Mode, read};

/// The largest displacement over the size of the model, and the largest rotation of a mode without displacements [rad], as
/// on the page.
const FAR: f64 = 1.0 / 12.0;
const TURN: f64 = 0.3;

/// Natural modes, read back from a folder of results.
#[derive(Clone, Debug)]
pub struct RecordedModes {
    /// One line about the model; empty for none.
    pub title: String,
    /// The scene of the model.
    pub scene: Scene,
    /// The state about which the model is linearised.
    state: Motion,
    modes: Vec<Mode>,
}

impl ResultFolder {
    /// Whether the folder was written by `lissom modes`.
    pub fn holds_modes(path: &Path) -> bool {
        path.join(MODES).is_file()
    }

    /// Natural modes with their shapes.
    ///
    /// # Errors
    /// If the folder contains no modes, or if they, their state or the scene are damaged or inconsistent.
    pub fn recorded_modes(path: &Path) -> Result<RecordedModes, FolderError> {
        let (modes, shapes) = (files::read_text(&path.join(MODES))?, files::read_text(&path.join(SHAPES))?);
        let summary = files::read_text(&path.join(SUMMARY)).unwrap_or_default();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap_or_default();
        let title = summary["title"].as_str().unwrap_or_default().to_owned();
        let file = path.join(MOTION);
        let bytes = files::read(&file).map_err(|error| files::failure(files::Action::Read, &file, error))?;
        let state = Motion::from_bytes(&bytes).map_err(|error| foreign(&file, error))?;
        let scene = read_scene(&path.join(SCENE))?;
        let count = state.reference().len();
        if state.times().len() != 1 || scene.most_node().index() >= count {
            return Err(foreign(&file, MotionError::Damaged));
        }
        let modes = read(&modes, &shapes, count);
        let modes = modes.ok_or_else(|| foreign(&path.join(SHAPES), MotionError::Damaged))?;
        Ok(RecordedModes { title, scene, state, modes })
    }
}

impl RecordedModes {
    /// Their number.
    pub fn count(&self) -> usize {
        self.modes.len()
    }

    /// Number from 1 and frequency of every mode.
    pub fn labels(&self) -> Vec<String> {
        let label = |(index, mode): (usize, &Mode)| format!("{}: {:.4} Hz", index + 1, mode.frequency);
        self.modes.iter().enumerate().map(label).collect()
    }

    /// The first shapes, at most this number: a frame for each, with the number of the mode as its time.
    pub fn shapes(&self, most: usize) -> Motion {
        let frames = (1_u32..).zip(self.modes.iter().take(most));
        let frames: Vec<_> =
            frames.map(|(number, mode)| (f64::from(number), self.moved(mode, 0.0))).collect();
        self.state.with_moved(&frames)
    }

    /// The oscillation of a mode, counted from 1: a frame for each of these fractions of its period, which ascend.
    /// None if there is no such mode.
    pub fn oscillation(&self, number: usize, shares: &[f64]) -> Option<Motion> {
        let mode = self.modes.get(number.checked_sub(1)?)?;
        let frames: Vec<_> = shares.iter().map(|share| (*share, self.moved(mode, *share))).collect();
        Some(self.state.with_moved(&frames))
    }

    /// Displacements and rotations of all nodes except the ground at a fraction of the period: the real part of the shape
    /// times exp(2πi share).
    fn moved(&self, mode: &Mode, share: f64) -> Vec<f64> {
        let (sine, cosine) = (TAU * share).sin_cos();
        let factor = self.amplitude(mode);
        let value = |(index, real): (usize, &f32)| {
            let imaginary = mode.imaginary.get(index).copied().unwrap_or(0.0);
            factor * (cosine * f64::from(*real) - sine * f64::from(imaginary))
        };
        mode.real.iter().enumerate().map(value).collect()
    }

    /// Factor of a shape that scales its largest displacement to a twelfth of the model.
    fn amplitude(&self, mode: &Mode) -> f64 {
        let places = || self.state.reference().iter().skip(1).map(|pose| pose.position);
        let low = places().reduce(|low, place| low.inf(&place)).unwrap_or_default();
        let high = places().reduce(|high, place| high.sup(&place)).unwrap_or_default();
        let extent = (high - low).norm();
        let size = if extent > 0.0 { extent } else { 1.0 };
        let square = |numbers: &[f32], node: usize| -> f64 {
            numbers.iter().skip(6 * node).take(3).map(|number| f64::from(*number).powi(2)).sum()
        };
        let length = |node: usize| (square(&mode.real, node) + square(&mode.imaginary, node)).sqrt();
        let most = (0..mode.real.len() / 6).map(length).fold(0.0, f64::max);
        let turns = mode.real.iter().map(|number| f64::from(number.abs())).fold(1e-300, f64::max);
        if most > 1e-9 * size * turns { FAR * size / most } else { TURN / turns }
    }
}
