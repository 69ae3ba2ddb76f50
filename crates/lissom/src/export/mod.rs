//! Results for other programs. A format is a file here and a line in [`FORMATS`].

mod buffer;
mod gltf;
mod netcdf;
pub(crate) mod npy;
mod npz;
mod parquet;
mod vtk;

use lissom_core::diagnostics::Diagnose;
use std::path::{Path, PathBuf};

use lissom_model::files::{self, FileError};
use lissom_motion::Motion as Pose;

use crate::folder_page::RecordedRun;
use crate::motion::Motion;
use lissom_core::kinematics::NodeId;

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
    /// Its name on the command line.
    pub name: &'static str,
    /// Its description and the programs that read it.
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

/// All formats.
pub static FORMATS: &[Format] = &[gltf::FORMAT, netcdf::FORMAT, npz::FORMAT, parquet::FORMAT, vtk::FORMAT];

/// Files of earlier exports in a folder of results.
pub(crate) fn files_in(folder: &Path) -> Vec<PathBuf> {
    let of = |format: &Format| -> Vec<PathBuf> {
        let target = folder.join(format.target);
        if !format.is_folder {
            return vec![target];
        }
        // Other files are kept.
        let is_own = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            format.files.iter().any(|(start, end)| name.starts_with(start) && name.ends_with(end))
        };
        files::entries(&target).filter(is_own).collect()
    };
    FORMATS.iter().flat_map(of).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_distinguished() {
        for (k, format) in FORMATS.iter().enumerate() {
            assert!(!format.summary.is_empty());
            for other in &FORMATS[..k] {
                assert!(format.name != other.name && format.target != other.target);
            }
        }
    }
}
