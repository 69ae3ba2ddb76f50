//! The process of a unit, as the simulation sees it: requests with a limit of time, and what is left when it has ended.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use lissom_core::interrupt;
use lissom_core::units::{AfterEvent, EvaluationFault, GroupPoint, Unit, UnitFault, UnitPoint, UnitValues};
use lissom_units::{Answer, Opening, Point, Reply, Request, end_group, receive, send};

use super::evaluations::Evaluations;

#[cfg(unix)]
type Stream = std::os::unix::net::UnixStream;
#[cfg(not(unix))]
type Stream = std::net::TcpStream;

/// Environment variable with the program that serves units, if it is not found by itself.
const PROGRAM: &str = "LISSOM_UNIT_HOST";
/// Subcommand of the program that serves units.
pub const COMMAND: &str = "unit-host";
/// How often a simulation that waits for a unit checks whether it is interrupted, and whether the process exists.
const POLL: Duration = Duration::from_millis(50);

/// The command that starts a process for a unit: a program and its arguments.
static HOST: Mutex<Option<(PathBuf, Vec<String>)>> = Mutex::new(None);

/// Sets the command that starts a process for a unit: it must call [`serve`](super::serve).
pub fn set_host(program: PathBuf, arguments: Vec<String>) {
    *HOST.lock().unwrap_or_else(PoisonError::into_inner) = Some((program, arguments));
}

/// The command for a process: the one that was set, that of the environment, or the program `lissom` beside this one or on the path.
fn host() -> Result<Command, UnitFault> {
    let set = HOST.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if let Some((program, arguments)) = set.filter(|_| std::env::var_os(PROGRAM).is_none()) {
        let mut command = Command::new(program);
        command.args(arguments);
        return Ok(command);
    }
    let name = format!("lissom{}", std::env::consts::EXE_SUFFIX);
    let own = std::env::current_exe().ok();
    // Tests and examples of Cargo are one folder below.
    let beside = own.iter().flat_map(|own| own.ancestors().skip(1).take(2)).map(|folder| folder.join(&name));
    let path = std::env::var_os("PATH").unwrap_or_default();
    let on_path: Vec<PathBuf> = std::env::split_paths(&path).map(|folder| folder.join(&name)).collect();
    let given = std::env::var_os(PROGRAM).map(PathBuf::from);
    let Some(program) = given.or_else(|| beside.chain(on_path).find(|program| program.is_file())) else {
        let cause = "the program `lissom`, which starts the process of a unit, is not found".to_owned();
        let remedy = format!("put it on the PATH, or set {PROGRAM} to its path");
        return Err(UnitFault { cause, remedy });
    };
    let is_python = program.file_stem().is_some_and(|stem| stem.to_string_lossy().starts_with("python"));
    let mut command = Command::new(program);
    if is_python {
        command.args(["-c", "from lissom._lissom import serve_unit; serve_unit()"]);
    } else {
        command.arg(COMMAND);
    }
    Ok(command)
}

/// A unit in its process, which answers one request after the other.
#[derive(Debug)]
pub(super) struct UnitProcess {
    running: Mutex<Running>,
    saves: bool,
    /// Whether the unit must be notified of accepted steps.
    completes: bool,
    /// Number of its states with equations, or of its outputs at samples.
    values: usize,
}

#[derive(Debug)]
struct Running {
    connection: Connection,
    evaluations: Evaluations,
    fault: Option<EvaluationFault>,
}

#[derive(Debug)]
struct Connection {
    child: Child,
    /// None after a failure.
    stream: Option<Stream>,
    /// The last bytes that the process has written to the terminal.
    written: Arc<Mutex<Vec<u8>>>,
    timeout: Duration,
    folder: UnpackedFolder,
}

/// A folder with the files of a unit, removed with this value by the process that made it.
#[derive(Debug)]
pub(super) struct UnpackedFolder {
    pub(super) path: PathBuf,
    /// Locked as long as the folder is in use.
    pub(super) _lock: File,
    /// The process that made it.
    pub(super) owner: u32,
}

impl UnpackedFolder {
    /// Whether this process is a copy, made by a fork, of the one that made the folder.
    fn is_of_another_process(&self) -> bool {
        self.owner != std::process::id()
    }
}

impl Drop for UnpackedFolder {
    fn drop(&mut self) {
        if !self.is_of_another_process() {
            // What cannot be removed remains among the temporary files.
            let _ = std::fs::remove_dir_all(&self.path);
        }
    }
}

