//! The functions of FMI 3.0 for importers, with the names and types of its header. The only unsafe code of the crate:
//! exported names must be unique in a process, which the standard guarantees, and pointers come from the importer, which
//! guarantees by the standard that they are as declared in the header. Every pointer is checked for null, only the instance is
//! retained, and no panic leaves a function.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::ptr::{null, null_mut};
use std::slice;

use crate::instance::{Instance, SavedState};

type Status = c_int;
const OK: Status = 0;
const ERROR: Status = 3;
const FATAL: Status = 4;

/// The importer's function for messages.
type Log = Option<unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char)>;

/// The object that an importer owns.
struct Unit {
    instance: Instance,
    environment: *mut c_void,
    log: Log,
}

fn log_message(log: Log, environment: *mut c_void, status: Status, words: &str) {
    let Some(log) = log else { return };
    let Ok(message) = CString::new(words.replace('\0', " ")) else { return };
    // SAFETY: the importer's own function and environment; both texts are null-terminated and live through the call.
    unsafe { log(environment, status, c"logStatusError".as_ptr(), message.as_ptr()) };
}

/// Applies `act` to a unit; errors are reported to the importer.
fn with(unit: *mut c_void, act: impl FnOnce(&mut Instance) -> Result<(), String>) -> Status {
    // SAFETY: a unit is null or the result of `fmi3InstantiateCoSimulation`, and is used by one thread at a time.
    let Some(unit) = (unsafe { unit.cast::<Unit>().as_mut() }) else { return ERROR };
    let (words, status) = match catch_unwind(AssertUnwindSafe(|| act(&mut unit.instance))) {
        Ok(Ok(())) => return OK,
        Ok(Err(words)) => (words, ERROR),
        Err(_) => ("a mistake in the library: please report it".to_owned(), FATAL),
    };
    log_message(unit.log, unit.environment, status, &words);
    status
}

/// The numbers at a pointer.
fn read<'a, T>(from: *const T, count: usize) -> Result<&'a [T], String> {
    match (from.is_null(), count) {
        (_, 0) => Ok(&[]),
        (true, _) => Err("a pointer is null".to_owned()),
        // SAFETY: the importer provides the declared number, and they live through the call.
        (false, _) => Ok(unsafe { slice::from_raw_parts(from, count) }),
    }
}

/// Memory at a pointer.
fn room<'a, T>(at: *mut T, count: usize) -> Result<&'a mut [T], String> {
    match (at.is_null(), count) {
        (_, 0) => Ok(&mut []),
        (true, _) => Err("a pointer is null".to_owned()),
        // SAFETY: the importer provides the declared amount of memory, exclusively for this call.
        (false, _) => Ok(unsafe { slice::from_raw_parts_mut(at, count) }),
    }
}

/// Writes a value to a pointer, if it is not null.
fn put<T>(at: *mut T, value: T) {
    // SAFETY: the importer provides memory for one value, or null.
    if let Some(at) = unsafe { at.as_mut() } {
        *at = value;
    }
}

fn text(from: *const c_char) -> Result<String, String> {
    if from.is_null() {
        return Err("a text is missing".to_owned());
    }
    // SAFETY: texts of the importer are null-terminated.
    Ok(unsafe { CStr::from_ptr(from) }.to_string_lossy().into_owned())
}

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn fmi3SetDebugLogging(_: *mut c_void, _: bool, _: usize, _: *const *const c_char) -> Status {
    OK
}

#[unsafe(no_mangle)]
extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    _event_mode: bool,
    _early_return: bool,
    _intermediate: *const u32,
    _intermediate_count: usize,
    environment: *mut c_void,
    log: Log,
    _intermediate_update: *const c_void,
) -> *mut c_void {
    let made = catch_unwind(|| {
        let resources = text(resources)?;
        let folder = PathBuf::from(resources.strip_prefix("file://").unwrap_or(&resources));
        Instance::new(&folder, &text(token)?)
    });
    match made {
        Ok(Ok(instance)) => Box::into_raw(Box::new(Unit { instance, environment, log })).cast(),
        Ok(Err(words)) => {
            log_message(log, environment, ERROR, &words);
            null_mut()
        }
        Err(_) => {
            log_message(log, environment, FATAL, "a mistake in the library: please report it");
            null_mut()
        }
    }
}

