//! `lissom live` as a page and as strangers see it.

use std::fs;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{CANTILEVER, Folder, Live, SPARE_SECTION, held};

impl Live {
    /// What is sent after `version`.
    fn after(&self, version: u64) -> Value {
        let began = Instant::now();
        loop {
            let path = format!("/{}/result?after={version}", self.word);
            let (status, body) = self.ask("GET", &path, &self.host(), "", "");
            if status == 200 {
                return serde_json::from_str(&body).unwrap();
            }
            assert_eq!(status, 204);
            assert!(began.elapsed() < Duration::from_secs(60), "nothing is sent after {version}");
        }
    }

    fn set(&self, body: &str) -> u16 {
        self.ask("POST", &format!("/{}/parameters", self.word), &self.host(), "", body).0
    }
}

fn version(reported: &Value) -> u64 {
    reported["version"].as_u64().unwrap()
}

/// Puts another file in the place of the model, as editors do.
fn save(folder: &Folder, text: &str) {
    folder.write("bar.toml.new", text);
    fs::rename(folder.path().join("bar.toml.new"), folder.path().join("bar.toml")).unwrap();
}

const WITH_PARAMETER: &str = "lissom = 1\n\n[parameters]\nload = 3\n";

fn model() -> String {
    CANTILEVER.replace("lissom = 1", WITH_PARAMETER).replace("3*t", "load*t")
}

#[test]
fn a_model_is_simulated_again_when_it_is_saved_and_mistakes_are_reported_meanwhile() {
    let folder = Folder::new("live-save");
    folder.write("bar.toml", &model());
    let live = Live::start("bar.toml", folder.path());
    let first = live.after(0);
    assert_eq!(first["notice"], Value::Null, "{first}");
    assert_eq!(first["result"]["motion"]["frames"], 5);
    // A mistake: it is underlined, and there are no results that could replace those on the page.
    save(&folder, &model().replace("elements = 4", "elements = -4"));
    let wrong = live.after(version(&first));
    let text = wrong["notice"]["text"].as_str().unwrap();
    assert!(wrong["result"].is_null() && wrong["notice"]["is_code"] == true);
    assert!(text.contains("elements") && text.contains("bar.toml:"), "{text}");
    // Half a file, as an editor may leave it for a moment, and then a right one.
    save(&folder, "lissom = ");
    let half = live.after(version(&wrong));
    assert!(half["result"].is_null());
    save(&folder, &model().replace("steps = 4", "steps = 7"));
    let right = live.after(version(&half));
    assert_eq!((&right["notice"], &right["result"]["motion"]["frames"]), (&Value::Null, &Value::from(8)));
    // A model that has no solution shows how far it came.
    save(&folder, &model().replace("load*t", "1e9*t").replace("steps = 4", "steps = 2\nmax_iterations = 3"));
    let failed = live.after(version(&right));
    assert_eq!(failed["result"]["notices"][0]["kind"], "error", "{}", failed["result"]["notices"]);
    fs::remove_file(folder.path().join("bar.toml")).unwrap();
    let gone = live.after(version(&failed));
    assert!(gone["notice"]["text"].as_str().unwrap().contains("no such file"), "{gone}");
    assert!(!folder.path().join("out").exists(), "no file is written");
}

#[test]
fn warnings_are_those_of_the_last_results() {
    let folder = Folder::new("live-warnings");
    folder.write("bar.toml", &format!("{}{SPARE_SECTION}", model()));
    let live = Live::start("bar.toml", folder.path());
    let first = live.after(0);
    let found = &first["result"]["notices"];
    assert_eq!((&found[0]["code"], &found[0]["part"]), (&"model".into(), &"spare".into()), "{found}");
    save(&folder, &model());
    let second = live.after(version(&first));
    assert_eq!(second["result"]["notices"], serde_json::json!([]));
}

#[test]
fn sliders_simulate_again() {
    let folder = Folder::new("live-slider");
    folder.write("bar.toml", &model());
    let live = Live::start("bar.toml", folder.path());
    let first = live.after(0);
    assert_eq!(
        first["parameters"][0],
        serde_json::json!({ "name": "load", "base": 3.0, "value": 3.0, "comment": "" })
    );
    assert_eq!(live.set("{\"load\": 4.5, \"unknown\": 1}"), 204);
    let second = live.after(version(&first));
    assert_eq!(second["parameters"][0]["value"], 4.5);
    let scale = &second["result"]["scene"]["loads"][0]["scale"];
    assert_eq!(scale.as_array().unwrap().last().unwrap(), 4.5);
    for wrong in ["", "[1]", "{\"load\": \"high\"}", "{\"load\": 1e999}"] {
        assert_eq!(live.set(wrong), 400, "{wrong}");
    }
    assert_eq!(live.set("{}"), 204);
    assert_eq!(live.after(version(&second))["parameters"][0]["value"], 3.0);
}

