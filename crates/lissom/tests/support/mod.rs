//! Runs the program in a folder of its own.

mod cantilever;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

pub(crate) use cantilever::CANTILEVER;

/// A folder that is gone afterwards.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// A new, empty folder.
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lissom-program-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.join(name), text).unwrap();
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Path of an example.
pub(crate) fn example(name: &str) -> String {
    format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// How the program ended.
pub(crate) struct Ended {
    pub(crate) code: i32,
    pub(crate) output: String,
    pub(crate) errors: String,
}

/// The program while it runs.
pub(crate) struct Run(Child);

impl Run {
    pub(crate) fn start(args: &[impl AsRef<OsStr>], folder: &Path) -> Self {
        let program = env!("CARGO_BIN_EXE_lissom");
        let mut command = Command::new(program);
        command.args(args).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
        Self(command.spawn().unwrap())
    }

    /// What Ctrl-C sends.
    pub(crate) fn interrupt(&mut self) {
        let pid = self.0.id().to_string();
        assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    }

    pub(crate) fn finish(self) -> Ended {
        let ended = self.0.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Ended {
            code: ended.status.code().unwrap_or(-1),
            output: text(ended.stdout),
            errors: text(ended.stderr),
        }
    }
}

/// Runs the program to its end.
pub(crate) fn lissom(args: &[impl AsRef<OsStr>], folder: &Path) -> Ended {
    Run::start(args, folder).finish()
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
        assert!(began.elapsed() < Duration::from_secs(60), "waited in vain");
        std::thread::sleep(Duration::from_millis(10));
    }
}
