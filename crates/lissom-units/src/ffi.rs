//! Calls of the functions of a unit, with the names and types of the headers of FMI 2.0 and 3.0. The only unsafe code of the crate:
//! foreign code is called through the pointers that its shared library exports, which have the declared types by the standard. It
//! runs in a process of its own, so that a unit that breaks the standard ends this process alone.
//!
//! The functions are declared here, because the crate `fmi` needs libclang and a C compiler to be built.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::{Mutex, PoisonError};

use libloading::Library;

use crate::messages::{Opening, Point, Standard, Variable, VariableType};

type Instance = *mut c_void;
type Status = c_int;

/// Messages of the unit of this process that are not yet reported: the last ones.
static LOG: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// The messages since the last call.
pub(crate) fn logged() -> Vec<String> {
    std::mem::take(&mut *LOG.lock().unwrap_or_else(PoisonError::into_inner))
}

fn note(message: *const c_char) {
    if message.is_null() {
        return;
    }
    // SAFETY: messages of a unit are null-terminated.
    let message = unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned();
    let mut log = LOG.lock().unwrap_or_else(PoisonError::into_inner);
    // The last messages of a step explain its failure.
    if log.len() == 8 {
        log.remove(0);
    }
    log.push(message);
}

extern "C" fn log3(_: *mut c_void, _: Status, _: *const c_char, message: *const c_char) {
    note(message);
}

/// The function for messages of FMI 2.0. In the header more arguments follow, for `%s` and the like in the message; the caller
/// removes them, and the message is reported without them.
extern "C" fn log2(_: *mut c_void, _: *const c_char, _: Status, _: *const c_char, message: *const c_char) {
    note(message);
}

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
    #[cfg(unix)]
    fn kill(process: c_int, signal: c_int) -> c_int;
}

/// Ends the processes of a group at once: a unit may have started others. The group is that of the process `id` for which it was made,
/// or that of this process for 0. Does nothing where units do not run.
pub fn end_group(id: u32) {
    #[cfg(unix)]
    if let Ok(id) = c_int::try_from(id) {
        const SIGKILL: c_int = 9;
        // SAFETY: the function only sends a signal. A group that has ended is no failure.
        unsafe { kill(-id, SIGKILL) };
    }
    #[cfg(not(unix))]
    let _ = id;
}

/// Functions for a unit of FMI 2.0.
#[repr(C)]
struct Callbacks {
    log: extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char),
    allocate: unsafe extern "C" fn(usize, usize) -> *mut c_void,
    free: unsafe extern "C" fn(*mut c_void),
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// A loaded and instantiated unit.
pub(crate) struct Unit {
    library: Library,
    standard: Standard,
    instance: Instance,
    /// Whether it has left its initialisation, and no function failed fatally.
    may_terminate: bool,
    /// Whether the last function that failed has discarded its arguments.
    has_discarded: bool,
    /// Used by the unit as long as it exists.
    _callbacks: Box<Callbacks>,
}

// Types of functions that both versions of the standard have.
type OfInstance = unsafe extern "C" fn(Instance) -> Status;
type Get<T> = unsafe extern "C" fn(Instance, *const u32, usize, *mut T) -> Status;
type Get3<T> = unsafe extern "C" fn(Instance, *const u32, usize, *mut T, usize) -> Status;
type Set<T> = unsafe extern "C" fn(Instance, *const u32, usize, *const T) -> Status;
type Set3<T> = unsafe extern "C" fn(Instance, *const u32, usize, *const T, usize) -> Status;
type Log = extern "C" fn(*mut c_void, Status, *const c_char, *const c_char);
type Deserialize = unsafe extern "C" fn(Instance, *const u8, usize, *mut *mut c_void) -> Status;
type OfState = unsafe extern "C" fn(Instance, *mut *mut c_void) -> Status;

