//! Tables, files, summary and text of natural modes.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::io;

use crate::start::lower;
use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::kinematics::Kinematics;
use lissom_core::linearized::{Completeness, Mode, ModeKind, NodeShape};
use lissom_core::number::{DIGITS, written};
use lissom_model::Document;
use lissom_model::files::FileError;
use lissom_model::output::quoted;
use lissom_model::scene::Scene;
use serde_json::{Value, json};

use super::ModeReport;
use super::names::names;
use crate::analyses::interface::AnalysisReport;
use crate::motion::{Motion, MotionRecorder};
use crate::pictures::picture::{Picture, PictureError};
use crate::results::folder::{FolderError, ResultFolder};
use crate::run::report::RunError;

/// Maximum number of nodes of models whose shapes are drawn: for larger ones drawing would take longer than the modes.
const MAX_DRAWN: usize = 2000;
/// Modes listed on the terminal; the tables contain all.
const LISTED: usize = 20;
/// Parts named for each of them.
const NAMED: usize = 3;

impl ModeReport {
    /// The table `modes.csv`: number from 1, frequency |s|/(2π) [Hz], damping ratio [-], kind.
    pub fn csv(&self) -> String {
        let mut text = "mode,frequency,damping,kind\n".to_owned();
        for (index, mode) in self.modes.iter().enumerate() {
            let Mode { frequency, damping, kind, .. } = mode;
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{},{frequency:?},{damping:?},{}", index + 1, kind.name());
        }
        text
    }

    /// The name of each mode, such as "1st bending of `tower` along y".
    pub fn names(&self) -> Vec<String> {
        names(&self.shapes, &self.shares, |mode| self.modes[mode].kind == ModeKind::Rigid)
    }

    /// The table `shapes.csv`: by mode and node its position [m], displacement [m] and rotation [rad] in global axes for unit modal
    /// mass, and imaginary parts of both where a mode has any.
    pub fn shapes_csv(&self) -> String {
        let is_complex = self.modes.iter().any(|mode| mode.shape.iter().any(|value| value.im != 0.0));
        shapes_table(&self.shapes, is_complex)
    }

    /// The table `energy.csv`: by mode and part its shares in kinetic and strain energy [-], empty where a mode has none.
    pub fn energy_csv(&self) -> String {
        let mut text = "mode,part,kinetic,strain\n".to_owned();
        for (index, (kinetic, strain)) in self.shares.iter().zip(&self.strain_shares).enumerate() {
            let parts: BTreeSet<&String> = kinetic.keys().chain(strain.keys()).collect();
            for part in parts {
                let of = |shares: &BTreeMap<String, f64>| {
                    if shares.is_empty() {
                        return String::new();
                    }
                    format!("{:?}", shares.get(part).copied().unwrap_or(0.0))
                };
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{},{},{},{}", index + 1, quoted(part), of(kinetic), of(strain));
            }
        }
        text
    }

    /// The table `participation.csv`: effective masses of each mode along [kg] and about [kg m²] the axes of space, the last row
    /// those of the whole model.
    pub fn participation_csv(&self) -> String {
        let mut text = "mode,x,y,z,rx,ry,rz\n".to_owned();
        let numbered = self.effective_masses.iter().enumerate();
        let named = numbered.map(|(index, masses)| ((index + 1).to_string(), masses));
        for (name, masses) in named.chain([("all".to_owned(), &self.masses)]) {
            let numbers: Vec<String> = masses.iter().map(|value| format!("{value:?}")).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{name},{}", numbers.join(","));
        }
        text
    }

    fn count(&self, kind: ModeKind) -> usize {
        self.modes.iter().filter(|mode| mode.kind == kind).count()
    }
}

impl AnalysisReport for ModeReport {
    fn tables(&self) -> Vec<(String, String)> {
        let tables = [
            ("modes.csv", self.csv()),
            ("energy.csv", self.energy_csv()),
            ("participation.csv", self.participation_csv()),
            ("shapes.csv", self.shapes_csv()),
        ];
        tables.map(|(name, text)| (name.to_owned(), text)).to_vec()
    }

