//! STL files, of numbers or of words.

use super::{SurfaceError, Triangle};

/// The triangles of a file.
pub(super) fn triangles(bytes: &[u8]) -> Result<Vec<Triangle>, SurfaceError> {
    match numbers(bytes) {
        Some(triangles) => Ok(triangles),
        None => words(bytes),
    }
}

/// A heading of 80 bytes, the number of triangles, and for each its normal, its corners and two bytes more; none if the length
/// states otherwise.
fn numbers(bytes: &[u8]) -> Option<Vec<Triangle>> {
    let count = u32::from_le_bytes(*bytes.get(80..84)?.first_chunk()?) as usize;
    if bytes.len() != 84 + 50 * count {
        return None;
    }
    let triangle = |record: &[u8]| {
        let (words, _) = record[12..48].as_chunks::<4>();
        std::array::from_fn(|corner| std::array::from_fn(|k| f32::from_le_bytes(words[3 * corner + k])))
    };
    Some(bytes[84..].chunks_exact(50).map(triangle).collect())
}

/// Words, of which those behind `vertex` are positions.
fn words(bytes: &[u8]) -> Result<Vec<Triangle>, SurfaceError> {
    let text = std::str::from_utf8(bytes).map_err(|_| SurfaceError::Foreign)?;
    if !text.trim_start().starts_with("solid") || !text.contains("facet") {
        return Err(SurfaceError::Foreign);
    }
    let mut places: Vec<[f32; 3]> = Vec::new();
    let mut words = text.split_ascii_whitespace();
    while let Some(word) = words.next() {
        if word == "vertex" {
            let mut number = || words.next().and_then(|word| word.parse().ok()).ok_or(SurfaceError::Foreign);
            places.push([number()?, number()?, number()?]);
        }
    }
    let (triangles, rest) = places.as_chunks::<3>();
    if rest.is_empty() { Ok(triangles.to_vec()) } else { Err(SurfaceError::Foreign) }
}
