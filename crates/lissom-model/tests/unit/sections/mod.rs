//! Tests of `sections`, a module of it.

use super::*;

const ALUMINIUM: Isotropic = Isotropic { young: 73e9, shear: 73e9 / 2.6, density: 2680.0, expansion: 23e-6 };

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
