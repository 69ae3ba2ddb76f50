//! Values as bytes with a checksum: a state with a single changed byte could often be read, and would continue from a
//! wrong state.

use flate2::Crc;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Length of the checksum at the end [bytes].
const CHECKSUM: usize = 4;

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum().to_le_bytes()
}

/// A value as bytes.
///
/// # Errors
/// If the value cannot be serialised.
pub fn to_bytes<T: Serialize>(value: &T) -> Result<Vec<u8>, postcard::Error> {
    let mut bytes = postcard::to_stdvec(value)?;
    let sum = checksum(&bytes);
    bytes.extend(sum);
    Ok(bytes)
}

/// The value of bytes that [`to_bytes`] returned; none for other bytes.
pub fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (bytes, sum) = bytes.split_at_checked(bytes.len().checked_sub(CHECKSUM)?)?;
    // Remaining bytes belong to another value.
    let (value, rest) = (checksum(bytes) == sum).then(|| postcard::take_from_bytes(bytes).ok())??;
    rest.is_empty().then_some(value)
}

#[cfg(test)]
#[path = "../../tests/unit/encodings/sealed.rs"]
mod tests;
