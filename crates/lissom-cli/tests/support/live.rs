//! `lissom live` and requests to it.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// The program while it serves a model.
pub(crate) struct Live {
    pub(crate) program: Child,
    pub(crate) port: u16,
    pub(crate) word: String,
}

impl Drop for Live {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

impl Live {
    pub(crate) fn start(model: &str, folder: &Path) -> Self {
        Self::start_at(0, model, folder)
    }

    /// On a port; 0 for any.
    pub(crate) fn start_at(port: u16, model: &str, folder: &Path) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lissom"));
        command.args(["live", model, "--port", &port.to_string()]).current_dir(folder).stdout(Stdio::piped());
        let mut program = command.spawn().unwrap();
        let output = program.stdout.take().unwrap();
        let (sender, receiver) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            let mut line = String::new();
            let read = BufReader::new(output).read_line(&mut line);
            let _ = sender.send(read.map(|_| line));
        });
        let Ok(line) = receiver.recv_timeout(Duration::from_secs(60)) else {
            let _ = program.kill();
            panic!("no address was printed within a minute");
        };
        let line = line.unwrap();
        let address = line.trim().strip_prefix("http://127.0.0.1:").unwrap().to_owned();
        let (port, word) = address.trim_end_matches('/').split_once('/').unwrap();
        Self { program, port: port.parse().unwrap(), word: word.to_owned() }
    }

    /// Sends a request as it is. Status and body.
    pub(crate) fn send(&self, request: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        let body = if head.to_ascii_lowercase().contains("transfer-encoding: chunked") {
            whole(body)
        } else {
            body.to_owned()
        };
        (head.split_whitespace().nth(1).unwrap().parse().unwrap(), body)
    }

    /// A request with other lines in its head.
    pub(crate) fn ask(&self, method: &str, path: &str, host: &str, more: &str, body: &str) -> (u16, String) {
        let length = body.len();
        self.send(&format!(
            "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {length}\r\n{more}\r\n{body}"
        ))
    }

    pub(crate) fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }
}

/// Puts the pieces of a body together: a length in hexadecimal digits, the piece, and so on to a length of zero.
fn whole(body: &str) -> String {
    let (mut rest, mut text) = (body, String::new());
    while let Some((length, after)) = rest.split_once("\r\n") {
        let length = usize::from_str_radix(length.trim(), 16).unwrap();
        if length == 0 {
            break;
        }
        text.push_str(&after[..length]);
        rest = after[length..].trim_start_matches("\r\n");
    }
    text
}

/// Memory [kB], threads and open files of a process, where the system reports them.
pub(crate) fn held(process: u32) -> Option<[u64; 3]> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let of = |name: &str| -> Option<u64> {
        status.lines().find(|line| line.starts_with(name))?.split_whitespace().nth(1)?.parse().ok()
    };
    let files = fs::read_dir(format!("/proc/{process}/fd")).ok()?.count() as u64;
    Some([of("VmRSS:")?, of("Threads:")?, files])
}
