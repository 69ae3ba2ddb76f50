//! Keys of parts, of positions relative to parts, and of motions at the start.

use super::tables::{TOP, has_named_entries};
use crate::keys::{Key, Shape, optional, required};

/// The key that names the part in whose frame an entry is placed.
pub(super) fn placed_in() -> Key {
    optional(
        "in",
        Shape::Text,
        "",
        "body, point mass or part in whose frame at the start positions and directions are given; default the one around",
    )
}

/// Keys of a part.
pub(crate) fn part() -> Vec<Key> {
    let mut keys = vec![
        optional("include", Shape::Text, "", "path of the file that it is made of, relative to this file"),
        optional("like", Shape::Text, "", "part of the same table of which it is a copy, turned and shifted"),
        optional(
            "count",
            Shape::Count(1, 20_000),
            "",
            "an array `name1`, `name2` …; `index` and `count` are parameters in it",
        ),
        placed_in(),
        optional("position", Shape::Place, "m", "position of its origin"),
        optional("rotation", Shape::Rotation, "rad", "rotation vector of its axes"),
        optional("parameters", Shape::Table, "", "its parameters, in place of the defaults of its file"),
        optional(
            "names",
            Shape::Table,
            "",
            "names in the included file that mean something outside, as { hub = \"hub\" }",
        ),
    ];
    let tables = TOP.iter().filter(|top| has_named_entries(top.name) && top.name != "parameters");
    keys.extend(tables.map(|top| optional(top.name, Shape::Entries(top.name), "", top.summary)));
    keys
}

/// Keys of a superelement.
pub(super) fn superelement() -> Vec<Key> {
    vec![
        placed_in(),
        required(
            "interfaces",
            Shape::Interfaces,
            "",
            "[{ name = \"root\" }, { name = \"tip\", at = [1, 0, 0] }]: what joints hold it by, in the order of the matrices",
        ),
        optional(
            "matrices",
            Shape::Text,
            "",
            "NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, where these are not given",
        ),
        optional(
            "mass",
            Shape::Text,
            "",
            "Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode",
        ),
        optional("stiffness", Shape::Text, "", "Matrix Market file over the same rows"),
        optional("damping", Shape::Text, "", "Matrix Market file over the same rows"),
        optional(
            "modal_damping",
            Shape::NotNegative,
            "",
            "instead: ratio to critical damping of every mode of the free part",
        ),
        optional("stiffness_damping", Shape::NotNegative, "s", "instead: times the stiffness"),
        optional(
            "recovery",
            Shape::Text,
            "",
            "file of a matrix that makes outputs of kind `recovered` of its unknowns: a row each, stresses or displacements between interfaces",
        ),
        optional(
            "preload",
            Shape::Text,
            "",
            "Matrix Market file of one column: forces of the undeformed part, which turn with it",
        ),
        optional(
            "geometric",
            Shape::Text,
            "",
            "Matrix Market file of `lissom reduce`: what is of second order in the deformation, as the stiffness that loads give and take",
        ),
        optional(
            "floating",
            Shape::Text,
            "",
            "the interface that carries the floating frame, default the first",
        ),
        optional("position", Shape::Place, "m", "position of the origin of the part"),
        optional("rotation", Shape::Rotation, "rad", "rotation vector of its axes"),
        optional("axes", Shape::Axes, "", "instead of rotation: first and second axis"),
    ]
}

/// Keys of an entry of `[initial]`.
pub(crate) fn part_motion() -> Vec<Key> {
    let mut keys = vec![required(
        "parts",
        Shape::Names,
        "",
        "bodies, point masses, beams, superelements and entries of [parts] that move in this way",
    )];
    keys.extend(initial().into_iter().filter(|key| !matches!(key.name, "equilibrium" | "steady_rotation")));
    keys
}

/// Keys of `[initial]` itself.
pub(crate) fn initial() -> Vec<Key> {
    vec![
        optional("velocity", Shape::GlobalVector, "m/s", "velocity of the point `about`"),
        optional("angular_velocity", Shape::GlobalVector, "rad/s", "global axes"),
        optional("about", Shape::Place, "m", "a point of the rigid motion; default the origin"),
        optional(
            "equilibrium",
            Shape::Flag,
            "",
            "start from static equilibrium under the loads of the first instant, default false",
        ),
        optional(
            "steady_rotation",
            Shape::Flag,
            "",
            "start from the positions at which the model keeps turning with its velocities, default false",
        ),
    ]
}
