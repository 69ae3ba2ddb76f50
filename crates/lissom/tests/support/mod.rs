//! Models, sessions and runs of the program that several tests share.

pub(crate) mod cantilever;
#[cfg(feature = "command-line")]
pub(crate) mod live;
pub(crate) mod paths;
#[cfg(feature = "command-line")]
pub(crate) mod program;
pub(crate) mod rail;
pub(crate) mod refused;
pub(crate) mod runs;
pub(crate) mod series;
pub(crate) mod sessions;
pub(crate) mod truss;

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

pub(crate) use cantilever::{CANTILEVER, SPARE_SECTION};
pub(crate) use live::{Live, held};
pub(crate) use program::{Ended, Folder, Run, lissom};

/// Path of an example.
pub(crate) fn example(name: &str) -> String {
    format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

impl Run {
    /// What Ctrl-C sends.
    pub(crate) fn interrupt(&mut self) {
        let pid = self.0.id().to_string();
        assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    }
}

/// The summary in a folder.
pub(crate) fn summary(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Waits until something is so, but not for ever.
pub(crate) fn wait_for(is_so: impl Fn() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < Duration::from_secs(60), "waited without success");
        std::thread::sleep(Duration::from_millis(10));
    }
}
