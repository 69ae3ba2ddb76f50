//! Tests of `commands::live::http`, a module of it.

use super::*;

#[test]
fn heads_are_complete_partial_or_rejected() {
    let whole = b"POST /a?b HTTP/1.1\r\nHost: x\r\ncontent-length: 3\r\n\r\nabc";
    let (request, head) = Request::parse(whole).unwrap().unwrap();
    assert_eq!((request.method.as_str(), request.target.as_str(), head), ("POST", "/a?b", whole.len() - 3));
    assert_eq!(request.named("Content-Length").collect::<Vec<_>>(), ["3"]);
    assert!(Request::parse(&whole[..30]).unwrap().is_none());
    assert!(Request::parse(b"\x16\x03\x01\x02").is_err());
    let many = format!("GET / HTTP/1.1\r\n{}\r\n", "a: b\r\n".repeat(100));
    assert!(matches!(Request::parse(many.as_bytes()), Err((431, _))));
}
