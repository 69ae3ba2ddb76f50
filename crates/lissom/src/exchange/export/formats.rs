//! The table of formats.

use std::path::{Path, PathBuf};

use lissom_model::files;

use super::{Format, gltf, netcdf, npz, parquet, vtk};

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

#[cfg(test)]
#[path = "../../../tests/unit/exchange/export/formats.rs"]
mod tests;
