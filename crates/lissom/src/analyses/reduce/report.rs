//! Files, summary and text of a reduction.

use std::fmt::Write;
use std::path::Path;

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::flexible::superelement::{Damping, ReducedMatrices};
use lissom_model::Document;
use lissom_model::output::full_matrix;
use lissom_model::toml_text::quoted;
use lissom_motion::Vector3;
use serde_json::{Value, json};

use super::ReduceReport;
use super::recovery::Recovery;
use crate::analyses::interface::AnalysisReport;
use crate::encodings::npy;
use crate::results::folder::{FolderError, ResultFolder};

/// Maximum number of frequencies printed on the terminal.
const LISTED: usize = 6;

/// The files that describe the superelement.
pub(super) fn files(
    name: &str,
    (labels, places): (&[String], &[Vector3]),
    (matrices, recovery): (&ReducedMatrices, &Recovery),
) -> Vec<(String, String)> {
    let mut keys = vec![("mass", &matrices.mass), ("stiffness", &matrices.stiffness)];
    if let Damping::Matrix(damping) = &matrices.damping {
        keys.push(("damping", damping));
    }
    let mut files = Vec::new();
    let mut text = format!(
        "# {name}: reduced by `lissom reduce`. Copy the table into a model in the same folder as its matrices, or include this file as\n\
         # an entry of [parts]. Joints refer to its interfaces as {}.\n\
         lissom = 1\n\n[superelements.{name}]\ninterfaces = [\n",
        labels.iter().map(|label| format!("\"{name}.{label}\"")).collect::<Vec<_>>().join(", ")
    );
    for (label, place) in labels.iter().zip(places) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {{ name = {}, at = [{:?}, {:?}, {:?}] }},",
            quoted(label),
            place.x,
            place.y,
            place.z
        );
    }
    text += "]\n";
    let size = matrices.mass.nrows();
    let comment =
        format!("six rows for each of {}, then {} modes", labels.join(", "), size - 6 * labels.len());
    for (key, matrix) in keys {
        let file = format!("{name}-{key}.mtx");
        let _ = writeln!(text, "{key} = {}", quoted(&file));
        files.push((
            file,
            full_matrix(&format!("{key} of {name}: {comment}"), [size, size], |i, j| matrix[(i, j)]),
        ));
    }
    if !matrices.preload.is_empty() {
        let file = format!("{name}-preload.mtx");
        let _ = writeln!(text, "preload = {}", quoted(&file));
        let column =
            full_matrix(&format!("preload of {name}: {comment}"), [size, 1], |i, _| matrices.preload[i]);
        files.push((file, column));
    }
    if let Some(geometric) = &matrices.geometric {
        let file = format!("{name}-geometric.mtx");
        let _ = writeln!(text, "geometric = {}", quoted(&file));
        let stacked = geometric.stacked();
        let column =
            full_matrix(&format!("geometric of {name}: {comment}"), [stacked.nrows(), size], |i, j| {
                stacked[(i, j)]
            });
        files.push((file, column));
    }
    if !recovery.names.is_empty() {
        let file = format!("{name}-recovery.mtx");
        let _ = writeln!(text, "# Components of an output of kind \"recovered\":");
        for (row, (output, unit)) in recovery.names.iter().enumerate() {
            let _ = writeln!(text, "#   r{} = {output} [{unit}]", row + 1);
        }
        let _ = writeln!(text, "recovery = {}", quoted(&file));
        let rows = recovery.names.len();
        let matrix =
            full_matrix(&format!("recovery of {name}: {comment}"), [rows, size], |i, j| recovery.rows[i][j]);
        files.push((file, matrix));
    }
    files.push((format!("{name}.toml"), text));
    files
}

/// The matrices as arrays for NumPy.
pub(super) fn archive(
    (labels, places): (&[String], &[Vector3]),
    (matrices, recovery): (&ReducedMatrices, &Recovery),
) -> std::io::Result<Vec<u8>> {
    let size = matrices.mass.nrows();
    // Rows and columns are equal: the matrices are symmetric.
    let square = |values: &[f64]| npy::numbers(&[size, size], values);
    let mut arrays = vec![
        ("mass.npy", square(matrices.mass.as_slice())),
        ("stiffness.npy", square(matrices.stiffness.as_slice())),
    ];
    if let Damping::Matrix(damping) = &matrices.damping {
        arrays.push(("damping.npy", square(damping.as_slice())));
    }
    if !matrices.preload.is_empty() {
        arrays.push(("preload.npy", npy::numbers(&[size], &matrices.preload)));
    }
    if let Some(geometric) = &matrices.geometric {
        // By rows.
        let stacked = geometric.stacked();
        let by_rows = stacked.transpose();
        arrays.push(("geometric.npy", npy::numbers(&[stacked.nrows(), size], by_rows.as_slice())));
    }
    if !recovery.names.is_empty() {
        arrays.push(("recovery.npy", npy::numbers(&[recovery.rows.len(), size], &recovery.rows.concat())));
    }
    let flat: Vec<f64> = places.iter().flat_map(|place| place.iter().copied()).collect();
    arrays.push(("interfaces.npy", npy::texts(labels)));
    arrays.push(("places.npy", npy::numbers(&[places.len(), 3], &flat)));
    let arrays: Vec<(&str, &[u8])> = arrays.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    crate::encodings::archive::zip(&arrays)
}

impl AnalysisReport for ReduceReport {
    fn tables(&self) -> Vec<(String, String)> {
        self.files.clone()
    }

    fn write_more(&self, folder: &ResultFolder, _: &Document) -> Result<(), Diagnostic> {
        let written = folder.write_archive(&format!("{}.npz", self.name), &self.archive);
        written.map_err(|error| FolderError::from(error).diagnostic())
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("interfaces", json!(self.interfaces));
        insert("unknowns", json!(self.unknowns[0]));
        insert("reduced_unknowns", json!(self.unknowns[1]));
        insert("frequencies", json!(self.frequencies));
        insert("corrections", json!(self.corrections));
        insert("recovered", self.recovered.iter().map(|(name, _)| json!(name)).collect());
        insert("mass", json!(self.mass));
        insert("preloaded", json!(self.is_preloaded));
        insert("files", self.files.iter().map(|(name, _)| json!(name)).collect());
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn text(&self, time: &str) -> String {
        let [before, after] = self.unknowns;
        let mut text = format!(
            "  superelement `{}`: {before} coordinates to {after}, {} interfaces, {} modes and {} corrections, {} kg{}, {time}\n",
            self.name,
            self.interfaces.len(),
            self.frequencies.len(),
            self.corrections,
            self.mass,
            if self.is_preloaded { ", preloaded" } else { "" }
        );
        if !self.frequencies.is_empty() {
            let listed: Vec<String> =
                self.frequencies.iter().take(LISTED).map(|frequency| format!("{frequency:.4}")).collect();
            let more = if self.frequencies.len() > LISTED { ", …" } else { "" };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  frequencies with fixed interfaces [Hz]: {}{more}", listed.join(", "));
        }
        text
    }

    fn ending(&self, folder: &Path) -> String {
        format!("to use it, include {}", folder.join(format!("{}.toml", self.name)).display())
    }
}
