//! Units of other programs (FMI 2.0 and 3.0) in a model: their archives and descriptions, and their processes.

mod description;
mod equations;
mod evaluations;
mod process;

use std::borrow::Cow;
use std::fs::{self, File};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Once};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use flate2::Crc;
use lissom_core::units::{Unit, UnitFault};
use lissom_model::document::{UnitEntry, UnitEquations, UnitMode};
use lissom_model::{Document, Located, Problem, Report, Span, files, suggestion};
use lissom_units::{Opening, Variable};

use crate::encodings::unarchive::Unarchived;
use description::{Described, Description, Kind};
use process::{UnitProcess, UnpackedFolder};

pub use process::{COMMAND, set_host};

/// A unit of a model, whose variables have been checked.
#[derive(Clone)]
pub struct ReadUnit {
    archive: Arc<[u8]>,
    /// Folder of the library within the archive.
    binaries: String,
    /// How it is loaded, with paths relative to the folder of its files, and without start time.
    opening: Opening,
    timeout: Duration,
}

/// Serves a unit in this process, until the simulation that started it has no more requests.
///
/// # Errors
/// If this process was not started for a unit.
pub fn serve() -> std::io::Result<()> {
    lissom_units::serve(crate::VERSION)
}

/// Reads the units of a document, and returns it with the equations of those for model exchange.
///
/// # Errors
/// All problems, underlined in the model's text.
pub(crate) fn read(document: &Document) -> Result<(Cow<'_, Document>, Vec<ReadUnit>), Report> {
    let mut with_equations = Cow::Borrowed(document);
    let (mut units, mut problems) = (Vec::new(), Vec::new());
    for (index, entry) in document.units.iter().enumerate() {
        match read_one(entry) {
            Ok((unit, equations)) => {
                units.push(unit);
                if equations.is_some() {
                    with_equations.to_mut().units[index].equations = equations;
                }
            }
            Err(problem) => problems.push(*problem),
        }
    }
    if problems.is_empty() { Ok((with_equations, units)) } else { Err(document.report(problems)) }
}

/// The units of these names, in their order.
pub(crate) fn in_order<'n>(units: &[ReadUnit], names: impl Iterator<Item = &'n str>) -> Vec<ReadUnit> {
    names.filter_map(|name| units.iter().find(|unit| unit.opening.name == name).cloned()).collect()
}

fn read_one(entry: &UnitEntry) -> Result<(ReadUnit, Option<UnitEquations>), Box<Problem>> {
    let name = &entry.name.value;
    let (path, span) = (&entry.file.value, entry.file.span);
    let fail = |message: String, help: &str| Box::new(Problem::error(span, message).help(help));
    let shown = path.display();
    let archive = files::read_input(path).map_err(|error| {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => error.to_string(),
        };
        fail(format!("unit `{name}`: `{shown}`: {reason}"), "name a file `.fmu`, relative to the model file")
    })?;
    let about = |message: String| {
        fail(
            format!("unit `{name}`: `{shown}` cannot be used: {message}"),
            "export the unit again, for co-simulation or model exchange with FMI 2.0 or 3.0",
        )
    };
    let files = Unarchived::of(&archive).map_err(about)?;
    let text = files.contents("modelDescription.xml").map_err(about)?;
    let text = text.ok_or_else(|| about("it has no `modelDescription.xml`, so it is no FMU".to_owned()))?;
    let text = String::from_utf8(text).map_err(|_| about("its description is not in UTF-8".to_owned()))?;
    let description = Description::read(&text).map_err(about)?;
    let (mode, kind) = mode_of(entry, &description).map_err(about)?;
    check_sample(entry, mode)?;
    let suffix = std::env::consts::DLL_SUFFIX;
    let library = |platform: &String| format!("binaries/{platform}/{}{suffix}", kind.library);
    let platforms = description.platforms();
    let Some(platform) = platforms.iter().find(|platform| files.names().any(|own| own == library(platform)))
    else {
        let found = files.names().filter_map(|own| own.strip_prefix("binaries/")?.split('/').next());
        let found: std::collections::BTreeSet<&str> = found.collect();
        let found = if found.is_empty() {
            "none".to_owned()
        } else {
            found.into_iter().collect::<Vec<_>>().join(", ")
        };
        let message = format!("it has no library `{}`; its platforms are: {found}", library(&platforms[0]));
        return Err(about(message));
    };
    let variables = Variables { unit: name, all: &description.variables };
    let mut inputs = Vec::new();
    for (variable, _) in &entry.inputs {
        inputs.push(variables.find(variable, "input", |own| own.causality == "input")?);
    }
    let missing: Vec<_> = description
        .variables
        .iter()
        .filter(|variable| {
            variable.causality == "input"
                && variable.variable.is_some()
                && (mode == UnitMode::CoSimulation || variable.is_continuous)
                && !entry.inputs.iter().any(|(given, _)| given.value == variable.name)
        })
        .collect();
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().map(|variable| format!("`{}`", variable.name)).collect();
        let lines = missing
            .iter()
            .map(|variable| format!("\"{}\" = {}", variable.name, variable.start.as_deref().unwrap_or("0")))
            .collect::<Vec<_>>();
        let (noun, verb) = if names.len() == 1 { ("input", "is") } else { ("inputs", "are") };
        let message =
            format!("unit `{name}` has the {noun} {}, which {verb} not in `inputs`", names.join(", "));
        let help = format!("add `{}` to `inputs`, or expressions", lines.join(", "));
        return Err(Box::new(Problem::error(entry.name.span, message).help(help)));
    }
    let mut outputs = Vec::new();
    for (_, variable) in &entry.outputs {
        outputs.push(variables.find(variable, "output", |own| own.causality != "independent")?);
    }
    let mut parameters = Vec::new();
    for (variable, value) in &entry.parameters {
        parameters.push((variables.find(variable, "parameter", |own| own.is_settable)?, *value));
    }
    let (library, binaries) = (library(platform), format!("binaries/{platform}/"));
    let saves = kind.saves;
    let equations = match mode {
        UnitMode::CoSimulation => None,
        UnitMode::ModelExchange => Some(equations::of(entry, &description, kind)?),
    };
    let (for_model, equations) = equations.unzip();
    let opening = Opening {
        version: crate::VERSION.to_owned(),
        standard: description.standard,
        library,
        resources: "resources".to_owned(),
        name: name.clone(),
        token: description.token.clone(),
        start: 0.0,
        parameters,
        inputs,
        outputs,
        saves,
        equations,
        archive: digest(&archive),
    };
    let timeout = Duration::try_from_secs_f64(entry.timeout).unwrap_or(Duration::MAX);
    let timeout = timeout.max(Duration::from_millis(1));
    Ok((ReadUnit { archive: archive.into(), binaries, opening, timeout }, for_model))
}

