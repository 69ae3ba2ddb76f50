//! Why a file or a part of it is rejected.

/// Why a mesh cannot be read or taken apart.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// The ending of the file is unknown.
    #[error(
        "`{found}` is no format of meshes; known are `msh` (Gmsh), `inp` (Abaqus, CalculiX), `obj` (Wavefront)"
    )]
    Format {
        /// The ending.
        found: String,
    },
    /// A line of the file cannot be read.
    #[error("line {line}: {found}; {remedy}")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// What is there.
        found: String,
        /// What to do.
        remedy: String,
    },
    /// The mesh has no such set of elements.
    #[error("there is no set of elements `{name}`; there are: {known}")]
    Set {
        /// The name.
        name: String,
        /// Names of the sets of elements, or a remark that there are none.
        known: String,
    },
    /// A part of a mesh is empty.
    #[error("no element of {from} has a shape that is wanted; its elements: {shapes}")]
    Empty {
        /// Set that is empty, or the mesh.
        from: String,
        /// Shapes that occur, with their numbers of elements.
        shapes: String,
    },
}

impl MeshError {
    pub(crate) fn at(line: usize, found: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Line { line, found: found.into(), remedy: remedy.into() }
    }
}
