//! One request per connection over HTTP/1.1, of bounded size, in bounded time. Independent of the page.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// Maximum length of a request's head: its first line and its headers [bytes].
const MAX_HEAD: usize = 1 << 14;
/// Maximum length of a body [bytes].
const MAX_BODY: usize = 1 << 16;
/// Maximum number of headers.
const MAX_HEADERS: usize = 64;
/// Maximum time for the arrival of a request.
const ARRIVAL: Duration = Duration::from_secs(10);
/// Maximum time for data that arrive after a request.
const CLOSING: Duration = Duration::from_secs(1);
/// Maximum time for the client to read an answer.
const DELIVERY: Duration = Duration::from_secs(10);

/// A complete request.
pub(super) struct Request {
    pub(super) method: String,
    /// Path and query.
    pub(super) target: String,
    headers: Vec<(String, String)>,
    pub(super) body: Vec<u8>,
}

/// Why a request is rejected: the status code and its text.
pub(super) type Rejection = (u16, &'static str);

impl Request {
    /// Reads a request.
    ///
    /// # Errors
    /// With the status for a request that is malformed, too large or too slow.
    pub(super) fn read(stream: &mut TcpStream) -> Result<Self, Rejection> {
        let deadline = Instant::now() + ARRIVAL;
        let mut bytes = Vec::with_capacity(1024);
        let (mut request, head) = loop {
            let found = Self::parse(&bytes)?;
            if let Some(found) = found {
                break found;
            }
            if bytes.len() >= MAX_HEAD {
                return Err((431, "the headers are too long"));
            }
            receive(stream, &mut bytes, MAX_HEAD, deadline)?;
        };
        if request.named("Transfer-Encoding").next().is_some() {
            return Err((411, "the length of the body is missing"));
        }
        let mut lengths = request.named("Content-Length");
        let length = match (lengths.next(), lengths.next()) {
            (None, _) => 0,
            (Some(length), None) if length.bytes().all(|byte| byte.is_ascii_digit()) => {
                // A number that overflows a machine word is too large for a body.
                length.parse().unwrap_or(usize::MAX)
            }
            _ => return Err((400, "the length of the body is not a number")),
        };
        if length > MAX_BODY {
            return Err((413, "the body is too long"));
        }
        let end = head + length;
        while bytes.len() < end {
            receive(stream, &mut bytes, end, deadline)?;
        }
        drop(lengths);
        request.body = bytes[head..end].to_vec();
        Ok(request)
    }

    /// The request whose head is at the beginning of `bytes`, with the length of the head; none if it is incomplete.
    fn parse(bytes: &[u8]) -> Result<Option<(Self, usize)>, Rejection> {
        let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
        let mut parsed = httparse::Request::new(&mut headers);
        match parsed.parse(bytes) {
            Ok(httparse::Status::Complete(head)) => {
                let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
                let headers =
                    parsed.headers.iter().map(|header| (header.name.to_owned(), text(header.value)));
                let request = Self {
                    method: parsed.method.unwrap_or_default().to_owned(),
                    target: parsed.path.unwrap_or_default().to_owned(),
                    headers: headers.collect(),
                    body: Vec::new(),
                };
                Ok(Some((request, head)))
            }
            Ok(httparse::Status::Partial) => Ok(None),
            Err(httparse::Error::TooManyHeaders) => Err((431, "there are too many headers")),
            Err(_) => Err((400, "this is no request")),
        }
    }

    /// Values of all headers of this name.
    pub(super) fn named<'r>(&'r self, name: &'r str) -> impl Iterator<Item = &'r str> {
        let found = self.headers.iter().filter(move |(known, _)| known.eq_ignore_ascii_case(name));
        found.map(|(_, value)| value.as_str())
    }
}

/// Reads available data, up to `most` bytes in all.
fn receive(
    stream: &mut TcpStream,
    bytes: &mut Vec<u8>,
    most: usize,
    deadline: Instant,
) -> Result<(), Rejection> {
    const LATE: Rejection = (408, "the request did not arrive in time");
    let left = deadline.saturating_duration_since(Instant::now());
    if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
        return Err(LATE);
    }
    let mut buffer = [0; 4096];
    let room = buffer.len().min(most - bytes.len());
    match stream.read(&mut buffer[..room]) {
        Ok(0) => Err((400, "the request is incomplete")),
        Ok(count) => {
            bytes.extend_from_slice(&buffer[..count]);
            Ok(())
        }
        Err(error) if error.kind() == ErrorKind::Interrupted => Ok(()),
        Err(_) => Err(LATE),
    }
}

/// Writes an answer and closes the connection.
pub(super) fn answer(
    stream: &mut TcpStream,
    status: u16,
    headers: &[(&str, &str)],
    body: &[u8],
) -> io::Result<()> {
    stream.set_write_timeout(Some(DELIVERY))?;
    let reason = match status {
        200 => "OK",
        204 => "No Content",
        403 => "Forbidden",
        404 => "Not Found",
        413 => "Content Too Large",
        503 => "Service Unavailable",
        _ => "Bad Request",
    };
    let mut head = format!("HTTP/1.1 {status} {reason}\r\nConnection: close\r\n").into_bytes();
    if status != 204 {
        write!(head, "Content-Length: {}\r\n", body.len())?;
    }
    for (name, value) in headers {
        write!(head, "{name}: {value}\r\n")?;
    }
    head.extend(b"\r\n");
    stream.write_all(&head)?;
    if status != 204 {
        stream.write_all(body)?;
    }
    stream.flush()
}

/// Ends a connection after an answer. If data of the client remain unread the system would discard the answer: they are
/// read for a short time.
pub(super) fn close(stream: &mut TcpStream) {
    let deadline = Instant::now() + CLOSING;
    let _ = stream.shutdown(Shutdown::Write);
    let mut buffer = [0; 4096];
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
            return;
        }
        match stream.read(&mut buffer) {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/commands/live/http.rs"]
mod tests;
