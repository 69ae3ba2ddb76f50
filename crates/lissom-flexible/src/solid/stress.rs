//! Stresses of a solid element at its nodes, extrapolated from the points where they are most accurate.

use lissom_motion::{Matrix3, Vector3};

use super::deformation::Deformation;
use super::reference::gradients;
use super::shape::{self, Functions, Natural};
use super::{Hexahedron, Solid, Tetrahedron};

/// Cauchy stress in global axes [Pa].
pub type CauchyStress = Matrix3;

/// Von Mises stress [Pa].
pub fn von_mises(stress: &CauchyStress) -> f64 {
    let deviator = stress - Matrix3::from_diagonal_element(stress.trace() / 3.0);
    (1.5 * deviator.norm_squared()).sqrt()
}

/// Largest principal stress [Pa].
pub fn principal(stress: &CauchyStress) -> f64 {
    stress.symmetric_eigenvalues().max()
}

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    /// Stress at a point.
    fn stress_at(
        &self,
        displacements: &[Vector3; NODES],
        mean: f64,
        functions: &Functions<NODES>,
    ) -> CauchyStress {
        let Ok((slopes, _)) = gradients(functions, &self.reference.positions) else {
            return CauchyStress::repeat(f64::NAN);
        };
        let point = Deformation::new(displacements, &slopes);
        self.law.first_stress(&point, mean) * point.gradient.transpose() / point.determinant
    }

    /// Stresses at the nodes from those at `COUNT` points, by functions that extrapolate from these.
    fn extrapolated<const COUNT: usize>(
        &self,
        positions: &[Vector3; NODES],
        functions: fn(Natural) -> Functions<NODES>,
        points: [Natural; COUNT],
        shares: impl Fn(usize) -> [f64; COUNT],
    ) -> [CauchyStress; NODES] {
        let (displacements, mean) = (self.displacements(positions), self.deformed_to(positions).mean);
        let known = points.map(|point| self.stress_at(&displacements, mean, &functions(point)));
        std::array::from_fn(|node| {
            let shares = shares(node);
            known.iter().zip(shares).map(|(stress, share)| share * stress).sum()
        })
    }

    /// Its volume at rest [m³].
    pub fn volume(&self) -> f64 {
        self.reference.volume
    }
}

impl Tetrahedron {
    /// Stresses at the nodes, which are at these positions: linear between the points of quadrature.
    pub fn nodal_stresses(&self, positions: &[Vector3; 10]) -> [CauchyStress; 10] {
        let points = shape::tetrahedron_points().map(|(point, _)| point);
        let [far, near] = [points[1][0], points[0][0]];
        self.extrapolated(positions, shape::tetrahedron, points, |node| {
            let [x, y, z] = shape::tetrahedron_node(node);
            // Volume coordinates of the tetrahedron of the points.
            [1.0 - x - y - z, x, y, z].map(|own| (own - near) / (far - near))
        })
    }
}

impl Hexahedron {
    /// Stresses at the nodes, which are at these positions: trilinear between 2 x 2 x 2 points of Gauss.
    pub fn nodal_stresses(&self, positions: &[Vector3; 20]) -> [CauchyStress; 20] {
        let near = (1.0_f64 / 3.0).sqrt();
        let signs: [Natural; 8] = std::array::from_fn(shape::hexahedron_node);
        let points = signs.map(|point| point.map(|sign| near * sign));
        self.extrapolated(positions, shape::hexahedron, points, |node| {
            let place = shape::hexahedron_node(node);
            signs.map(|sign| (0..3).map(|k| 0.5 * (1.0 + sign[k] * place[k] / near)).product())
        })
    }
}
