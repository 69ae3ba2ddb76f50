//! Cross sections: from shape and material to 6 x 6 stiffness and mass per length.
//!
//! Order of strains and forces: axial, shear 2, shear 3, torsion, bending 2, bending 3; of velocities:
//! translations 1, 2, 3, then rotations 1, 2, 3. Axis 1 runs along the beam through the centroid.
//!
//! A shape is one file and one line of `KINDS`.

mod circle;
mod cross_section;
mod outline;
mod rectangle;
mod shear;
mod torsion;
mod tube;

pub use outline::Outline;

use lissom_motion::{Matrix3, Matrix6, Vector3, Vector6, skew};

pub(crate) use cross_section::{CrossSection, SectionKind};
pub use shear::ShearTheory;
pub use torsion::rectangle_torsion_constant;

use cross_section::Integrals;

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropic {
    /// Young's modulus E [Pa].
    pub young: f64,
    /// Shear modulus G [Pa].
    pub shear: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Strain per change of temperature [1/K].
    pub expansion: f64,
}

impl Isotropic {
    /// Poisson's ratio `ν = E/(2G) - 1`.
    pub fn poisson(&self) -> f64 {
        self.young / (2.0 * self.shear) - 1.0
    }
}

/// All shapes that a section is computed from, one line each.
pub(crate) const KINDS: [SectionKind; 3] = [rectangle::KIND, circle::KIND, tube::KIND];

/// Names of all shapes, with that of sections that are given by numbers.
pub(crate) const NAMES: [&str; KINDS.len() + 1] = {
    let mut names = [GENERAL; KINDS.len() + 1];
    let mut index = 0;
    while index < KINDS.len() {
        names[index] = KINDS[index].name;
        index += 1;
    }
    names
};

/// The shape of sections that are given by their stiffness and mass.
pub(crate) const GENERAL: &str = "general";

/// How the shear coefficients are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shear {
    /// From the shape, by a theory.
    Theory(ShearTheory),
    /// Given: for shear along axes 2 and 3.
    Given(f64, f64),
}

/// Stiffness and mass per length of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionProperties {
    /// Stiffness: [N] for the strains 1-3, [N m²] for the curvatures 4-6.
    pub stiffness: Matrix6,
    /// Mass per length: [kg/m] for the translations, [kg m] for the rotations.
    pub mass: Matrix6,
    /// Damping proportional to the stiffness [s].
    pub damping: f64,
    /// Strain per change of temperature [1/K].
    pub expansion: f64,
}

impl SectionProperties {
    /// A homogeneous section of one isotropic material; without damping.
    pub(crate) fn homogeneous(shape: &dyn CrossSection, material: &Isotropic, shear: Shear) -> Self {
        let Integrals { area, second, torsion } = shape.integrals();
        let [k2, k3] = match shear {
            Shear::Theory(theory) => shape.shear_coefficients(theory, material.poisson()),
            Shear::Given(k2, k3) => [k2, k3],
        };
        let Isotropic { young, shear, density, expansion } = *material;
        let diagonal = [
            young * area,
            k2 * shear * area,
            k3 * shear * area,
            shear * torsion,
            young * second[0],
            young * second[1],
        ];
        let inertia =
            Matrix3::from_diagonal(&Vector3::new(second[0] + second[1], second[0], second[1])) * density;
        Self {
            stiffness: Matrix6::from_diagonal(&Vector6::from_column_slice(&diagonal)),
            mass: mass_matrix(density * area, &inertia, [0.0, 0.0]),
            damping: 0.0,
            expansion,
        }
    }

    /// The properties at `fraction` of the way from `self` to `other`, each entry linear.
    pub fn towards(&self, other: &Self, fraction: f64) -> Self {
        let (a, b) = (1.0 - fraction, fraction);
        Self {
            stiffness: self.stiffness * a + other.stiffness * b,
            mass: self.mass * a + other.mass * b,
            damping: self.damping * a + other.damping * b,
            expansion: self.expansion * a + other.expansion * b,
        }
    }
}

/// The mass matrix of a slice: mass per length [kg/m], inertia per length about the centre of mass [kg m], and
/// the centre of mass along axes 2 and 3 [m].
pub(crate) fn mass_matrix(per_length: f64, inertia: &Matrix3, center: [f64; 2]) -> Matrix6 {
    // A point of the slice moves with v - c × ω: momentum m(v - c̃ω), moment of momentum c̃p + Jω.
    let c = skew(&Vector3::new(0.0, center[0], center[1]));
    let mut mass = Matrix6::zeros();
    mass.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * per_length));
    mass.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-c * per_length));
    mass.fixed_view_mut::<3, 3>(3, 0).copy_from(&(c * per_length));
    mass.fixed_view_mut::<3, 3>(3, 3).copy_from(&(inertia - c * c * per_length));
    mass
}

#[cfg(test)]
#[path = "../../tests/unit/sections/mod.rs"]
mod tests;
