//! Tests of `encodings::archive`, a module of it.

use super::*;

#[test]
fn an_archive_has_its_files_where_the_directory_says() {
    let archive = zip(&[("a.txt", b"aaaaaaaaaaaaaaaa"), ("b/c", b"")]).unwrap();
    assert_eq!(&archive[..4], b"PK\x03\x04");
    let end = archive.len() - 22;
    assert_eq!(&archive[end..end + 4], b"PK\x05\x06");
    let number = |at: usize| u32::from_le_bytes(archive[at..at + 4].try_into().unwrap()) as usize;
    let central = number(end + 16);
    assert_eq!(number(end + 12) + central, end);
    assert_eq!(&archive[central..central + 4], b"PK\x01\x02");
    // The second entry of the directory refers to the second file.
    let second = central + 46 + "a.txt".len();
    let local = number(second + 42);
    assert_eq!(&archive[local..local + 4], b"PK\x03\x04");
    assert_eq!(&archive[local + 30..local + 33], b"b/c");
    assert_eq!(number(central + 24), 16, "length of the first file");
}
