//! glTF 2.0 files, `.glb` or `.gltf`: the triangles of the scene at rest, as the nodes place them. Colours, textures and
//! animations are omitted; features that would be drawn incorrectly (skins, compressed meshes) are rejected.

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector4};
use serde_json::Value;

use super::{MAX_TRIANGLES, SurfaceError, Triangle};

/// Reads another file that a glTF file names by its path relative to it.
pub(super) type Beside<'a> = dyn Fn(&str) -> Result<Vec<u8>, String> + 'a;

/// The first bytes of a binary file.
pub(super) const MAGIC: &[u8] = b"glTF";
/// Kinds of numbers in buffers.
const BYTE: u64 = 5121;
const SHORT: u64 = 5123;
const INTEGER: u64 = 5125;
const FLOAT: u64 = 5126;

/// The triangles of a file; `beside` reads the buffers that it names.
pub(super) fn triangles(bytes: &[u8], beside: &Beside<'_>) -> Result<Vec<Triangle>, SurfaceError> {
    let (text, own) = if bytes.starts_with(MAGIC) { chunks(bytes)? } else { (bytes, None) };
    let json: Value =
        serde_json::from_slice(text).map_err(|error| wrong(&format!("its JSON is no JSON: {error}")))?;
    if !json["asset"]["version"].as_str().is_some_and(|version| version.starts_with("2.")) {
        return Err(wrong("it is not of version 2"));
    }
    if let Some(extension) = list(&json, "extensionsRequired").first() {
        let name = extension.as_str().unwrap_or_default();
        return Err(wrong(&format!(
            "it requires the extension `{name}`, which is not known: export without it"
        )));
    }
    let buffers: Result<Vec<Vec<u8>>, SurfaceError> =
        list(&json, "buffers").iter().map(|buffer| contents(buffer, own, beside)).collect();
    let mut file = File { json: &json, buffers: buffers?, triangles: Vec::new() };
    for root in file.roots()? {
        file.node(root, &Matrix4::identity(), 0)?;
    }
    Ok(file.triangles)
}

fn wrong(what: &str) -> SurfaceError {
    SurfaceError::Gltf(what.to_owned())
}

/// The JSON and the buffer of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), SurfaceError> {
    let (mut text, mut own) = (None, None);
    let mut rest = bytes.get(12..).unwrap_or_default();
    while let Some((heading, tail)) = rest.split_first_chunk::<8>() {
        let length = u32::from_le_bytes([heading[0], heading[1], heading[2], heading[3]]) as usize;
        let Some(chunk) = tail.get(..length) else { return Err(wrong("it ends within a chunk")) };
        match &heading[4..] {
            b"JSON" => text = text.or(Some(chunk)),
            b"BIN\0" => own = own.or(Some(chunk)),
            _ => {}
        }
        rest = &tail[length..];
    }
    Ok((text.ok_or_else(|| wrong("it holds no JSON"))?, own))
}

/// The bytes of a buffer: in the file itself, as base64 in its text, or in another file.
fn contents(buffer: &Value, own: Option<&[u8]>, beside: &Beside<'_>) -> Result<Vec<u8>, SurfaceError> {
    let Some(name) = buffer.get("uri").and_then(Value::as_str) else {
        return own.map(<[u8]>::to_vec).ok_or_else(|| wrong("a buffer is missing"));
    };
    match name.strip_prefix("data:") {
        Some(uri) => {
            let (_, letters) =
                uri.split_once(";base64,").ok_or_else(|| wrong("a buffer is not in base64"))?;
            base64(letters).ok_or_else(|| wrong("a buffer is not in base64"))
        }
        None => {
            beside(name).map_err(|reason| wrong(&format!("its buffer `{name}` cannot be read: {reason}")))
        }
    }
}

