//! Which format a file has.

use crate::error::MeshError;
use crate::formats::{abaqus, gmsh, obj};
use crate::mesh::Mesh;

/// Reads the text of a mesh file.
///
/// The extension of its name determines the format: `msh`, `inp` or `obj`, in upper or lower case, with or without a dot.
/// Bytes that are no UTF-8, such as umlauts of old files in comments, are replaced.
///
/// # Errors
/// The extension is unknown, or a line of the file cannot be read; the message has its number and a remedy.
pub fn read(text: &[u8], extension: &str) -> Result<Mesh, MeshError> {
    let text = String::from_utf8_lossy(text);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    match extension.trim_start_matches('.').to_ascii_lowercase().as_str() {
        "msh" => gmsh::read(text),
        "inp" => abaqus::read(text),
        "obj" => obj::read(text),
        _ => Err(MeshError::Format { found: extension.to_owned() }),
    }
}

#[cfg(test)]
#[path = "../../tests/unit/formats/read.rs"]
mod tests;
