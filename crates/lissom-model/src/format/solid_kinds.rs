//! The kinds of solids that `shape` names, with their own keys.

use super::keys::{Key, Shape};

/// A kind of solid.
pub(crate) struct SolidKind {
    /// Word in the model file.
    pub(crate) word: &'static str,
    /// One sentence.
    pub(crate) summary: &'static str,
    /// Keys that only some solids have.
    pub(crate) keys: &'static [&'static str],
}

/// Keys of every solid.
const COMMON: [&str; 4] = ["position", "rotation", "touches", "colour"];

const fn solid(word: &'static str, keys: &'static [&'static str], summary: &'static str) -> SolidKind {
    SolidKind { word, summary, keys }
}

/// All of them, in the order of the reference.
pub(crate) const SOLID_KINDS: [SolidKind; 11] = [
    solid("box", &["sides"], "A box about its centre."),
    solid("cylinder", &["radius", "length", "axis"], "A cylinder about its centre."),
    solid("tube", &["radius", "inner_radius", "length", "axis"], "A hollow cylinder about its centre."),
    solid("sphere", &["radius"], "A sphere."),
    solid("capsule", &["radius", "length", "axis"], "A cylinder with half spheres as ends."),
    solid("ellipsoid", &["semi_axes"], "An ellipsoid."),
    solid("plane", &["normal"], "A solid half-space; its position is a point of the plane."),
    solid(
        "outline",
        &["points", "smooth", "length", "axis"],
        "A prism along its axis with corners [x, y], or with a smooth curve through them: cams, slots, gears.",
    ),
    solid("hull", &["points"], "The convex hull of at most 200 points [x, y, z]."),
    solid(
        "height_field",
        &["heights", "extent"],
        "A smooth surface over a rectangle, solid below, constant beyond its border.",
    ),
    solid("mesh", &["file", "scale"], "The closed triangles of a file."),
];

impl SolidKind {
    /// Keys of the kind except `kind`.
    pub(crate) fn all_keys(&self) -> Vec<Key> {
        let is_own = |key: &Key| self.keys.contains(&key.name) || COMMON.contains(&key.name);
        Shape::drawn_keys().into_iter().filter(is_own).collect()
    }
}

#[cfg(test)]
#[path = "../../tests/unit/format/solid_kinds.rs"]
mod tests;
