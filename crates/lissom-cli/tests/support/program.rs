//! Runs the program in a folder of its own.

use std::ffi::OsStr;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How the program ended.
pub(crate) struct Ended {
    pub(crate) code: i32,
    pub(crate) output: String,
    pub(crate) errors: String,
}

/// The program while it runs.
pub(crate) struct Run(pub(crate) Child);

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

    /// Waits for the end; a program that does not end in time is killed, and the test fails.
    pub(crate) fn finish(mut self) -> Ended {
        let output = read_aside(self.0.stdout.take());
        let errors = read_aside(self.0.stderr.take());
        let began = Instant::now();
        let status = loop {
            if let Some(status) = self.0.try_wait().unwrap() {
                break Some(status);
            }
            if began.elapsed() > LONGEST {
                let _ = self.0.kill();
                let _ = self.0.wait();
                break None;
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let [output, errors] = [output, errors].map(|text| text.join().unwrap());
        let status = status.unwrap_or_else(|| panic!("not ended after {LONGEST:?}:\n{output}\n{errors}"));
        Ended { code: status.code().unwrap_or(-1), output, errors }
    }
}

/// A program that is left alone by a test that fails does not go on.
impl Drop for Run {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The longest that a test waits for the program.
const LONGEST: Duration = Duration::from_secs(300);

/// Reads while the program goes on, so that it need not wait for that.
fn read_aside(from: Option<impl Read + Send + 'static>) -> JoinHandle<String> {
    let mut text = String::new();
    std::thread::spawn(move || {
        from.expect("it is read once").read_to_string(&mut text).expect("it writes texts");
        text
    })
}

/// Runs the program to its end.
pub(crate) fn lissom(args: &[impl AsRef<OsStr>], folder: &Path) -> Ended {
    Run::start(args, folder).finish()
}
