//! Tests of `read`, a module of it.

use super::*;

#[test]
fn the_extension_determines_the_format() {
    let text = b"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 # \xfc\n";
    assert_eq!(read(text, ".OBJ").map(|mesh| mesh.elements.len()), Ok(1));
    assert_eq!(read(text, "stl"), Err(MeshError::Format { found: "stl".to_owned() }));
    assert!(read(text, "msh").is_err_and(|error| error.to_string().starts_with("line 1: ")));
}

/// Whatever the damage, a file is read or rejected, and no claimed count is believed.
#[test]
fn damaged_files_do_not_panic() {
    let samples = [
        ("msh", gmsh::tests::VERSION_2),
        ("msh", gmsh::tests::VERSION_4),
        ("inp", abaqus::tests::FLAT),
        ("inp", abaqus::tests::ASSEMBLED),
        ("obj", obj::tests::SAMPLE),
    ];
    let use_it = |text: &[u8], extension: &str| {
        if let Ok(mut mesh) = read(text, extension) {
            mesh.surface_faults();
            mesh.orient();
            let _ = mesh.part(None, crate::MeshShape::is_surface);
            let divided = mesh.divided_into_quadrilaterals();
            assert_eq!(divided.positions.len(), divided.node_numbers.len());
        }
    };
    for (extension, sample) in samples {
        assert!(read(sample.as_bytes(), extension).is_ok(), "{:?}", read(sample.as_bytes(), extension));
        let bytes = sample.as_bytes();
        for index in 0..bytes.len() {
            use_it(&bytes[..index], extension);
            use_it(&bytes[index..], extension);
            for new in *b"09-.,*$\n \xff" {
                let mut damaged = bytes.to_vec();
                damaged[index] = new;
                use_it(&damaged, extension);
            }
            if bytes[index].is_ascii_digit() {
                let large = [&bytes[..index], b"999999999999", &bytes[index + 1..]].concat();
                use_it(&large, extension);
            }
        }
    }
}
