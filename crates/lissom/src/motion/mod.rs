//! The motion file `motion.bin`: poses of all nodes and section forces of all beams, frame by frame, for animations.
//! Written during a run; a file that ends within a frame, for example after a crash, is read up to that frame.
//!
//! ```text
//! 8 bytes    LISSOMMO
//! u32        version, 2
//! u32        length n of the header, a multiple of 8
//! n bytes    header: JSON, padded with spaces
//! reference  f64, nodes x 7: position [m] and quaternion (scalar first) of every node as the model describes it
//! u32, u32   checksum (CRC-32) of all bytes before, and zero
//! frames     each of the same length, in the order of time:
//!   f64                 time [s]
//!   f32, nodes x 3      displacement x - x₀ [m], global axes
//!   f32, nodes x 3      rotation vector log(R R₀⁻¹) [rad], global axes
//!   f32, points x 6     section forces and moments [N, N m], local axes: axial, shear 2, 3, torsion, bending 2, 3
//!   u32, u32            checksum of the frame, and zero
//! ```
//!
//! Version 1 has no checksums, and is read as well.
//!
//! Numbers are little-endian. Displacements are stored instead of positions, so that small ones of large structures
//! keep their digits: the relative error of a displacement is 6e-8.

mod header;
mod reader;
mod recorded_run;
mod recorder;

pub use lissom_core::kinematics::NodeId;

pub use header::{ForcePoints, Header};
pub use reader::{Motion, MotionError};
pub use recorded_run::RecordedRun;
pub use recorder::MotionRecorder;

/// First bytes of the file.
const MAGIC: &[u8; 8] = b"LISSOMMO";
/// Version of the format.
pub(crate) const VERSION: u32 = 2;
/// The version before, without checksums.
const UNSEALED: u32 = 1;
/// Bytes before the header.
const PREFIX: usize = 16;
/// Length of a checksum with its zeros.
const CHECKSUM: usize = 8;

/// Checksum of bytes.
fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut crc = flate2::Crc::new();
    crc.update(bytes);
    u64::from(crc.sum()).to_le_bytes()
}

/// Whether these bytes end with their checksum.
fn is_sealed(bytes: &[u8]) -> bool {
    bytes.split_last_chunk::<CHECKSUM>().is_some_and(|(bytes, sum)| checksum(bytes) == *sum)
}
