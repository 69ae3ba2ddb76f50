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
mod tests {
    use super::*;

    const ALUMINIUM: Isotropic =
        Isotropic { young: 73e9, shear: 73e9 / 2.6, density: 2680.0, expansion: 23e-6 };

    #[test]
    fn the_benchmark_beam_has_its_published_section() {
        // Bauchau, Betsch, Cardona, Gerstmayr, Jonker, Masarati, Sonneville 2016: aluminium 100 x 10 mm, with the
        // thin side along axis 2; EA 73e6 N, GJ 877.2 N m², EI 60 830 and 608.3 N m², 2.68 kg/m.
        let shape = rectangle::Rectangle { width: 0.01, height: 0.1 };
        let section = SectionProperties::homogeneous(&shape, &ALUMINIUM, Shear::Given(5.0 / 6.0, 5.0 / 6.0));
        let k = section.stiffness;
        let close = |found: f64, wanted: f64, digits: f64| (found / wanted - 1.0).abs() < digits;
        assert!(close(k[(0, 0)], 73e6, 1e-12));
        assert!(close(k[(2, 2)], 23.40e6, 1e-3));
        // The exact series gives 876.9 with this modulus: the published digits are rounded.
        assert!(close(k[(3, 3)], 877.2, 5e-4), "{}", k[(3, 3)]);
        assert!(close(k[(4, 4)], 60_830.0, 1e-4));
        assert!(close(k[(5, 5)], 608.3, 1e-4));
        let m = section.mass;
        assert!(close(m[(0, 0)], 2.68, 1e-12));
        assert!(close(m[(4, 4)], 2.233e-3, 1e-3) && close(m[(5, 5)], 2.233e-5, 1e-3));
        assert!(close(m[(3, 3)], m[(4, 4)] + m[(5, 5)], 1e-14));
    }

    #[test]
    fn a_tube_without_hole_is_a_circle() {
        let tube = tube::Tube { outer: 0.015, inner: 0.0 };
        let circle = circle::Circle { radius: 0.015 };
        for theory in [ShearTheory::Cowper, ShearTheory::Renton] {
            let of = |shape: &dyn CrossSection| {
                SectionProperties::homogeneous(shape, &ALUMINIUM, Shear::Theory(theory))
            };
            assert!((of(&tube).stiffness - of(&circle).stiffness).norm() < 1e-9 * of(&tube).stiffness.norm());
        }
        let polar = circle.integrals();
        assert!((polar.torsion / (std::f64::consts::PI * 0.015_f64.powi(4) / 2.0) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_mass_matrix_gives_the_kinetic_energy_of_the_slice() {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, 0.2));
        let mass = mass_matrix(2.0, &inertia, [0.4, -0.7]);
        let (v, w) = (Vector3::new(0.3, -1.0, 0.6), Vector3::new(1.1, 0.4, -0.9));
        let centre = v + w.cross(&Vector3::new(0.0, 0.4, -0.7));
        let energy = centre.norm_squared() + 0.5 * w.dot(&(inertia * w));
        let twist = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        assert!((0.5 * twist.dot(&(mass * twist)) - energy).abs() < 1e-13);
        assert_eq!(mass, mass.transpose());
    }

    #[test]
    fn a_tapered_section_is_linear_between_its_stations() {
        let of = |radius| {
            SectionProperties::homogeneous(&circle::Circle { radius }, &ALUMINIUM, Shear::Given(1.0, 1.0))
        };
        let middle = of(0.01).towards(&of(0.03), 0.25);
        let wanted = 0.75 * of(0.01).stiffness[(3, 3)] + 0.25 * of(0.03).stiffness[(3, 3)];
        assert!((middle.stiffness[(3, 3)] / wanted - 1.0).abs() < 1e-15);
    }
}
