//! Messages between a simulation and the process of a unit: the length as four bytes, then the content.

use std::io::{self, Read, Write};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Version of the standard of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Standard {
    /// FMI 2.0.
    Fmi2,
    /// FMI 3.0.
    Fmi3,
}

/// Type of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum VariableType {
    /// `Float64`, or `Real`.
    Real,
    /// `Int32`, or `Integer`.
    Integer,
    /// `Boolean`, 0 or 1.
    Boolean,
}

/// A variable by its value reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Variable {
    /// Value reference.
    pub reference: u32,
    /// Type.
    pub holds: VariableType,
}

/// How a unit is loaded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// Version of the program, which must be that of the process.
    pub version: String,
    /// Version of the standard.
    pub standard: Standard,
    /// Path of the shared library.
    pub library: String,
    /// Absolute path of the folder of the resources.
    pub resources: String,
    /// Name of the instance.
    pub name: String,
    /// Instantiation token, or GUID.
    pub token: String,
    /// Start time [s].
    pub start: f64,
    /// Variables with their start values.
    pub parameters: Vec<(Variable, f64)>,
    /// Inputs.
    pub inputs: Vec<Variable>,
    /// Outputs.
    pub outputs: Vec<Variable>,
    /// Whether the state of the unit can be stored.
    pub saves: bool,
    /// For model exchange.
    pub equations: Option<Equations>,
    /// Checksum and length of the archive: stored states belong to these equations.
    pub archive: [u64; 2],
}

/// Equations of a unit for model exchange.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Equations {
    /// Value references of the states.
    pub states: Vec<u32>,
    /// Value references of their derivatives.
    pub derivatives: Vec<u32>,
    /// Number of event indicators.
    pub indicators: usize,
    /// Nominal values of the states, then of the inputs: increments for differences.
    pub nominals: Vec<f64>,
    /// Whether the unit must be notified of accepted steps.
    pub completes: bool,
    /// Values that are evaluated at once.
    pub groups: Vec<Group>,
}

/// Values of a unit that depend on all states and the same inputs: outputs, then derivatives of states, then event indicators.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// Indices of the inputs.
    pub inputs: Vec<usize>,
    /// Indices of the outputs.
    pub outputs: Vec<usize>,
    /// Outputs, counted in the group, that are continuous; others have no derivatives.
    pub continuous: Vec<usize>,
    /// Whether derivatives of states and event indicators are in the group.
    pub has_derivatives: bool,
    /// Whether the unit provides directional derivatives of all of them.
    pub differentiates: bool,
}

/// A request to the process of a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Loads and instantiates the unit.
    Open(Box<Opening>),
    /// Sets inputs before the first step; the answer has the outputs.
    Begin(Vec<f64>),
    /// Sets inputs and takes a step.
    Advance {
        /// Time at the start of the step [s].
        from: f64,
        /// Size of the step [s].
        step: f64,
        /// Values of the inputs.
        inputs: Vec<f64>,
    },
    /// Evaluates a group at a time [s], with all states and the inputs of the group.
    Evaluate {
        /// Index of the group.
        group: usize,
        /// Time [s].
        time: f64,
        /// States, then inputs.
        arguments: Vec<f64>,
        /// Whether derivatives with respect to them are required.
        differentiates: bool,
    },
    /// Notifies the unit of an accepted step that ends here.
    Complete(Point),
    /// Executes an event; the first one ends the initialisation.
    Event(Point),
    /// Returns the state.
    Save,
    /// Sets the state.
    Restore(Vec<u8>),
}

/// Time, states and inputs of a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Time [s].
    pub time: f64,
    /// States.
    pub states: Vec<f64>,
    /// Inputs.
    pub inputs: Vec<f64>,
}

/// What a request has resulted in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// It is done.
    Done,
    /// Values of the outputs.
    Values(Vec<f64>),
    /// The state.
    State(Vec<u8>),
    /// Values of a group, and their derivatives value by value.
    Evaluated {
        /// The values.
        values: Vec<f64>,
        /// Derivatives, empty if they were not required.
        derivatives: Vec<f64>,
    },
    /// The unit discards the point, for this reason.
    Discarded(String),
    /// Whether the unit requests an event after a step.
    Completed(bool),
    /// States after an event, and the time of the next event that is known in advance [s].
    Event(Vec<f64>, Option<f64>),
}

/// The answer to a request, or why there is none, and messages of the unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reply {
    /// The answer.
    pub answer: Result<Answer, String>,
    /// Messages of the unit since the last reply.
    pub log: Vec<String>,
}

/// Largest length of a message [bytes]: states of units may have hundreds of megabytes.
const MAX_LENGTH: u64 = 1 << 30;

/// Sends a message.
///
/// # Errors
/// If the other process has ended.
pub fn send(to: &mut impl Write, message: &impl Serialize) -> io::Result<()> {
    let content = postcard::to_stdvec(message).map_err(io::Error::other)?;
    let length = u32::try_from(content.len()).map_err(io::Error::other)?;
    let mut bytes = length.to_le_bytes().to_vec();
    bytes.extend(content);
    to.write_all(&bytes)?;
    to.flush()
}

/// Receives a message.
///
/// # Errors
/// If the other process has ended, or sends something else.
pub fn receive<T: DeserializeOwned>(from: &mut impl Read) -> io::Result<T> {
    let mut length = [0; 4];
    from.read_exact(&mut length)?;
    let length = u64::from(u32::from_le_bytes(length));
    if length > MAX_LENGTH {
        return Err(io::ErrorKind::InvalidData.into());
    }
    // Memory grows with what arrives: a wrong length allocates nothing.
    let mut content = Vec::new();
    from.take(length).read_to_end(&mut content)?;
    if (content.len() as u64) < length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    postcard::from_bytes(&content).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}
