//! Tests of `abaqus_types`, a module of it.

use super::*;

#[test]
fn every_type_has_a_treatment() {
    assert_eq!(treatment("S4R"), Treatment::Read(MeshShape::Quadrilateral4));
    assert_eq!(treatment("C3D10"), Treatment::Read(MeshShape::Tetrahedron10));
    assert_eq!(treatment("B31"), Treatment::Read(MeshShape::Line2));
    assert_eq!(treatment("S8R"), Treatment::Read(MeshShape::Quadrilateral8));
    assert_eq!(treatment("SPRINGA"), Treatment::LeaveOut);
    assert!(matches!(treatment("CPS3"), Treatment::ReadAs(MeshShape::Triangle3, _)));
    for name in ["B32", "C3D5", "U1", ""] {
        assert!(matches!(treatment(name), Treatment::Reject(_)), "{name}");
    }
}
