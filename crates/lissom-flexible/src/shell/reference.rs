//! A shell element in its stress-free state: tangents, local axes and areas at points of the element.

use lissom_motion::Vector3;
use nalgebra::{Matrix2, Vector2};

use super::quadrilateral::{CORNERS, STRAINS, bilinear};

/// Sine of the angle to the normal, 0.1 degrees, below which a direction has no projection on the surface.
const PARALLEL: f64 = 1.745e-3;

/// Positions of an element's four nodes, global axes.
#[derive(Clone, Debug)]
pub(super) struct Reference {
    pub(super) positions: [Vector3; 4],
    /// Direction of the first local axis, before it is projected on the surface.
    pub(super) first: Vector3,
}

/// Local axes and the map from r and s to lengths along them at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalAxes {
    pub(super) first: Vector3,
    pub(super) normal: Vector3,
    /// `J[α][i] = g_α · a_i`.
    pub(super) jacobian: Matrix2<f64>,
    /// Area per r and s.
    pub(super) area: f64,
}

impl Reference {
    /// Four positions; `direction` is projected on the surface to be the first local axis, and the global z axis where it is within 0.1
    /// degrees of the normal. Without one it bisects the element's mean directions, so that it does not depend on the node with which
    /// the element begins by more than quarter turns.
    pub(super) fn new(positions: [Vector3; 4], direction: Option<Vector3>) -> Self {
        let mut own = Self { positions, first: Vector3::x() };
        let [along, across] = own.tangents(0.0, 0.0).map(|tangent| tangent.normalize());
        let bisector = (along + across).normalize() + (along - across).normalize();
        let normal = along.cross(&across).normalize();
        own.first = direction.map_or(bisector, |given| {
            if given.cross(&normal).norm() > PARALLEL * given.norm() { given } else { Vector3::z() }
        });
        own
    }

    /// Derivatives of the position with respect to r and s.
    pub(super) fn tangents(&self, r: f64, s: f64) -> [Vector3; 2] {
        let [_, by_r, by_s] = bilinear(r, s);
        [by_r, by_s].map(|by| (0..4).map(|i| by[i] * self.positions[i]).sum())
    }

    /// Local axes at (r, s).
    pub(super) fn axes(&self, r: f64, s: f64) -> LocalAxes {
        let [along, across] = self.tangents(r, s);
        let cross = along.cross(&across);
        let area = cross.norm();
        let normal = cross / area;
        let first = (self.first - normal * self.first.dot(&normal)).normalize();
        let second = normal.cross(&first);
        let jacobian =
            Matrix2::new(along.dot(&first), along.dot(&second), across.dot(&first), across.dot(&second));
        LocalAxes { first, normal, jacobian, area }
    }

    /// The natural strains, see `strains`, of local strains ε11, ε22, 2 ε12, κ11, κ22, 2 κ12 that are the same everywhere.
    pub(super) fn natural_strains(&self, local: &[f64; 6]) -> [f64; STRAINS] {
        let mut strains = [0.0; STRAINS];
        // The middles of the edges and the centre, with the natural coordinates of the strain there.
        let places =
            [(0.0, -1.0, 0, 0), (0.0, 1.0, 0, 0), (-1.0, 0.0, 1, 1), (1.0, 0.0, 1, 1), (0.0, 0.0, 0, 1)];
        for (k, (r, s, i, j)) in places.into_iter().enumerate() {
            let jacobian = self.axes(r, s).jacobian;
            for part in 0..2 {
                let [first, second, shear] = [0, 1, 2].map(|l| local[3 * part + l]);
                let tensor = Matrix2::new(first, 0.5 * shear, 0.5 * shear, second);
                strains[5 * part + k] = (jacobian.row(i) * tensor).dot(&jacobian.row(j));
            }
        }
        strains
    }

    /// Unit normal at each node.
    pub(super) fn nodal_normals(&self) -> [Vector3; 4] {
        CORNERS.map(|(r, s)| self.axes(r, s).normal)
    }

    /// `x_d = c_r x_r + c_s x_s`, least squares: how far the element is from a parallelogram.
    pub(super) fn distortion(&self) -> Vector2<f64> {
        let [x_r, x_s] = self.tangents(0.0, 0.0);
        let p = &self.positions;
        let x_d = 0.25 * (p[0] - p[1] + p[2] - p[3]);
        let gram = Matrix2::new(x_r.dot(&x_r), x_r.dot(&x_s), x_r.dot(&x_s), x_s.dot(&x_s));
        let right = Vector2::new(x_d.dot(&x_r), x_d.dot(&x_s));
        gram.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * right)
    }
}
