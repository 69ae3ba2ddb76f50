//! Blocks: hexahedra over u, v and w.

use lissom_motion::Vector3;

use crate::kinds::SOLID_KINDS;
use crate::mesh::MeshShape;
use crate::parts::meshed_part::{Element, MeshedPart};

/// Names of the sides: u = 0 and 1, v = 0 and 1, w = 0 and 1.
const SIDES: [&str; 6] = ["west", "east", "south", "north", "bottom", "top"];

/// A block with so many elements along u, v and w, of positions at these. Nodes are at half divisions, of which those at the middles of faces
/// and elements do not exist.
///
/// # Errors
/// The first place where the position is not finite.
pub fn block(position: impl Fn([f64; 3]) -> Vector3, divisions: [usize; 3]) -> Result<MeshedPart, [f64; 3]> {
    let [l, m, n] = divisions;
    let counts = divisions.map(|count| 2 * count + 1);
    let mut numbers = vec![usize::MAX; counts.iter().product()];
    let place = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
    let (mut part, mut places) = (MeshedPart { coordinates: 3, ..MeshedPart::default() }, Vec::new());
    for k in 0..counts[2] {
        for j in 0..counts[1] {
            for i in (0..counts[0]).filter(|i| i % 2 + j % 2 + k % 2 < 2) {
                let own: [f64; 3] = std::array::from_fn(|c| [i, j, k][c] as f64 / (counts[c] - 1) as f64);
                let position = position(own);
                if !position.iter().all(|x| x.is_finite()) {
                    return Err(own);
                }
                for (c, [low, high]) in [[0, 1], [2, 3], [4, 5]].into_iter().enumerate() {
                    for (side, value) in [(low, 0.0), (high, 1.0)] {
                        if own[c] == value {
                            part.sets.entry(SIDES[side].to_owned()).or_default().push(part.positions.len());
                        }
                    }
                }
                numbers[place([i, j, k])] = part.positions.len();
                part.positions.push(position);
                places.push(own);
            }
        }
    }
    let shape = MeshShape::Hexahedron20;
    let kind = shape.solid_kind().map_or(SOLID_KINDS[0], |(kind, _)| kind);
    for element in 0..l * m * n {
        let first = [element % l, element / l % m, element / (l * m)];
        let node = |node: usize| {
            let own = kind.node(node);
            numbers[place(std::array::from_fn(|c| (2 * first[c] + 1).wrapping_add_signed(own[c] as isize)))]
        };
        part.elements.push(Element { shape, nodes: (0..kind.node_count()).map(node).collect() });
    }
    part.places = Some(places);
    Ok(part)
}
