//! Data that persist from step to step, as bytes of a snapshot that are restored to the last bit.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A value as bytes.
pub(crate) fn to_bytes<T: Serialize>(value: &T) -> Vec<u8> {
    postcard::to_stdvec(value).unwrap_or_default()
}

/// The saved value, if it can be read.
pub(crate) fn read_bytes<T: DeserializeOwned>(saved: &[u8]) -> Option<T> {
    postcard::from_bytes(saved).ok()
}

/// Writes the saved value to `value`, which is unchanged if it cannot be read. Whether it was read.
pub(crate) fn from_bytes<T: DeserializeOwned>(saved: &[u8], value: &mut T) -> bool {
    read_bytes(saved).map(|read| *value = read).is_some()
}
