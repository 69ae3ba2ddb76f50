//! Finite-element meshes from the text of files: Gmsh (`msh`), Abaqus or CalculiX (`inp`) and Wavefront (`obj`), and a
//! search for faults of surface meshes. Independent of mechanics; it opens no file.
//!
//! ```
//! use lissom_mesh::{MeshShape, read};
//!
//! let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng plate\nf 1 2 3 4\n";
//! let mesh = read(text, "obj").unwrap();
//! assert_eq!(mesh.elements[0].shape, MeshShape::Quadrilateral4);
//! assert_eq!(mesh.node_sets["plate"], [0, 1, 2, 3]);
//! assert!(mesh.surface_faults().is_empty());
//! ```

mod abaqus;
mod abaqus_sets;
mod abaqus_types;
mod block;
mod connection;
mod division;
mod draft;
mod edges;
mod error;
mod fault;
mod faults;
mod fields;
mod gmsh;
mod gmsh_types;
mod join;
pub mod kinds;
mod mesh;
mod meshed_part;
mod node_tree;
mod obj;
mod orientation;
mod part;
mod patch;
mod raise;
mod read;
mod region;
mod set_budget;
mod sizes;
mod vectors;

pub use block::block;
pub use connection::ConnectionFault;
pub use error::MeshError;
pub use fault::{MeshFault, MeshFaultKind, Severity};
pub use mesh::{Mesh, MeshElement, MeshMaterial, MeshSection, MeshShape};
pub use meshed_part::{Element, MeshedPart};
pub use patch::{PatchFault, patch};
pub use read::read;
pub use region::Region;