#[unsafe(no_mangle)]
extern "C" fn fmi3FreeInstance(unit: *mut c_void) {
    if !unit.is_null() {
        // SAFETY: the importer returns the result of `fmi3InstantiateCoSimulation`, once.
        drop(unsafe { Box::from_raw(unit.cast::<Unit>()) });
    }
}

#[unsafe(no_mangle)]
extern "C" fn fmi3EnterInitializationMode(
    unit: *mut c_void,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> Status {
    with(unit, |instance| instance.enter_initialization(start))
}

#[unsafe(no_mangle)]
extern "C" fn fmi3ExitInitializationMode(unit: *mut c_void) -> Status {
    with(unit, Instance::exit_initialization)
}

#[unsafe(no_mangle)]
extern "C" fn fmi3Terminate(unit: *mut c_void) -> Status {
    with(unit, Instance::terminate)
}

#[unsafe(no_mangle)]
extern "C" fn fmi3Reset(unit: *mut c_void) -> Status {
    with(unit, |instance| {
        instance.reset();
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn fmi3GetFloat64(
    unit: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *mut f64,
    value_count: usize,
) -> Status {
    with(unit, |instance| instance.get(read(references, reference_count)?, room(values, value_count)?))
}

#[unsafe(no_mangle)]
extern "C" fn fmi3SetFloat64(
    unit: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *const f64,
    value_count: usize,
) -> Status {
    with(unit, |instance| instance.set(read(references, reference_count)?, read(values, value_count)?))
}

#[unsafe(no_mangle)]
extern "C" fn fmi3DoStep(
    unit: *mut c_void,
    current: f64,
    size: f64,
    _no_state_before: bool,
    event_needed: *mut bool,
    terminate: *mut bool,
    early_return: *mut bool,
    last_time: *mut f64,
) -> Status {
    for flag in [event_needed, terminate, early_return] {
        put(flag, false);
    }
    with(unit, |instance| {
        let outcome = instance.step(current, size);
        put(last_time, instance.time());
        let stepped = outcome?;
        put(terminate, stepped.is_ended);
        put(early_return, stepped.is_ended && stepped.time < current + size);
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn fmi3GetFMUState(unit: *mut c_void, state: *mut *mut c_void) -> Status {
    with(unit, |instance| {
        let [place] = room(state, 1)? else { return Err("a pointer is null".to_owned()) };
        let saved = instance.save();
        // SAFETY: the importer passes null, or a state of this library to be overwritten.
        match unsafe { place.cast::<SavedState>().as_mut() } {
            Some(old) => *old = saved,
            None => *place = Box::into_raw(Box::new(saved)).cast(),
        }
        Ok(())
    })
}

/// The state at a pointer.
fn saved<'a>(state: *mut c_void) -> Result<&'a SavedState, String> {
    // SAFETY: the importer passes the result of `fmi3GetFMUState` or `fmi3DeserializeFMUState`.
    unsafe { state.cast::<SavedState>().as_ref() }.ok_or_else(|| "a state is missing".to_owned())
}

#[unsafe(no_mangle)]
extern "C" fn fmi3SetFMUState(unit: *mut c_void, state: *mut c_void) -> Status {
    with(unit, |instance| instance.restore(saved(state)?))
}

#[unsafe(no_mangle)]
extern "C" fn fmi3FreeFMUState(unit: *mut c_void, state: *mut *mut c_void) -> Status {
    with(unit, |_| {
        let [place] = room(state, 1)? else { return Ok(()) };
        if !place.is_null() {
            // SAFETY: as in `saved`; the importer no longer uses it, as stated by null.
            drop(unsafe { Box::from_raw(place.cast::<SavedState>()) });
            *place = null_mut();
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn fmi3SerializedFMUStateSize(unit: *mut c_void, state: *mut c_void, size: *mut usize) -> Status {
    with(unit, |_| {
        put(size, saved(state)?.to_bytes()?.len());
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn fmi3SerializeFMUState(
    unit: *mut c_void,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Status {
    with(unit, |_| {
        let own = saved(state)?.to_bytes()?;
        let room = room(bytes, size)?;
        if room.len() < own.len() {
            return Err(format!("a state takes {} bytes, there is room for {size}", own.len()));
        }
        room[..own.len()].copy_from_slice(&own);
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn fmi3DeserializeFMUState(
    unit: *mut c_void,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Status {
    with(unit, |_| {
        let made = SavedState::from_bytes(read(bytes, size)?)?;
        put(state, Box::into_raw(Box::new(made)).cast());
        Ok(())
    })
}

/// Functions of features that a unit does not have: an error, unless the number of values is zero. Further arguments are
/// not read, which the calling conventions of C allow.
macro_rules! without {
    ($what:literal: $($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(unit: *mut c_void, _: *const u32, count: usize) -> Status {
            if count == 0 {
                return OK;
            }
            with(unit, |_| Err(concat!("the unit has no ", $what).to_owned()))
        }
    )*};
}

/// Functions of missing features that have no number of values: an error.
macro_rules! never {
    ($what:literal: $($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(unit: *mut c_void) -> Status {
            with(unit, |_| Err(concat!("the unit has no ", $what).to_owned()))
        }
    )*};
}

without! { "variables of this type":
    fmi3GetFloat32 fmi3GetInt8 fmi3GetUInt8 fmi3GetInt16 fmi3GetUInt16 fmi3GetInt32 fmi3GetUInt32 fmi3GetInt64 fmi3GetUInt64
    fmi3GetBoolean fmi3GetString fmi3GetBinary fmi3GetClock
    fmi3SetFloat32 fmi3SetInt8 fmi3SetUInt8 fmi3SetInt16 fmi3SetUInt16 fmi3SetInt32 fmi3SetUInt32 fmi3SetInt64 fmi3SetUInt64
    fmi3SetBoolean fmi3SetString fmi3SetBinary fmi3SetClock
    fmi3GetIntervalDecimal fmi3GetIntervalFraction fmi3GetShiftDecimal fmi3GetShiftFraction
    fmi3SetIntervalDecimal fmi3SetIntervalFraction fmi3SetShiftDecimal fmi3SetShiftFraction
    fmi3GetOutputDerivatives
}

never! { "derivatives": fmi3GetDirectionalDerivative fmi3GetAdjointDerivative }
never! { "known dependencies": fmi3GetNumberOfVariableDependencies fmi3GetVariableDependencies }
never! { "event mode": fmi3EnterEventMode fmi3EvaluateDiscreteStates fmi3UpdateDiscreteStates fmi3EnterStepMode }
never! { "configuration mode": fmi3EnterConfigurationMode fmi3ExitConfigurationMode }
never! { "model exchange":
    fmi3EnterContinuousTimeMode fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates
    fmi3GetContinuousStateDerivatives fmi3GetEventIndicators fmi3GetContinuousStates fmi3GetNominalsOfContinuousStates
    fmi3GetNumberOfEventIndicators fmi3GetNumberOfContinuousStates
}
never! { "scheduled execution": fmi3ActivateModelPartition }

#[unsafe(no_mangle)]
extern "C" fn fmi3InstantiateModelExchange() -> *const c_void {
    null()
}

#[unsafe(no_mangle)]
extern "C" fn fmi3InstantiateScheduledExecution() -> *const c_void {
    null()
}
