//! Arrays of numbers in NumPy's archives: `.npz`, a ZIP archive of `.npy` files, stored or deflated.

use std::collections::BTreeMap;
use std::io::Read;

use flate2::read::DeflateDecoder;
use nalgebra::DMatrix;

/// Bytes of the largest array that is unpacked.
const MAX_BYTES: u64 = 100_000_000;

/// An archive that is not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum NpzError {
    /// It is no ZIP archive, or cut off.
    #[error("it is not an NPZ archive, or it is incomplete")]
    NotAnArchive,
    /// A file in it is packed in another way.
    #[error(
        "the compression of `{0}` in it is not supported: write it by `numpy.savez` or `numpy.savez_compressed`"
    )]
    Packing(String),
    /// A file in it is no array.
    #[error("`{0}` in it is not a NumPy array")]
    NotAnArray(String),
    /// An array is of another type or shape.
    #[error(
        "the array `{name}` is `{what}`: only real numbers (float64, float32) in one or two dimensions are read"
    )]
    Kind {
        /// Name of the array.
        name: String,
        /// Type or shape.
        what: String,
    },
    /// It is too large.
    #[error("the array `{0}` is larger than any model can use")]
    TooLarge(String),
}

/// Bytes at a position.
fn bytes<const N: usize>(of: &[u8], at: usize) -> Result<[u8; N], NpzError> {
    let found = of.get(at..at.saturating_add(N)).ok_or(NpzError::NotAnArchive)?;
    found.try_into().map_err(|_| NpzError::NotAnArchive)
}

fn short(of: &[u8], at: usize) -> Result<usize, NpzError> {
    Ok(usize::from(u16::from_le_bytes(bytes(of, at)?)))
}

fn long(of: &[u8], at: usize) -> Result<usize, NpzError> {
    Ok(u32::from_le_bytes(bytes(of, at)?) as usize)
}

/// The arrays of real numbers in an archive, by name; a vector is a matrix of one column. Other arrays are passed over.
pub(crate) fn arrays(archive: &[u8]) -> Result<BTreeMap<String, Result<DMatrix<f64>, NpzError>>, NpzError> {
    const END: &[u8] = b"PK\x05\x06";
    let from = archive.len().saturating_sub(22 + usize::from(u16::MAX));
    let end =
        archive[from..].windows(4).rposition(|window| window == END).ok_or(NpzError::NotAnArchive)? + from;
    let (count, mut at) = (short(archive, end + 10)?, long(archive, end + 16)?);
    // The last entry is the length of a comment, which ends the archive.
    if end + 22 + short(archive, end + 20)? > archive.len() {
        return Err(NpzError::NotAnArchive);
    }
    let mut arrays = BTreeMap::new();
    for _ in 0..count {
        if bytes::<4>(archive, at)? != *b"PK\x01\x02" {
            return Err(NpzError::NotAnArchive);
        }
        let (method, packed, length) =
            (short(archive, at + 10)?, long(archive, at + 20)?, long(archive, at + 24)?);
        let (name_length, extra, comment) =
            (short(archive, at + 28)?, short(archive, at + 30)?, short(archive, at + 32)?);
        let local = long(archive, at + 42)?;
        let name = archive.get(at + 46..at + 46 + name_length).ok_or(NpzError::NotAnArchive)?;
        let name = String::from_utf8_lossy(name).into_owned();
        at += 46 + name_length + extra + comment;
        let begin = local + 30 + short(archive, local + 26)? + short(archive, local + 28)?;
        let content = archive.get(begin..begin.saturating_add(packed)).ok_or(NpzError::NotAnArchive)?;
        let Some(own) = name.strip_suffix(".npy") else { continue };
        if length as u64 > MAX_BYTES {
            return Err(NpzError::TooLarge(own.to_owned()));
        }
        let unpacked = match method {
            0 => content.to_vec(),
            8 => {
                let mut unpacked = Vec::with_capacity(length);
                let read = DeflateDecoder::new(content).take(MAX_BYTES).read_to_end(&mut unpacked);
                read.map_err(|_| NpzError::NotAnArchive)?;
                unpacked
            }
            _ => return Err(NpzError::Packing(name)),
        };
        arrays.insert(own.to_owned(), array(own, &unpacked));
    }
    Ok(arrays)
}

/// The array of a `.npy` file.
fn array(name: &str, file: &[u8]) -> Result<DMatrix<f64>, NpzError> {
    let not_an_array = || NpzError::NotAnArray(name.to_owned());
    if !file.starts_with(b"\x93NUMPY") {
        return Err(not_an_array());
    }
    let (begin, length): (usize, usize) = match file.get(6) {
        Some(1) => (10, short(file, 8)?),
        _ => (12, long(file, 8)?),
    };
    let header = file.get(begin..begin.saturating_add(length)).ok_or_else(not_an_array)?;
    let header = std::str::from_utf8(header).map_err(|_| not_an_array())?;
    let after = |key: &str| header.split_once(key).map(|(_, rest)| rest.trim_start_matches([' ', ':']));
    let kind = after("'descr'").ok_or_else(not_an_array)?;
    let kind = kind.split('\'').nth(1).unwrap_or(kind);
    let by_columns = after("'fortran_order'").ok_or_else(not_an_array)?.starts_with("True");
    let shape =
        after("'shape'").and_then(|rest| rest.strip_prefix('(')?.split_once(')')).ok_or_else(not_an_array)?.0;
    let sizes: Vec<usize> = shape.split(',').filter_map(|size| size.trim().parse().ok()).collect();
    let other = |what: &str| NpzError::Kind { name: name.to_owned(), what: what.to_owned() };
    let (rows, columns) = match sizes.as_slice() {
        [rows] => (*rows, 1),
        [rows, columns] => (*rows, *columns),
        _ => return Err(other(&format!("of shape ({shape})"))),
    };
    let content = &file[begin + length..];
    let numbers: Vec<f64> = match kind {
        "<f8" => content
            .chunks_exact(8)
            .map(|own| f64::from_le_bytes(own.try_into().unwrap_or_default()))
            .collect(),
        "<f4" => content
            .chunks_exact(4)
            .map(|own| f64::from(f32::from_le_bytes(own.try_into().unwrap_or_default())))
            .collect(),
        kind => return Err(other(kind)),
    };
    if rows.checked_mul(columns) != Some(numbers.len()) {
        return Err(not_an_array());
    }
    Ok(if by_columns || columns == 1 {
        DMatrix::from_column_slice(rows, columns, &numbers)
    } else {
        DMatrix::from_row_slice(rows, columns, &numbers)
    })
}

#[cfg(test)]
#[path = "../../tests/unit/files/npz.rs"]
mod tests;