    /// Writes the state as a motion of one frame, for the page that shows the modes, and draws the first shapes on one sheet.
    fn write_more(&self, folder: &ResultFolder, document: &Document) -> Result<(), Diagnostic> {
        let unwritable = |error: FileError| FolderError::from(error).diagnostic();
        let unwritten = |error: io::Error| RunError::Write(error).diagnostic();
        let undrawn = |error: PictureError| error.diagnostic();
        let lowered = lower(document).map_err(|report| report.diagnostic())?;
        let scene = Scene::of(document, &lowered.placed());
        folder.write_scene(&scene).map_err(unwritable)?;
        let file = folder.motion().map_err(unwritable)?;
        MotionRecorder::new(&lowered, None, file).write_still(&self.state).map_err(unwritten)?;
        if self.moved.is_empty() || self.state.nodes.len() > MAX_DRAWN {
            return Ok(());
        }
        let mut bytes = Vec::new();
        // A frame for each shape, with its number as time.
        let frames: Vec<Kinematics> = (1_u32..)
            .zip(&self.moved)
            .map(|(number, moved)| Kinematics { time: f64::from(number), ..moved.clone() })
            .collect();
        MotionRecorder::new(&lowered, None, &mut bytes).write_frames(&frames).map_err(unwritten)?;
        let motion = Motion::from_bytes(&bytes).map_err(|error| error.diagnostic())?;
        let labels = self.modes.iter().take(frames.len()).enumerate();
        let labels = labels.map(|(index, mode)| format!("{}: {:.4} Hz", index + 1, mode.frequency));
        let picture = Picture {
            times: frames.iter().map(|at| at.time).collect(),
            labels: labels.collect(),
            ..Picture::default()
        };
        let title = document.title.as_deref().unwrap_or_default();
        let drawing = picture.draw(&scene, &motion, title).map_err(undrawn)?;
        let text = drawing.svg().map_err(|error| undrawn(error.into()))?;
        folder.write_table("shapes.svg", &text).map_err(unwritable)
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("about", json!(self.about));
        insert("time", json!(self.time));
        insert("asked", json!(self.asked));
        insert("found", json!(self.modes.len()));
        insert("completeness", json!(self.completeness.name()));
        insert("unknowns", json!(self.unknowns[0] + self.unknowns[1]));
        insert("multipliers", json!(self.unknowns[1]));
        insert("rigid_modes", json!(self.count(ModeKind::Rigid)));
        if let Some(points) = self.friction {
            insert("friction_points", json!({ "sticking": points.sticking, "sliding": points.sliding }));
        }
        insert("masses", json!(self.masses));
        let names = self.names();
        let mode = |(index, (mode, shares)): (usize, (&Mode, &BTreeMap<String, f64>))| {
            json!({
                "mode": index + 1,
                "name": names.get(index),
                "frequency": mode.frequency,
                "damping": mode.damping,
                "kind": mode.kind.name(),
                "eigenvalue": [mode.eigenvalue.re, mode.eigenvalue.im],
                "residual": mode.residual,
                "kinetic_shares": shares,
                "strain_shares": self.strain_shares[index],
                "effective_masses": self.effective_masses[index],
            })
        };
        insert("modes", self.modes.iter().zip(&self.shares).enumerate().map(mode).collect());
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn text(&self, time: &str) -> String {
        let [coordinates, multipliers] = self.unknowns;
        let number = self.modes.len();
        let [fewer, counted] = match self.completeness {
            Completeness::Counted => ["there are no more", "none missed according to a count of pivots"],
            _ => ["no more were found", "not counted"],
        };
        let fewer = if number < self.asked {
            format!(" (requested: {}; {fewer})", self.asked)
        } else {
            String::new()
        };
        let mut text = format!(
            "  {number} modes{fewer} about {}, {coordinates} coordinates, {multipliers} multipliers, {counted}, {time}\n",
            self.about
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  mode   frequency [Hz]   damping ratio   {:<13}name, largest kinetic energies",
            "kind"
        );
        let names = self.names();
        for (index, mode) in self.modes.iter().take(LISTED).enumerate() {
            let _ = writeln!(
                text,
                "  {:>4}   {:>14}   {:>13}   {:<13}{}: {}",
                index + 1,
                written(mode.frequency, DIGITS),
                written(mode.damping, 4),
                mode.kind.name(),
                names.get(index).map_or("", String::as_str),
                largest(&self.shares[index])
            );
        }
        if let Some(points) = self.friction {
            let _ = writeln!(
                text,
                "  points of contact with friction: {} stick, {} slide",
                points.sticking, points.sliding
            );
        }
        if number > LISTED {
            let _ = writeln!(text, "  … {} more in modes.csv", number - LISTED);
        }
        text
    }
}

/// The parts with the largest shares in the kinetic energy of a mode, in words.
fn largest(shares: &BTreeMap<String, f64>) -> String {
    let mut parts: Vec<(&String, f64)> = shares.iter().map(|(part, share)| (part, *share)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let shown = parts.iter().take(NAMED).filter(|(_, share)| *share >= 0.01);
    shown.map(|(part, share)| format!("{part} {:.0} %", 100.0 * share)).collect::<Vec<_>>().join(", ")
}

/// A table of shapes, by number and node.
pub(crate) fn shapes_table(shapes: &[Vec<NodeShape>], is_complex: bool) -> String {
    let mut text = "mode,node,x,y,z,u1,u2,u3,r1,r2,r3".to_owned();
    text += if is_complex { ",u1_im,u2_im,u3_im,r1_im,r2_im,r3_im\n" } else { "\n" };
    for (index, shape) in shapes.iter().enumerate() {
        for node in shape {
            // Writing to a string cannot fail.
            let _ = write!(text, "{},{}", index + 1, quoted(&node.node));
            let motion = || node.displacement.iter().chain(&node.rotation);
            let numbers = node.position.iter().copied().chain(motion().map(|value| value.re));
            for value in numbers.chain(motion().filter(|_| is_complex).map(|value| value.im)) {
                let _ = write!(text, ",{value:?}");
            }
            text.push('\n');
        }
    }
    text
}
