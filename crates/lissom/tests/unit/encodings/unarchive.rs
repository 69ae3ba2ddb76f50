//! Tests of `encodings::unarchive`, a module of it.

use super::*;
use crate::encodings::archive::zip;

fn error(bytes: &[u8]) -> String {
    Unarchived::of(bytes).err().unwrap_or_default()
}

#[test]
fn files_are_read_as_they_were_written() {
    let text = b"abc".repeat(1000);
    let archive = zip(&[("a.txt", &text), ("b/c", b"")]).unwrap();
    let files = Unarchived::of(&archive).unwrap();
    assert_eq!(files.names().collect::<Vec<_>>(), ["a.txt", "b/c"]);
    assert_eq!(files.contents("a.txt").unwrap().unwrap(), text);
    assert_eq!(files.contents("b/c").unwrap().unwrap(), b"");
    assert!(files.contents("none").unwrap().is_none());
}

#[test]
fn names_that_lead_outside_are_rejected() {
    for name in ["../a", "/a", "a/../../b", "a//b", "C:a", "a\\b", "./a", ".."] {
        let message = error(&zip(&[(name, b"x")]).unwrap());
        assert!(message.contains("outside of the folder"), "{name}: {message}");
    }
    assert!(error(&zip(&[("a", b"x"), ("A", b"y")]).unwrap()).contains("twice"));
}

#[test]
fn links_wrong_sizes_and_damage_are_rejected() {
    let archive = zip(&[("a", &[0; 1000])]).unwrap();
    let central = archive.windows(4).position(|four| four == b"PK\x01\x02").unwrap();
    let with = |at: usize, bytes: &[u8]| {
        let mut changed = archive.clone();
        changed[central + at..central + at + bytes.len()].copy_from_slice(bytes);
        changed
    };
    assert!(error(&with(40, &0o120_777_u16.to_le_bytes())).contains("link"));
    assert!(error(&with(24, &[255; 4])).contains("2 GB"));
    assert!(error(&with(10, &[12])).contains("another method"));
    // A file that unpacks to more than it declares is not unpacked further.
    for (at, bytes) in [(24, 10_u32), (16, 1)] {
        let changed = with(at, &bytes.to_le_bytes());
        let files = Unarchived::of(&changed).unwrap();
        assert!(files.contents("a").unwrap_err().contains("damaged"));
    }
    assert!(error(b"no archive").contains("no ZIP archive"));
    for length in 0..archive.len() {
        // No panic, whatever is missing.
        if let Ok(files) = Unarchived::of(&archive[..length]) {
            let _ = files.contents("a");
        }
    }
}
