//! Tests of `pictures::view::packed`, a module of it.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::*;

#[test]
fn letters_are_those_of_the_standard() {
    for (bytes, wanted) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
    {
        assert_eq!(base64(bytes.as_bytes()), wanted);
    }
}

#[test]
fn integers_take_few_bytes() {
    let of = |value| {
        let mut out = Vec::new();
        put_integer(value, &mut out);
        out
    };
    assert_eq!(of(0), [0]);
    assert_eq!(of(-1), [1]);
    assert_eq!(of(63), [126]);
    assert_eq!(of(64), [128, 1]);
    assert_eq!(of(i64::MIN).len(), 10);
}

#[test]
fn what_is_deflated_comes_back() {
    let mut bytes = Vec::new();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(6));
    encoder.write_all(&[7; 1000]).unwrap();
    ZlibDecoder::new(&*encoder.finish().unwrap()).read_to_end(&mut bytes).unwrap();
    assert_eq!(bytes, [7; 1000]);
    for effort in [Effort::Small, Effort::Soon] {
        assert!(deflated(&[7; 1000], effort).len() < 60);
    }
}
