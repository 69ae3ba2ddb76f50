//! Tests of `encodings::npy`, a module of it.

use super::*;

#[test]
fn headers_are_as_the_format_has_them() {
    let array = numbers(&[2, 1], &[1.0, -2.0]);
    assert!(array.starts_with(b"\x93NUMPY\x01\x00"));
    let length = usize::from(u16::from_le_bytes([array[8], array[9]]));
    assert_eq!((10 + length) % 64, 0);
    let header = std::str::from_utf8(&array[10..10 + length]).unwrap();
    assert!(
        header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1,), }")
            && header.ends_with('\n')
    );
    assert_eq!(&array[10 + length..], [1.0_f64.to_le_bytes(), (-2.0_f64).to_le_bytes()].concat());
    let words = texts(&["N m²".to_owned(), String::new()]);
    assert!(
        words.windows(4).any(|part| part == b"<U4'") && words.len() == 128 + 2 * 4 * 4
            || words.len() == 64 + 64 + 32
    );
}
