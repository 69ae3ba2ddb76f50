//! Tests of `files::npz`, a module of it.

use std::io::Write;

use flate2::Compression;
use flate2::write::DeflateEncoder;

use super::*;

fn npy(kind: &str, order: &str, shape: &str, content: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': ({shape}), }}\n");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((header.len() as u16).to_le_bytes());
    file.extend(header.as_bytes());
    file.extend(content);
    file
}

fn archive(files: &[(&str, Vec<u8>, bool)]) -> Vec<u8> {
    let (mut whole, mut central) = (Vec::new(), Vec::new());
    for (name, content, is_deflated) in files {
        let packed = if *is_deflated {
            let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(content).expect("memory");
            encoder.finish().expect("memory")
        } else {
            content.clone()
        };
        let offset = whole.len() as u32;
        let mut facts = Vec::new();
        let method = if *is_deflated { 8_u16 } else { 0 };
        for number in [20, 0, method, 0, 0] {
            facts.extend(number.to_le_bytes());
        }
        for number in [0, packed.len() as u32, content.len() as u32] {
            facts.extend(number.to_le_bytes());
        }
        facts.extend((name.len() as u16).to_le_bytes());
        facts.extend(0_u16.to_le_bytes());
        whole.extend(b"PK\x03\x04");
        whole.extend(&facts);
        whole.extend(name.as_bytes());
        whole.extend(packed);
        central.extend(b"PK\x01\x02\x14\x00");
        central.extend(&facts);
        central.extend([0; 10]);
        central.extend(offset.to_le_bytes());
        central.extend(name.as_bytes());
    }
    let (start, length) = (whole.len() as u32, central.len() as u32);
    whole.extend(central);
    whole.extend(b"PK\x05\x06\0\0\0\0");
    for _ in 0..2 {
        whole.extend((files.len() as u16).to_le_bytes());
    }
    whole.extend(length.to_le_bytes());
    whole.extend(start.to_le_bytes());
    whole.extend([0; 2]);
    whole
}

#[test]
fn arrays_are_read_by_rows_and_by_columns() {
    let numbers: Vec<u8> = [1.0_f64, 2.0, 3.0, 4.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    let short: Vec<u8> = [0.5_f32, -1.5].iter().flat_map(|value| value.to_le_bytes()).collect();
    let found = arrays(&archive(&[
        ("M.npy", npy("<f8", "False", "2, 2", &numbers), true),
        ("K.npy", npy("<f8", "True", "2, 2", &numbers), false),
        ("f.npy", npy("<f4", "False", "2,", &short), true),
        ("names.npy", npy("<U4", "False", "1,", &[0; 16]), true),
        ("notes.txt", b"words".to_vec(), false),
    ]))
    .expect("an archive");
    assert_eq!(found["M"], Ok(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 3.0, 4.0])));
    assert_eq!(found["K"], Ok(DMatrix::from_row_slice(2, 2, &[1.0, 3.0, 2.0, 4.0])));
    assert_eq!(found["f"], Ok(DMatrix::from_column_slice(2, 1, &[0.5, -1.5])));
    assert!(found["names"].clone().unwrap_err().to_string().contains("`<U4`"));
    assert_eq!(found.len(), 4);
}

#[test]
fn what_is_damaged_is_reported() {
    let whole = archive(&[("M.npy", npy("<f8", "False", "1, 1", &[0; 8]), true)]);
    assert_eq!(arrays(b"no archive"), Err(NpzError::NotAnArchive));
    for length in 0..whole.len() {
        assert!(arrays(&whole[..length]).is_err(), "{length}");
    }
    let found =
        arrays(&archive(&[("M.npy", npy("<f8", "False", "2, 1", &[0; 8]), false)])).expect("an archive");
    assert_eq!(found["M"], Err(NpzError::NotAnArray("M".to_owned())));
}
