//! The process of a unit: answers requests until the simulation closes the connection.

use std::io;

use serde::{Deserialize, Serialize};

use crate::ffi::{Unit, logged};
use crate::messages::{Answer, Opening, Reply, Request, receive, send};

/// A unit with what is known of its run.
struct Hosted {
    unit: Unit,
    opening: Opening,
    has_begun: bool,
    /// Inputs at the start.
    start: Vec<f64>,
}

/// Serves one unit over the socket that is the standard input of this process; `version` is that of the program.
///
/// # Errors
/// If the standard input is no socket, or a message cannot be read.
#[cfg(unix)]
pub fn serve(version: &str) -> io::Result<()> {
    use std::os::fd::AsFd;
    use std::os::unix::net::UnixStream;
    let mut stream = UnixStream::from(io::stdin().as_fd().try_clone_to_owned()?);
    let mut hosted = None;
    loop {
        let request = match receive(&mut stream) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            other => other?,
        };
        let answer = handle(&mut hosted, request, version);
        send(&mut stream, &Reply { answer, log: logged() })?;
    }
}

/// Serves no unit: this platform has no connected sockets between processes.
///
/// # Errors
/// Always.
#[cfg(not(unix))]
pub fn serve(_: &str) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

fn handle(hosted: &mut Option<Hosted>, request: Request, version: &str) -> Result<Answer, String> {
    if let Request::Open(opening) = request {
        if opening.version != version {
            let there = &opening.version;
            return Err(format!(
                "the simulation is of version {there}, the program for units of version {version}"
            ));
        }
        *hosted = Some(Hosted::open(*opening)?);
        return Ok(Answer::Done);
    }
    let Some(own) = hosted else { return Err("no unit is loaded".to_owned()) };
    match request {
        Request::Open(_) => Ok(Answer::Done),
        Request::Begin(_) if own.has_begun => Err("the unit has left its start".to_owned()),
        Request::Begin(inputs) => {
            own.set_start(inputs)?;
            Ok(Answer::Values(own.unit.get(&own.opening.outputs)?))
        }
        Request::Advance { from, step, inputs } => {
            own.begin()?;
            own.unit.set(&own.opening.inputs, &inputs)?;
            own.unit.step([from, step], !own.opening.saves)?;
            Ok(Answer::Values(own.unit.get(&own.opening.outputs)?))
        }
        Request::Save => Ok(Answer::State(own.save()?)),
        Request::Restore(state) => {
            match postcard::from_bytes(&state).map_err(|error| error.to_string())? {
                Saved::State(token, _) if token != own.opening.token => {
                    return Err("the state is of another unit, or of another version of it".to_owned());
                }
                Saved::State(_, state) => {
                    own.begin()?;
                    own.unit.restore(&state)?;
                }
                Saved::Start(inputs) => {
                    if own.has_begun {
                        // The instance is freed first: some units exist only once in a process.
                        let opening = own.opening.clone();
                        *hosted = None;
                        *hosted = Some(Hosted::open(opening)?);
                    }
                    if let Some(own) = hosted {
                        own.set_start(inputs)?;
                    }
                }
            }
            Ok(Answer::Done)
        }
    }
}

/// A saved state.
#[derive(Serialize, Deserialize)]
enum Saved {
    /// Before the first step, with the inputs there.
    Start(Vec<f64>),
    /// Between two steps: the instantiation token of the unit, and what it has returned.
    State(String, Vec<u8>),
}

impl Hosted {
    /// Loads a unit and begins its initialisation.
    fn open(opening: Opening) -> Result<Self, String> {
        let mut unit = Unit::load(&opening)?;
        for (variable, value) in &opening.parameters {
            unit.set(&[*variable], &[*value])?;
        }
        unit.enter_initialization(opening.start)?;
        Ok(Self { unit, opening, has_begun: false, start: Vec::new() })
    }

    fn set_start(&mut self, inputs: Vec<f64>) -> Result<(), String> {
        self.unit.set(&self.opening.inputs, &inputs)?;
        self.start = inputs;
        Ok(())
    }

    /// Ends the initialisation.
    fn begin(&mut self) -> Result<(), String> {
        if !self.has_begun {
            self.unit.exit_initialization()?;
            self.has_begun = true;
        }
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>, String> {
        let saved = if self.has_begun {
            Saved::State(self.opening.token.clone(), self.unit.save()?)
        } else {
            Saved::Start(self.start.clone())
        };
        postcard::to_stdvec(&saved).map_err(|error| error.to_string())
    }
}