/// Finds a function of the library.
fn symbol<T: Copy>(library: &Library, name: &str) -> Result<T, String> {
    // SAFETY: by the standard the function of this name has the type with which the callers of this function declare it.
    let found = unsafe { library.get::<T>(name.as_bytes()) };
    found.map(|symbol| *symbol).map_err(|_| format!("its library has no function `{name}`"))
}

fn text(of: &str) -> Result<CString, String> {
    CString::new(of).map_err(|_| format!("`{of}` contains a zero"))
}

/// The URI of a folder.
fn uri(path: &str) -> String {
    let mut uri = "file://".to_owned();
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' => {
                uri.push(char::from(byte));
            }
            other => {
                let digit = |half: u8| char::from_digit(u32::from(half), 16).unwrap_or_default();
                uri.extend(['%', digit(other >> 4), digit(other & 15)]);
            }
        }
    }
    uri
}

impl Unit {
    /// Loads the library and instantiates the unit.
    pub(crate) fn load(opening: &Opening) -> Result<Self, String> {
        // SAFETY: loading runs code of the library, which belongs to this process alone.
        let library = unsafe { Library::new(&opening.library) }.map_err(|error| {
            // The cause, such as a missing library on which it depends.
            let cause =
                std::error::Error::source(&error).map(|cause| format!(": {cause}")).unwrap_or_default();
            format!("its library cannot be loaded: {error}{cause}")
        })?;
        let (name, token) = (text(&opening.name)?, text(&opening.token)?);
        let callbacks = Box::new(Callbacks {
            log: log2,
            allocate: calloc,
            free,
            step_finished: null(),
            environment: null_mut(),
        });
        let instance = match opening.standard {
            Standard::Fmi2 => {
                type Instantiate = unsafe extern "C" fn(
                    *const c_char,
                    c_int,
                    *const c_char,
                    *const c_char,
                    *const Callbacks,
                    c_int,
                    c_int,
                ) -> Instance;
                let instantiate: Instantiate = symbol(&library, "fmi2Instantiate")?;
                let resources = text(&uri(&opening.resources))?;
                // Exporters of FMI 2.0 report the causes of errors with logging only; the last messages are kept.
                let logs = 1;
                // SAFETY: types and life times of the standard; 0 is model exchange, 1 co-simulation.
                unsafe {
                    instantiate(
                        name.as_ptr(),
                        c_int::from(opening.equations.is_none()),
                        token.as_ptr(),
                        resources.as_ptr(),
                        &raw const *callbacks,
                        0,
                        logs,
                    )
                }
            }
            Standard::Fmi3 if opening.equations.is_some() => {
                type Instantiate = unsafe extern "C" fn(
                    *const c_char,
                    *const c_char,
                    *const c_char,
                    bool,
                    bool,
                    *mut c_void,
                    Log,
                ) -> Instance;
                let instantiate: Instantiate = symbol(&library, "fmi3InstantiateModelExchange")?;
                let resources = text(&format!("{}/", opening.resources))?;
                let [name, token, resources] = [&name, &token, &resources].map(|own| own.as_ptr());
                // SAFETY: types and life times of the standard.
                unsafe { instantiate(name, token, resources, false, false, null_mut(), log3) }
            }
            Standard::Fmi3 => {
                type Instantiate = unsafe extern "C" fn(
                    *const c_char,
                    *const c_char,
                    *const c_char,
                    bool,
                    bool,
                    bool,
                    bool,
                    *const u32,
                    usize,
                    *mut c_void,
                    Log,
                    *const c_void,
                ) -> Instance;
                let instantiate: Instantiate = symbol(&library, "fmi3InstantiateCoSimulation")?;
                let resources = text(&format!("{}/", opening.resources))?;
                // SAFETY: types and life times of the standard; no events, early returns or intermediate values.
                unsafe {
                    instantiate(
                        name.as_ptr(),
                        token.as_ptr(),
                        resources.as_ptr(),
                        false,
                        false,
                        false,
                        false,
                        null(),
                        0,
                        null_mut(),
                        log3,
                        null(),
                    )
                }
            }
        };
        if instance.is_null() {
            return Err("it cannot be instantiated".to_owned());
        }
        Ok(Self {
            library,
            standard: opening.standard,
            instance,
            may_terminate: false,
            has_discarded: false,
            _callbacks: callbacks,
        })
    }