/// A connection during one request: waits until the limit of time, while the process exists and the simulation is not interrupted.
struct Link<'a> {
    stream: &'a mut Stream,
    child: &'a mut Child,
    deadline: Option<Instant>,
}

impl Link<'_> {
    fn wait<T>(&mut self, mut attempt: impl FnMut(&mut Stream) -> io::Result<T>) -> io::Result<T> {
        loop {
            match attempt(self.stream) {
                Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => {
                }
                other => return other,
            }
            if interrupt::is_asked() {
                // Functions of the standard library repeat calls that are `Interrupted`.
                return Err(io::ErrorKind::ConnectionAborted.into());
            }
            // Its children may keep the connection open.
            if !matches!(self.child.try_wait(), Ok(None)) {
                return Err(io::ErrorKind::BrokenPipe.into());
            }
            if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                return Err(io::ErrorKind::TimedOut.into());
            }
        }
    }
}

impl Read for Link<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.wait(|stream| stream.read(bytes))
    }
}

impl Write for Link<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.wait(|stream| stream.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// A text of another program in one line, without control characters.
fn plain(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut joined = lines.collect::<Vec<_>>().join("; ");
    // Terminals interpret control characters.
    joined.retain(|sign| !sign.is_control());
    let count = joined.chars().count();
    if count > 600 { joined.chars().skip(count - 600).collect() } else { joined }
}

fn words(status: Option<ExitStatus>) -> String {
    #[cfg(unix)]
    if let Some(signal) = status.and_then(|status| std::os::unix::process::ExitStatusExt::signal(&status)) {
        let name = match signal {
            4 => " (illegal instruction)",
            6 => " (abort)",
            8 => " (arithmetic exception)",
            9 => " (killed)",
            11 => " (invalid memory access)",
            _ => "",
        };
        return format!("its process was ended by signal {signal}{name}");
    }
    match status.and_then(|status| status.code()) {
        Some(code) => format!("its process ended with exit code {code}"),
        None => "its process ended".to_owned(),
    }
}

impl UnitProcess {
    /// Starts a process and loads the unit, whose files are in `folder`.
    pub(super) fn start(
        opening: Opening,
        folder: UnpackedFolder,
        timeout: Duration,
    ) -> Result<Self, UnitFault> {
        let saves = opening.saves;
        let sampled = (false, opening.outputs.len());
        let (completes, values) =
            opening.equations.as_ref().map_or(sampled, |own| (own.completes, own.states.len()));
        let mut command = host()?;
        let program = PathBuf::from(command.get_program());
        let failed = |error: io::Error| UnitFault {
            cause: format!("its process, `{}`, cannot be started: {error}", program.display()),
            remedy: format!("check the program, or set {PROGRAM} to the path of `lissom`"),
        };
        let (stream, child) = spawn(&mut command, &folder.path).map_err(failed)?;
        let poll = Some(POLL.min(timeout));
        stream.set_read_timeout(poll).and_then(|()| stream.set_write_timeout(poll)).map_err(failed)?;
        let mut connection =
            Connection { child, stream: Some(stream), written: Arc::default(), timeout, folder };
        connection.collect_errors();
        connection.request(&Request::Open(Box::new(opening)))?;
        let running = Running { connection, evaluations: Evaluations::default(), fault: None };
        Ok(Self { running: Mutex::new(running), saves, completes, values })
    }

    fn running(&self) -> MutexGuard<'_, Running> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes a request after which values may differ.
    fn change(&self, request: &Request) -> Result<Answer, UnitFault> {
        let mut running = self.running();
        running.evaluations.clear();
        running.connection.request(request)
    }

    fn values(&self, request: &Request) -> Result<Vec<f64>, UnitFault> {
        match self.change(request)? {
            Answer::Values(values) if values.len() == self.values => Ok(values),
            _ => Err(unexpected()),
        }
    }
}

impl Running {
    /// Evaluates a group.
    fn evaluate(
        &mut self,
        GroupPoint { group, time, arguments }: GroupPoint<'_>,
        differentiates: bool,
    ) -> Result<UnitValues, EvaluationFault> {
        let fails = |fault| EvaluationFault { fails_at: Some(time), fault };
        let discards = |cause| EvaluationFault { fails_at: None, fault: unusable(cause) };
        let request = Request::Evaluate { group, time, arguments: arguments.to_vec(), differentiates };
        match self.connection.request(&request).map_err(fails)? {
            Answer::Evaluated { values, derivatives }
                if !differentiates || derivatives.len() == values.len() * arguments.len() =>
            {
                if values.iter().chain(&derivatives).all(|value| value.is_finite()) {
                    return Ok(UnitValues { values, derivatives });
                }
                Err(discards(format!("one of its values or derivatives is not finite at t = {time} s")))
            }
            Answer::Discarded(cause) => Err(discards(cause)),
            _ => Err(fails(unexpected())),
        }
    }
}

fn unexpected() -> UnitFault {
    UnitFault {
        cause: "its process gives another answer than expected".to_owned(),
        remedy: "start the simulation again".to_owned(),
    }
}

/// A fault of a unit whose values cannot be used at a point.
fn unusable(cause: String) -> UnitFault {
    UnitFault { cause, remedy: "look for the cause in its inputs, states and parameters".to_owned() }
}

/// Starts the process with a socket as its standard input. It has a group of its own, so that an interrupt from the keyboard reaches
/// the simulation alone.
#[cfg(unix)]
fn spawn(command: &mut Command, folder: &Path) -> io::Result<(Stream, Child)> {
    use std::os::fd::OwnedFd;
    use std::os::unix::process::CommandExt;
    let (own, other) = Stream::pair()?;
    command.stdin(Stdio::from(OwnedFd::from(other))).stdout(Stdio::null()).stderr(Stdio::piped());
    command.current_dir(folder).process_group(0);
    let child = command.spawn()?;
    // The socket is also open in the command: without this the end of the process would not be noticed.
    command.stdin(Stdio::null());
    Ok((own, child))
}

#[cfg(not(unix))]
fn spawn(_: &mut Command, _: &Path) -> io::Result<(Stream, Child)> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "units run on Linux and macOS only"))
}

