// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Parts that may touch, and the solids that are fixed in space.

use super::words;
use crate::builder::entry::entries;
use crate::builder::values::{Node, Solid};
use crate::ids::MaterialId;

entries! {
    /// Two parts that may touch, by their shapes.
    Contact => ContactId, "contact" {
        * base: Node = "base", "a body or point mass with a `shape`, or \"ground\"; or a beam if the tip is one; or a shell, with `stiffness_per_area`";
        * tip: Node = "tip", "the other part that may touch it; or the name of a beam, a shell or a solid";
        kind: words::Kind = "kind", "Its kind; default by its parts and keys.";
        others: Vec<Node> = "others", "Further parts: every two of `base`, `tip` and these may touch.";
        except: Vec<Vec<Node>> = "except", "With `others`: lists of parts of which no two touch.";
        rigid: bool = "rigid", "Older word for the kinds `rigid` and `compliant`.";
        stiffness: f64 = "stiffness", "Normal force at a penetration of 1 m \\[N/m^n\\].";
        exponent: f64 = "exponent", "Exponent n of the penetration, at least 1; default 1.";
        material: MaterialId = "material", "Instead of `stiffness` and `exponent`: the material of both parts, for balls on balls or planes by the theory of Hertz.";
        tip_material: MaterialId = "tip_material", "Material of the tip, if it is another one.";
        restitution: f64 = "restitution", "Velocity after an impact over that before, at any impact velocity: from 0.01 to 1, and 1 if it is omitted.";
        rest_velocity: f64 = "rest_velocity", "Slower impacts dissipate as those of this velocity; requires `restitution`; default 1e-3 \\[m/s\\].";
        dissipation: f64 = "dissipation", "Instead of `restitution`: relative increase of the normal force per penetration velocity \\[s/m\\].";
        friction: f64 = "friction", "Coefficient of sliding friction; default 0.";
        static_friction: f64 = "static_friction", "Coefficient at rest, not below `friction`; default: that of `friction`.";
        stribeck: f64 = "stribeck", "Sliding velocity at which the difference has fallen to 1/e, and friction begins to yield; default 0.01 \\[m/s\\].";
        deflection: f64 = "deflection", "Tangential deflection before it slips; default 1e-5 \\[m\\].";
        surface_velocity: [f64; 3] = "surface_velocity", "Velocity at which the surface of the base moves along itself, as a conveyor belt, in the axes of the base; requires `friction` \\[m/s\\].";
        rolling_friction: f64 = "rolling_friction", "Moment against rolling per normal force; default 0 \\[m\\].";
        torsional_friction: f64 = "torsional_friction", "Moment against spinning about the normal per normal force; default 0 \\[m\\].";
        stiffness_per_length: f64 = "stiffness_per_length", "Of a beam: normal force per length at a penetration of 1 m \\[N/m^(n+1)\\].";
        points: usize = "points", "Of a beam: number of intervals between points of contact in an element; default 2.";
        radius: f64 = "radius", "Of a beam as tip: its radius where it touches; default that of its sections, if they are round and equal \\[m\\].";
        base_radius: f64 = "base_radius", "Of a beam as base: its radius \\[m\\].";
        stiffness_per_area: f64 = "stiffness_per_area", "Of a shell or a solid: normal force per area at a penetration of 1 m \\[N/m^(n+2)\\].";
        faces: String = "faces", "Of a solid: set of nodes whose faces touch; default all outer faces.";
    }

    /// Solids that are fixed in space.
    Ground => GroundId, "ground" {
        shape: Solid = "shape", "Solids, in global axes; by default at the origin.";
        mesh: String = "mesh", "Instead of `shape`: an STL or glTF file in metres, drawn only.";
    }
}
