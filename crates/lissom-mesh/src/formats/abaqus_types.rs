//! Types of elements of Abaqus and CalculiX.

use crate::kinds::SOLID_KINDS;
use crate::mesh::MeshShape;

/// What is done with elements of a type.
#[derive(Debug, PartialEq)]
pub(crate) enum Treatment {
    /// They are read.
    Read(MeshShape),
    /// They are read, and a note states as what.
    ReadAs(MeshShape, &'static str),
    /// They have no shape, such as springs, and are left out.
    LeaveOut,
    /// They cannot be read; with a remedy.
    Reject(&'static str),
}

const TRIANGLES: [&str; 5] = ["S3", "S3R", "S3RS", "STRI3", "M3D3"];
const QUADRILATERALS: [&str; 7] = ["S4", "S4R", "S4RS", "S4RSW", "S4R5", "M3D4", "M3D4R"];
const LINES: [&str; 9] = ["T3D2", "T3D2H", "B31", "B31R", "B31H", "B31OS", "B31OSH", "B33", "B33H"];
/// Flat, rigid and surface elements: meshers such as Gmsh write surfaces as these.
const OTHER_TRIANGLES: [&str; 4] = ["CPS3", "CPE3", "R3D3", "SFM3D3"];
const OTHER_QUADRILATERALS: [&str; 9] =
    ["CPS4", "CPS4R", "CPS4I", "CPE4", "CPE4R", "CPE4I", "R3D4", "SFM3D4", "SFM3D4R"];
/// Beginnings of the names of types without a shape.
const WITHOUT_SHAPE: [&str; 8] = ["MASS", "ROTARYI", "SPRING", "DASHPOT", "CONN", "GAP", "DCOUP", "HEATCAP"];
const TRIANGLES_6: [&str; 3] = ["STRI65", "S6", "M3D6"];
const QUADRILATERALS_8: [&str; 5] = ["S8", "S8R", "S8R5", "M3D8", "M3D8R"];
const OTHER_TRIANGLES_6: [&str; 3] = ["CPS6", "CPE6", "SFM3D6"];
const OTHER_QUADRILATERALS_8: [&str; 6] = ["CPS8", "CPS8R", "CPE8", "CPE8R", "SFM3D8", "SFM3D8R"];

/// What is done with a type, in upper case.
pub(crate) fn treatment(name: &str) -> Treatment {
    use Treatment::{LeaveOut, Read, ReadAs, Reject};
    let read: [(&[&str], MeshShape); 7] = [
        (&TRIANGLES, MeshShape::Triangle3),
        (&QUADRILATERALS, MeshShape::Quadrilateral4),
        (&LINES, MeshShape::Line2),
        (&["T3D3"], MeshShape::Line3),
        (&TRIANGLES_6, MeshShape::Triangle6),
        (&QUADRILATERALS_8, MeshShape::Quadrilateral8),
        (&["S9R5", "M3D9"], MeshShape::Quadrilateral9),
    ];
    let solids = SOLID_KINDS.iter().flat_map(|kind| kind.abaqus.into_iter().zip(kind.shapes));
    if let Some((_, shape)) = read.into_iter().chain(solids).find(|(names, _)| names.contains(&name)) {
        return Read(shape);
    }
    let others: [(&[&str], MeshShape, &'static str); 4] = [
        (&OTHER_TRIANGLES, MeshShape::Triangle3, "triangles of a surface"),
        (&OTHER_TRIANGLES_6, MeshShape::Triangle6, "triangles of a surface"),
        (&OTHER_QUADRILATERALS, MeshShape::Quadrilateral4, "quadrilaterals of a surface"),
        (&OTHER_QUADRILATERALS_8, MeshShape::Quadrilateral8, "quadrilaterals of a surface"),
    ];
    if let Some((_, shape, what)) = others.into_iter().find(|(names, ..)| names.contains(&name)) {
        return ReadAs(shape, what);
    }
    if WITHOUT_SHAPE.iter().any(|start| name.starts_with(start)) {
        return LeaveOut;
    }
    if name.starts_with("C3D") {
        return Reject("mesh with C3D4, C3D10, C3D6, C3D15, C3D8 or C3D20 instead");
    }
    Reject("remove these elements, or mesh with S3, S4, S6, S8, C3D4, C3D10, C3D6, C3D15, C3D8 or C3D20")
}

#[cfg(test)]
#[path = "../../tests/unit/formats/abaqus_types.rs"]
mod tests;
