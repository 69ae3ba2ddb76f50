//! NPZ: named arrays for NumPy, with units beside the numbers.

use super::{ExportError, Format, Sink, chosen_frames, poses};
use crate::encodings::archive::zip;
use crate::encodings::npy;
use crate::motion::RecordedRun;

pub(super) const FORMAT: Format = Format {
    name: "npz",
    summary: "Arrays for NumPy: the table with names and units of its columns, and the motion of all nodes.",
    target: "results.npz",
    is_folder: false,
    files: &[],
    write,
};

fn write(run: &RecordedRun, most: usize, sink: &mut Sink<'_>) -> Result<(), ExportError> {
    let RecordedRun { record, motion, .. } = run;
    let mut files: Vec<(&str, Vec<u8>)> = Vec::new();
    let mut add = |name, bytes| files.push((name, bytes));
    let columns = &record.columns;
    let rows = record.times.len();
    let table: Vec<f64> =
        (0..rows).flat_map(|row| record.values.iter().map(move |values| values[row])).collect();
    let words = |word: fn(&lissom_model::output::Column) -> String| {
        npy::texts(&columns.iter().map(word).collect::<Vec<_>>())
    };
    add("time.npy", npy::numbers(&[rows], &record.times));
    add("values.npy", npy::numbers(&[rows, columns.len()], &table));
    add("columns.npy", words(lissom_model::output::Column::name));
    add("quantities.npy", words(|column| column.quantity.clone()));
    add("units.npy", words(|column| column.unit.clone()));
    let frames = chosen_frames(motion, most);
    let nodes = motion.header().nodes.len();
    let points = motion.header().point_count();
    let (mut times, mut places, mut turns) = (Vec::new(), Vec::new(), Vec::new());
    let mut forces: Vec<f32> = Vec::new();
    for &frame in &frames {
        times.push(motion.times()[frame]);
        for pose in poses(motion, frame) {
            places.extend(pose.position.iter());
            turns.extend(pose.rotation.quaternion());
        }
        forces.extend(&motion.frame(frame)[6 * nodes..]);
    }
    let count = frames.len();
    add("frame_time.npy", npy::numbers(&[count], &times));
    add("node_names.npy", npy::texts(&motion.header().nodes));
    add("positions.npy", npy::numbers(&[count, nodes, 3], &places));
    add("quaternions.npy", npy::numbers(&[count, nodes, 4], &turns));
    let (mut beams, mut fractions) = (Vec::new(), Vec::new());
    for of_beam in &motion.header().force_points {
        for at in &of_beam.at {
            beams.push(of_beam.beam.clone());
            fractions.push(*at);
        }
    }
    add("section_beams.npy", npy::texts(&beams));
    add("section_fractions.npy", npy::numbers(&[points], &fractions));
    add("section_forces.npy", npy::short_numbers(&[count, points, 6], &forces));
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    Ok(sink("", &zip(&files)?)?)
}