impl Connection {
    /// Keeps the end of what the process writes to the terminal, for messages.
    fn collect_errors(&mut self) {
        let Some(mut from) = self.child.stderr.take() else { return };
        let written = Arc::clone(&self.written);
        std::thread::spawn(move || {
            let mut bytes = [0; 1024];
            while let Ok(count) = from.read(&mut bytes) {
                if count == 0 {
                    break;
                }
                let mut all = written.lock().unwrap_or_else(PoisonError::into_inner);
                all.extend_from_slice(&bytes[..count]);
                let excess = all.len().saturating_sub(4096);
                all.drain(..excess);
            }
        });
    }

    fn request(&mut self, request: &Request) -> Result<Answer, UnitFault> {
        if self.folder.is_of_another_process() {
            let cause = "the simulation belongs to the process from which this one was forked".to_owned();
            let remedy = "make a new simulation in this process".to_owned();
            return Err(UnitFault { cause, remedy });
        }
        let Some(stream) = &mut self.stream else {
            let remedy = "start the simulation again".to_owned();
            return Err(UnitFault { cause: "its process has ended".to_owned(), remedy });
        };
        let deadline = Instant::now().checked_add(self.timeout);
        let mut link = Link { stream, child: &mut self.child, deadline };
        let answered = send(&mut link, request).and_then(|()| receive::<Reply>(&mut link));
        let error = match answered {
            Ok(Reply { answer: Ok(answer), .. }) => return Ok(answer),
            Ok(Reply { answer: Err(error), log }) => {
                let mut cause = error;
                for words in [log.join("\n"), self.terminal()] {
                    let words = plain(&words);
                    if !words.is_empty() {
                        cause = format!("{cause}: {words}");
                    }
                }
                let remedy = if cause.contains("undefined symbol: Py")
                    || cause.contains("undefined symbol: _Py")
                {
                    format!(
                        "it needs a Python interpreter: run the model from Python, or set {PROGRAM}=python3"
                    )
                } else {
                    "check its inputs and parameters, and its step `sample` if it has one".to_owned()
                };
                return Err(UnitFault { cause, remedy });
            }
            Err(error) => error,
        };
        self.stream = None;
        let ended = match error.kind() {
            io::ErrorKind::TimedOut => Some((
                format!("it did not answer within {} s", self.timeout.as_secs_f64()),
                "increase `timeout` of the unit, or look for what it waits for",
            )),
            io::ErrorKind::ConnectionAborted => Some(("the run was interrupted".to_owned(), "run it again")),
            io::ErrorKind::InvalidData => Some((
                "its process sends an answer that cannot be read".to_owned(),
                "check whether the unit writes to its standard input, which connects it to the simulation",
            )),
            _ => None,
        };
        if let Some((cause, remedy)) = ended {
            end_group(self.child.id());
            return Err(UnitFault { cause, remedy: remedy.to_owned() });
        }
        let mut cause = words(self.wait(Duration::from_secs(5)));
        end_group(self.child.id());
        let written = plain(&self.terminal());
        if !written.is_empty() {
            cause = format!("{cause}; it wrote: {written}");
        }
        let remedy =
            "run the unit alone, with the inputs of this instant, in the program that made it".to_owned();
        Err(UnitFault { cause, remedy })
    }

