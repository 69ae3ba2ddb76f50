//! NetCDF, in its classic form with 64-bit offsets (CDF-2): all columns over time, and the motion of all nodes.
//!
//! The format is a header of names, dimensions and positions, and big-endian numbers [NetCDF Classic and 64-bit Offset File
//! Formats, OGC 10-092r3]. HDF5 libraries are not needed for it.

use super::{ExportError, Format, Sink, chosen_frames, poses};
use crate::motion::RecordedRun;

pub(super) const FORMAT: Format = Format {
    name: "netcdf",
    summary: "NetCDF (classic) for xarray, MATLAB, Julia and Octave: all columns with units, and the motion of all nodes.",
    target: "results.nc",
    is_folder: false,
    files: &[],
    write,
};

/// Tags of the lists of a header.
const DIMENSIONS: u32 = 10;
const VARIABLES: u32 = 11;
const ATTRIBUTES: u32 = 12;
/// Types.
const TEXT: u32 = 2;
const DOUBLE: u32 = 6;
/// Maximum size of a variable [bytes].
const MAX_SIZE: usize = u32::MAX as usize - 4;

/// A variable with its data.
struct Variable {
    name: String,
    /// Indices of its dimensions.
    dimensions: Vec<u32>,
    /// Names and texts.
    attributes: Vec<(&'static str, String)>,
    kind: u32,
    /// Padded to a multiple of four.
    bytes: Vec<u8>,
}

impl Variable {
    fn numbers(
        name: &str,
        dimensions: &[u32],
        attributes: &[(&'static str, &str)],
        values: impl Iterator<Item = f64>,
    ) -> Self {
        let stated = attributes.iter().filter(|(_, text)| !text.is_empty());
        Self {
            name: name.to_owned(),
            dimensions: dimensions.to_vec(),
            attributes: stated.map(|(name, text)| (*name, (*text).to_owned())).collect(),
            kind: DOUBLE,
            bytes: values.flat_map(f64::to_be_bytes).collect(),
        }
    }

    /// Texts, each padded with zeros to `length`.
    fn texts(name: &str, dimensions: &[u32], texts: &[String], length: usize) -> Self {
        let mut bytes = Vec::new();
        for text in texts {
            let end = bytes.len() + length;
            bytes.extend(text.as_bytes());
            bytes.resize(end, 0);
        }
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let (name, dimensions) = (name.to_owned(), dimensions.to_vec());
        Self { name, dimensions, attributes: Vec::new(), kind: TEXT, bytes }
    }
}

fn write(run: &RecordedRun, most: usize, sink: &mut Sink<'_>) -> Result<(), ExportError> {
    let RecordedRun { record, motion, .. } = run;
    let frames = chosen_frames(motion, most);
    let names = &motion.header().nodes;
    // A dimension of length zero would be the unlimited one.
    let longest = names.iter().map(String::len).max().unwrap_or(0).max(1);
    let dimensions = [
        ("time", record.times.len()),
        ("frame", frames.len()),
        ("node", names.len()),
        ("axis", 3),
        ("quaternion", 4),
        ("letter", longest),
    ];
    if dimensions.iter().any(|(_, length)| *length == 0) {
        return Err(ExportError::Empty);
    }
    let [time, frame, node, axis, quaternion, letter] = [0, 1, 2, 3, 4, 5];
    let seconds = [("units", "s")];
    let mut variables = vec![Variable::numbers("time", &[time], &seconds, record.times.iter().copied())];
    for (column, values) in record.columns.iter().zip(&record.values) {
        let attributes = [("units", column.unit.as_str()), ("long_name", &column.quantity)];
        variables.push(Variable::numbers(&column.name(), &[time], &attributes, values.iter().copied()));
    }
    let (mut places, mut turns) = (Vec::new(), Vec::new());
    for &frame in &frames {
        for pose in poses(motion, frame) {
            places.extend(pose.position.iter().copied());
            turns.extend(pose.rotation.quaternion());
        }
    }
    let times = frames.iter().map(|&frame| motion.times()[frame]);
    variables.push(Variable::numbers("frame_time", &[frame], &seconds, times));
    variables.push(Variable::texts("node_name", &[node, letter], names, longest));
    let metres = [("units", "m")];
    variables.push(Variable::numbers("position", &[frame, node, axis], &metres, places.into_iter()));
    let order = [("long_name", "rotation, scalar first")];
    variables.push(Variable::numbers("rotation", &[frame, node, quaternion], &order, turns.into_iter()));
    Ok(sink("", &file(&dimensions, &variables)?)?)
}

/// The file.
fn file(dimensions: &[(&str, usize)], variables: &[Variable]) -> Result<Vec<u8>, ExportError> {
    let too_large = |variable: &Variable| variable.bytes.len() > MAX_SIZE;
    if variables.iter().any(too_large) || dimensions.iter().any(|(_, length)| *length > i32::MAX as usize) {
        return Err(ExportError::TooLarge);
    }
    // Positions have a fixed length: the header of any positions is as long as the final one.
    let mut begin = header(dimensions, variables, &vec![0; variables.len()]).len() as u64;
    let mut begins = Vec::with_capacity(variables.len());
    for variable in variables {
        begins.push(begin);
        begin += variable.bytes.len() as u64;
    }
    let mut bytes = header(dimensions, variables, &begins);
    bytes.extend(variables.iter().flat_map(|variable| &variable.bytes));
    Ok(bytes)
}

fn header(dimensions: &[(&str, usize)], variables: &[Variable], begins: &[u64]) -> Vec<u8> {
    let mut bytes = b"CDF\x02".to_vec();
    // There are no records.
    number(&mut bytes, 0);
    list(&mut bytes, DIMENSIONS, dimensions.len());
    for (name, length) in dimensions {
        text(&mut bytes, name);
        number(&mut bytes, *length as u32);
    }
    list(&mut bytes, ATTRIBUTES, 1);
    attribute(&mut bytes, "source", &format!("lissom {}", crate::VERSION));
    list(&mut bytes, VARIABLES, variables.len());
    for (variable, begin) in variables.iter().zip(begins) {
        text(&mut bytes, &variable.name);
        number(&mut bytes, variable.dimensions.len() as u32);
        for &dimension in &variable.dimensions {
            number(&mut bytes, dimension);
        }
        list(&mut bytes, ATTRIBUTES, variable.attributes.len());
        for (name, value) in &variable.attributes {
            attribute(&mut bytes, name, value);
        }
        number(&mut bytes, variable.kind);
        number(&mut bytes, variable.bytes.len() as u32);
        bytes.extend(begin.to_be_bytes());
    }
    bytes
}

fn number(bytes: &mut Vec<u8>, value: u32) {
    bytes.extend(value.to_be_bytes());
}

/// Beginning of a list; an empty one has no tag.
fn list(bytes: &mut Vec<u8>, tag: u32, length: usize) {
    number(bytes, if length == 0 { 0 } else { tag });
    number(bytes, length as u32);
}

/// A text with its length, padded.
fn text(bytes: &mut Vec<u8>, value: &str) {
    number(bytes, value.len() as u32);
    bytes.extend(value.as_bytes());
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}

fn attribute(bytes: &mut Vec<u8>, name: &str, value: &str) {
    text(bytes, name);
    number(bytes, TEXT);
    text(bytes, value);
}
