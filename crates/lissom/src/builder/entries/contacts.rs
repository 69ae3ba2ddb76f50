// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Parts that may touch, and the solids that are fixed in space.

use super::words;
use crate::builder::entry::entry;
use crate::builder::values::{Node, Solid};
use crate::ids::MaterialId;

entry! {
    /// Two parts that may touch, by their shapes.
    Contact => ContactId, "contact";
    []
    /// With what must be given.
    ///
    /// - `base`: a body or point mass with a `shape`, or "ground"; or a beam if the tip is one; or a shell, with `stiffness_per_area`
    /// - `tip`: the other part that may touch it; or the name of a beam, a shell or a solid
    new(base: Node = "base", tip: Node = "tip")
    /// Its kind; default by its parts and keys.
    kind: words::Kind = "kind";
    /// Further parts: every two of `base`, `tip` and these may touch.
    others: Vec<Node> = "others";
    /// Older word for the kinds `rigid` and `compliant`.
    rigid: bool = "rigid";
    /// Normal force at a penetration of 1 m \[N/m^n\].
    stiffness: f64 = "stiffness";
    /// Exponent n of the penetration, at least 1; default 1.
    exponent: f64 = "exponent";
    /// Instead of `stiffness` and `exponent`: the material of both parts, for balls on balls or planes by the theory of Hertz.
    material: MaterialId = "material";
    /// Material of the tip, if it is another one.
    tip_material: MaterialId = "tip_material";
    /// Velocity after an impact over that before, at any impact velocity: from 0.01 to 1, and 1 if it is omitted.
    restitution: f64 = "restitution";
    /// Slower impacts dissipate as those of this velocity; requires `restitution`; default 1e-3 \[m/s\].
    rest_velocity: f64 = "rest_velocity";
    /// Instead of `restitution`: relative increase of the normal force per penetration velocity \[s/m\].
    dissipation: f64 = "dissipation";
    /// Coefficient of sliding friction; default 0.
    friction: f64 = "friction";
    /// Coefficient at rest, not below `friction`; default: that of `friction`.
    static_friction: f64 = "static_friction";
    /// Sliding velocity at which the difference has fallen to 1/e, and friction begins to yield; default 0.01 \[m/s\].
    stribeck: f64 = "stribeck";
    /// Tangential deflection before it slips; default 1e-5 \[m\].
    deflection: f64 = "deflection";
    /// Velocity at which the surface of the base moves along itself, as a conveyor belt, in the axes of the base; requires `friction` \[m/s\].
    surface_velocity: [f64; 3] = "surface_velocity";
    /// Moment against rolling per normal force; default 0 \[m\].
    rolling_friction: f64 = "rolling_friction";
    /// Moment against spinning about the normal per normal force; default 0 \[m\].
    torsional_friction: f64 = "torsional_friction";
    /// Of a beam: normal force per length at a penetration of 1 m \[N/m^(n+1)\].
    stiffness_per_length: f64 = "stiffness_per_length";
    /// Of a beam: number of intervals between points of contact in an element; default 2.
    points: usize = "points";
    /// Of a beam as tip: its radius where it touches; default that of its sections, if they are round and equal \[m\].
    radius: f64 = "radius";
    /// Of a beam as base: its radius \[m\].
    base_radius: f64 = "base_radius";
    /// Of a shell or a solid: normal force per area at a penetration of 1 m \[N/m^(n+2)\].
    stiffness_per_area: f64 = "stiffness_per_area";
    /// Of a solid: set of nodes whose faces touch; default all outer faces.
    faces: String = "faces";
}

entry! {
    /// Solids that are fixed in space.
    Ground => GroundId, "ground";
    []
    /// With what must be given.
    new()
    /// Solids, in global axes; by default at the origin.
    shape: Solid = "shape";
    /// Instead of `shape`: an STL or glTF file in metres, drawn only.
    mesh: String = "mesh";
}
