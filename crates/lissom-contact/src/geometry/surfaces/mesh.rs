//! A closed surface of triangles.
//!
//! ```text
//! nearest in a triangle:   n its normal, H = 0
//! on an edge along e:      n = ±(y - p)/|y - p|,   H = (I - n nᵀ - e eᵀ)/φ
//! in a corner:             n = ±(y - p)/|y - p|,   H = (I - n nᵀ)/φ
//! ```

use std::collections::HashMap;
use std::fmt;

use lissom_motion::{Matrix3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector as Point;
use parry3d_f64::query::{PointQueryWithLocation, Ray, RayCast};
use parry3d_f64::shape::{TriMesh, TriMeshFlags, TrianglePointLocation};
use parry3d_f64::transformation::try_convex_hull;

use super::{Distance, Surface};
use lissom_mechanics::round_off;

/// A surface that encloses no solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// An edge is not shared by two triangles that run along it in opposite directions.
    #[error("it is not closed: {0} edges are not shared by two triangles of the same orientation")]
    Open(usize),
    /// It has no volume, or is inside out.
    #[error("it encloses no volume, or its triangles are seen from inside")]
    NoVolume,
    /// The points of the mesh have no convex hull.
    #[error("its points are in a plane")]
    Flat,
}

/// A closed surface of triangles, counterclockwise as seen from outside.
pub struct Mesh {
    shape: TriMesh,
    normals: Vec<Vector3>,
    size: f64,
    depth: f64,
}

impl Mesh {
    /// Mesh of points and the indices of those of each triangle.
    ///
    /// # Errors
    /// If it is not closed, or encloses no volume.
    pub fn new(points: &[Vector3], triangles: &[[u32; 3]]) -> Result<Self, MeshError> {
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        let mut distinct: Vec<Vector3> = Vec::new();
        let index: Vec<u32> = points
            .iter()
            .map(|point| {
                // -0 and 0 are one place.
                let bits: [u64; 3] = std::array::from_fn(|k| (point[k] + 0.0).to_bits());
                *known.entry(bits).or_insert_with(|| {
                    distinct.push(*point);
                    distinct.len() as u32 - 1
                })
            })
            .collect();
        let triangles: Vec<[u32; 3]> = triangles
            .iter()
            .map(|corners| corners.map(|corner| index[corner as usize]))
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for [a, b, c] in &triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (key, way) = if from < to { ((*from, *to), 1) } else { ((*to, *from), -1) };
                *edges.entry(key).or_default() += way;
            }
        }
        let open = edges.values().filter(|count| **count != 0).count();
        if open > 0 {
            return Err(MeshError::Open(open));
        }
        let corner = |corners: &[u32; 3]| corners.map(|index| distinct[index as usize]);
        let volume: f64 = triangles.iter().map(corner).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum();
        if volume.is_nan() || volume <= 0.0 {
            return Err(MeshError::NoVolume);
        }
        let normals = triangles.iter().map(corner).map(|[a, b, c]| (b - a).cross(&(c - a)).normalize());
        let normals = normals.collect();
        let size = distinct.iter().map(Vector3::norm).fold(0.0, f64::max);
        let points = distinct.iter().map(|point| Point::new(point.x, point.y, point.z)).collect();
        let shape = TriMesh::with_flags(points, triangles, TriMeshFlags::ORIENTED)
            .map_err(|_| MeshError::NoVolume)?;
        let mut mesh = Self { shape, normals, size, depth: f64::INFINITY };
        mesh.depth = mesh.thickness();
        Ok(mesh)
    }

    /// The convex hull of points.
    ///
    /// # Errors
    /// If they are in a plane.
    pub fn hull(points: &[Vector3]) -> Result<Self, MeshError> {
        let points: Vec<Point> = points.iter().map(|point| Point::new(point.x, point.y, point.z)).collect();
        let (points, triangles) = try_convex_hull(&points).map_err(|_| MeshError::Flat)?;
        let points: Vec<Vector3> =
            points.iter().map(|point| Vector3::new(point.x, point.y, point.z)).collect();
        Self::new(&points, &triangles)
    }

    /// Corners of the mesh [m].
    pub fn corners(&self) -> impl Iterator<Item = Vector3> {
        self.shape.vertices().iter().map(|point| Vector3::new(point.x, point.y, point.z))
    }

    /// Indices of the corners of its triangles.
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.shape.indices()
    }

    /// Points of its planes, each with its normal.
    fn planes(&self) -> impl Iterator<Item = (Vector3, Vector3)> {
        let start = |corners: &[u32; 3]| self.shape.vertices()[corners[0] as usize];
        let starts = self.triangles().iter().map(start).map(|point| Vector3::new(point.x, point.y, point.z));
        starts.zip(self.normals.iter().copied())
    }

    /// A hull with all faces moved inwards by `inset` [m]. Its corners are the faces of the hull of the reciprocal points
    /// n/(n·(p - o) - inset) of its faces, about the centre of volume o.
    ///
    /// # Errors
    /// If nothing remains.
    pub fn inset(&self, inset: f64) -> Result<Self, MeshError> {
        let corners: Vec<Vector3> = self.corners().collect();
        let (mut centre, mut volume) = (Vector3::zeros(), 0.0);
        for [a, b, c] in
            self.triangles().iter().map(|own| own.map(|index| corners[index as usize] - corners[0]))
        {
            let share = a.dot(&b.cross(&c));
            (centre, volume) = (centre + 0.25 * share * (a + b + c), volume + share);
        }
        let centre = corners[0] + centre / volume;
        let reciprocal =
            |(point, normal): (Vector3, Vector3)| normal / (normal.dot(&(point - centre)) - inset);
        let dual = Self::hull(&distinct(self.planes().map(reciprocal)))?;
        let corner = |(point, normal): (Vector3, Vector3)| normal / normal.dot(&point);
        Self::hull(&distinct(dual.planes().map(corner)).iter().map(|own| own + centre).collect::<Vec<_>>())
    }

    /// Ends of the edges of a hull, moved inwards by `inset` [m] from its faces.
    pub fn edges(&self, inset: f64) -> Vec<[Vector3; 2]> {
        let corners: Vec<Vector3> = self.corners().collect();
        let sides = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
        let of = |(own, normal)| sides(own).map(|side| (side, normal));
        let beside: HashMap<(u32, u32), Vector3> =
            self.triangles().iter().copied().zip(self.normals.iter().copied()).flat_map(of).collect();
        let mut all = Vec::new();
        for (from, to) in self.triangles().iter().copied().flat_map(sides).filter(|(from, to)| from < to) {
            let (one, other) = (beside[&(from, to)], beside[&(to, from)]);
            let width = 1.0 + one.dot(&other);
            // Triangles of one face have no edge between them.
            if 2.0 - width < round_off::GIVEN || width < round_off::GIVEN {
                continue;
            }
            let [from, to] = [from, to].map(|own| corners[own as usize] - inset / width * (one + other));
            let mut range = [0.0_f64, 1.0];
            for (point, normal) in self.planes() {
                let (outside, slope) = (normal.dot(&(from - point)) + inset, normal.dot(&(to - from)));
                if slope.abs() > round_off::OPERATIONS * self.size {
                    let end = usize::from(slope > 0.0);
                    let share = -outside / slope;
                    range[end] = if end == 1 { range[1].min(share) } else { range[0].max(share) };
                }
            }
            if range[1] - range[0] > round_off::GIVEN {
                all.push(range.map(|share| from + share * (to - from)));
            }
        }
        all
    }

    /// Half the smallest thickness below the middle of a triangle [m].
    fn thickness(&self) -> f64 {
        let of = |(index, normal): (usize, &Vector3)| {
            let triangle = self.shape.triangle(index as u32);
            let start = triangle.center();
            let inwards = Point::new(-normal.x, -normal.y, -normal.z);
            let ray = Ray::new(start + inwards * (1e-9 * self.size), inwards);
            self.shape.cast_local_ray(&ray, 2.0 * self.size, false).unwrap_or(self.size)
        };
        0.5 * self.normals.iter().enumerate().map(of).fold(f64::INFINITY, f64::min)
    }
}