#[test]
fn strangers_are_refused() {
    let folder = Folder::new("live-strangers");
    folder.write("bar.toml", &model());
    folder.write("secret.toml", "secret");
    let live = Live::start("bar.toml", folder.path());
    let own = format!("/{}/", live.word);
    let host = live.host();
    let get = |path: &str, host: &str, more: &str| live.ask("GET", path, host, more, "");
    let (status, page) = get(&own, &host, "");
    assert!(status == 200 && page.contains("connect-src 'self'") && !page.contains("{{"));
    assert_eq!(get(&own, &format!("localhost:{}", live.port), "").0, 200);
    assert_eq!(get(&own, &host, &format!("Origin: http://{host}\r\n")).0, 200);
    // Pages of others, also those whose name was made to lead here.
    for origin in
        ["http://example.org", "null", "https://127.0.0.1", &format!("http://127.0.0.1:{}", live.port ^ 1)]
    {
        assert_eq!(get(&own, &host, &format!("Origin: {origin}\r\n")).0, 403, "{origin}");
        let path = format!("/{}/parameters", live.word);
        let sent = live.ask("POST", &path, &host, &format!("Origin: {origin}\r\n"), "{}");
        assert_eq!(sent.0, 403, "{origin}");
    }
    for other in ["example.org", &format!("example.org:{}", live.port), "127.0.0.1", "127.0.0.1:1"] {
        assert_eq!(get(&own, other, "").0, 403, "{other}");
    }
    assert_eq!(get(&own, &host, "Sec-Fetch-Site: cross-site\r\n").0, 403);
    assert_eq!(get(&own, &host, "Host: example.org\r\n").0, 403);
    assert_eq!(live.send(&format!("GET {own} HTTP/1.0\r\n\r\n")).0, 403, "without a host");
    // Other words, other paths: no file has a name here.
    let other = "0".repeat(32);
    let paths = [
        "/".to_owned(),
        format!("/{other}/"),
        format!("/{}", live.word),
        format!("{own}secret.toml"),
        format!("{own}../secret.toml"),
        format!("{own}%2e%2e/secret.toml"),
        format!("{own}bar.toml"),
        "/etc/passwd".to_owned(),
    ];
    for path in paths {
        let (status, body) = get(&path, &host, "");
        assert!(status == 404 && !body.contains("secret"), "{path}: {status} {body}");
    }
    assert_eq!(live.ask("PUT", &own, &host, "", "").0, 404);
    // Only this machine is listened to.
    let words = fs::read_to_string("/proc/net/tcp").unwrap_or_default();
    let port = format!(":{:04X}", live.port);
    let listening = words.lines().filter(|line| line.contains(&port) && line.contains(" 0A "));
    for line in listening {
        assert!(line.contains(&format!("0100007F{port}")), "{line}");
    }
}

#[test]
fn what_is_malformed_or_too_large_is_rejected_and_the_server_lives() {
    let folder = Folder::new("live-limits");
    folder.write("bar.toml", &model());
    let live = Live::start("bar.toml", folder.path());
    let host = live.host();
    let of_length =
        |length: &str| format!("POST /x HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n");
    for (length, status) in [
        ("99999999999999", 413),
        ("99999999999999999999999999", 413),
        ("65537", 413),
        ("-1", 400),
        ("1e3", 400),
        ("12\r\nContent-Length: 13", 400),
        ("12\r\nTransfer-Encoding: chunked", 411),
    ] {
        assert_eq!(live.send(&of_length(length)).0, status, "{length}");
    }
    let long = format!("GET / HTTP/1.1\r\nHost: {host}\r\nX: {}", "a".repeat(1 << 14));
    assert_eq!(live.send(&long).0, 431);
    let many = format!("GET / HTTP/1.1\r\n{}\r\n", "X: a\r\n".repeat(1000));
    assert_eq!(live.send(&many).0, 431);
    assert_eq!(live.send("\u{16}\u{3}\u{1} no request\r\n\r\n").0, 400);
    // Connections beyond a bound are answered and closed, and memory stays bounded.
    let before = held(live.program.id());
    let open: Vec<_> = (0..300).filter_map(|_| TcpStream::connect(("127.0.0.1", live.port)).ok()).collect();
    std::thread::sleep(Duration::from_millis(300));
    if let (Some([memory, ..]), Some([now, threads, _])) = (before, held(live.program.id())) {
        assert!(threads < 60 && now < memory + 20_000, "{threads} threads, {memory} kB, then {now} kB");
    }
    drop(open);
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(live.ask("GET", &format!("/{}/", live.word), &host, "", "").0, 200);
}