/// How a unit is simulated: as requested, or as it supports.
fn mode_of<'d>(entry: &UnitEntry, description: &'d Description) -> Result<(UnitMode, &'d Kind), String> {
    let co_simulation = description.co_simulation.as_ref().map(|kind| (UnitMode::CoSimulation, kind));
    let model_exchange = description.model_exchange.as_ref().map(|kind| (UnitMode::ModelExchange, kind));
    match entry.mode {
        None => co_simulation.or(model_exchange).ok_or_else(|| {
            let message = "its description has neither `CoSimulation` nor `ModelExchange`; it supports scheduled execution only";
            format!("{message} (a class of PythonFMU3 needs the base `CoSimulation`)")
        }),
        Some(UnitMode::CoSimulation) => {
            co_simulation.ok_or_else(|| "it does not support co-simulation".to_owned())
        }
        Some(UnitMode::ModelExchange) => {
            model_exchange.ok_or_else(|| "it does not support model exchange".to_owned())
        }
    }
}

/// A unit has samples for co-simulation, and none for model exchange.
fn check_sample(entry: &UnitEntry, mode: UnitMode) -> Result<(), Box<Problem>> {
    let name = &entry.name.value;
    match (mode, entry.sample) {
        (UnitMode::CoSimulation, None) => {
            let message = format!("unit `{name}` lacks `sample`, its step for co-simulation");
            let help = "add `sample`, in seconds; units for model exchange have none";
            Err(Box::new(Problem::error(entry.name.span, message).help(help)))
        }
        (UnitMode::ModelExchange, Some(sample)) => {
            let message = format!("unit `{name}` is for model exchange, and has no samples");
            let help = "remove `sample`: its equations are solved with those of the model";
            Err(Box::new(Problem::error(sample.span, message).label("here").help(help)))
        }
        _ => Ok(()),
    }
}

/// Variables of a unit.
struct Variables<'d> {
    unit: &'d str,
    all: &'d [Described],
}

impl Variables<'_> {
    /// The variable of a name that is `accepted` in a role.
    fn find(
        &self,
        name: &Located<String>,
        role: &str,
        accepted: impl Fn(&Described) -> bool,
    ) -> Result<Variable, Box<Problem>> {
        let fail = |span: Span, message: String, help: Option<String>| {
            Box::new(Problem::error(span, message).label("here").maybe_help(help))
        };
        let wanted = &name.value;
        let Some(found) = self.all.iter().find(|own| own.name == *wanted) else {
            let known = self.all.iter().filter(|own| accepted(own) && own.variable.is_some());
            let message = format!("unit `{}` has no variable `{wanted}`", self.unit);
            return Err(fail(name.span, message, suggestion(wanted, known.map(|own| own.name.as_str()))));
        };
        if !accepted(found) {
            let message = format!(
                "the variable `{wanted}` of unit `{}` cannot be set: it is {}",
                self.unit,
                match found.causality.as_str() {
                    "input" => "an input".to_owned(),
                    other => format!("of causality `{other}`"),
                }
            );
            let known = self.all.iter().filter(|own| accepted(own) && own.variable.is_some());
            let known: Vec<&str> = known.map(|own| own.name.as_str()).take(8).collect();
            let help = format!("name one that is an {role}: {}", known.join(", "));
            return Err(fail(name.span, message, Some(help)));
        }
        found.variable.ok_or_else(|| {
            let message =
                format!("the variable `{wanted}` of unit `{}` is of type {}", self.unit, found.holds);
            let help =
                "variables of type Float64, Int32 and Boolean (Real, Integer) can be used, one number each";
            fail(name.span, message, Some(help.to_owned()))
        })
    }
}

