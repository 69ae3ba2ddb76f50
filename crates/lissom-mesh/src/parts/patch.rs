//! Patches: quadrilaterals over u and v.

use lissom_motion::Vector3;

use crate::mesh::MeshShape;
use crate::parts::meshed_part::{Element, MeshedPart};

/// Names of the sides: u = 0 and 1, v = 0 and 1.
const SIDES: [&str; 4] = ["west", "east", "south", "north"];

/// A place of a surface without a normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchFault(pub [f64; 2]);

/// A patch with `m` by `n` elements of a surface, which is its position at u and v with its derivatives by both.
///
/// # Errors
/// The first place where the sides of the surface are parallel, have no length, or are not finite.
pub fn patch(
    surface: impl Fn(f64, f64) -> [Vector3; 3],
    [m, n]: [usize; 2],
) -> Result<MeshedPart, PatchFault> {
    let (mut part, mut places, mut normals) =
        (MeshedPart { coordinates: 2, ..MeshedPart::default() }, Vec::new(), Vec::new());
    for j in 0..=n {
        for i in 0..=m {
            let [u, v] = [i as f64 / m as f64, j as f64 / n as f64];
            let [position, along, across] = surface(u, v);
            let normal = along.cross(&across);
            let size = along.norm() * across.norm();
            if !(normal.norm() > 1e-8 * size && position.iter().all(|x| x.is_finite())) {
                return Err(PatchFault([u, v]));
            }
            part.positions.push(position);
            places.push([u, v, 0.0]);
            normals.push(normal.normalize());
        }
    }
    let node = |i: usize, j: usize| j * (m + 1) + i;
    part.elements.extend((0..m * n).map(|k| {
        let (i, j) = (k % m, k / m);
        let nodes = vec![node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        Element { shape: MeshShape::Quadrilateral4, nodes }
    }));
    let sides: [Vec<usize>; 4] = [
        (0..=n).map(|j| node(0, j)).collect(),
        (0..=n).map(|j| node(m, j)).collect(),
        (0..=m).map(|i| node(i, 0)).collect(),
        (0..=m).map(|i| node(i, n)).collect(),
    ];
    part.sets.extend(SIDES.map(str::to_owned).into_iter().zip(sides));
    (part.places, part.normals) = (Some(places), Some(normals));
    Ok(part)
}