#[test]
fn many_saves_leave_nothing_behind() {
    let folder = Folder::new("live-many");
    folder.write("bar.toml", &model());
    let live = Live::start("bar.toml", folder.path());
    let mut reported = live.after(0);
    let mut sizes = Vec::new();
    for round in 0..1000 {
        save(&folder, &format!("{}\n# {}", model(), "x".repeat(1 + round % 7)));
        reported = live.after(version(&reported));
        assert_eq!(reported["notice"], Value::Null);
        if round == 99 || round == 999 {
            sizes.extend(held(live.program.id()));
        }
    }
    if let [before, after] = sizes[..] {
        assert!(after[0] < before[0] + 4000, "{} kB after 100 saves, {} kB after 1000", before[0], after[0]);
        // Threads that answer end on their own.
        assert!(
            after[1] <= before[1] + 3 && after[2] <= before[2] + 3,
            "{before:?} threads and files, {after:?}"
        );
    }
}

#[test]
fn paths_are_followed_and_what_does_not_move_is_refused() {
    let folder = Folder::new("live-path");
    let statics = model();
    let (parts, _) = statics.split_once("[analysis]").unwrap();
    let parts = parts.replace("load*t", "load");
    save(&folder, &format!("{parts}[analysis]\nkind = \"path\"\nend = 1\n"));
    let live = Live::start("bar.toml", folder.path());
    let first = live.after(0);
    assert_eq!(first["notice"], Value::Null, "{first}");
    let scene = &first["result"]["scene"];
    let last = |list: &Value| list.as_array().unwrap().last().unwrap().as_f64().unwrap();
    assert!((last(&scene["path"]["values"]) - 1.0).abs() < 1e-9);
    assert!((last(&scene["loads"][0]["scale"]) - 3.0).abs() < 1e-8);
    save(&folder, &format!("{parts}[analysis]\nkind = \"buckling\"\n"));
    let refused = live.after(version(&first));
    assert!(
        refused["notice"]["text"].as_str().unwrap().contains("`buckling` is not simulated here"),
        "{refused}"
    );
}

#[test]
fn a_model_that_is_not_there_is_reported() {
    let folder = Folder::new("live-missing");
    let ended = crate::support::lissom(&["live", "nothing.toml"], folder.path());
    assert_eq!(ended.code, 2);
    assert!(ended.errors.contains("no such file"), "{}", ended.errors);
}

#[test]
fn a_change_in_an_included_file_is_seen() {
    let folder = Folder::new("live-included");
    let (parts, analysis) = CANTILEVER.split_once("[analysis]").unwrap();
    folder.write("part.toml", parts);
    folder.write(
        "model.toml",
        &format!("lissom = 1\n[parts.a]\ninclude = \"part.toml\"\n[analysis]{analysis}"),
    );
    let live = Live::start("model.toml", folder.path());
    let first = live.after(0);
    assert_eq!(first["notice"], Value::Null, "{first}");
    folder.write("part.toml", &parts.replace("elements = 4", "elements = -4"));
    let wrong = live.after(version(&first));
    assert!(wrong["notice"]["text"].as_str().unwrap().contains("part.toml:"), "{wrong}");
    folder.write("part.toml", &parts.replace("elements = 4", "elements = 5"));
    let right = live.after(version(&wrong));
    assert_eq!(right["notice"], Value::Null, "{right}");
}

#[test]
fn a_page_can_be_served_again_on_the_same_port() {
    let folder = Folder::new("live-port");
    folder.write("bar.toml", &model());
    let first = Live::start("bar.toml", folder.path());
    first.after(0);
    let port = first.port;
    // A page that waits for results while the program ends leaves a connection that the system closes later.
    let waiting = TcpStream::connect(("127.0.0.1", port)).unwrap();
    drop(first);
    let again = Live::start_at(port, "bar.toml", folder.path());
    assert_eq!(again.port, port);
    assert_eq!(again.after(0)["notice"], Value::Null);
    drop(waiting);
}