impl ReadUnit {
    /// Starts a unit in a process, at the time `start` [s].
    pub(crate) fn start(&self, start: f64) -> Result<Arc<dyn Unit>, UnitFault> {
        let folder = self.unpack().map_err(|reason| UnitFault {
            cause: format!("its files cannot be unpacked: {reason}"),
            remedy: "check the folder of temporary files, TMPDIR, and its free space".to_owned(),
        })?;
        let absolute = |path: &str| folder.path.join(path).display().to_string();
        let opening = Opening {
            start,
            library: absolute(&self.opening.library),
            resources: absolute(&self.opening.resources),
            ..self.opening.clone()
        };
        Ok(Arc::new(UnitProcess::start(opening, folder, self.timeout)?))
    }

    /// Writes the files that the unit needs to a new temporary folder, which only this user can read.
    fn unpack(&self) -> Result<UnpackedFolder, String> {
        static LEFT: Once = Once::new();
        let files = Unarchived::of(&self.archive)?;
        LEFT.call_once(|| remove_left_folders(&std::env::temp_dir()));
        let folder = new_folder().map_err(|error| error.to_string())?;
        let is_needed = |name: &&str| {
            let is_other = name.starts_with("binaries/") && !name.starts_with(&self.binaries);
            !(is_other || name.starts_with("sources/") || name.starts_with("documentation/"))
        };
        fs::create_dir_all(folder.path.join("resources")).map_err(|error| error.to_string())?;
        for name in files.names().filter(is_needed) {
            let path = folder.path.join(name);
            let written = path.parent().map_or(Ok(()), fs::create_dir_all);
            let contents = files.contents(name)?.unwrap_or_default();
            written
                .and_then(|()| fs::write(&path, contents))
                .map_err(|error| format!("`{name}`: {error}"))?;
        }
        Ok(folder)
    }
}

/// Checksum and length of an archive.
fn digest(archive: &[u8]) -> [u64; 2] {
    let mut crc = Crc::new();
    crc.update(archive);
    [u64::from(crc.sum()), archive.len() as u64]
}

/// Beginning of the names of folders of units.
const PREFIX: &str = "lissom-unit-";
/// File in the folder of a unit that is locked as long as the folder is in use.
const LOCK: &str = ".lissom-lock";

/// Removes the folders of units whose simulation was killed: nothing locks them.
fn remove_left_folders(temporary: &Path) {
    for folder in fs::read_dir(temporary).into_iter().flatten().flatten() {
        let is_of_unit = folder.file_name().to_string_lossy().starts_with(PREFIX);
        let lock = is_of_unit.then(|| File::open(folder.path().join(LOCK)));
        if let Some(Ok(lock)) = lock
            && lock.try_lock().is_ok()
        {
            // What belongs to others remains.
            let _ = fs::remove_dir_all(folder.path());
        }
    }
}

/// A new folder among the temporary files.
fn new_folder() -> std::io::Result<UnpackedFolder> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let mut builder = fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    let mut last = std::io::Error::from(std::io::ErrorKind::AlreadyExists);
    for _ in 0..100 {
        let nanoseconds =
            SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.subsec_nanos());
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let owner = std::process::id();
        let name = format!("{PREFIX}{owner}-{number}-{nanoseconds:x}");
        let path = std::path::absolute(std::env::temp_dir().join(name))?;
        match builder.create(&path) {
            Ok(()) => {
                let lock = File::create(path.join(LOCK))?;
                lock.lock()?;
                // Until it was locked, another simulation could remove the folder.
                if path.join(LOCK).exists() {
                    return Ok(UnpackedFolder { path, _lock: lock, owner });
                }
            }
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => last = error,
            Err(error) => return Err(error),
        }
    }
    Err(last)
}

/// The folder of this machine's platform, as named by FMI 3.0.
pub fn platform() -> String {
    let system = match std::env::consts::OS {
        "macos" => "darwin",
        other => other,
    };
    format!("{}-{system}", std::env::consts::ARCH)
}
