// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Beams, shells, solids, rigid bodies, point masses and superelements.

use super::words;
use crate::builder::entry::{entry, keys};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::{Inertia, Mass, PositionOrNode, Solid};
use crate::ids::{MaterialId, SectionId};

entry! {
    /// A flexible beam.
    Beam => BeamId, "beam";
    []
    /// With what must be given.
    ///
    /// - `elements`: number of elements
    new(elements: usize = "elements")
    /// Name of a section; either it or `stations` is required.
    section: SectionId = "section";
    /// \[{ at = 0, section = "a" }, …, { at = 1, … }\], interpolated linearly.
    stations: Vec<(f64, SectionId)> = "stations";
    /// Start: a position, or a node of another part, which is then shared \[m\].
    from: PositionOrNode = "from";
    /// End: a position, or a node of another part, which is then shared \[m\].
    to: PositionOrNode = "to";
    /// An intermediate point: the beam is a circular arc \[m\].
    through: [f64; 3] = "through";
    /// Instead of `from` and `to`: three expressions of s in 0..1 \[m\].
    curve: [Expression; 3] = "curve";
    /// 1, 2 or 3: elements of 2, 3 or 4 nodes; default 3.
    order: usize = "order";
    /// Direction towards which local axis 3 is oriented.
    up: [f64; 3] = "up";
    /// In global axes, fixed in direction: three numbers or expressions of s and t \[N/m\].
    force_per_length: [Expression; 3] = "force_per_length";
    /// In the section's axes 1, 2 and 3, with which it rotates: three numbers or expressions of s and t \[N/m\].
    section_force_per_length: [Expression; 3] = "section_force_per_length";
    /// Rotation about the tangent, a number or an expression of s \[rad\].
    twist: Function = "twist";
    /// Above that of the state without stress, over the whole analysis: a number or an expression of s \[K\].
    temperature: Function = "temperature";
    /// Change of the temperature along axes 2 and 3 of the section: it bends the beam \[K/m\].
    temperature_slope: [f64; 2] = "temperature_slope";
}

entry! {
    /// A flexible shell or plate.
    Shell => ShellId, "shell";
    []
    /// With what must be given.
    new()
    /// Four corners of a patch, counterclockwise about its normal: u = v = 0; u = 1; u = v = 1; v = 1 \[m\].
    corners: [[f64; 3]; 4] = "corners";
    /// Instead of `corners`: x, y and z over u and v from 0 to 1 \[m\].
    surface: [Expression; 3] = "surface";
    /// Of a patch: numbers of elements along u and v.
    divisions: [f64; 2] = "divisions";
    /// Instead of `corners`: a Gmsh (.msh), Abaqus (.inp) or Wavefront (.obj) file; path relative to this file.
    mesh: String = "mesh";
    /// Of a mesh: the set of its elements to be used; default all surfaces.
    group: String = "group";
    /// Whether nodes at the same position are one, as along the seam of a tube; default `false`.
    join: bool = "join";
    /// A number or an expression of u and v; it or `plies` is required, unless the file of the mesh has one section for all elements \[m\].
    thickness: Expression = "thickness";
    /// Of `thickness`, and of plies without their own.
    material: MaterialId = "material";
    /// Place of the middle of the thickness along the normal of the surface; default 0 \[m\].
    offset: f64 = "offset";
    /// Projected on the surface, the first local axis, from which angles of plies count; default the direction of u of a patch, global x of a mesh.
    direction: [f64; 3] = "direction";
    /// Largest angle between elements of a mesh that count as one smooth surface; default 0.52 \[rad\].
    fold_angle: f64 = "fold_angle";
    /// Force per area along the normal, which it follows, as on the face opposite to it: an expression of u, v, t and the present place x, y, z \[Pa\].
    pressure: Expression = "pressure";
    /// Force per area on the face of the normal, against the normal, as `top` in `pressure` of a solid: an expression of u, v, t and the present place x, y, z \[Pa\].
    pressure_on_top: Expression = "pressure_on_top";
    /// In global axes, fixed in direction: three numbers or expressions of u, v and t \[Pa\].
    force_per_area: [Expression; 3] = "force_per_area";
    /// Of a taut membrane: forces per length 11, 22 and 12 in the local axes before any strain \[N/m\].
    prestress: [f64; 3] = "prestress";
}

