//! The process of a unit: answers requests until the simulation closes the connection.

use std::io;

use serde::{Deserialize, Serialize};

use crate::ffi::{Unit, logged};
use crate::messages::{
    Answer, Equations, Opening, Point, Reply, Request, Variable, VariableType, receive, send,
};

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
    use crate::ffi::end_group;
    use std::os::fd::AsFd;
    use std::os::unix::net::UnixStream;
    use std::os::unix::process::parent_id;
    use std::time::Duration;
    let simulation = parent_id();
    // A unit that computes does not notice that the simulation was killed. One between two steps ends by itself.
    std::thread::spawn(move || {
        while parent_id() == simulation {
            std::thread::sleep(Duration::from_millis(200));
        }
        std::thread::sleep(Duration::from_secs(1));
        end_group(0);
    });
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
            let states = own.opening.equations.as_ref().map(|equations| reals(&equations.states));
            Ok(Answer::Values(own.unit.get(&states.unwrap_or_else(|| own.opening.outputs.clone()))?))
        }
        Request::Evaluate { group, time, arguments, differentiates } => {
            let evaluated = own.evaluate((group, time), &arguments, differentiates);
            own.or_discarded(evaluated)
        }
        Request::Complete(at) => {
            let completed = own.set_all(&at).and_then(|()| own.unit.complete(at.time));
            Ok(Answer::Completed(completed?))
        }
        Request::Event(at) => own.event(&at),
        Request::Advance { from, step, inputs } => {
            own.begin()?;
            own.unit.set(&own.opening.inputs, &inputs)?;
            own.unit.step([from, step], !own.opening.saves)?;
            Ok(Answer::Values(own.unit.get(&own.opening.outputs)?))
        }
        Request::Save => Ok(Answer::State(own.save()?)),
        Request::Restore(state) => {
            match postcard::from_bytes(&state).map_err(|error| error.to_string())? {
                Saved::State(archive, _) | Saved::Start(archive, _) if archive != own.opening.archive => {
                    return Err("the file of the unit has changed since the state was stored".to_owned());
                }
                Saved::State(_, state) => {
                    own.begin()?;
                    own.unit.restore(&state)?;
                }
                Saved::Start(_, inputs) => {
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
    /// Before the first step: the archive of the unit, and the inputs there.
    Start([u64; 2], Vec<f64>),
    /// Between two steps: the archive of the unit, and what it has returned.
    State([u64; 2], Vec<u8>),
}

/// Value reference of a value of a group: an output, or the derivative of a state.
fn reference(equations: &Equations, outputs: &[Variable], row: usize) -> u32 {
    outputs.get(row).map_or_else(|| equations.derivatives[row - outputs.len()], |own| own.reference)
}

/// Real variables of value references.
fn reals(references: &[u32]) -> Vec<Variable> {
    references.iter().map(|&reference| Variable { reference, holds: VariableType::Real }).collect()
}

impl Hosted {
    /// Sets time, states and inputs.
    fn set_all(&mut self, at: &Point) -> Result<(), String> {
        if self.has_begun {
            self.unit.set_point(at.time, &at.states)?;
        }
        self.unit.set(&self.opening.inputs, &at.inputs)
    }

    /// The answer, also if the unit has discarded the point.
    fn or_discarded(&mut self, answer: Result<Answer, String>) -> Result<Answer, String> {
        let has_discarded = self.unit.take_discarded();
        match answer {
            Err(error) if has_discarded => Ok(Answer::Discarded(error)),
            other => other,
        }
    }

    /// Executes an event, or ends the initialisation.
    fn event(&mut self, at: &Point) -> Result<Answer, String> {
        self.set_all(at)?;
        let next = self.unit.event(at, !self.has_begun)?;
        self.has_begun = true;
        Ok(Answer::Event(self.unit.states(at.states.len())?, next))
    }

    /// Evaluates a group.
    fn evaluate(
        &mut self,
        (group, time): (usize, f64),
        arguments: &[f64],
        differentiates: bool,
    ) -> Result<Answer, String> {
        let equations = self.opening.equations.clone().unwrap_or_default();
        let group = equations.groups.get(group).ok_or("the unit has no such equations")?;
        let (states, inputs) = arguments.split_at(equations.states.len().min(arguments.len()));
        let variables: Vec<Variable> = group.inputs.iter().map(|&input| self.opening.inputs[input]).collect();
        let outputs: Vec<Variable> = group.outputs.iter().map(|&own| self.opening.outputs[own]).collect();
        let has_derivatives = group.has_derivatives && self.has_begun;
        let values_at = |own: &mut Self, states: &[f64], inputs: &[f64]| {
            if own.has_begun {
                own.unit.set_point(time, states)?;
            }
            own.unit.set(&variables, inputs)?;
            let mut values = own.unit.get(&outputs)?;
            if has_derivatives {
                values.extend(own.unit.derivatives(equations.states.len())?);
                values.extend(own.unit.indicators(equations.indicators)?);
            } else if group.has_derivatives {
                // Before the end of the initialisation there are none.
                values.resize(values.len() + equations.states.len() + equations.indicators, 0.0);
            }
            Ok::<_, String>(values)
        };
        let values = values_at(self, states, inputs)?;
        if !differentiates {
            return Ok(Answer::Evaluated { values, derivatives: Vec::new() });
        }
        let mut derivatives = vec![0.0; values.len() * arguments.len()];
        let rows = group.continuous.iter().copied();
        let of_states = outputs.len()..outputs.len() + equations.states.len();
        let rows: Vec<usize> = rows.chain(of_states.filter(|_| has_derivatives)).collect();
        let mut set =
            |row: usize, column: usize, value: f64| derivatives[row * arguments.len() + column] = value;
        if group.differentiates {
            // An output that is a state is no unknown of the structure.
            let state_of = |row: &usize| {
                let own = outputs.get(*row)?.reference;
                equations.states.iter().position(|state| *state == own)
            };
            for (&row, state) in rows.iter().filter_map(|row| Some((row, state_of(row)?))) {
                set(row, state, 1.0);
            }
            let rows: Vec<usize> = rows.into_iter().filter(|row| state_of(row).is_none()).collect();
            let unknowns: Vec<u32> = rows.iter().map(|&row| reference(&equations, &outputs, row)).collect();
            let knowns = equations.states.iter().copied().chain(variables.iter().map(|own| own.reference));
            for (column, known) in knowns.enumerate().filter(|_| !unknowns.is_empty()) {
                let found = self.unit.directional(&unknowns, known)?;
                rows.iter().zip(found).for_each(|(&row, value)| set(row, column, value));
            }
            return Ok(Answer::Evaluated { values, derivatives });
        }
        let nominals = equations.nominals[..states.len()].iter().copied();
        let nominals =
            nominals.chain(group.inputs.iter().map(|&input| equations.nominals[states.len() + input]));
        for (column, nominal) in nominals.enumerate() {
            let mut beside = arguments.to_vec();
            // A forward difference, whose increment balances curvature and round-off.
            beside[column] += f64::EPSILON.sqrt() * arguments[column].abs().max(nominal);
            let step = beside[column] - arguments[column];
            let (states, inputs) = beside.split_at(states.len());
            let found = values_at(self, states, inputs)?;
            for &row in &rows {
                set(row, column, (found[row] - values[row]) / step);
            }
        }
        values_at(self, states, inputs)?;
        Ok(Answer::Evaluated { values, derivatives })
    }

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
        if self.has_begun {
            return Ok(());
        }
        if self.opening.equations.is_some() {
            let point = Point { time: self.opening.start, states: Vec::new(), inputs: self.start.clone() };
            self.unit.event(&point, true)?;
        } else {
            self.unit.exit_initialization()?;
        }
        self.has_begun = true;
        Ok(())
    }

    fn save(&mut self) -> Result<Vec<u8>, String> {
        let saved = if self.has_begun {
            Saved::State(self.opening.archive, self.unit.save()?)
        } else {
            Saved::Start(self.opening.archive, self.start.clone())
        };
        postcard::to_stdvec(&saved).map_err(|error| error.to_string())
    }
}
