//! Normals of surfaces: of faces, and of the round surface to which neighbouring faces belong.

use std::collections::BTreeMap;

use lissom_motion::Vector3;

use super::mesh::Mesh;

/// Cosine of the angle [36°] between faces up to which their common edge is round.
const ROUND: f64 = 0.81;

/// Normals of a mesh.
#[derive(Clone, Debug)]
pub struct Normals {
    faces: Vec<Option<Vector3>>,
    /// The faces around every point.
    around: Vec<Vec<u32>>,
}

/// An edge of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Points of the edge, in ascending order.
    pub ends: [u32; 2],
    /// A face beside it.
    pub face: usize,
    /// The normal of that face.
    pub normal: Vector3,
    /// Whether it is not within a round surface: a border or a fold.
    pub is_border: bool,
}

impl Normals {
    /// Normals of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let mut around = vec![Vec::new(); mesh.points.len()];
        for (index, face) in mesh.faces.iter().enumerate() {
            for point in face {
                around[*point as usize].push(index as u32);
            }
        }
        let of = |face: &Vec<u32>| {
            normal(&face.iter().map(|point| mesh.points[*point as usize]).collect::<Vec<_>>())
        };
        Self { faces: mesh.faces.iter().map(of).collect(), around }
    }

    /// That of a face; none for a face without area.
    pub fn face(&self, face: usize) -> Option<Vector3> {
        self.faces[face]
    }

    /// That at a point of the round surface to which a face with the normal `own` belongs.
    pub fn at(&self, point: u32, own: &Vector3) -> Vector3 {
        let others = self.around[point as usize].iter().filter_map(|face| self.faces[*face as usize]);
        let sum: Vector3 = others.filter(|other| other.dot(own) > ROUND).sum();
        sum.try_normalize(0.0).unwrap_or(*own)
    }

    /// The edges of the mesh between faces with an area.
    pub fn edges(&self, mesh: &Mesh) -> Vec<Edge> {
        let mut beside: BTreeMap<[u32; 2], Vec<(usize, Vector3)>> = BTreeMap::new();
        for (index, (face, normal)) in mesh.faces.iter().zip(&self.faces).enumerate() {
            let Some(normal) = *normal else { continue };
            for (k, &from) in face.iter().enumerate() {
                let to = face[(k + 1) % face.len()];
                beside.entry([from.min(to), from.max(to)]).or_default().push((index, normal));
            }
        }
        let edge = |(ends, faces): ([u32; 2], Vec<(usize, Vector3)>)| {
            let (face, normal) = faces[0];
            let is_border = !matches!(faces[..], [(_, a), (_, b)] if a.dot(&b) > ROUND);
            Edge { ends, face, normal, is_border }
        };
        beside.into_iter().map(edge).collect()
    }
}

/// The normal of a face by Newell's formula; none for a face without area.
pub fn normal(points: &[Vector3]) -> Option<Vector3> {
    // Relative to the first point, so that positions far from the origin keep their digits.
    let from_first = |k: usize| points[k % points.len()] - points[0];
    let twice: Vector3 = (0..points.len()).map(|k| from_first(k).cross(&from_first(k + 1))).sum();
    twice.try_normalize(0.0)
}
