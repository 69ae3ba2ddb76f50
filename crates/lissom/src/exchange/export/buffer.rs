//! The binary part of a glTF file: numbers, and their descriptions.

use serde_json::{Value, json};

/// 32-bit floating-point numbers.
const FLOAT: u32 = 5126;
/// 32-bit integers.
const WHOLE: u32 = 5125;
/// 16-bit integers.
const SHORT: u32 = 5123;

/// Concatenated numbers, with their accessors.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    fn add(&mut self, bytes: impl IntoIterator<Item = u8>, accessor: Value, target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        let mut accessor = accessor;
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Vectors of this number of components, with their extremes if `is_bounded`. Returns the index of the accessor.
    pub(super) fn vectors(
        &mut self,
        values: &[f32],
        size: usize,
        is_bounded: bool,
        target: Option<u32>,
    ) -> usize {
        let kind = match size {
            1 => "SCALAR",
            3 => "VEC3",
            4 => "VEC4",
            _ => "MAT4",
        };
        let mut accessor = json!({ "componentType": FLOAT, "count": values.len() / size, "type": kind });
        if is_bounded {
            let bound = |k: usize, first: f32, pick: fn(f32, f32) -> f32| {
                values.iter().skip(k).step_by(size).copied().fold(first, pick)
            };
            accessor["min"] = (0..size).map(|k| bound(k, f32::INFINITY, f32::min)).collect();
            accessor["max"] = (0..size).map(|k| bound(k, f32::NEG_INFINITY, f32::max)).collect();
        }
        self.add(values.iter().flat_map(|value| value.to_le_bytes()), accessor, target)
    }

    /// Indices of points, three for each triangle.
    pub(super) fn triangles(&mut self, points: &[u32]) -> usize {
        let accessor = json!({ "componentType": WHOLE, "count": points.len(), "type": "SCALAR" });
        self.add(points.iter().flat_map(|point| point.to_le_bytes()), accessor, Some(34963))
    }

    /// The one joint of a skin for each vertex.
    pub(super) fn joints(&mut self, joints: &[u16]) -> usize {
        let accessor = json!({ "componentType": SHORT, "count": joints.len(), "type": "VEC4" });
        let four = |joint: &u16| [*joint, 0, 0, 0];
        self.add(joints.iter().flat_map(four).flat_map(u16::to_le_bytes), accessor, Some(34962))
    }
}
