//! Arrays in the format of NumPy: version 1.0 of `.npy`, little-endian, by rows.

/// An array of numbers.
pub(crate) fn numbers(shape: &[usize], values: &[f64]) -> Vec<u8> {
    with_header("<f8", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// An array of numbers in single precision.
pub(crate) fn short_numbers(shape: &[usize], values: &[f32]) -> Vec<u8> {
    with_header("<f4", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// A list of texts.
pub(crate) fn texts(values: &[String]) -> Vec<u8> {
    let longest = values.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    let padded = |text: &String| -> Vec<u8> {
        let letters = text.chars().map(u32::from).chain(std::iter::repeat(0)).take(longest);
        letters.flat_map(u32::to_le_bytes).collect()
    };
    with_header(&format!("<U{longest}"), &[values.len()], values.iter().flat_map(padded))
}

fn with_header(kind: &str, shape: &[usize], content: impl Iterator<Item = u8>) -> Vec<u8> {
    let sizes: Vec<String> = shape.iter().map(|size| format!("{size},")).collect();
    let mut header =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", sizes.join(" "));
    // The content begins at a multiple of 64 bytes; the header ends with a newline.
    let whole = (10 + header.len() + 1).next_multiple_of(64);
    header.extend(std::iter::repeat_n(' ', whole - 10 - header.len() - 1));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(content);
    bytes
}

#[cfg(test)]
#[path = "../../tests/unit/encodings/npy.rs"]
mod tests;
