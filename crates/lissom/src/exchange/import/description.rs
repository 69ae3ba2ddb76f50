//! Descriptions of all formats, distinguished by their root element.

use std::path::Path;

use super::mjcf::{self, from_mjcf};
use super::urdf::from_urdf;
use super::{ImportError, Robot, include, xml};

/// Reads a robot from a URDF or MJCF file. Files that an MJCF includes are looked for in its folder.
///
/// # Errors
/// If a file cannot be read, or as for [`from_description`].
pub fn from_file(path: &Path) -> Result<Robot, ImportError> {
    let text = include::with_included(path)?;
    match xml::root_tag(&text)?.as_str() {
        "mujoco" => mjcf::in_folder(&text, Some(path.parent().unwrap_or(Path::new("")))),
        _ => from_description(&text),
    }
}

/// Reads a robot from a URDF or MJCF text, distinguished by the root element.
///
/// Elements that cannot be converted are in [`Robot::obstacles`], so that all are reported at once.
///
/// # Errors
/// If it is neither, or its structure is not that of a robot.
pub fn from_description(text: &str) -> Result<Robot, ImportError> {
    match xml::root_tag(text)?.as_str() {
        "robot" => from_urdf(text),
        "mujoco" => from_mjcf(text),
        other => {
            let message =
                format!("this is neither URDF nor MJCF: its root is <{other}>, not <robot> or <mujoco>");
            Err(ImportError::new(message))
        }
    }
}
