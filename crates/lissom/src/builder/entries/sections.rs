// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Materials and cross sections.

use crate::builder::entry::{entries, keys};
use crate::builder::values::{Matrix, SectionMass, Shear};
use crate::ids::MaterialId;

entries! {
    /// An isotropic elastic material.
    Material => MaterialId, "material" {
        * youngs_modulus: f64 = "E", "Young's modulus \\[Pa\\]";
        * density: f64 = "density", "mass density \\[kg/m³\\]";
        poisson_ratio: f64 = "nu", "Poisson's ratio; either it or `G` is required.";
        shear_modulus: f64 = "G", "Shear modulus; either it or `nu` is required \\[Pa\\].";
    }

    /// Solid rectangle.
    Rectangle => SectionId, shape: "rectangle" {
        * material: MaterialId = "material", "name of a material";
        * width: f64 = "width", "side along axis 2 \\[m\\]";
        * height: f64 = "height", "side along axis 3 \\[m\\]";
    }

    /// Solid circle.
    Circle => SectionId, shape: "circle" {
        * material: MaterialId = "material", "name of a material";
        * radius: f64 = "radius", "radius \\[m\\]";
    }

    /// Circular tube.
    Tube => SectionId, shape: "tube" {
        * material: MaterialId = "material", "name of a material";
        * outer_radius: f64 = "outer_radius", "outer radius \\[m\\]";
        * thickness: f64 = "thickness", "thickness of the wall \\[m\\]";
    }

    /// Specified by its stiffness and mass matrices.
    General => SectionId, shape: "general" {
        * stiffness: Matrix = "stiffness", "6 x 6 or its diagonal: axial, shear 2, shear 3, torsion, bending 2, bending 3 \\[N, N m²\\]";
        * mass: SectionMass = "mass", "6 x 6, or { per\\_length, inertia = \\[J11, J22, J33\\], center = \\[c2, c3\\] } \\[kg/m, kg m\\]";
    }

    /// Mass of a section, by its parts.
    SliceMass {
        * per_length: f64 = "per_length", "mass per length \\[kg/m\\]";
        * inertia: [f64; 3] = "inertia", "\\[J11, J22, J33\\] per length about the centre of mass \\[kg m\\]";
        center: [f64; 2] = "center", "\\[c2, c3\\]: centre of mass across the beam \\[m\\].";
    }
}

keys! {
    [Material, General]
        expansion: f64 = "expansion", "Strain per change of temperature; default 0 \\[1/K\\].";
}

keys! {
    [Rectangle, Circle, Tube]
        shear: Shear = "shear", "Shear coefficient: one or two numbers (along 2 and 3), \"cowper\" (default) or \"renton\".";
}

keys! {
    [Rectangle, Circle, Tube, General]
        damping: f64 = "damping", "Damping in proportion to the stiffness \\[s\\].";
}
