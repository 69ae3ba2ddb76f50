//! The page of a model on this machine. Answers at one address that holds a random word, to this page's own requests, and
//! hands out nothing but the page and the results: no file can be named.

use std::collections::BTreeMap;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Read};
use std::net::{Ipv4Addr, SocketAddr};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use lissom::view;
use tiny_http::{Header, Method, Request, Response, Server};

use super::simulation::Shared;

/// Longest time that a page waits for news before it asks again.
const PATIENCE: Duration = Duration::from_secs(20);
/// Most requests that are answered at a time; pages hold one each while they wait.
const MOST_REQUESTS: usize = 24;
/// Longest list of values that a page may send [bytes].
const LONGEST_BODY: u64 = 1 << 16;

/// Serves the page in threads of its own for as long as the program runs. The address.
pub(super) fn start(port: u16, model: &Path, shared: &Arc<Shared>) -> io::Result<String> {
    let server = Server::http(SocketAddr::from((Ipv4Addr::LOCALHOST, port))).map_err(io::Error::other)?;
    let port = server.server_addr().to_ip().map_or(port, |address| address.port());
    let title = model.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let site = Arc::new(Site { word: random_word(), port, page: view::empty_page(&title) });
    let address = format!("http://127.0.0.1:{port}/{}/", site.word);
    let shared = Arc::clone(shared);
    let busy = Arc::new(AtomicUsize::new(0));
    std::thread::spawn(move || {
        for request in server.incoming_requests() {
            if busy.fetch_add(1, Ordering::SeqCst) >= MOST_REQUESTS {
                busy.fetch_sub(1, Ordering::SeqCst);
                answer(request, 503, "text/plain", "too many pages are open");
                continue;
            }
            let (site, shared, busy) = (Arc::clone(&site), Arc::clone(&shared), Arc::clone(&busy));
            std::thread::spawn(move || {
                site.serve(request, &shared);
                busy.fetch_sub(1, Ordering::SeqCst);
            });
        }
    });
    Ok(address)
}

/// A word that cannot be guessed: two values of a keyed hash whose 128-bit key the system has chosen at random.
fn random_word() -> String {
    let keyed = RandomState::new();
    format!("{:016x}{:016x}", keyed.hash_one(0_u64), keyed.hash_one(1_u64))
}

struct Site {
    word: String,
    port: u16,
    page: String,
}

impl Site {
    fn serve(&self, mut request: Request, shared: &Shared) {
        if !self.is_own(&request) {
            return answer(request, 403, "text/plain", "this page is for requests of its own alone");
        }
        let url = request.url().to_owned();
        let (path, query) = url.split_once('?').unwrap_or((&url, ""));
        let Some(path) = path.strip_prefix('/').and_then(|path| path.strip_prefix(&*self.word)) else {
            return answer(request, 404, "text/plain", "there is nothing here");
        };
        match (request.method(), path) {
            (Method::Get, "/") => answer(request, 200, "text/html; charset=utf-8", &self.page),
            (Method::Get, "/result") => {
                let after = query.strip_prefix("after=").and_then(|number| number.parse().ok()).unwrap_or(0);
                match shared.wait_after(after, PATIENCE) {
                    Some(told) => answer(request, 200, "application/json", &told),
                    None => answer(request, 204, "application/json", ""),
                }
            }
            (Method::Post, "/parameters") => {
                let mut body = String::new();
                let read = request.as_reader().take(LONGEST_BODY).read_to_string(&mut body);
                let values = serde_json::from_str::<BTreeMap<String, f64>>(&body);
                match (read, values) {
                    (Ok(_), Ok(values)) if values.values().all(|value| value.is_finite()) => {
                        shared.ask(values);
                        answer(request, 204, "text/plain", "");
                    }
                    _ => answer(request, 400, "text/plain", "numbers by name are wanted"),
                }
            }
            _ => answer(request, 404, "text/plain", "there is nothing here"),
        }
    }

    /// Whether a request comes from this page or from a person who has typed its address. A foreign page may make a
    /// browser send requests here, but cannot keep it from telling where they come from.
    fn is_own(&self, request: &Request) -> bool {
        let named = |name: &'static str| {
            let found = request.headers().iter().filter(move |header| header.field.equiv(name));
            found.map(|header| header.value.as_str())
        };
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let mut host = named("Host");
        let is_host_known =
            host.next().is_some_and(|host| hosts.iter().any(|own| own == host)) && host.next().is_none();
        let is_origin_own = named("Origin").all(|origin| {
            origin.strip_prefix("http://").is_some_and(|origin| hosts.iter().any(|own| own == origin))
        });
        let is_site_own = named("Sec-Fetch-Site").all(|site| matches!(site, "same-origin" | "none"));
        is_host_known && is_origin_own && is_site_own
    }
}

fn answer(request: Request, status: u16, kind: &str, text: &str) {
    let headers = [
        ("Content-Type", kind),
        ("Cache-Control", "no-store"),
        ("X-Content-Type-Options", "nosniff"),
        ("X-Frame-Options", "DENY"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Referrer-Policy", "no-referrer"),
    ];
    let mut response = Response::from_string(text).with_status_code(status);
    for header in headers.iter().filter_map(|(name, value)| Header::from_bytes(*name, *value).ok()) {
        response.add_header(header);
    }
    // A page that has been closed takes no answer.
    let _ = request.respond(response);
}
