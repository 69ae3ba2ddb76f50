// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Beams, shells, solids, rigid bodies, point masses and superelements.

use super::words;
use crate::builder::entry::{entries, keys};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::{Inertia, Mass, PositionOrNode, Solid};
use crate::ids::{MaterialId, SectionId};

entries! {
    /// A flexible beam.
    Beam => BeamId, "beam" {
        * elements: usize = "elements", "number of elements";
        section: SectionId = "section", "Name of a section; either it or `stations` is required.";
        stations: Vec<(f64, SectionId)> = "stations", "\\[{ at = 0, section = \"a\" }, …, { at = 1, … }\\], interpolated linearly.";
        from: PositionOrNode = "from", "Start: a position, or a node of another part, which is then shared \\[m\\].";
        to: PositionOrNode = "to", "End: a position, or a node of another part, which is then shared \\[m\\].";
        through: [f64; 3] = "through", "An intermediate point: the beam is a circular arc \\[m\\].";
        curve: [Expression; 3] = "curve", "Instead of `from` and `to`: three expressions of s in 0..1 \\[m\\].";
        order: usize = "order", "1, 2 or 3: elements of 2, 3 or 4 nodes; default 3.";
        up: [f64; 3] = "up", "Direction towards which local axis 3 is oriented.";
        force_per_length: [Expression; 3] = "force_per_length", "In global axes, fixed in direction: three numbers or expressions of s and t \\[N/m\\].";
        section_force_per_length: [Expression; 3] = "section_force_per_length", "In the section's axes 1, 2 and 3, with which it rotates: three numbers or expressions of s and t \\[N/m\\].";
        twist: Function = "twist", "Rotation about the tangent, a number or an expression of s \\[rad\\].";
        temperature: Function = "temperature", "Above that of the state without stress, over the whole analysis: a number or an expression of s \\[K\\].";
        temperature_slope: [f64; 2] = "temperature_slope", "Change of the temperature along axes 2 and 3 of the section: it bends the beam \\[K/m\\].";
    }

    /// A flexible shell or plate.
    Shell => ShellId, "shell" {
        corners: [[f64; 3]; 4] = "corners", "Four corners of a patch, counterclockwise about its normal: u = v = 0; u = 1; u = v = 1; v = 1 \\[m\\].";
        surface: [Expression; 3] = "surface", "Instead of `corners`: x, y and z over u and v from 0 to 1 \\[m\\].";
        divisions: [f64; 2] = "divisions", "Of a patch: numbers of elements along u and v.";
        mesh: String = "mesh", "Instead of `corners`: a Gmsh (.msh), Abaqus (.inp) or Wavefront (.obj) file; path relative to this file.";
        group: String = "group", "Of a mesh: the set of its elements to be used; default all surfaces.";
        join: bool = "join", "Whether nodes at the same position are one, as along the seam of a tube; default `false`.";
        thickness: Expression = "thickness", "A number or an expression of u and v; it or `plies` is required, unless the file of the mesh has one section for all elements \\[m\\].";
        material: MaterialId = "material", "Of `thickness`, and of plies without their own.";
        offset: f64 = "offset", "Place of the middle of the thickness along the normal of the surface; default 0 \\[m\\].";
        direction: [f64; 3] = "direction", "Projected on the surface, the first local axis, from which angles of plies count; default the direction of u of a patch, global x of a mesh.";
        fold_angle: f64 = "fold_angle", "Largest angle between elements of a mesh that count as one smooth surface; default 0.52 \\[rad\\].";
        pressure: Expression = "pressure", "Force per area along the normal, which it follows, as on the face opposite to it: an expression of u, v, t and the present place x, y, z \\[Pa\\].";
        pressure_on_top: Expression = "pressure_on_top", "Force per area on the face of the normal, against the normal, as `top` in `pressure` of a solid: an expression of u, v, t and the present place x, y, z \\[Pa\\].";
        force_per_area: [Expression; 3] = "force_per_area", "In global axes, fixed in direction: three numbers or expressions of u, v and t \\[Pa\\].";
        prestress: [f64; 3] = "prestress", "Of a taut membrane: forces per length 11, 22 and 12 in the local axes before any strain \\[N/m\\].";
    }

    /// An elastic solid.
    ElasticSolid => SolidId, "elastic_solid" {
        * material: MaterialId = "material", "the material";
        size: [f64; 3] = "size", "Of a box along the axes: its lengths \\[m\\].";
        origin: [f64; 3] = "origin", "Of a box: its corner with the lowest coordinates; default the origin \\[m\\].";
        volume: [Expression; 3] = "volume", "Instead of `size`: x, y and z over u, v and w from 0 to 1, which are right-handed \\[m\\].";
        divisions: [f64; 3] = "divisions", "Of `size` and `volume`: numbers of elements along u, v and w.";
        mesh: String = "mesh", "Instead of `size`: a Gmsh (.msh) or Abaqus (.inp) file; path relative to this file.";
        group: String = "group", "Of a mesh: the set of its elements to be used; default all solids.";
        join: bool = "join", "Whether nodes at the same position are one, as along the seam of a ring; default `false`.";
        model: words::Model = "model", "Law of elasticity: for small strains, or for rubber; default `\"st-venant-kirchhoff\"`.";
        c01: f64 = "c01", "Second constant of `model = \"mooney-rivlin\"`; the first one is E/(4 (1 + nu)) - c01 \\[Pa\\].";
    }

    /// A rigid body.
    Body => BodyId, "body" {
        * mass: Mass = "mass", "mass, or { density } of the solid in `inertia`; 0, also for `inertia`, is a frame between joints \\[kg\\]";
        * inertia: Inertia = "inertia", "about the centre of mass, in body axes: 3 numbers, 3 x 3, or a solid such as { kind = \"box\", sides = \\[a, b, c\\] } \\[kg m²\\]";
        position: [f64; 3] = "position", "Position of the reference frame \\[m\\].";
        rotation: [f64; 3] = "rotation", "Rotation vector of the reference frame \\[rad\\].";
        axes: [[f64; 3]; 2] = "axes", "Instead of `rotation`: first and second body axis.";
        center_of_mass: [f64; 3] = "center_of_mass", "In body axes, from the reference point \\[m\\].";
        shape: Solid = "shape", "What is drawn of it, about the centre of mass; default: a solid with its inertia; \\[\\] draws nothing.";
        mesh: String = "mesh", "Instead of `shape`: an STL or glTF file in metres and body axes; path relative to this file.";
        velocity: [f64; 3] = "velocity", "Of the reference point at the start, global axes \\[m/s\\].";
        angular_velocity: [f64; 3] = "angular_velocity", "At the start, body axes \\[rad/s\\].";
    }

    /// A mass without extension.
    PointMass => PointMassId, "point_mass" {
        * mass: f64 = "mass", "mass \\[kg\\]";
        position: [f64; 3] = "position", "Position at the start \\[m\\].";
        plane: words::Plane = "plane", "Restricts the motion to this plane.";
        shape: Solid = "shape", "Solid to be drawn about its position; default: a ball.";
        mesh: String = "mesh", "Instead of `shape`: an STL or glTF file in metres, along the global axes; path relative to this file.";
        velocity: [f64; 3] = "velocity", "At the start, global axes \\[m/s\\].";
    }

    /// A linear elastic part that is given by reduced matrices.
    Superelement => SuperelementId, "superelement" {
        * interfaces: Vec<(String, [f64; 3])> = "interfaces", "\\[{ name = \"root\" }, { name = \"tip\", at = \\[1, 0, 0\\] }\\]: nodes for joints, in the order of the matrices";
        matrices: String = "matrices", "NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, instead of these keys.";
        mass: String = "mass", "Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode.";
        stiffness: String = "stiffness", "Matrix Market file over the same rows.";
        damping: String = "damping", "Matrix Market file over the same rows.";
        modal_damping: f64 = "modal_damping", "Instead of `damping`: damping ratio of every mode of the free part.";
        stiffness_damping: f64 = "stiffness_damping", "Instead of `damping`: factor of the stiffness \\[s\\].";
        recovery: String = "recovery", "File of a matrix for outputs of kind `recovered`: each row yields a stress or displacement from the unknowns.";
        preload: String = "preload", "Matrix Market file of one column: forces on the undeformed part, which rotate with it.";
        geometric: String = "geometric", "Matrix Market file of `lissom reduce`: terms of second order in the deformation, such as geometric stiffness.";
        floating: String = "floating", "Interface to which the floating frame is attached; default: the first.";
        position: [f64; 3] = "position", "Position of the origin of the part \\[m\\].";
        rotation: [f64; 3] = "rotation", "Rotation vector of its axes \\[rad\\].";
        axes: [[f64; 3]; 2] = "axes", "Instead of `rotation`: first and second axis.";
    }
}

keys! {
    [Shell, ElasticSolid]
        scale: f64 = "scale", "Of a mesh: factor to metres; default 1.";
        damping: f64 = "damping", "Damping in proportion to the stiffness; default 0 \\[s\\].";
        temperature: Expression = "temperature", "Above that of the state without stress, over the whole analysis: a number or an expression of x, y and z at rest, in the axes of the part \\[K\\].";
}
