//! Runs of the program; models and sessions that tests share with those of the library.

#[path = "../../../lissom/tests/support/cantilever.rs"]
pub(crate) mod cantilever;
#[path = "../../../lissom/tests/support/folder.rs"]
pub(crate) mod folder;
pub(crate) mod live;
#[path = "../../../lissom/tests/support/paths.rs"]
pub(crate) mod paths;
pub(crate) mod program;
#[path = "../../../lissom/tests/support/rail.rs"]
pub(crate) mod rail;
#[path = "../../../lissom/tests/support/refused.rs"]
pub(crate) mod refused;
#[path = "../../../lissom/tests/support/sessions.rs"]
pub(crate) mod sessions;
#[path = "../../../lissom/tests/support/starts.rs"]
pub(crate) mod starts;
#[path = "../../../lissom/tests/support/truss.rs"]
pub(crate) mod truss;

use std::path::Path;
use std::time::{Duration, Instant};

pub(crate) use cantilever::CANTILEVER;
pub(crate) use folder::Folder;
pub(crate) use live::{Live, held};
pub(crate) use program::{Ended, Run, lissom};

/// A section that no beam has, which is a warning of a model.
pub(crate) const SPARE_SECTION: &str = r#"

[sections.spare]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 200]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
"#;

/// Path of an example.
pub(crate) fn example(name: &str) -> String {
    format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"))
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
