// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Materials and cross sections.

use crate::builder::entry::{entry, keys, nested};
use crate::builder::values::{Matrix, SectionMass, Shear};
use crate::ids::MaterialId;

entry! {
    /// An isotropic elastic material.
    Material => MaterialId, "material";
    []
    /// With what must be given.
    ///
    /// - `youngs_modulus`: Young's modulus \[Pa\]
    /// - `density`: mass density \[kg/m³\]
    new(youngs_modulus: f64 = "E", density: f64 = "density")
    /// Poisson's ratio; either it or `G` is required.
    poisson_ratio: f64 = "nu";
    /// Shear modulus; either it or `nu` is required \[Pa\].
    shear_modulus: f64 = "G";
}

entry! {
    /// Solid rectangle.
    Rectangle => SectionId, "rectangle";
    ["shape" = "rectangle"]
    /// With what must be given.
    ///
    /// - `material`: name of a material
    /// - `width`: side along axis 2 \[m\]
    /// - `height`: side along axis 3 \[m\]
    new(material: MaterialId = "material", width: f64 = "width", height: f64 = "height")
}

entry! {
    /// Solid circle.
    Circle => SectionId, "circle";
    ["shape" = "circle"]
    /// With what must be given.
    ///
    /// - `material`: name of a material
    /// - `radius`: radius \[m\]
    new(material: MaterialId = "material", radius: f64 = "radius")
}

entry! {
    /// Circular tube.
    Tube => SectionId, "tube";
    ["shape" = "tube"]
    /// With what must be given.
    ///
    /// - `material`: name of a material
    /// - `outer_radius`: outer radius \[m\]
    /// - `thickness`: thickness of the wall \[m\]
    new(material: MaterialId = "material", outer_radius: f64 = "outer_radius", thickness: f64 = "thickness")
}

entry! {
    /// Specified by its stiffness and mass matrices.
    General => SectionId, "general";
    ["shape" = "general"]
    /// With what must be given.
    ///
    /// - `stiffness`: 6 x 6 or its diagonal: axial, shear 2, shear 3, torsion, bending 2, bending 3 \[N, N m²\]
    /// - `mass`: 6 x 6, or { per\_length, inertia = \[J11, J22, J33\], center = \[c2, c3\] } \[kg/m, kg m\]
    new(stiffness: Matrix = "stiffness", mass: SectionMass = "mass")
}

nested! {
    /// Mass of a section, by its parts.
    SliceMass;
    /// With what must be given.
    ///
    /// - `per_length`: mass per length \[kg/m\]
    /// - `inertia`: \[J11, J22, J33\] per length about the centre of mass \[kg m\]
    new(per_length: f64 = "per_length", inertia: [f64; 3] = "inertia")
    /// \[c2, c3\]: centre of mass across the beam \[m\].
    center: [f64; 2] = "center";
}

keys! {
    [Material, General]
    /// Strain per change of temperature; default 0 \[1/K\].
    expansion: f64 = "expansion";
}

keys! {
    [Rectangle, Circle, Tube]
    /// Shear coefficient: one or two numbers (along 2 and 3), "cowper" (default) or "renton".
    shear: Shear = "shear";
}

keys! {
    [Rectangle, Circle, Tube, General]
    /// Damping in proportion to the stiffness \[s\].
    damping: f64 = "damping";
}
