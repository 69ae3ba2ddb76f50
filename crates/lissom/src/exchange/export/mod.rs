//! Results for other programs. A format is a file here and a line in [`FORMATS`].

mod buffer;
mod formats;
mod gltf;
mod netcdf;
mod npz;
mod parquet;
mod shell_cells;
mod solid_cells;
mod vtk;

use lissom_core::diagnostics::Diagnose;
use lissom_model::files::FileError;
use lissom_motion::Motion as Pose;

use crate::motion::{Motion, RecordedRun};
use lissom_core::kinematics::NodeId;

pub use formats::FORMATS;
pub(crate) use formats::files_in;

/// Writes a file, given its name below the target and its bytes.
pub type Sink<'a> = dyn FnMut(&str, &[u8]) -> Result<(), FileError> + 'a;

/// Why results could not be exported.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum ExportError {
    /// A file cannot be written.
    File(#[from] FileError),
    /// The motion has no frames.
    Empty,
    /// The archive could not be written.
    Archive(#[from] std::io::Error),
    /// It exceeds the limits of the format.
    TooLarge,
}

/// A format of other programs.
pub struct Format {
    /// Name of the format on the command line.
    pub name: &'static str,
    /// Description of the format and the programs that read it.
    pub summary: &'static str,
    /// Name of its one file, or of the folder of its files, below the folder of results.
    pub target: &'static str,
    /// Whether there are several files.
    pub is_folder: bool,
    /// Beginnings and endings of the names of its files, if there are several.
    pub files: &'static [(&'static str, &'static str)],
    /// Exports a run with at most this number of frames of its motion.
    pub write: fn(&RecordedRun, usize, &mut Sink<'_>) -> Result<(), ExportError>,
}

/// At most this number of frames of a motion, including its first and last, at equal distances.
fn chosen_frames(motion: &Motion, most: usize) -> Vec<usize> {
    let count = motion.times().len();
    if count <= most || most < 2 {
        return if most < 2 { (count.saturating_sub(1)..count).collect() } else { (0..count).collect() };
    }
    (0..most).map(|k| k * (count - 1) / (most - 1)).collect()
}

/// Poses of all nodes in a frame.
fn poses(motion: &Motion, frame: usize) -> Vec<Pose> {
    NodeId::first(motion.reference().len()).map(|node| motion.pose(frame, node)).collect()
}
