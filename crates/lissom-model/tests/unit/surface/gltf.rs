//! Tests of `surface::gltf`, a module of it.

use serde_json::json;

use super::super::Surface;
use super::*;

fn nothing_beside(_: &str) -> Result<Vec<u8>, String> {
    Err("there is no such file".to_owned())
}

/// A tetrahedron: corners as floats with a stride of 16 bytes, then triangles as short numbers.
fn buffer() -> Vec<u8> {
    let corners: [[f32; 4]; 4] = [[0.0; 4], [1.0, 0.0, 0.0, 9.0], [0.0, 1.0, 0.0, 9.0], [0.0, 0.0, 1.0, 9.0]];
    let faces: [u16; 12] = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend(faces.iter().flat_map(|index| index.to_le_bytes()));
    bytes
}

fn scene(uri: Option<&str>) -> Value {
    let mut buffer = json!({ "byteLength": 88 });
    if let Some(uri) = uri {
        buffer["uri"] = json!(uri);
    }
    json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "translation": [10, 0, 0], "rotation": [0, 0, 0.5_f64.sqrt(), 0.5_f64.sqrt()], "children": [1] },
            { "scale": [2, 1, -3], "mesh": 0 },
            { "mesh": 0 },
        ],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0 }, "indices": 1 },
            { "attributes": { "POSITION": 0 }, "mode": 1 },
        ] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 64, "byteStride": 16 },
            { "buffer": 0, "byteOffset": 64, "byteLength": 24 },
        ],
        "buffers": [buffer],
    })
}

fn binary(json: &Value, own: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = MAGIC.to_vec();
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend((28 + text.len() as u32 + own.len() as u32).to_le_bytes());
    for (name, chunk) in [(b"JSON", text.as_slice()), (b"BIN\0", own)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(name);
        bytes.extend(chunk);
    }
    bytes
}

#[test]
fn all_forms_of_gltf_are_read_and_placed_by_their_nodes() {
    let from_binary = Surface::of_file(&binary(&scene(None), &buffer()), &nothing_beside).unwrap();
    assert_eq!((from_binary.points.len(), from_binary.triangles.len()), (4, 4));
    // Twice as long along x and mirrored and three times along z, then a quarter turn about z and 10 m along x.
    for (point, place) in from_binary.points.iter().zip([[10, 0, 0], [10, 2, 0], [9, 0, 0], [10, 0, -3]]) {
        for k in 0..3 {
            assert!((f64::from(point[k]) - f64::from(place[k])).abs() < 1e-6, "{point:?} for {place:?}");
        }
    }
    let place = |index: u32| nalgebra::Vector3::from(from_binary.points[index as usize].map(f64::from));
    let volume: f64 =
        from_binary.triangles.iter().map(|t| place(t[0]).dot(&place(t[1]).cross(&place(t[2]))) / 6.0).sum();
    assert!((volume - 1.0).abs() < 1e-5, "{volume}: seen from outside");
    let beside = |name: &str| if name == "part.bin" { Ok(buffer()) } else { Err("another".to_owned()) };
    let apart = scene(Some("part.bin")).to_string();
    assert_eq!(Surface::of_file(apart.as_bytes(), &beside).unwrap(), from_binary);
    let letters = "AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAEEEAAAAAAACAPwAAAAAAABBBAAAAAAAAAAAAAIA/AAAQQQ\
                       AAAgABAAAAAQADAAAAAwACAAEAAgADAA==";
    let within = scene(Some(&format!("data:application/octet-stream;base64,{letters}"))).to_string();
    assert_eq!(Surface::of_file(within.as_bytes(), &nothing_beside).unwrap(), from_binary);
}

#[test]
fn files_that_cannot_be_drawn_say_why() {
    let problem = |change: &dyn Fn(&mut Value)| {
        let mut json = scene(None);
        change(&mut json);
        Surface::of_file(&binary(&json, &buffer()), &nothing_beside).unwrap_err().to_string()
    };
    assert!(problem(&|json| json["asset"]["version"] = json!("1.0")).contains("version 2"));
    assert!(
        problem(&|json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"])).contains("draco")
    );
    assert!(problem(&|json| json["nodes"][1]["skin"] = json!(0)).contains("skin"));
    assert!(problem(&|json| json["accessors"][1]["count"] = json!(13)).contains("beyond its buffer"));
    assert!(problem(&|json| json["accessors"][0]["componentType"] = json!(5123)).contains("another kind"));
    assert!(problem(&|json| json["nodes"][1]["children"] = json!([0])).contains("deep"));
    assert!(problem(&|json| json["bufferViews"][0]["byteLength"] = json!(30)).contains("beyond its buffer"));
    assert!(problem(&|json| json["scenes"][0]["nodes"] = json!([])).contains("no triangles"));
    assert!(problem(&|json| json["buffers"][0]["uri"] = json!("a.bin")).contains("`a.bin` cannot be read"));
    let whole = binary(&scene(None), &buffer());
    for length in [5, 13, 100, whole.len() - 1] {
        assert!(Surface::of_file(&whole[..length], &nothing_beside).is_err(), "{length} bytes");
    }
}