    /// What the process has written to the terminal.
    fn terminal(&self) -> String {
        String::from_utf8_lossy(&self.written.lock().unwrap_or_else(PoisonError::into_inner)).into_owned()
    }

    /// Waits for the end of the process, which is ended after `longest`.
    fn wait(&mut self, longest: Duration) -> Option<ExitStatus> {
        let began = Instant::now();
        while began.elapsed() < longest {
            if let Ok(Some(status)) = self.child.try_wait() {
                return Some(status);
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        end_group(self.child.id());
        self.child.wait().ok()
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.stream = None;
        if !self.folder.is_of_another_process() {
            self.wait(Duration::from_secs(2));
        }
    }
}

fn point(at: &UnitPoint) -> Point {
    Point { time: at.time, states: at.states.clone(), inputs: at.inputs.clone() }
}

impl Unit for UnitProcess {
    fn begin(&self, inputs: &[f64]) -> Result<Vec<f64>, UnitFault> {
        self.values(&Request::Begin(inputs.to_vec()))
    }

    fn advance(&self, [from, step]: [f64; 2], inputs: &[f64]) -> Result<Vec<f64>, UnitFault> {
        self.values(&Request::Advance { from, step, inputs: inputs.to_vec() })
    }

    fn evaluate(&self, at: GroupPoint<'_>, differentiates: bool) -> Option<Arc<UnitValues>> {
        let mut running = self.running();
        let known = running.evaluations.find(at, differentiates);
        let has_failed = running.fault.as_ref().is_some_and(|fault| fault.fails_at.is_some());
        if known.is_some() || has_failed || at.arguments.iter().any(|argument| !argument.is_finite()) {
            return known;
        }
        match running.evaluate(at, differentiates) {
            Ok(found) => {
                let found = Arc::new(found);
                running.evaluations.keep(at, &found);
                Some(found)
            }
            Err(fault) => {
                running.fault = Some(fault);
                None
            }
        }
    }

    fn fault(&self) -> Option<EvaluationFault> {
        self.running().fault.clone()
    }

    fn complete(&self, at: &UnitPoint) -> Result<bool, UnitFault> {
        let mut running = self.running();
        // Points of attempts that were not accepted.
        running.fault.take_if(|fault| fault.fails_at.is_none());
        if !self.completes {
            return Ok(false);
        }
        match running.connection.request(&Request::Complete(point(at)))? {
            Answer::Completed(requests) => Ok(requests),
            _ => Err(unexpected()),
        }
    }

    fn event(&self, at: &UnitPoint) -> Result<AfterEvent, UnitFault> {
        match self.change(&Request::Event(point(at)))? {
            Answer::Event(states, next) if states.len() == self.values => {
                let is_wrong = states.iter().any(|state| !state.is_finite());
                let is_past = next.is_some_and(|next| next.is_nan() || next <= at.time);
                let cause = match (is_wrong, is_past) {
                    (true, _) => "a state is not finite after its event",
                    (_, true) => "it announces its next event at a time that has passed",
                    _ => return Ok(AfterEvent { states, next }),
                };
                Err(unusable(cause.to_owned()))
            }
            _ => Err(unexpected()),
        }
    }

    fn save(&self) -> Option<Vec<u8>> {
        match self.saves.then(|| self.running().connection.request(&Request::Save)) {
            Some(Ok(Answer::State(state))) => Some(state),
            _ => None,
        }
    }

    fn restore(&self, state: &[u8]) -> Result<(), UnitFault> {
        self.change(&Request::Restore(state.to_vec())).map(|_| ())
    }
}
