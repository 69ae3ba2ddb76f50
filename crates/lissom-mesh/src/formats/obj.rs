//! Files of Wavefront (`obj`): vertices, faces of three or four corners, lines, groups and objects.
//!
//! The elements of a group and of an object are a set of elements, and their nodes a set of nodes, with its name.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::MeshError;
use crate::formats::draft::Draft;
use crate::formats::fields::{Lines, quote, real};
use crate::mesh::{Mesh, MeshShape};

/// What belongs to pictures, not to a mesh.
const APPEARANCE: [&str; 6] = ["vt", "vn", "s", "usemtl", "mtllib", "usemap"];

pub(crate) fn read(text: &str) -> Result<Mesh, MeshError> {
    let (mut draft, mut lines) = (Draft::default(), Lines::new(text));
    let (mut groups, mut object) = (Vec::<String>::new(), None::<String>);
    let mut element_sets: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
    let mut left_out: BTreeMap<String, usize> = BTreeMap::new();
    while let Some((line, content)) = lines.next() {
        let mut statement = content.to_owned();
        while statement.ends_with('\\') {
            statement.pop();
            let Some((_, more)) = lines.next() else { break };
            statement.push_str(more);
        }
        let statement = statement.split('#').next().unwrap_or("");
        let mut fields = statement.split_whitespace();
        let Some(word) = fields.next() else { continue };
        let fields: Vec<&str> = fields.collect();
        match word {
            "v" => {
                let [x, y, z, ..] = fields.as_slice() else {
                    let found = format!("a vertex of {} coordinates", fields.len());
                    return Err(MeshError::at(line, found, "write three coordinates"));
                };
                let position = [real(line, x)?, real(line, y)?, real(line, z)?];
                draft.add_node(line, draft.mesh.positions.len() as u64 + 1, position)?;
            }
            "f" | "l" => {
                let nodes: Result<Vec<u64>, MeshError> =
                    fields.iter().map(|field| vertex(line, field, draft.mesh.positions.len())).collect();
                for (shape, nodes) in shapes(line, word, nodes?)? {
                    let number = draft.mesh.elements.len() as u64 + 1;
                    let index = draft.add_element(line, number, shape, nodes)?;
                    for name in groups.iter().chain(&object) {
                        if let Some(set) = element_sets.get_mut(name) {
                            set.insert(index);
                        } else {
                            element_sets.insert(name.clone(), BTreeSet::from([index]));
                        }
                    }
                }
            }
            "g" => groups = fields.into_iter().map(str::to_owned).collect(),
            "o" => object = Some(fields.join(" ")).filter(|name| !name.is_empty()),
            _ if APPEARANCE.contains(&word) => {}
            _ => {
                left_out.entry(word.to_owned()).or_insert(line);
            }
        }
    }
    draft.connect(lines.number)?;
    let mut mesh = draft.mesh;
    mesh.notes =
        left_out.iter().map(|(word, line)| format!("line {line}: {} is not read", quote(word))).collect();
    mesh.element_sets =
        element_sets.into_iter().map(|(name, set)| (name, set.into_iter().collect())).collect();
    mesh.node_sets = mesh.element_sets.iter().map(|(name, set)| (name.clone(), mesh.nodes_of(set))).collect();
    Ok(mesh)
}

/// Number of a vertex such as `3`, `3/1/2`, or `-1` for the last one.
fn vertex(line: usize, field: &str, count: usize) -> Result<u64, MeshError> {
    let text = field.split('/').next().unwrap_or("");
    let number = match text.parse::<i64>() {
        Ok(number) if number > 0 => u64::try_from(number).ok(),
        Ok(number) if number < 0 => {
            (count as u64 + 1).checked_sub(number.unsigned_abs()).filter(|own| *own > 0)
        }
        _ => None,
    };
    number.ok_or_else(|| {
        let found = format!("{} is no number of a vertex", quote(field));
        MeshError::at(line, found, "write a number from 1, or from -1 for the last vertex backwards")
    })
}

/// Elements of a face or of a line.
fn shapes(line: usize, word: &str, nodes: Vec<u64>) -> Result<Vec<(MeshShape, Vec<u64>)>, MeshError> {
    match (word, nodes.len()) {
        ("f", 3) => Ok(vec![(MeshShape::Triangle3, nodes)]),
        ("f", 4) => Ok(vec![(MeshShape::Quadrilateral4, nodes)]),
        ("l", 2..) => Ok(nodes.windows(2).map(|pair| (MeshShape::Line2, pair.to_vec())).collect()),
        ("l", count) => {
            Err(MeshError::at(line, format!("a line of {count} vertices"), "write at least two vertices"))
        }
        (_, count) => {
            let remedy = "divide it into triangles and quadrilaterals when exporting";
            Err(MeshError::at(line, format!("a face of {count} vertices"), remedy))
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/formats/obj.rs"]
pub(crate) mod tests;
