//! Tests of `encodings::sealed`, a module of it.

use super::*;

#[test]
fn every_changed_missing_or_added_byte_is_noticed() {
    let value = (vec![1.0_f64, -2.5, 1e300], "name".to_owned(), 7_u64);
    let bytes = to_bytes(&value).unwrap();
    assert_eq!(from_bytes(&bytes), Some(value));
    for place in 0..bytes.len() {
        for change in 1..=255_u8 {
            let mut damaged = bytes.clone();
            damaged[place] ^= change;
            assert_eq!(from_bytes::<(Vec<f64>, String, u64)>(&damaged), None, "{place} {change}");
        }
        assert_eq!(from_bytes::<(Vec<f64>, String, u64)>(&bytes[..place]), None);
    }
    let longer: Vec<u8> = bytes.iter().copied().chain([0]).collect();
    assert_eq!(from_bytes::<(Vec<f64>, String, u64)>(&longer), None);
    assert_eq!(from_bytes::<u8>(&[]), None);
}