/// Points without those that repeat others up to round-off.
fn distinct(points: impl Iterator<Item = Vector3>) -> Vec<Vector3> {
    let mut kept: Vec<Vector3> = Vec::new();
    for point in points {
        if kept.iter().all(|own| (own - point).norm() > round_off::POSITION * point.norm()) {
            kept.push(point);
        }
    }
    kept
}

impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mesh")
            .field("triangles", &self.normals.len())
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        self.triangles() == other.triangles() && self.corners().eq(other.corners())
    }
}

impl Surface for Mesh {
    fn depth(&self) -> f64 {
        self.depth
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let point = Point::new(y.x, y.y, y.z);
        let (nearest, (triangle, location)) = self.shape.project_local_point_and_get_location(point, false);
        let foot = Vector3::new(nearest.point.x, nearest.point.y, nearest.point.z);
        let normal = self.normals[triangle as usize];
        let away = y - foot;
        let length = away.norm();
        let edge = match location {
            TrianglePointLocation::OnVertex(_) => Some(Vector3::zeros()),
            TrianglePointLocation::OnEdge(index, _) => {
                let corners = self.shape.triangle(triangle).vertices().map(|v| Vector3::new(v.x, v.y, v.z));
                let index = index as usize;
                Some((corners[(index + 1) % 3] - corners[index]).normalize())
            }
            _ => None,
        };
        match edge {
            Some(edge) if length > round_off::OPERATIONS * self.size => {
                let value = if nearest.is_inside { -length } else { length };
                let normal = away / value;
                let across = Matrix3::identity() - normal * normal.transpose() - edge * edge.transpose();
                Distance { value, normal, curvature: across / value }
            }
            _ => Distance { value: normal.dot(&away), normal, curvature: Matrix3::zeros() },
        }
    }

    fn has_hollows(&self) -> bool {
        true
    }

    fn sides(&self, y: &Vector3, within: f64, visit: &mut dyn FnMut(&Distance)) {
        let vector = |point: Point| Vector3::new(point.x, point.y, point.z);
        let centre = Point::new(y.x, y.y, y.z);
        let around = Aabb::from_half_extents(centre, Point::splat(within));
        for triangle in self.shape.bvh().intersect_aabb(&around) {
            let own = self.shape.triangle(triangle);
            let (nearest, location) = own.project_local_point_and_get_location(centre, false);
            let away = y - vector(nearest.point);
            let (value, outwards) = (away.norm(), self.normals[triangle as usize].dot(&away));
            if value >= within || outwards <= 0.0 {
                continue;
            }
            // A point on an edge is the nearest one of all around it if it remains the nearest one closer to it.
            let is_within = matches!(location, TrianglePointLocation::OnFace(..));
            let closer = || self.distance(&(y - 0.5 * away)).value;
            if is_within || closer() >= 0.5 * value - round_off::OPERATIONS * self.size {
                visit(&Distance { value, normal: away / value, curvature: Matrix3::zeros() });
            }
        }
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/geometry/surfaces/mesh.rs"]
mod tests;
