// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Beams, rigid bodies, point masses and superelements.

use super::words;
use crate::builder::entry::entry;
use crate::builder::expression::{Expression, Function};
use crate::builder::ids::SectionId;
use crate::builder::values::{Inertia, Mass, Place, Solid};

entry! {
    /// A flexible beam.
    Beam => BeamId, "beam";
    []
    /// With what must be given.
    ///
    /// - `elements`: number of elements
    new(elements: usize = "elements")
    /// Name of a section; give it or `stations`.
    section: SectionId = "section";
    /// \[{ at = 0, section = "a" }, …, { at = 1, … }\], linear between.
    stations: Vec<(f64, SectionId)> = "stations";
    /// Start: a point, or a node of another part, which is shared \[m\].
    from: Place = "from";
    /// End: a point, or a node of another part, which is shared \[m\].
    to: Place = "to";
    /// A point between: the beam is a circular arc \[m\].
    through: [f64; 3] = "through";
    /// Instead of from and to: three expressions of s in 0..1 \[m\].
    curve: [Expression; 3] = "curve";
    /// 1, 2 or 3 (default): elements of 2, 3 or 4 nodes.
    order: usize = "order";
    /// Direction that local axis 3 leans to.
    up: [f64; 3] = "up";
    /// Along global axes, which it keeps: three numbers or expressions of s and t \[N/m\].
    force_per_length: [Expression; 3] = "force_per_length";
    /// Along the section's axes 1, 2 and 3, with which it turns: three numbers or expressions of s and t \[N/m\].
    section_force_per_length: [Expression; 3] = "section_force_per_length";
    /// Turn about the tangent, a number or an expression of s \[rad\].
    twist: Function = "twist";
}

entry! {
    /// A rigid body.
    Body => BodyId, "body";
    []
    /// With what must be given.
    ///
    /// - `mass`: mass, or { density } of the solid in `inertia` \[kg\]
    /// - `inertia`: about the centre of mass, in body axes: 3 numbers, 3 x 3, or a solid as { box = \[a, b, c\] } \[kg m²\]
    new(mass: Mass = "mass", inertia: Inertia = "inertia")
    /// Position of the reference frame \[m\].
    position: [f64; 3] = "position";
    /// Rotation vector of the reference frame \[rad\].
    rotation: [f64; 3] = "rotation";
    /// Instead of rotation: first and second body axis.
    axes: [[f64; 3]; 2] = "axes";
    /// In body axes, from the reference point \[m\].
    center_of_mass: [f64; 3] = "center_of_mass";
    /// Drawn about the centre of mass, instead of what has its inertia.
    shape: Solid = "shape";
    /// Instead of `shape`: an STL or glTF file in metres and body axes; relative to the file that names it.
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
    /// Move in this plane only.
    plane: words::Plane = "plane";
    /// At the start, global axes \[m/s\].
    velocity: [f64; 3] = "velocity";
}

entry! {
    /// A linear elastic part that is given by reduced matrices.
    Superelement => SuperelementId, "superelement";
    []
    /// With what must be given.
    ///
    /// - `interfaces`: \[{ name = "root" }, { name = "tip", at = \[1, 0, 0\] }\]: what joints hold it by, in the order of the matrices
    new(interfaces: Vec<(String, [f64; 3])> = "interfaces")
    /// NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, where these are not given.
    matrices: String = "matrices";
    /// Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode.
    mass: String = "mass";
    /// Matrix Market file over the same rows.
    stiffness: String = "stiffness";
    /// Matrix Market file over the same rows.
    damping: String = "damping";
    /// Instead: ratio to critical damping of every mode of the free part.
    modal_damping: f64 = "modal_damping";
    /// Instead: times the stiffness \[s\].
    stiffness_damping: f64 = "stiffness_damping";
    /// File of a matrix that makes outputs of kind `recovered` of its unknowns: a row each, stresses or displacements between interfaces.
    recovery: String = "recovery";
    /// Matrix Market file of one column: forces of the undeformed part, which turn with it.
    preload: String = "preload";
    /// Matrix Market file of `lissom reduce`: what is of second order in the deformation, as the stiffness that loads give and take.
    geometric: String = "geometric";
    /// The interface that carries the floating frame, default the first.
    floating: String = "floating";
    /// Position of the origin of the part \[m\].
    position: [f64; 3] = "position";
    /// Rotation vector of its axes \[rad\].
    rotation: [f64; 3] = "rotation";
    /// Instead of rotation: first and second axis.
    axes: [[f64; 3]; 2] = "axes";
}
