//! Tests of `encodings::parquet`, a module of it.

use super::*;

#[test]
fn numbers_are_as_short_as_the_protocol_has_them() {
    let of = |value| {
        let mut bytes = Vec::new();
        zigzag(&mut bytes, value);
        bytes
    };
    assert_eq!([of(0), of(1), of(63)], [[0], [2], [126]]);
    assert_eq!(of(64), [0x80, 1]);
    assert_eq!(of(1 << 40).len(), 6);
}

/// The bytes of a small file: page, metadata, length, magic bytes.
#[test]
fn a_file_has_pages_and_metadata_where_it_says() {
    let columns = [("a".to_owned(), Values::Numbers(vec![1.5, -2.0]))];
    let file = parquet(&columns, &[("unit", "m".to_owned())]).unwrap();
    assert!(file.starts_with(MAGIC) && file.ends_with(MAGIC));
    let length = u32::from_le_bytes(file[file.len() - 8..file.len() - 4].try_into().unwrap()) as usize;
    let metadata = &file[file.len() - 8 - length..file.len() - 8];
    // Version 1, then a list of two schema elements.
    assert_eq!(metadata[..4], [0x15, 2, 0x19, 0x2c]);
    assert_eq!(metadata[length - 1], 0);
    let values: Vec<u8> = [1.5_f64, -2.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    let place = file.windows(16).position(|part| part == values).unwrap();
    // The page's header ends with two zeros: of the data page's and of its own.
    assert_eq!(file[place - 2..place], [0, 0]);
    assert_eq!(place + 16, file.len() - 8 - length);
}

#[test]
fn long_tables_have_several_groups() {
    let rows = GROUP + 3;
    let columns = [
        ("k".to_owned(), Values::Whole(vec![7; rows])),
        ("t".to_owned(), Values::Texts(vec!["ä".to_owned(); rows])),
    ];
    let file = parquet(&columns, &[]).unwrap();
    assert!(file.len() > rows * 14);
    let empty = parquet(&[("k".to_owned(), Values::Whole(Vec::new()))], &[]).unwrap();
    assert!(empty.ends_with(MAGIC));
}