    /// The prefix of the names of all functions.
    fn prefix(&self) -> &'static str {
        match self.standard {
            Standard::Fmi2 => "fmi2",
            Standard::Fmi3 => "fmi3",
        }
    }

    fn function<T: Copy>(&self, name: &str) -> Result<T, String> {
        symbol(&self.library, &format!("{}{name}", self.prefix()))
    }

    /// Whether a call has succeeded, perhaps with a warning.
    fn check(&mut self, status: Status, name: &str) -> Result<(), String> {
        let word = match status {
            0 | 1 => return Ok(()),
            2 => "Discard",
            3 => "Error",
            4 => "Fatal",
            5 => "Pending",
            _ => "an unknown status",
        };
        self.may_terminate &= status == 2;
        self.has_discarded = status == 2;
        Err(format!("`{}{name}` returned {word}", self.prefix()))
    }

    fn call(&mut self, name: &str) -> Result<(), String> {
        let function: OfInstance = self.function(name)?;
        // SAFETY: the instance exists until this value is dropped.
        let status = unsafe { function(self.instance) };
        self.check(status, name)
    }

    /// Begins the initialisation at `start` [s].
    pub(crate) fn enter_initialization(&mut self, start: f64) -> Result<(), String> {
        let name = "EnterInitializationMode";
        match self.standard {
            Standard::Fmi2 => {
                let setup = "SetupExperiment";
                let function: unsafe extern "C" fn(Instance, c_int, f64, f64, c_int, f64) -> Status =
                    self.function(setup)?;
                // SAFETY: types of the standard; neither tolerance nor stop time.
                let status = unsafe { function(self.instance, 0, 0.0, start, 0, 0.0) };
                self.check(status, setup)?;
                self.call(name)
            }
            Standard::Fmi3 => {
                let function: unsafe extern "C" fn(Instance, bool, f64, f64, bool, f64) -> Status =
                    self.function(name)?;
                // SAFETY: types of the standard; neither tolerance nor stop time.
                let status = unsafe { function(self.instance, false, 0.0, start, false, 0.0) };
                self.check(status, name)
            }
        }
    }

    /// Ends the initialisation.
    pub(crate) fn exit_initialization(&mut self) -> Result<(), String> {
        self.call("ExitInitializationMode")?;
        self.may_terminate = true;
        Ok(())
    }

    fn set_of<T: Copy>(&mut self, name: &str, references: &[u32], values: &[T]) -> Result<(), String> {
        let (all, count, numbers) = (references.as_ptr(), references.len(), values.as_ptr());
        let status = match self.standard {
            Standard::Fmi2 => {
                let function: Set<T> = self.function(name)?;
                // SAFETY: both pointers are to as many numbers as declared.
                unsafe { function(self.instance, all, count, numbers) }
            }
            Standard::Fmi3 => {
                let function: Set3<T> = self.function(name)?;
                // SAFETY: both pointers are to as many numbers as declared.
                unsafe { function(self.instance, all, count, numbers, values.len()) }
            }
        };
        self.check(status, name)
    }

    fn get_of<T: Copy + Default>(&mut self, name: &str, references: &[u32]) -> Result<Vec<T>, String> {
        let mut values = vec![T::default(); references.len()];
        let (all, count, numbers) = (references.as_ptr(), references.len(), values.as_mut_ptr());
        let status = match self.standard {
            Standard::Fmi2 => {
                let function: Get<T> = self.function(name)?;
                // SAFETY: both pointers are to as many numbers as declared.
                unsafe { function(self.instance, all, count, numbers) }
            }
            Standard::Fmi3 => {
                let function: Get3<T> = self.function(name)?;
                // SAFETY: both pointers are to as many numbers as declared.
                unsafe { function(self.instance, all, count, numbers, count) }
            }
        };
        self.check(status, name)?;
        Ok(values)
    }

    /// Positions of the variables of a type, with their value references.
    fn of_type(variables: &[Variable], wanted: VariableType) -> Option<(Vec<usize>, Vec<u32>)> {
        let all = variables.iter().enumerate().filter(|(_, variable)| variable.holds == wanted);
        let found: (Vec<usize>, Vec<u32>) = all.map(|(index, variable)| (index, variable.reference)).unzip();
        (!found.0.is_empty()).then_some(found)
    }

    /// Sets variables; integers are rounded, and booleans are true from 0.5 on.
    pub(crate) fn set(&mut self, variables: &[Variable], values: &[f64]) -> Result<(), String> {
        if variables.len() != values.len() {
            return Err(format!("it has {} inputs, and receives {}", variables.len(), values.len()));
        }
        let is_second = self.standard == Standard::Fmi2;
        if let Some((places, references)) = Self::of_type(variables, VariableType::Real) {
            let numbers: Vec<f64> = places.iter().map(|&place| values[place]).collect();
            self.set_of(if is_second { "SetReal" } else { "SetFloat64" }, &references, &numbers)?;
        }
        if let Some((places, references)) = Self::of_type(variables, VariableType::Integer) {
            let numbers: Vec<i32> = places.iter().map(|&place| values[place].round() as i32).collect();
            self.set_of(if is_second { "SetInteger" } else { "SetInt32" }, &references, &numbers)?;
        }
        if let Some((places, references)) = Self::of_type(variables, VariableType::Boolean) {
            let flags = places.iter().map(|&place| values[place] >= 0.5);
            if is_second {
                self.set_of("SetBoolean", &references, &flags.map(c_int::from).collect::<Vec<_>>())?;
            } else {
                self.set_of("SetBoolean", &references, &flags.collect::<Vec<_>>())?;
            }
        }
        Ok(())
    }

    /// Values of variables.
    pub(crate) fn get(&mut self, variables: &[Variable]) -> Result<Vec<f64>, String> {
        let is_second = self.standard == Standard::Fmi2;
        let mut values = vec![0.0; variables.len()];
        if let Some((places, references)) = Self::of_type(variables, VariableType::Real) {
            let found: Vec<f64> =
                self.get_of(if is_second { "GetReal" } else { "GetFloat64" }, &references)?;
            places.into_iter().zip(found).for_each(|(place, value)| values[place] = value);
        }
        if let Some((places, references)) = Self::of_type(variables, VariableType::Integer) {
            let found: Vec<i32> =
                self.get_of(if is_second { "GetInteger" } else { "GetInt32" }, &references)?;
            places.into_iter().zip(found).for_each(|(place, value)| values[place] = f64::from(value));
        }
        if let Some((places, references)) = Self::of_type(variables, VariableType::Boolean) {
            // One byte in FMI 3.0: any other value than 0 and 1 would be no `bool` of Rust.
            let found: Vec<bool> = if is_second {
                let found: Vec<c_int> = self.get_of("GetBoolean", &references)?;
                found.into_iter().map(|value| value != 0).collect()
            } else {
                let found: Vec<u8> = self.get_of("GetBoolean", &references)?;
                found.into_iter().map(|value| value != 0).collect()
            };
            places
                .into_iter()
                .zip(found)
                .for_each(|(place, value)| values[place] = f64::from(u8::from(value)));
        }
        Ok(values)
    }

    /// Takes a step; `is_final` is whether the unit will not return to its start.
    pub(crate) fn step(&mut self, [from, step]: [f64; 2], is_final: bool) -> Result<(), String> {
        let name = "DoStep";
        match self.standard {
            Standard::Fmi2 => {
                let function: unsafe extern "C" fn(Instance, f64, f64, c_int) -> Status =
                    self.function(name)?;
                // SAFETY: types of the standard.
                let status = unsafe { function(self.instance, from, step, c_int::from(is_final)) };
                self.check(status, name)
            }
            Standard::Fmi3 => {
                type DoStep = unsafe extern "C" fn(
                    Instance,
                    f64,
                    f64,
                    bool,
                    *mut u8,
                    *mut u8,
                    *mut u8,
                    *mut f64,
                ) -> Status;
                let function: DoStep = self.function(name)?;
                let (mut event, mut ended, mut early, mut last) = (0, 0, 0, from + step);
                // SAFETY: types of the standard, where a boolean is one byte; the pointers live through the call.
                let status = unsafe {
                    function(
                        self.instance,
                        from,
                        step,
                        is_final,
                        &raw mut event,
                        &raw mut ended,
                        &raw mut early,
                        &raw mut last,
                    )
                };
                self.check(status, name)?;
                if ended != 0 {
                    return Err(format!("it ended the simulation at t = {last} s"));
                }
                if early != 0 {
                    return Err(format!("its step ended early, at t = {last} s, which was not allowed"));
                }
                Ok(())
            }
        }
    }

    /// Whether the last failure was only a discarded point.
    pub(crate) fn take_discarded(&mut self) -> bool {
        std::mem::take(&mut self.has_discarded)
    }

    /// Sets time [s] and continuous states.
    pub(crate) fn set_point(&mut self, time: f64, states: &[f64]) -> Result<(), String> {
        let name = "SetTime";
        let function: unsafe extern "C" fn(Instance, f64) -> Status = self.function(name)?;
        // SAFETY: types of the standard.
        let status = unsafe { function(self.instance, time) };
        self.check(status, name)?;
        if states.is_empty() {
            return Ok(());
        }
        let name = "SetContinuousStates";
        let function: unsafe extern "C" fn(Instance, *const f64, usize) -> Status = self.function(name)?;
        // SAFETY: the pointer is to as many numbers as declared.
        let status = unsafe { function(self.instance, states.as_ptr(), states.len()) };
        self.check(status, name)
    }

    /// Calls a function that returns this number of values.
    fn vector(&mut self, name: &str, count: usize) -> Result<Vec<f64>, String> {
        let mut values = vec![0.0; count];
        if count > 0 {
            let function: unsafe extern "C" fn(Instance, *mut f64, usize) -> Status = self.function(name)?;
            // SAFETY: the pointer is to as many numbers as declared.
            let status = unsafe { function(self.instance, values.as_mut_ptr(), count) };
            self.check(status, name)?;
        }
        Ok(values)
    }

    /// Derivatives of the continuous states.
    pub(crate) fn derivatives(&mut self, count: usize) -> Result<Vec<f64>, String> {
        let is_second = self.standard == Standard::Fmi2;
        self.vector(if is_second { "GetDerivatives" } else { "GetContinuousStateDerivatives" }, count)
    }

    /// Event indicators.
    pub(crate) fn indicators(&mut self, count: usize) -> Result<Vec<f64>, String> {
        self.vector("GetEventIndicators", count)
    }

    /// Continuous states.
    pub(crate) fn states(&mut self, count: usize) -> Result<Vec<f64>, String> {
        self.vector("GetContinuousStates", count)
    }

    /// Derivatives of variables, by their value references, with respect to another one.
    pub(crate) fn directional(&mut self, unknowns: &[u32], known: u32) -> Result<Vec<f64>, String> {
        let name = "GetDirectionalDerivative";
        let mut out = vec![0.0; unknowns.len()];
        let (all, count, by, seed) = (unknowns.as_ptr(), unknowns.len(), &raw const known, 1.0);
        let status = match self.standard {
            Standard::Fmi2 => {
                type Directional = unsafe extern "C" fn(
                    Instance,
                    *const u32,
                    usize,
                    *const u32,
                    usize,
                    *const f64,
                    *mut f64,
                ) -> Status;
                let function: Directional = self.function(name)?;
                // SAFETY: all pointers are to as many numbers as declared.
                unsafe { function(self.instance, all, count, by, 1, &raw const seed, out.as_mut_ptr()) }
            }
            Standard::Fmi3 => {
                type Directional = unsafe extern "C" fn(
                    Instance,
                    *const u32,
                    usize,
                    *const u32,
                    usize,
                    *const f64,
                    usize,
                    *mut f64,
                    usize,
                ) -> Status;
                let function: Directional = self.function(name)?;
                // SAFETY: all pointers are to as many numbers as declared.
                unsafe {
                    function(self.instance, all, count, by, 1, &raw const seed, 1, out.as_mut_ptr(), count)
                }
            }
        };
        self.check(status, name)?;
        Ok(out)
    }

    /// Ends an accepted step. Returns whether the unit requests an event.
    pub(crate) fn complete(&mut self, time: f64) -> Result<bool, String> {
        let name = "CompletedIntegratorStep";
        // Room for booleans of both versions of the standard: 4 bytes and one. Attempts that are rejected do not return to a state.
        let (mut event, mut ended): (c_int, c_int) = (0, 0);
        let status = match self.standard {
            Standard::Fmi2 => {
                let function: unsafe extern "C" fn(Instance, c_int, *mut c_int, *mut c_int) -> Status =
                    self.function(name)?;
                // SAFETY: types of the standard; the pointers live through the call.
                unsafe { function(self.instance, 1, &raw mut event, &raw mut ended) }
            }
            Standard::Fmi3 => {
                let function: unsafe extern "C" fn(Instance, bool, *mut c_int, *mut c_int) -> Status =
                    self.function(name)?;
                // SAFETY: a boolean is one byte, for which there is room; the pointers live through the call.
                unsafe { function(self.instance, true, &raw mut event, &raw mut ended) }
            }
        };
        self.check(status, name)?;
        if ended == 0 { Ok(event != 0) } else { Err(format!("it ended the simulation at t = {time} s")) }
    }

    /// Executes an event, or the one that ends the initialisation if it `is_first`. Returns the time of the next one [s].
    pub(crate) fn event(&mut self, at: &Point, is_first: bool) -> Result<Option<f64>, String> {
        if is_first {
            self.exit_initialization()?;
        } else {
            self.call("EnterEventMode")?;
        }
        // Usual units need two passes.
        for _ in 0..1000 {
            let (is_needed, next) = self.update_discrete(at.time)?;
            if !is_needed {
                self.call("EnterContinuousTimeMode")?;
                return Ok(next);
            }
        }
        Err(format!("its discrete states at t = {} s change without end", at.time))
    }

    /// Updates discrete states. Returns whether it must be repeated, and the time of the next event [s].
    fn update_discrete(&mut self, time: f64) -> Result<(bool, Option<f64>), String> {
        #[derive(Default)]
        #[repr(C)]
        struct Info {
            is_needed: c_int,
            ended: c_int,
            nominals: c_int,
            states: c_int,
            is_defined: c_int,
            next: f64,
        }
        let mut info = Info::default();
        let status = match self.standard {
            Standard::Fmi2 => {
                let function: unsafe extern "C" fn(Instance, *mut Info) -> Status =
                    self.function("NewDiscreteStates")?;
                // SAFETY: the structure of the standard, which lives through the call.
                unsafe { function(self.instance, &raw mut info) }
            }
            Standard::Fmi3 => {
                type Update = unsafe extern "C" fn(
                    Instance,
                    *mut c_int,
                    *mut c_int,
                    *mut c_int,
                    *mut c_int,
                    *mut c_int,
                    *mut f64,
                ) -> Status;
                let function: Update = self.function("UpdateDiscreteStates")?;
                // SAFETY: a boolean is one byte, for which there is room; the pointers live through the call.
                unsafe {
                    function(
                        self.instance,
                        &raw mut info.is_needed,
                        &raw mut info.ended,
                        &raw mut info.nominals,
                        &raw mut info.states,
                        &raw mut info.is_defined,
                        &raw mut info.next,
                    )
                }
            }
        };
        let is_second = self.standard == Standard::Fmi2;
        self.check(status, if is_second { "NewDiscreteStates" } else { "UpdateDiscreteStates" })?;
        if info.ended != 0 {
            return Err(format!("it ended the simulation at t = {time} s"));
        }
        Ok((info.is_needed != 0, (info.is_defined != 0).then_some(info.next)))
    }

    /// Applies `act` to a state, which is freed afterwards.
    fn with_state<T>(
        &mut self,
        mut state: *mut c_void,
        act: impl FnOnce(&mut Self, *mut c_void) -> Result<T, String>,
    ) -> Result<T, String> {
        let done = act(self, state);
        let name = if self.standard == Standard::Fmi2 { "FreeFMUstate" } else { "FreeFMUState" };
        let function: OfState = self.function(name)?;
        // SAFETY: the state is one of this instance.
        let status = unsafe { function(self.instance, &raw mut state) };
        self.check(status, name)?;
        done
    }

    /// The state as bytes.
    pub(crate) fn save(&mut self) -> Result<Vec<u8>, String> {
        let names = match self.standard {
            Standard::Fmi2 => ["GetFMUstate", "SerializedFMUstateSize", "SerializeFMUstate"],
            Standard::Fmi3 => ["GetFMUState", "SerializedFMUStateSize", "SerializeFMUState"],
        };
        let function: OfState = self.function(names[0])?;
        let mut state = null_mut();
        // SAFETY: a null pointer becomes a new state.
        let status = unsafe { function(self.instance, &raw mut state) };
        self.check(status, names[0])?;
        self.with_state(state, |unit, state| {
            let size: unsafe extern "C" fn(Instance, *mut c_void, *mut usize) -> Status =
                unit.function(names[1])?;
            let mut count = 0;
            // SAFETY: the state is one of this instance.
            let status = unsafe { size(unit.instance, state, &raw mut count) };
            unit.check(status, names[1])?;
            let serialize: unsafe extern "C" fn(Instance, *mut c_void, *mut u8, usize) -> Status =
                unit.function(names[2])?;
            let mut bytes = vec![0; count];
            // SAFETY: there is room for as many bytes as the unit has requested.
            let status = unsafe { serialize(unit.instance, state, bytes.as_mut_ptr(), count) };
            unit.check(status, names[2])?;
            Ok(bytes)
        })
    }

    /// Sets the state.
    pub(crate) fn restore(&mut self, bytes: &[u8]) -> Result<(), String> {
        let names = match self.standard {
            Standard::Fmi2 => ["DeSerializeFMUstate", "SetFMUstate"],
            Standard::Fmi3 => ["DeserializeFMUState", "SetFMUState"],
        };
        let function: Deserialize = self.function(names[0])?;
        let mut state = null_mut();
        // SAFETY: the bytes live through the call; a null pointer becomes a new state.
        let status = unsafe { function(self.instance, bytes.as_ptr(), bytes.len(), &raw mut state) };
        self.check(status, names[0])?;
        self.with_state(state, |unit, state| {
            let set: unsafe extern "C" fn(Instance, *mut c_void) -> Status = unit.function(names[1])?;
            // SAFETY: the state is one of this instance.
            let status = unsafe { set(unit.instance, state) };
            unit.check(status, names[1])
        })
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        if self.may_terminate {
            // The simulation is over: a failure has no consequence.
            let _ = self.call("Terminate");
        }
        if let Ok(function) = self.function::<unsafe extern "C" fn(Instance)>("FreeInstance") {
            // SAFETY: the instance is not used any more.
            unsafe { function(self.instance) };
        }
    }
}
