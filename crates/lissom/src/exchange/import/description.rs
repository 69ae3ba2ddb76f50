//! Descriptions of all formats, distinguished by their root element.

use std::path::Path;

use super::mjcf::{self, from_mjcf};
use super::sdf::{self, from_sdf};
use super::urdf::from_urdf;
use super::{ImportError, Robot, include, xml};

/// Reads a robot from a URDF, MJCF or SDF file. Files that it includes are looked for in its folder, models of SDF also beside it.
///
/// # Errors
/// If a file cannot be read, or as for [`from_description`].
pub fn from_file(path: &Path) -> Result<Robot, ImportError> {
    let text = include::with_included(path)?;
    match xml::root_tag(&text)?.as_str() {
        "mujoco" => mjcf::in_folder(&text, Some(path.parent().unwrap_or(Path::new("")))),
        "sdf" => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            sdf::in_folder(&text, Some(folder.unwrap_or(Path::new("."))))
        }
        _ => from_description(&text),
    }
}

/// Reads a robot from a URDF, MJCF or SDF text, distinguished by the root element.
///
/// Elements that cannot be converted are in [`Robot::obstacles`], so that all are reported at once.
///
/// # Errors
/// If it is none of these, or its structure is not that of a robot.
pub fn from_description(text: &str) -> Result<Robot, ImportError> {
    let text = &xml::without_comments(text.to_owned());
    match xml::root_tag(text)?.as_str() {
        "robot" => from_urdf(text),
        "mujoco" => from_mjcf(text),
        "sdf" => from_sdf(text),
        other => {
            let message = format!(
                "this is neither URDF, MJCF nor SDF: its root is <{other}>, not <robot>, <mujoco> or <sdf>"
            );
            Err(ImportError::new(message))
        }
    }
}
