//! Ready-made parts: files of sub-assemblies that belong to the program, which models include as `lissom:NAME`. A part is a file in
//! `ready_made/` and a line here.

use super::library::Missing;
use crate::format::suggest;

/// Prefix of the paths of ready-made parts.
pub const PREFIX: &str = "lissom:";

/// A file of a sub-assembly that belongs to the program.
#[derive(Clone, Copy, Debug)]
pub struct ReadyMadePart {
    /// Name, without the prefix.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The file.
    pub text: &'static str,
}

/// A part whose file has its name.
macro_rules! part {
    ($name:literal, $summary:literal) => {
        ReadyMadePart {
            name: $name,
            summary: $summary,
            text: include_str!(concat!("ready_made/", $name, ".toml")),
        }
    };
}

/// All of them.
pub const PARTS: [ReadyMadePart; 11] = [
    part!("speed-drive", "motor with limited torque and PI control of the rate of a joint"),
    part!("suspended-wheel", "wheel with spring, damper and stops, and a tyre on an uneven road"),
    part!("unbalanced-rotor", "flexible shaft with an unbalanced disc in two bearings, run up from rest"),
    part!("parallel-gripper", "two coupled fingers with a drive of limited force"),
    part!("hydraulic-cylinder", "cylinder between two points with compressible oil and a 4/3 valve"),
    part!("belt-drive", "elastic belt between two joints, which slips beyond its friction"),
    part!("steering-rack", "pinion, rack and two tie rods, turned by an angle of the steering wheel"),
    part!("anti-roll-bar", "torsionally elastic bar with two arms and drop links"),
    part!("differential", "open or locking differential between a shaft and two wheels"),
    part!("driveline", "engine, clutch, gearbox and differential on two wheels"),
    part!("double-wishbone-corner", "wheel on double wishbones with spring and damper, left or right"),
];

/// The part called `name`, with or without the prefix.
///
/// # Errors
/// If there is none; with the nearest name.
pub fn find(name: &str) -> Result<&'static ReadyMadePart, Missing> {
    let name = name.strip_prefix(PREFIX).unwrap_or(name);
    PARTS.iter().find(|part| part.name == name).ok_or_else(|| Missing {
        message: format!("there is no ready-made part `{name}`"),
        help: suggest::help(name, PARTS.iter().map(|part| part.name))
            .or_else(|| Some("`lissom parts` lists the ready-made parts".to_owned())),
    })
}