/// Six bits a letter.
fn base64(letters: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(letters.len() / 4 * 3);
    let (mut bits, mut count) = (0_u32, 0);
    for letter in letters.trim_end_matches('=').bytes() {
        let value = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        (bits, count) = ((bits << 6) | u32::from(value), count + 6);
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    Some(bytes)
}

/// A list of an object, empty where it is not there.
fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// A whole number of an object.
fn whole(of: &Value, key: &str) -> Option<usize> {
    of.get(key).and_then(Value::as_u64).and_then(|number| usize::try_from(number).ok())
}

/// Numbers of an object, as many as `N`; none where they are not there.
fn numbers<const N: usize>(of: &Value, key: &str) -> Result<Option<[f64; N]>, SurfaceError> {
    let Some(value) = of.get(key) else { return Ok(None) };
    let found: Option<Vec<f64>> = value.as_array().and_then(|all| all.iter().map(Value::as_f64).collect());
    match found.and_then(|all| <[f64; N]>::try_from(all).ok()) {
        Some(numbers) => Ok(Some(numbers)),
        None => Err(wrong(&format!("`{key}` of a node is not made of {N} numbers"))),
    }
}

/// A file that is read.
struct File<'a> {
    json: &'a Value,
    buffers: Vec<Vec<u8>>,
    triangles: Vec<Triangle>,
}