entry! {
    /// An elastic solid.
    ElasticSolid => SolidId, "elastic_solid";
    []
    /// With what must be given.
    ///
    /// - `material`: the material
    new(material: MaterialId = "material")
    /// Of a box along the axes: its lengths \[m\].
    size: [f64; 3] = "size";
    /// Of a box: its corner with the lowest coordinates; default the origin \[m\].
    origin: [f64; 3] = "origin";
    /// Instead of `size`: x, y and z over u, v and w from 0 to 1, which are right-handed \[m\].
    volume: [Expression; 3] = "volume";
    /// Of `size` and `volume`: numbers of elements along u, v and w.
    divisions: [f64; 3] = "divisions";
    /// Instead of `size`: a Gmsh (.msh) or Abaqus (.inp) file; path relative to this file.
    mesh: String = "mesh";
    /// Of a mesh: the set of its elements to be used; default all solids.
    group: String = "group";
    /// Whether nodes at the same position are one, as along the seam of a ring; default `false`.
    join: bool = "join";
    /// Law of elasticity: for small strains, or for rubber; default `"st-venant-kirchhoff"`.
    model: words::Model = "model";
    /// Second constant of `model = "mooney-rivlin"`; the first one is E/(4 (1 + nu)) - c01 \[Pa\].
    c01: f64 = "c01";
}

entry! {
    /// A rigid body.
    Body => BodyId, "body";
    []
    /// With what must be given.
    ///
    /// - `mass`: mass, or { density } of the solid in `inertia`; 0, also for `inertia`, is a frame between joints \[kg\]
    /// - `inertia`: about the centre of mass, in body axes: 3 numbers, 3 x 3, or a solid such as { kind = "box", sides = \[a, b, c\] } \[kg m²\]
    new(mass: Mass = "mass", inertia: Inertia = "inertia")
    /// Position of the reference frame \[m\].
    position: [f64; 3] = "position";
    /// Rotation vector of the reference frame \[rad\].
    rotation: [f64; 3] = "rotation";
    /// Instead of `rotation`: first and second body axis.
    axes: [[f64; 3]; 2] = "axes";
    /// In body axes, from the reference point \[m\].
    center_of_mass: [f64; 3] = "center_of_mass";
    /// What is drawn of it, about the centre of mass; default: a solid with its inertia; \[\] draws nothing.
    shape: Solid = "shape";
    /// Instead of `shape`: an STL or glTF file in metres and body axes; path relative to this file.
    mesh: String = "mesh";
    /// Of the reference point at the start, global axes \[m/s\].
    velocity: [f64; 3] = "velocity";
    /// At the start, body axes \[rad/s\].
    angular_velocity: [f64; 3] = "angular_velocity";
}

entry! {
    /// A mass without extension.
    PointMass => PointMassId, "point_mass";
    []
    /// With what must be given.
    ///
    /// - `mass`: mass \[kg\]
    new(mass: f64 = "mass")
    /// Position at the start \[m\].
    position: [f64; 3] = "position";
    /// Restricts the motion to this plane.
    plane: words::Plane = "plane";
    /// Solid to be drawn about its position; default: a ball.
    shape: Solid = "shape";
    /// Instead of `shape`: an STL or glTF file in metres, along the global axes; path relative to this file.
    mesh: String = "mesh";
    /// At the start, global axes \[m/s\].
    velocity: [f64; 3] = "velocity";
}

entry! {
    /// A linear elastic part that is given by reduced matrices.
    Superelement => SuperelementId, "superelement";
    []
    /// With what must be given.
    ///
    /// - `interfaces`: \[{ name = "root" }, { name = "tip", at = \[1, 0, 0\] }\]: nodes for joints, in the order of the matrices
    new(interfaces: Vec<(String, [f64; 3])> = "interfaces")
    /// NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, instead of these keys.
    matrices: String = "matrices";
    /// Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode.
    mass: String = "mass";
    /// Matrix Market file over the same rows.
    stiffness: String = "stiffness";
    /// Matrix Market file over the same rows.
    damping: String = "damping";
    /// Instead of `damping`: damping ratio of every mode of the free part.
    modal_damping: f64 = "modal_damping";
    /// Instead of `damping`: factor of the stiffness \[s\].
    stiffness_damping: f64 = "stiffness_damping";
    /// File of a matrix for outputs of kind `recovered`: each row yields a stress or displacement from the unknowns.
    recovery: String = "recovery";
    /// Matrix Market file of one column: forces on the undeformed part, which rotate with it.
    preload: String = "preload";
    /// Matrix Market file of `lissom reduce`: terms of second order in the deformation, such as geometric stiffness.
    geometric: String = "geometric";
    /// Interface to which the floating frame is attached; default: the first.
    floating: String = "floating";
    /// Position of the origin of the part \[m\].
    position: [f64; 3] = "position";
    /// Rotation vector of its axes \[rad\].
    rotation: [f64; 3] = "rotation";
    /// Instead of `rotation`: first and second axis.
    axes: [[f64; 3]; 2] = "axes";
}

keys! {
    [Shell, ElasticSolid]
    /// Of a mesh: factor to metres; default 1.
    scale: f64 = "scale";
    /// Damping in proportion to the stiffness; default 0 \[s\].
    damping: f64 = "damping";
    /// Above that of the state without stress, over the whole analysis: a number or an expression of x, y and z at rest, in the axes of the part \[K\].
    temperature: Expression = "temperature";
}
