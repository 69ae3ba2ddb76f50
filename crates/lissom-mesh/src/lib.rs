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

mod error;
mod formats;
pub mod kinds;
mod mesh;
mod parts;
mod surface;
mod vectors;

pub use error::MeshError;
pub use formats::read::read;
pub use mesh::{Mesh, MeshElement, MeshMaterial, MeshSection, MeshShape};
pub use parts::block::block;
pub use parts::connection::ConnectionFault;
pub use parts::meshed_part::{Element, MeshedPart};
pub use parts::patch::{PatchFault, patch};
pub use parts::region::Region;
pub use surface::fault::{MeshFault, MeshFaultKind, Severity};
