//! Keys of parts, of positions relative to parts, and of motions at the start.

use super::top_level::{TOP, has_named_entries};
use crate::format::keys::{Key, Shape, optional, required, unitless};

/// Key of the part in whose frame an entry is placed.
pub(crate) fn placed_in() -> Key {
    unitless(
        "in",
        Shape::Text,
        "body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part",
    )
}

/// Keys of a part.
pub(crate) fn part() -> Vec<Key> {
    let mut keys = vec![
        unitless(
            "include",
            Shape::Text,
            "path of the file with its contents, relative to this file, or `lissom:NAME` for a ready-made part",
        ),
        unitless(
            "like",
            Shape::Text,
            "part of the same table of which it is a copy, at another position and orientation",
        ),
        unitless(
            "count",
            Shape::Count(1, 20_000),
            "number of copies `name1`, `name2` …; `index` and `count` are parameters in each",
        ),
        placed_in(),
        optional("position", Shape::Place, "m", "position of its origin"),
        optional("rotation", Shape::Rotation, "rad", "rotation vector of its axes"),
        unitless("parameters", Shape::Table, "values of its parameters, instead of the defaults in its file"),
        unitless(
            "names",
            Shape::Table,
            "names in the included file that refer to entries outside, such as { hub = \"hub\" }",
        ),
    ];
    let tables = TOP.iter().filter(|top| has_named_entries(top.name) && top.name != "parameters");
    keys.extend(tables.map(|top| unitless(top.name, Shape::Entries(top.name), top.summary)));
    keys
}

/// Keys of a superelement.
pub(crate) fn superelement() -> Vec<Key> {
    vec![
        placed_in(),
        required(
            "interfaces",
            Shape::Interfaces,
            "",
            "[{ name = \"root\" }, { name = \"tip\", at = [1, 0, 0] }]: nodes for joints, in the order of the matrices",
        ),
        unitless(
            "matrices",
            Shape::Text,
            "NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, instead of these keys",
        ),
        unitless(
            "mass",
            Shape::Text,
            "Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode",
        ),
        unitless("stiffness", Shape::Text, "Matrix Market file over the same rows"),
        unitless("damping", Shape::Text, "Matrix Market file over the same rows"),
        unitless(
            "modal_damping",
            Shape::NotNegative,
            "instead of `damping`: damping ratio of every mode of the free part",
        ),
        optional(
            "stiffness_damping",
            Shape::NotNegative,
            "s",
            "instead of `damping`: factor of the stiffness",
        ),
        unitless(
            "recovery",
            Shape::Text,
            "file of a matrix for outputs of kind `recovered`: each row yields a stress or displacement from the unknowns",
        ),
        unitless(
            "preload",
            Shape::Text,
            "Matrix Market file of one column: forces on the undeformed part, which rotate with it",
        ),
        unitless(
            "geometric",
            Shape::Text,
            "Matrix Market file of `lissom reduce`: terms of second order in the deformation, such as geometric stiffness",
        ),
        unitless(
            "floating",
            Shape::Text,
            "interface to which the floating frame is attached; default: the first",
        ),
        optional("position", Shape::Place, "m", "position of the origin of the part"),
        optional("rotation", Shape::Rotation, "rad", "rotation vector of its axes"),
        unitless("axes", Shape::Axes, "instead of `rotation`: first and second axis"),
    ]
}

/// Keys of an entry of `[initial]`.
pub(crate) fn part_motion() -> Vec<Key> {
    let mut keys = vec![required(
        "parts",
        Shape::Names,
        "",
        "bodies, point masses, beams, shells, solids, superelements and entries of [parts] with this motion",
    )];
    keys.extend(
        initial()
            .into_iter()
            .filter(|key| !matches!(key.name, "equilibrium" | "steady_rotation" | "follow_drives")),
    );
    keys
}

/// Keys of `[initial]` itself.
pub(crate) fn initial() -> Vec<Key> {
    vec![
        optional("velocity", Shape::GlobalVector, "m/s", "velocity of the point `about`"),
        optional("angular_velocity", Shape::GlobalVector, "rad/s", "global axes"),
        optional("about", Shape::Place, "m", "a point of the rigid motion; default the origin"),
        unitless(
            "equilibrium",
            Shape::Flag,
            "start from static equilibrium under the loads at the start",
        ).or_flag(false),
        unitless(
            "steady_rotation",
            Shape::Flag,
            "start from the relative equilibrium in which the model rotates steadily with its velocities",
        ).or_flag(false),
        unitless(
            "follow_drives",
            Shape::Flag,
            "beams, shells, solids and superelements without given velocities start with those of their drive, otherwise at rest",
        )
        .or_flag(true),
    ]
}
