//! The local page of a model. It answers at one address that contains a random word, to this page's own requests, and
//! serves only the page and the results: no file can be named.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use lissom::pictures::view;

use super::address_word;
use super::http::{self, Request};
use super::simulation::Shared;

/// Maximum duration of a request for new results; the page then repeats it.
const PATIENCE: Duration = Duration::from_secs(20);
/// Maximum number of simultaneous connections; each page has one open while it waits.
const MAX_CONNECTIONS: usize = 24;
/// Stack of the thread of a connection [bytes].
const STACK_SIZE: usize = 1 << 18;

/// First of the ports that follow from the path of a model, and their number: below those that systems give to connections.
const PORTS: [u16; 2] = [20_000, 10_000];

/// The port of a model, which is the same whenever the program is started.
fn usual_port(model: &Path) -> u16 {
    let mut hasher = DefaultHasher::new();
    model.canonicalize().unwrap_or_else(|_| model.to_owned()).hash(&mut hasher);
    PORTS[0] + (hasher.finish() % u64::from(PORTS[1])) as u16
}

/// Serves the page in threads of its own as long as the program runs. Returns the address, with the same word whenever a port is
/// used again; port 0 is any free port.
pub(super) fn start(port: Option<u16>, model: &Path, shared: &Arc<Shared>) -> io::Result<String> {
    let bind = |port: u16| TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    let wanted = port.unwrap_or_else(|| usual_port(model));
    let (listener, known) = match bind(wanted) {
        Err(_) if port.is_none() => (bind(0)?, 0),
        listener => (listener?, wanted),
    };
    let word = address_word::word(known);
    let port = listener.local_addr()?.port();
    let title = model.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let site = Arc::new(Site { word, port, page: view::empty_page(&title) });
    let address = format!("http://127.0.0.1:{port}/{}/", site.word);
    let shared = Arc::clone(shared);
    let busy = Arc::new(AtomicUsize::new(0));
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            if busy.fetch_add(1, Ordering::SeqCst) >= MAX_CONNECTIONS {
                busy.fetch_sub(1, Ordering::SeqCst);
                // Fits into the system's buffer: the write does not block.
                answer(&mut stream, 503, "text/plain", "too many pages are open");
                continue;
            }
            let (site, shared) = (Arc::clone(&site), Arc::clone(&shared));
            let own = Busy(Arc::clone(&busy));
            let thread = std::thread::Builder::new().stack_size(STACK_SIZE);
            // If no thread can be created the connection is closed.
            let _ = thread.spawn(move || {
                let _own = own;
                match Request::read(&mut stream) {
                    Ok(request) => site.serve(&mut stream, &request, &shared),
                    Err((status, words)) => answer(&mut stream, status, "text/plain", words),
                }
                http::close(&mut stream);
            });
        }
    });
    Ok(address)
}

/// Counts a connection as long as it is open.
struct Busy(Arc<AtomicUsize>);

impl Drop for Busy {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

struct Site {
    word: String,
    port: u16,
    page: String,
}

impl Site {
    fn serve(&self, stream: &mut TcpStream, request: &Request, shared: &Shared) {
        if !self.is_own(request) {
            return answer(stream, 403, "text/plain", "only requests of this page itself are answered");
        }
        let (path, query) = request.target.split_once('?').unwrap_or((&request.target, ""));
        let Some(path) = path.strip_prefix('/').and_then(|path| path.strip_prefix(&*self.word)) else {
            return answer(stream, 404, "text/plain", "there is nothing here");
        };
        match (request.method.as_str(), path) {
            ("GET", "/") => answer(stream, 200, "text/html; charset=utf-8", &self.page),
            ("GET", "/result") => {
                let after = query.strip_prefix("after=").and_then(|number| number.parse().ok()).unwrap_or(0);
                match shared.wait_after(after, PATIENCE) {
                    Some(published) => answer(stream, 200, "application/json", &published),
                    None => answer(stream, 204, "application/json", ""),
                }
            }
            ("POST", "/parameters") => match serde_json::from_slice::<BTreeMap<String, f64>>(&request.body) {
                Ok(values) if values.values().all(|value| value.is_finite()) => {
                    shared.ask(values);
                    answer(stream, 204, "text/plain", "");
                }
                _ => answer(stream, 400, "text/plain", "the body must be numbers by name"),
            },
            _ => answer(stream, 404, "text/plain", "there is nothing here"),
        }
    }

    /// Whether a request comes from this page or from a user who has entered its address. A foreign page may make a
    /// browser send requests here, but cannot prevent it from reporting their origin.
    fn is_own(&self, request: &Request) -> bool {
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let mut host = request.named("Host");
        let is_host_known =
            host.next().is_some_and(|host| hosts.iter().any(|own| own == host)) && host.next().is_none();
        let is_origin_own = request.named("Origin").all(|origin| {
            origin.strip_prefix("http://").is_some_and(|origin| hosts.iter().any(|own| own == origin))
        });
        let is_site_own = request.named("Sec-Fetch-Site").all(|site| matches!(site, "same-origin" | "none"));
        is_host_known && is_origin_own && is_site_own
    }
}

fn answer(stream: &mut TcpStream, status: u16, kind: &str, text: &str) {
    let headers = [
        ("Content-Type", kind),
        ("Cache-Control", "no-store"),
        ("X-Content-Type-Options", "nosniff"),
        ("X-Frame-Options", "DENY"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Referrer-Policy", "no-referrer"),
    ];
    // The page may have been closed: errors are ignored.
    let _ = http::answer(stream, status, &headers, text.as_bytes());
}
