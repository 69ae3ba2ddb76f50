//! Compressed results for a page: numbers rounded to the resolution of a screen, differences, deflate, base64.
//!
//! A number of a motion is a multiple of its own quantum, stored as a second difference in as few bytes as necessary.
//! Quanta are a fraction of the number's range during the run: 2⁻¹⁷ for displacements, 2⁻¹⁵ for rotations, 2⁻¹² for section forces and fields;
//! and never less than a fraction of the largest range of their kind. Motions of more than ten million numbers have quanta eight times as large.

use std::fmt::Write as _;
use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use lissom_model::output::{CsvWriter, Record, Writer};
use serde::Serialize;

use super::fields::{PartField, recorded};
use crate::motion::{ForcePoints, Motion as Recorded};

/// Quantum over the range of a number, and over the largest range of its kind.
const DISPLACEMENT: [f64; 2] = [1.0 / 131_072.0, 1.5e-8];
const ROTATION: [f64; 2] = [1.0 / 32_768.0, 1.5e-8];
const FORCE: [f64; 2] = [1.0 / 4096.0, 1e-6];
const FIELD: [f64; 2] = [1.0 / 4096.0, 1.0 / 32_768.0];
/// A motion with more numbers is a large one, and this is the factor of its quanta.
const LARGE: usize = 10_000_000;
const COARSER: f64 = 8.0;
/// Quantum of a field over what is round-off in it, which then vanishes.
const OVER_NOISE: f64 = 3.0;

/// A motion in the page's format.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Motion {
    nodes: Vec<String>,
    force_points: Vec<ForcePoints>,
    frames: usize,
    /// Every `field_stride`th frame has fields, and the last one.
    field_stride: usize,
    packed: String,
}

impl Motion {
    /// Number of nodes, the ground included.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn of(motion: &Recorded, fields: &(usize, Vec<PartField>), effort: Effort) -> Self {
        let (header, times) = (motion.header(), motion.times());
        let mut bytes: Vec<u8> = times.iter().flat_map(|time| time.to_le_bytes()).collect();
        for pose in motion.reference() {
            let numbers = pose.position.iter().copied().chain(pose.rotation.quaternion());
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
        let nodes = 3 * header.nodes.len();
        let points = 6 * header.point_count();
        let is_large = times.len() * (2 * nodes + points) > LARGE;
        let factor = if is_large { COARSER } else { 1.0 };
        let of = |quanta: [f64; 2]| quanta.map(|quantum| factor * quantum);
        let mut first = 0;
        let mut put = |count: usize, kinds: &[usize], quanta: [f64; 2]| {
            let value = |frame: usize, k: usize| f64::from(motion.frame(frame)[first + k]);
            channels(times.len(), count, kinds, quanta, &[0.0; 6], value, &mut bytes);
            first += count;
        };
        put(nodes, &[0], of(DISPLACEMENT));
        put(nodes, &[0], of(ROTATION));
        put(points, &[0, 1, 2, 3, 4, 5], of(FORCE));
        let with_fields = recorded(times.len(), fields.0).count();
        for part in &fields.1 {
            bytes.extend(part.constants.iter().flat_map(|number| number.to_le_bytes()));
            let value = |frame: usize, k: usize| f64::from(part.values[frame * part.count + k]);
            channels(with_fields, part.count, part.kinds, FIELD, &part.noise, value, &mut bytes);
        }
        Self {
            nodes: header.nodes.clone(),
            force_points: header.force_points.clone(),
            frames: times.len(),
            field_stride: fields.0,
            packed: deflated(&bytes, effort),
        }
    }
}

/// Appends `count` numbers, each over all frames. The kind of each is one of `kinds`, again and again; `noise` is the round-off of each kind.
fn channels(
    frames: usize,
    count: usize,
    kinds: &[usize],
    quanta: [f64; 2],
    noise: &[f64],
    value: impl Fn(usize, usize) -> f64,
    out: &mut Vec<u8>,
) {
    let range = |k: usize| {
        let ends = (0..frames).map(|frame| value(frame, k));
        let [low, high] =
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        (high - low).max(0.0)
    };
    let ranges: Vec<f64> = (0..count).map(range).collect();
    let kind = |k: usize| kinds[k % kinds.len()];
    let mut largest = [0.0_f64; 6];
    for (k, range) in ranges.iter().enumerate() {
        largest[kind(k)] = largest[kind(k)].max(*range);
    }
    for (k, range) in ranges.iter().enumerate() {
        let noise = OVER_NOISE * noise[kind(k)];
        let quantum = (quanta[0] * range).max(quanta[1] * largest[kind(k)]).max(noise);
        let start = if frames > 0 && value(0, k).abs() > noise { value(0, k) } else { 0.0 };
        let quantum = if *range > 0.0 { quantum } else { 0.0 };
        out.extend_from_slice(&start.to_le_bytes());
        out.extend_from_slice(&quantum.to_le_bytes());
        if quantum == 0.0 {
            continue;
        }
        let (mut last, mut slope) = (0, 0);
        for frame in 0..frames {
            let whole = ((value(frame, k) - start) / quantum).round() as i64;
            let change = whole - last;
            put_integer(change - slope, out);
            (last, slope) = (whole, change);
        }
    }
}

/// Seven bits per byte, least significant first, with the sign in the last bit of all.
fn put_integer(value: i64, out: &mut Vec<u8>) {
    let mut rest = ((value << 1) ^ (value >> 63)) as u64;
    while rest > 127 {
        out.push((rest & 127) as u8 | 128);
        rest >>= 7;
    }
    out.push(rest as u8);
}

/// Every `stride`th row of a table and its last, as comma-separated values.
pub(super) fn table(record: &Record, stride: usize, effort: Effort) -> String {
    let mut text = Vec::new();
    let mut writer = CsvWriter::new(&mut text);
    let last = record.times.len().saturating_sub(1);
    let mut values = Vec::with_capacity(record.columns.len());
    let mut write = || {
        writer.begin(&record.columns)?;
        for (row, time) in
            record.times.iter().enumerate().filter(|(row, _)| row % stride == 0 || *row == last)
        {
            values.clear();
            values.extend(record.values.iter().map(|column| column[row]));
            writer.row(*time, &values)?;
        }
        writer.finish()
    };
    write().expect("a vector takes all that is written");
    deflated(&text, effort)
}

/// Effort of the compression.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Effort {
    /// For pages that are stored or sent.
    #[default]
    Small,
    /// For waiting local pages: larger by some tenths, in a third of the time.
    Soon,
}

/// Compressed in the format of zlib, in base64.
fn deflated(bytes: &[u8], effort: Effort) -> String {
    let level = match effort {
        Effort::Small => 6,
        Effort::Soon => 1,
    };
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(level));
    let packed = encoder.write_all(bytes).and_then(|()| encoder.finish());
    base64(&packed.expect("a vector takes all that is written"))
}

/// RFC 4648.
pub(crate) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let whole = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let letter = char::from(LETTERS[(whole >> (18 - 6 * k)) as usize & 63]);
            // Writing to a string cannot fail.
            let _ = text.write_char(if k > group.len() { '=' } else { letter });
        }
    }
    text
}
#[cfg(test)]
#[path = "../../../tests/unit/pictures/view/packed.rs"]
mod tests;
