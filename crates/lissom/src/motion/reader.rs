//! Reads motion files.

use lissom_core::diagnostics::Diagnose;
use lissom_motion::{Motion as Pose, Rotation, Vector3, Vector6};

use super::header::{Header, checksum_bytes};
use super::{MAGIC, PREFIX, UNSEALED, VERSION, is_sealed};
use lissom_core::kinematics::NodeId;

/// Why a file is not a valid motion file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum MotionError {
    /// It begins differently.
    Foreign,
    /// It was written by another version.
    Version(u32),
    /// It ends before its first frame, or its header is damaged.
    Damaged,
    /// The bytes of a frame are not those that were written.
    Altered(usize),
    /// A number is not finite.
    NotFinite(usize),
}

/// A motion file in memory. An incomplete last frame is omitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    header: Header,
    reference: Vec<Pose>,
    times: Vec<f64>,
    /// Displacements, rotations and section forces of all frames, in the order of the file.
    numbers: Vec<f32>,
}

impl Motion {
    /// Reads the bytes of a motion file.
    ///
    /// # Errors
    /// If they are not a motion file, or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, MotionError> {
        let (header, [poses, frames]) = Self::split(bytes)?;
        let has_checksums = frames > poses + 56 * header.nodes.len();
        let reference: Option<Vec<Pose>> =
            bytes[poses..].chunks_exact(56).take(header.nodes.len()).map(pose).collect();
        let reference = reference.ok_or(MotionError::Damaged)?;
        let per_frame = 6 * (header.nodes.len() + header.point_count());
        let (mut times, mut numbers) = (Vec::new(), Vec::new());
        for (index, frame) in bytes[frames..].chunks_exact(header.frame_bytes).enumerate() {
            if has_checksums && !is_sealed(frame) {
                return Err(MotionError::Altered(index + 1));
            }
            times.push(number(frame));
            let (words, _) = frame[8..8 + 4 * per_frame].as_chunks::<4>();
            numbers.extend(words.iter().map(|word| f32::from_le_bytes(*word)));
            let is_finite = times[index].is_finite()
                && numbers[index * per_frame..].iter().all(|number| number.is_finite());
            if !is_finite {
                return Err(MotionError::NotFinite(index + 1));
            }
        }
        Ok(Self { header, reference, times, numbers })
    }

    /// Header, and offsets of the poses of the model and of the frames.
    fn split(bytes: &[u8]) -> Result<(Header, [usize; 2]), MotionError> {
        if bytes.len() < PREFIX || &bytes[..8] != MAGIC {
            return Err(MotionError::Foreign);
        }
        let word = |at: usize| u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        let version = word(8);
        if ![VERSION, UNSEALED].contains(&version) {
            return Err(MotionError::Version(version));
        }
        let end = PREFIX + word(12) as usize;
        let text = bytes.get(PREFIX..end).ok_or(MotionError::Damaged)?;
        let header: Header = serde_json::from_slice(text).map_err(|_| MotionError::Damaged)?;
        let frames = end + 56 * header.nodes.len() + checksum_bytes(version);
        let head = bytes.get(..frames).ok_or(MotionError::Damaged)?;
        let is_whole = version == UNSEALED || is_sealed(head);
        if header.frame_bytes == header.needed_bytes(version) && is_whole {
            Ok((header, [end, frames]))
        } else {
            Err(MotionError::Damaged)
        }
    }

    /// Time of the last complete frame [s] of a file to which frames are to be appended.
    ///
    /// # Errors
    /// If the bytes are not a motion file of the present version.
    pub(crate) fn time_to_continue_from(bytes: &[u8]) -> Result<Option<f64>, MotionError> {
        let is_earlier = bytes.get(8..12) == Some(&UNSEALED.to_le_bytes());
        if is_earlier { Err(MotionError::Version(UNSEALED)) } else { Self::last_time(bytes) }
    }

    /// Time of the last complete frame [s], without reading the others; none without frames.
    ///
    /// # Errors
    /// If the bytes are not a motion file.
    pub fn last_time(bytes: &[u8]) -> Result<Option<f64>, MotionError> {
        let (header, [_, frames]) = Self::split(bytes)?;
        Ok(bytes[frames..].chunks_exact(header.frame_bytes).next_back().map(number))
    }

    /// Description of the frames.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Times of the frames [s].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The node called `name`.
    pub fn node(&self, name: &str) -> Option<NodeId> {
        self.header.nodes.iter().position(|known| known == name).map(NodeId::new)
    }

    /// Poses of the nodes in the configuration of the model file.
    pub fn reference(&self) -> &[Pose] {
        &self.reference
    }

    /// Displacements, rotations and section forces of a frame, concatenated.
    ///
    /// # Panics
    /// If there is no such frame.
    pub fn frame(&self, frame: usize) -> &[f32] {
        let length = 6 * (self.header.nodes.len() + self.header.point_count());
        &self.numbers[frame * length..(frame + 1) * length]
    }

    /// Pose of a node in a frame.
    ///
    /// # Panics
    /// If there is no such frame or node.
    pub fn pose(&self, frame: usize, node: NodeId) -> Pose {
        let (numbers, count) = (self.frame(frame), self.header.nodes.len());
        let vector = |at: usize| Vector3::from_fn(|k, _| f64::from(numbers[3 * at + k]));
        let start = &self.reference[node];
        let rotation = Rotation::exponential(&vector(count + node.index())) * start.rotation;
        Pose::new(rotation, start.position + vector(node.index()))
    }

    /// Another motion: each frame has its time, and displacements of nodes except the ground from the first frame of this
    /// one, three displacements [m] and a rotation vector [rad] each, in global axes. Section forces are zero.
    pub(crate) fn with_moved(&self, frames: &[(f64, Vec<f64>)]) -> Self {
        let count = self.header.nodes.len();
        let (mut times, mut numbers) = (Vec::new(), Vec::new());
        for (time, moved) in frames {
            let of = |node: NodeId, k: usize| match node.index().checked_sub(1) {
                Some(node) => moved.get(6 * node + k).copied().unwrap_or(0.0),
                None => 0.0,
            };
            times.push(*time);
            let vector = |node: NodeId, first: usize| Vector3::from_fn(|k, _| of(node, first + k));
            let start = numbers.len();
            for node in NodeId::first(count) {
                let shift = self.pose(0, node).position - self.reference[node].position + vector(node, 0);
                numbers.extend(shift.iter().map(|number| *number as f32));
            }
            for node in NodeId::first(count) {
                let rotation = Rotation::exponential(&vector(node, 3)) * self.pose(0, node).rotation;
                let turn = (rotation * self.reference[node].rotation.inverse()).logarithm();
                numbers.extend(turn.iter().map(|number| *number as f32));
            }
            numbers.resize(start + 6 * (count + self.header.point_count()), 0.0);
        }
        Self { header: self.header.clone(), reference: self.reference.clone(), times, numbers }
    }

    /// Section forces [N] and moments [N m] at a point in a frame, local axes.
    ///
    /// # Panics
    /// If there is no such frame or point.
    pub fn section_forces(&self, frame: usize, point: usize) -> Vector6 {
        let first = 6 * (self.header.nodes.len() + point);
        Vector6::from_fn(|k, _| f64::from(self.frame(frame)[first + k]))
    }
}

/// The number at the beginning of a slice of bytes.
fn number(bytes: &[u8]) -> f64 {
    bytes.first_chunk().map_or(f64::NAN, |word| f64::from_le_bytes(*word))
}

fn pose(bytes: &[u8]) -> Option<Pose> {
    let at = |k: usize| number(&bytes[8 * k..]);
    let position = Vector3::new(at(0), at(1), at(2));
    let is_finite = position.iter().all(|number| number.is_finite());
    let rotation = Rotation::from_quaternion([at(3), at(4), at(5), at(6)])?;
    is_finite.then(|| Pose::new(rotation, position))
}