impl<'a> File<'a> {
    fn entry(&self, table: &str, index: usize) -> Result<&'a Value, SurfaceError> {
        list(self.json, table)
            .get(index)
            .ok_or_else(|| wrong(&format!("entry {index} of `{table}` is missing")))
    }

    /// The nodes at the top of the scene that is shown; without scenes those that are below no other.
    fn roots(&self) -> Result<Vec<usize>, SurfaceError> {
        let all = |nodes: &[Value]| -> Vec<usize> {
            nodes.iter().filter_map(Value::as_u64).filter_map(|node| usize::try_from(node).ok()).collect()
        };
        if !list(self.json, "scenes").is_empty() {
            let scene = self.entry("scenes", whole(self.json, "scene").unwrap_or(0))?;
            return Ok(all(list(scene, "nodes")));
        }
        let nodes = list(self.json, "nodes");
        let below: Vec<usize> = nodes.iter().flat_map(|node| all(list(node, "children"))).collect();
        Ok((0..nodes.len()).filter(|node| !below.contains(node)).collect())
    }

    /// A node with all below it.
    fn node(&mut self, index: usize, above: &Matrix4<f64>, depth: usize) -> Result<(), SurfaceError> {
        const DEEPEST: usize = 100;
        if depth > DEEPEST {
            return Err(wrong(&format!("its nodes are more than {DEEPEST} deep")));
        }
        let node = self.entry("nodes", index)?;
        let own = match numbers::<16>(node, "matrix")? {
            Some(matrix) => Matrix4::from_column_slice(&matrix),
            None => placed(node)?,
        };
        let place = above * own;
        if let Some(mesh) = whole(node, "mesh") {
            if node.get("skin").is_some() {
                return Err(wrong("it holds a skin: export it without bones"));
            }
            for primitive in list(self.entry("meshes", mesh)?, "primitives") {
                self.primitive(primitive, &place)?;
            }
        }
        for child in list(node, "children") {
            let child = child.as_u64().and_then(|child| usize::try_from(child).ok());
            self.node(child.ok_or_else(|| wrong("a node is none"))?, &place, depth + 1)?;
        }
        Ok(())
    }

    /// Triangles one by one, in a strip or in a fan; points and lines have no surface.
    fn primitive(&mut self, primitive: &Value, place: &Matrix4<f64>) -> Result<(), SurfaceError> {
        let mode = whole(primitive, "mode").unwrap_or(4);
        if !(4..=6).contains(&mode) {
            return Ok(());
        }
        let Some(positions) = whole(&primitive["attributes"], "POSITION") else { return Ok(()) };
        let points: Vec<[f32; 3]> =
            self.positions(positions)?.iter().map(|point| moved(place, *point)).collect();
        let order = match whole(primitive, "indices") {
            Some(indices) => self.indices(indices)?,
            None => (0..points.len()).collect(),
        };
        let count = if mode == 4 { order.len() / 3 } else { order.len().saturating_sub(2) };
        if self.triangles.len() + count > MAX_TRIANGLES {
            return Err(SurfaceError::TooMany(self.triangles.len() + count));
        }
        // A mirror turns triangles over.
        let is_mirrored = place.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
        for k in 0..count {
            let corners = match mode {
                4 => [3 * k, 3 * k + 1, 3 * k + 2],
                5 if k % 2 == 1 => [k + 1, k, k + 2],
                5 => [k, k + 1, k + 2],
                _ => [0, k + 1, k + 2],
            };
            let mut triangle = [[0.0; 3]; 3];
            for (corner, at) in triangle.iter_mut().zip(corners) {
                *corner = *points.get(order[at]).ok_or_else(|| wrong("a corner is missing"))?;
            }
            if is_mirrored {
                triangle.swap(1, 2);
            }
            self.triangles.push(triangle);
        }
        Ok(())
    }

    fn positions(&self, accessor: usize) -> Result<Vec<[f32; 3]>, SurfaceError> {
        let entries = self.accessor(accessor, "VEC3", |kind| (kind == FLOAT).then_some(12))?;
        let number = |bytes: &[u8], k: usize| {
            f32::from_le_bytes([bytes[4 * k], bytes[4 * k + 1], bytes[4 * k + 2], bytes[4 * k + 3]])
        };
        Ok(entries.map(|bytes| [0, 1, 2].map(|k| number(bytes, k))).collect())
    }

    fn indices(&self, accessor: usize) -> Result<Vec<usize>, SurfaceError> {
        let bytes = |kind| match kind {
            BYTE => Some(1),
            SHORT => Some(2),
            INTEGER => Some(4),
            _ => None,
        };
        let entries = self.accessor(accessor, "SCALAR", bytes)?;
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |sum, byte| 256 * sum + usize::from(*byte));
        Ok(entries.map(number).collect())
    }

    /// The entries of an accessor, as bytes; `bytes` returns the length of an entry for the type of its numbers.
    fn accessor(
        &self,
        index: usize,
        shape: &str,
        bytes: impl Fn(u64) -> Option<usize>,
    ) -> Result<impl Iterator<Item = &[u8]>, SurfaceError> {
        let accessor = self.entry("accessors", index)?;
        let kind = accessor["componentType"].as_u64().unwrap_or_default();
        let size = bytes(kind).filter(|_| accessor["type"].as_str() == Some(shape));
        let size = size.ok_or_else(|| wrong(&format!("accessor {index} has numbers of another kind")))?;
        let view = whole(accessor, "bufferView").filter(|_| accessor.get("sparse").is_none());
        let view = self.entry("bufferViews", view.ok_or_else(|| wrong("an accessor is sparse"))?)?;
        let stride = whole(view, "byteStride").unwrap_or(size);
        let count = whole(accessor, "count").unwrap_or(0);
        let range = || {
            let buffer = self.buffers.get(whole(view, "buffer")?)?;
            let first = whole(view, "byteOffset").unwrap_or(0);
            let view = buffer.get(first..first.checked_add(whole(view, "byteLength")?)?)?;
            let own = view.get(whole(accessor, "byteOffset").unwrap_or(0)..)?;
            let needed = stride.checked_mul(count.saturating_sub(1))?.checked_add(size)?;
            (stride >= size && (count == 0 || needed <= own.len())).then_some(own)
        };
        let own = range().ok_or_else(|| wrong(&format!("accessor {index} reaches beyond its buffer")))?;
        Ok((0..count).map(move |entry| &own[stride * entry..stride * entry + size]))
    }
}

/// The position of a node by its translation, rotation and scale.
fn placed(node: &Value) -> Result<Matrix4<f64>, SurfaceError> {
    let shift = numbers::<3>(node, "translation")?.unwrap_or_default();
    let [x, y, z, w] = numbers::<4>(node, "rotation")?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = numbers::<3>(node, "scale")?.unwrap_or([1.0; 3]);
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_homogeneous();
    Ok(Matrix4::new_translation(&shift.into()) * turn * Matrix4::new_nonuniform_scaling(&scale.into()))
}

fn moved(place: &Matrix4<f64>, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let point = place * Vector4::new(f64::from(x), f64::from(y), f64::from(z), 1.0);
    [point.x as f32, point.y as f32, point.z as f32]
}

#[cfg(test)]
#[path = "../../tests/unit/surface/gltf.rs"]
mod tests;
