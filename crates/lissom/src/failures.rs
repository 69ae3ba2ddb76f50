//! Table of the failures of analyses, sweeps, studies, results and units: code, values, cause, remedy and explanation of each.
//!
//! The enumerations are defined with their analyses. A new variant is an entry here, and `#[error("{}", self.diagnostic())]`
//! above its enumeration. The catalogue, the chapter on warnings and `lissom explain` are generated from the table.

use lissom_core::catalogued;
use lissom_core::diagnostics::{Diagnose, Diagnostic, Entry, Severity};

use crate::analyses::gradient::GradientError;
use crate::analyses::path::{PathRunError, PathSessionError};
use crate::analyses::ports::PortError;
use crate::analyses::study::StudyError;
use crate::command_error::CommandError;
use crate::exchange::export::ExportError;
use crate::exchange::fmu::FmuError;
use crate::exchange::import::ImportError;
use crate::ids::ForeignId;
use crate::motion::{MotionError, VERSION};
use crate::pictures::picture::PictureError;
use crate::results::checkpoint::CheckpointError;
use crate::results::folder::FolderError;
use crate::run::report::RunError;
use crate::run::results::ColumnError;
use crate::session::{JointCoordinateError, PartError, ReadError, SessionError, StartError};
use crate::sweep::SweepError;
use crate::sweep::SweepFolderError;

/// Entries of the catalogue.
pub(crate) fn entries() -> impl Iterator<Item = &'static Entry> {
    ENTRIES.iter().chain([&PICTURE, &FOREIGN_ID, &IMPORT])
}

catalogued! {
    Failure SessionError {
        NotInTime { 0 => kind } => "session-kind" {
            cause: "an analysis of kind `{kind}` has no time steps",
            remedy: "use an analysis of kind `dynamics` or `statics`, or the function for the analysis of this kind",
            meaning: "A session advances a model step by step, which requires time steps or load steps.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Initial { 0 => error } => error.diagnostic(),
    }

    Failure StartError {
        OtherModel { what => what, found => found, wanted => wanted } => "state-of-other-model" {
            cause: "the state has {found} {what}, but the model has {wanted}",
            remedy: "obtain the state from the prepared model itself, and change it",
            meaning: "The numbers of nodes, coordinates or inputs of a given initial state differ from those of the model.",
        }
        NotFinite {} => "state-not-finite" {
            cause: "the state contains a number that is not finite",
            remedy: "check the expressions with which the state was changed",
            meaning: "A position, velocity or other number of a given initial state is infinite or not a number.",
        }
        Violated { joint => joint, equation => equation, violation => violation } => "state-violates-joint" {
            cause: "the positions of the state violate joint `{joint}` ({equation}) by {violation:.1e}",
            remedy: "move all connected parts consistently, or change the positions in the model and use `[assembly]`",
            meaning: "A given initial state has positions at which a joint is open. Positions of states are not corrected.",
        }
    } wraps {
        Initial { 0 => error } => error.diagnostic(),
    }

    Failure JointCoordinateError {
        Unknown { name => name, known => known } => "unknown-joint-coordinate" {
            cause: "`{name}` is not one of the joint coordinates",
            remedy: "they are: {known}",
            meaning: "A joint coordinate was named that the model does not have, or a rate of a coordinate that is not among the chosen independent ones.",
            advice: "Coordinates are named after their joints, such as `elbow.angle` or `rail.displacement`, and the base of a robot that floats after its body.",
        }
        NoDefault { actuated => actuated, single => single, freedoms => freedoms } => "no-joint-coordinates" {
            cause: "the motion has {freedoms} degrees of freedom, but {actuated} joint coordinates have an actuator, and {single} joints have a single coordinate",
            remedy: "choose as many independent joint coordinates as degrees of freedom",
            meaning: "Joint coordinates are chosen by default if those of actuators, or of joints with one coordinate, are as many as the degrees of freedom of the parts that joints connect with them.",
            advice: "Choose the coordinates by name. Parts that no joint connects with them, such as free bodies, need none.",
        }
        NotFinite { name => name, value => value } => "joint-coordinate-not-finite" {
            cause: "joint coordinate `{name}` cannot be {value}",
            remedy: "specify a finite number",
            meaning: "A value or rate of a joint coordinate is infinite or not a number.",
        }
        NoRotation { 0 => base } => "base-without-rotation" {
            cause: "the quaternion q0 … q3 of base `{base}` has no direction",
            remedy: "give four finite numbers that are not all zero, the scalar part first",
            meaning: "The orientation of a floating base was given by a quaternion of length zero.",
        }
        Output { name => name, known => known } => "jacobian-output" {
            cause: "the model has no output `{name}`",
            remedy: "its outputs are: {known}",
            meaning: "The Jacobian of an output was requested that the model does not have.",
            advice: "Use a name of the section `[outputs]`.",
        }
        NoJacobian { 0 => name } => "no-jacobian" {
            cause: "output `{name}` has no derivatives with respect to joint coordinates or rates",
            remedy: "use an output of positions or velocities",
            meaning: "Accelerations, forces and accumulated outputs are no functions of joint coordinates and rates.",
        }
    } wraps {
        Assembly { 0 => error } => error.diagnostic(),
        Space { 0 => error } => error.diagnostic(),
        Start { 0 => error } => error.diagnostic(),
    }

    Failure RunError {
        Write { 0 => error } => "results-not-written" {
            cause: "the results cannot be written: {error}",
            remedy: "check the permissions of the folder and the free disk space",
            meaning: "A file of results could not be written during a run.",
        }
    } wraps {
        Step { 0 => error } => error.diagnostic(),
    }

    Failure ColumnError {
        Unknown { name => name, near => near } => "no-column" {
            cause: "the results have no column `{name}`",
            remedy: "{near}",
            meaning: "A column was read from results in memory that was not recorded.",
            advice: "Columns are named after an output and one of its components, such as `tip.u3`.",
        }
    } wraps {}

    Failure PathRunError {
        Write { 0 => error } => "path-not-written" {
            cause: "the results cannot be written: {error}",
            remedy: "check the permissions of the folder and the free disk space",
            meaning: "A file of results could not be written while an equilibrium path was followed.",
        }
    } wraps {
        Path { 0 => error } => error.diagnostic(),
        Model { 0 => report } => report.diagnostic(),
    }

    Failure PathSessionError {
        NotAPath { 0 => kind } => "path-kind" {
            cause: "the analysis is of kind `{kind}`, not `path`",
            remedy: "set `analysis.kind` to `path`",
            meaning: "An equilibrium path was requested for a model with an analysis of another kind.",
        }
        AlreadyCritical { path => path, load_factor => load_factor } => "path-loads-critical" {
            cause: "`{path}` is varied from the equilibrium under the loads of the model, but they exceed a critical point at load \
                    factor {load_factor}",
            remedy: "start with smaller loads, or vary a parameter of the loads instead",
            meaning: "A path along a number of the model starts from the equilibrium under its loads. It is ambiguous if the loads \
                      exceed a critical point.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Start { 0 => error } => error.diagnostic(),
        NotLoaded { path => path, error => error } => error.diagnostic().within(&format!(
            "`{path}` is varied from the equilibrium under the loads of the model, which is not found"
        )),
    }

    Failure PortError {
        Input { name => name, known => known } => "port-input" {
            cause: "the model has no input `{name}`; its inputs are {known}",
            remedy: "specify an entry of [inputs], a load or a prescribed motion",
            meaning: "An input of a frequency response or linear model does not exist.",
        }
        Ambiguous { name => name, meanings => meanings } => "port-ambiguous" {
            cause: "`{name}` is ambiguous",
            remedy: "write {meanings}",
            meaning: "Several entries of the model have the name of a requested input.",
            advice: "Write the table before the name, such as `loads.motor`.",
        }
        Output { name => name, known => known } => "port-output" {
            cause: "the model has no output or output column `{name}`",
            remedy: "its columns are {known}",
            meaning: "An output of a frequency response or linear model does not exist.",
            advice: "Specify an entry of [outputs], or a column of one.",
        }
        NotLinear { 0 => name } => "port-not-linear" {
            cause: "the output `{name}` has no linear response: it is accumulated from step to step",
            remedy: "use a power or a relative coordinate",
            meaning: "Work and angles beyond half a revolution depend on the whole motion and have no linear response.",
        }
        WithoutEffect { 0 => name } => "port-without-effect" {
            cause: "the input `{name}` has no effect: no load, state or requested output depends on it in this state",
            remedy: "use another input, or a state in which it acts",
            meaning: "The derivative of the equations and of all requested outputs with respect to an input is zero.",
        }
    } wraps {
        Model { 0 => error } => error.diagnostic(),
    }

    Failure GradientError {
        Column { name => name, known => known } => "gradient-column" {
            cause: "the model has no output column `{name}`",
            remedy: "its columns are {known}",
            meaning: "The output to be differentiated does not exist.",
            advice: "Specify a column of an entry of [outputs].",
        }
        Number { 0 => reason } => "gradient-number" {
            cause: "{reason}",
            remedy: "specify the path of a number in the model file, such as `bodies.top.mass` or `parameters.length`",
            meaning: "Derivatives are computed with respect to numbers that are written in the model file and are not zero.",
        }
        Time { time => time, start => start, end => end } => "gradient-time" {
            cause: "the output at t = {time} s was requested, but the analysis is from {start} to {end} s",
            remedy: "choose a time of the analysis",
            meaning: "The time at which an output is differentiated is outside of the analysis.",
        }
        NotInTime { 0 => kind } => "gradient-kind" {
            cause: "an analysis of kind `{kind}` has no time steps along which outputs are differentiated",
            remedy: "use an analysis of kind `dynamics` or `statics`",
            meaning: "Derivatives are computed along time steps or load steps.",
        }
        Unlike { 0 => path } => "gradient-unknowns" {
            cause: "a change of `{path}` changes the unknowns of the model, so there is no derivative with respect to it",
            remedy: "choose a number that changes neither parts nor elements",
            meaning: "The number of unknowns depends on the number with respect to which an output is differentiated.",
        }
        KinkMoves { path => path, time => time } => "gradient-breakpoint" {
            cause: "a change of `{path}` moves a kink or jump of a load or drive, at t = {time} s, at which a step ends",
            remedy: "smooth the function over several steps, or compare runs",
            meaning: "Steps end at kinks and jumps of functions of time. Their derivative with respect to the time of the kink is not \
                      computed.",
        }
        Feedback {} => "gradient-feedback" {
            cause: "outputs of models with feedback, states, delayed or sampled signals cannot be differentiated",
            remedy: "remove loads and states whose signals depend on the motion, or compare runs",
            meaning: "Derivatives along the motion are not implemented for feedback, states, events and sampled signals, except those of \
                      contacts.",
        }
        InParts { 0 => time } => "gradient-bisected-step" {
            cause: "the step to t = {time} s was bisected, and bisected steps cannot be differentiated: the whole step has no \
                    solution, or a load or drive has a kink or jump there",
            remedy: "choose a smaller step, steps that end at kinks of loads and drives, or smooth these",
            meaning: "Derivatives are not computed along steps that were bisected.",
        }
        NotSmooth { path => path } => "gradient-not-smooth" {
            cause: "there is no derivative with respect to `{path}`: forces switch during the run, for example at a stop or a slack \
                    spring, and differences of runs over two distances disagree",
            remedy: "choose another time, a smaller `analysis.relative_tolerance`, or compare runs",
            meaning: "The output is not smooth in this number, or a force switches at the time of the output.",
        }
        Denied { expected => expected, found => found } => "gradient-refuted" {
            cause: "the derivatives add up to a change of {expected:.3e}, but runs of the model with perturbed numbers change by {found:.3e}",
            remedy: "choose another time, because the output may have jumps or kinks nearby; if that does not help, report an error \
                     of the program",
            meaning: "The finite-difference check refutes the derivatives of `lissom gradient`: the output has a jump or a kink nearby.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Initial { 0 => error } => error.diagnostic(),
        Step { 0 => error } => error.diagnostic(),
        Target { 0 => error } => error.diagnostic(),
    }

    Failure SweepError {
        NotInTime { 0 => kind } => "sweep-kind" {
            cause: "an analysis of kind `{kind}` has no history from which scalars are collected",
            remedy: "use an analysis of kind `dynamics` or `statics`",
            meaning: "Sweeps collect scalars from histories over time.",
        }
        Column { name => name, column => column, known => known } => "sweep-column" {
            cause: "`{name}` collects `{column}`, which the model does not record",
            remedy: "{known}",
            meaning: "A sweep collects a column that is not an output of the model.",
            advice: "Specify a column of an entry of [outputs].",
        }
        NoExponent { name => name, column => column } => "sweep-exponent" {
            cause: "`{name}` collects the damage equivalent range of `{column}`, whose output has no `woehler_exponent`",
            remedy: "add `woehler_exponent` to the output",
            meaning: "Damage equivalent ranges require the exponent of the Wöhler curve.",
        }
        Window { name => name, at => at, problem => problem, remedy => remedy } => "sweep-window" {
            cause: "the window of `{name}` ({at}) cannot be used: {problem}",
            remedy: "{remedy}",
            meaning: "The window of a collected statistic is empty or not within the analysis, or names an event that the model does not have.",
            advice: "Choose limits within the analysis: `after=0.5`, `before=2`, `last=0.2`, or events.",
        }
        Event { name => name, event => event, known => known } => "sweep-event" {
            cause: "`{name}` collects the time of the event `{event}`, which the model does not have",
            remedy: "{known}",
            meaning: "A sweep collects the time of an event that the model does not have.",
            advice: "Specify an entry of [events].",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
    }

    Failure FmuError {
        NotInTime { 0 => kind } => "unit-kind" {
            cause: "an analysis of kind `{kind}` has no time steps, which a unit requires",
            remedy: "use an analysis of kind `dynamics` or `statics`",
            meaning: "A co-simulation unit advances its model in time.",
        }
        SameName { 0 => name } => "unit-name" {
            cause: "`{name}` would be the name of two variables",
            remedy: "rename one of them in the model",
            meaning: "The variables of a co-simulation unit (inputs, parameters, columns) must have distinct names.",
        }
        Archive { 0 => error } => "unit-archive" {
            cause: "the archive cannot be created: {error}",
            remedy: "check the free memory, and the size of the included files",
            meaning: "The archive of a co-simulation unit could not be packed.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
    }

    Failure FolderError {
        NoResults { path => path, is => content } => "no-results" {
            cause: "`{path}` {content}",
            remedy: "specify a folder of results, such as `lissom run MODEL.toml --out DIR` creates",
            meaning: "The given path is not a folder with results of a run.",
        }
        Several { path => path, first => first, folders => folders } => "several-results" {
            cause: "`{path}` has no results itself, but folders of results: {folders}",
            remedy: "specify one of them, such as `{first}`",
            meaning: "The given folder contains several folders of results, and one of them must be chosen.",
            advice: "Specify one of the folders that the message names.",
        }
        NoMotion { path => path, holds => content, remedy => remedy } => "no-motion" {
            cause: "`{path}` contains {content}",
            remedy: "{remedy}",
            meaning: "The results contain no recorded motion of a run.",
            advice: "Run the model again; shapes of modes are shown by `lissom view` and `lissom snapshot`.",
        }
    } wraps {
        File { 0 => error } => error.diagnostic(),
        Record { path => path, error => error } => error.diagnostic().within(&format!("`{path}`")),
        Motion { path => path, error => error } => error.diagnostic().within(&format!("`{path}`")),
        Scene { path => path, error => error } => error.diagnostic().within(&format!("`{path}`")),
        Figure { 0 => error } => error.diagnostic(),
    }

    Failure MotionError {
        Foreign {} => "motion-foreign" {
            cause: "the file is not a motion file of this program",
            remedy: "run the model again",
            meaning: "A file in the place of a recorded motion, `motion.bin`, has other contents.",
        }
        Version { 0 => version } => "motion-version" {
            cause: "the motion file is of version {version}, but that of this program is {VERSION}",
            remedy: "run the model again",
            meaning: "A motion was recorded by another version of the program.",
        }
        Damaged {} => "motion-damaged" {
            cause: "the motion file is damaged, or belongs to another model",
            remedy: "run the model again",
            meaning: "A recorded motion ends before its first frame, has an invalid header, or does not fit the scene beside it.",
        }
        Altered { 0 => frame } => "motion-altered" {
            cause: "frame {frame} of the motion is not as it was written: its checksum differs",
            remedy: "copy the file again, or run the model again, and check the disk",
            meaning: "Bytes of a recorded motion have changed since it was written, for example by an incomplete copy or a faulty disk.",
        }
        NotFinite { 0 => frame } => "motion-not-finite" {
            cause: "frame {frame} of the motion contains a number that is not finite",
            remedy: "run the model again",
            meaning: "A recorded motion contains a number that is infinite or not a number.",
        }
    } wraps {}

    Failure ExportError {
        Empty {} => "export-empty" {
            cause: "the motion has no frames",
            remedy: "run the model again",
            meaning: "The recorded motion to be exported has no frames.",
        }
        Archive { 0 => error } => "export-archive" {
            cause: "the archive cannot be packed: {error}",
            remedy: "request fewer frames or outputs",
            meaning: "The archive of an export exceeds the limits of its format, or memory is insufficient.",
        }
        TooLarge {} => "export-too-large" {
            cause: "the results exceed 4 GB, the limit of this format",
            remedy: "request fewer frames or outputs, or use another format",
            meaning: "The format of an export addresses at most 4 GB.",
        }
    } wraps {
        File { 0 => error } => error.diagnostic(),
    }

    Failure PictureError {
        Outside { time => time, first => first, last => last } => "picture-time" {
            cause: "there is no motion at t = {time} s: it was recorded from {first} s to {last} s",
            remedy: "choose an instant of the recorded motion",
            meaning: "A picture was requested at an instant outside of the recorded motion.",
        }
        Empty {} => "picture-empty" {
            cause: "the motion has no frames",
            remedy: "run the model again",
            meaning: "The recorded motion to be drawn has no frames.",
        }
        TooMany { count => count, most => most } => "picture-count" {
            cause: "{count} pictures were requested",
            remedy: "request 1 to {most}",
            meaning: "A sheet or an animation was requested with no pictures, or with too many.",
            advice: "Request fewer pictures.",
        }
    } wraps {
        Drawing { 0 => error } => Diagnostic::of(
            &PICTURE,
            format!("the picture cannot be drawn: {error}"),
            "choose another size, view or instant",
        ),
    }

    Failure SweepFolderError {
        OtherSweep { 0 => path } => "sweep-of-other-model" {
            cause: "`{path}` holds another sweep: its model, its sweep file or the version of the program is different",
            remedy: "choose another folder by `--out`, or discard its contents by `--restart`",
            meaning: "The folder of a sweep has members of another sweep.",
        }
        Busy { 0 => path } => "sweep-busy" {
            cause: "another process is writing to `{path}`",
            remedy: "wait for the other process, or choose another folder by `--out`",
            meaning: "Two processes cannot write to the folder of one sweep.",
        }
        Damaged { path => path, line => line } => "sweep-damaged" {
            cause: "line {line} of `{path}` is not a member of this sweep",
            remedy: "discard the contents of the folder by `--restart`",
            meaning: "The record of the completed members of a sweep has an invalid line.",
        }
    } wraps {
        File { 0 => error } => error.diagnostic(),
    }

    Failure CheckpointError {
        Missing { 0 => path } => "checkpoint-missing" {
            cause: "there is no checkpoint in `{path}`: the run has ended, or was started without `--checkpoint-every`",
            remedy: "run the model again, with `--checkpoint-every`",
            meaning: "A run cannot be resumed without a checkpoint, which is removed at the end of a run.",
        }
        Unreadable { 0 => path } => "checkpoint-version" {
            cause: "`{path}` is not a checkpoint of this version of the program",
            remedy: "run the model again",
            meaning: "A checkpoint is damaged, or was written by another version of the program.",
        }
    } wraps {
        File { 0 => error } => error.diagnostic(),
    }

    Failure StudyError {
        NotDynamic {} => "study-kind" {
            cause: "this study requires time steps, which the analysis of the model does not have",
            remedy: "use an analysis of kind `dynamics`",
            meaning: "A study compares time steps or step sizes, which an analysis of another kind does not have.",
        }
        SchemeWord { word => word, reason => reason } => "study-scheme" {
            cause: "`{word}` is not a scheme for a study",
            remedy: "{reason}",
            meaning: "A scheme of a study is unknown, or is written with invalid parameters.",
            advice: "Write the name of a scheme, and its step size after a colon where the study requires it.",
        }
        Output { name => name, known => known } => "study-output" {
            cause: "the model has no output `{name}`",
            remedy: "its outputs are {known}",
            meaning: "The output to be compared does not exist.",
            advice: "Specify an entry of [outputs].",
        }
        Steps { step => step, coarsest => coarsest } => "study-steps" {
            cause: "the step size {step} s does not divide the largest, {coarsest} s",
            remedy: "choose steps that are integer fractions of the largest, such as 1e-2,5e-3,2.5e-3",
            meaning: "Runs are compared at the ends of the largest steps, which must be ends of all steps.",
        }
        CoarseReference { 0 => step } => "study-reference" {
            cause: "the step size of the reference, {step} s, is larger than a step of the study",
            remedy: "choose a smaller step for the reference",
            meaning: "The errors of runs are differences from a reference, which must be more accurate.",
        }
        NothingToCompare { 0 => name } => "study-output-zero" {
            cause: "the output `{name}` is zero at all times",
            remedy: "choose an output that changes",
            meaning: "Errors are relative to the amplitude of the output, which is zero.",
        }
        Interrupted {} => "study-interrupted" {
            cause: "interrupted",
            remedy: "",
            meaning: "A study was interrupted by Ctrl-C or by the caller.",
            advice: "Start it again.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Initial { 0 => error } => error.diagnostic(),
        Run { 0 => error } => error.diagnostic(),
    }

    Failure CommandError {
        Request { 0 => reason } => "request" {
            cause: "{reason}",
            remedy: "",
            meaning: "The arguments of a command or function contradict each other, or name something that does not exist. Nothing was \
                      computed.",
            advice: "Follow the message; `lissom COMMAND --help` lists the arguments of a command.",
        }
        Members { failed => failed, count => count } => "sweep-members" {
            cause: "{failed} of {count} members have no solution",
            remedy: "",
            meaning: "Some members of a sweep failed; the others are in its table.",
            advice: "The table of the sweep has the cause of each failure; run the model of such a member alone.",
        }
        Port { port => port, reason => reason } => "live-port" {
            cause: "port {port} cannot be used: {reason}",
            remedy: "choose another port by `--port`",
            meaning: "Another program uses the port of a live page, or it is reserved.",
        }
        Output { 0 => reason } => "output-cut" {
            cause: "the standard output is incomplete: {reason}",
            remedy: "free space on the disk or device that receives it, or redirect the output to another one",
            meaning: "Results that are printed could not be written, as where a file that receives them is on a full disk. Files of results \
                      are complete.",
        }
        Browser { 0 => path } => "no-browser" {
            cause: "no browser could be started",
            remedy: "open `{path}` in one",
            meaning: "A page was written, but the desktop has no program that shows it.",
            advice: "Open the page in a browser.",
        }
    } wraps {}

    Failure ReadError {
        NotBuilt {} => "read-by-id" {
            cause: "the model was not built in code, so its parts have no ids",
            remedy: "use the names of outputs and inputs",
            meaning: "A quantity was requested by an id, but ids exist only for models that are built in code.",
        }
        NotRecorded { 0 => name } => "read-not-recorded" {
            cause: "`{name}` is not recorded",
            remedy: "remove the override that removes this output, or do not request it",
            meaning: "An output was requested by its id, but an override has removed it from the model.",
        }
    } wraps {
        Foreign { 0 => error } => error.diagnostic(),
        Input { 0 => error } => error.diagnostic(),
    }

    Failure PartError {
        NotBuilt {} => "part-by-id" {
            cause: "the model was not built in code, so its parts have no ids",
            remedy: "use the names of nodes",
            meaning: "A part was requested by an id, but ids exist only for models that are built in code.",
        }
        NoInput { 0 => name } => "state-without-input" {
            cause: "the state has no input `{name}`: it belongs to another model",
            remedy: "obtain the state from the prepared model itself",
            meaning: "An input of a given initial state was set, which the model of the state does not have.",
        }
        Beam { 0 => name } => "state-of-beam" {
            cause: "`{name}` is a beam, which has many nodes",
            remedy: "set the motion of its nodes in the state",
            meaning: "The motion of a part was set by one position and velocity, which a beam does not have.",
        }
    } wraps {
        Foreign { 0 => error } => error.diagnostic(),
    }
}

const PICTURE: Entry = Entry {
    code: "picture-drawing",
    variant: "PictureError::Drawing",
    severity: Severity::Failure,
    message: "the picture cannot be drawn: {error}",
    meaning: "A picture is empty, exceeds the size of an image, or has a position that is not finite.",
    advice: "Choose another size, view or instant.",
};

const FOREIGN_ID: Entry = Entry {
    code: "foreign-id",
    variant: "ForeignId",
    severity: Severity::Failure,
    message: "a {kind} of another model is used with this one",
    meaning: "Ids of parts, inputs and outputs are valid only in the model that returned them.",
    advice: "Use the ids that this model has returned.",
};

impl Diagnose for ForeignId {
    fn diagnostic(&self) -> Diagnostic {
        let cause = format!("a {} of another model is used with this one", self.kind());
        Diagnostic::of(&FOREIGN_ID, cause, "ids are valid only in the model that returned them")
    }
}

const IMPORT: Entry = Entry {
    code: "import",
    variant: "ImportError",
    severity: Severity::Failure,
    message: "{message}",
    meaning: "A robot description has an error, or elements that a model of this program cannot represent, and vice versa.",
    advice: "Follow the message; `--without` omits what cannot be represented.",
};

impl Diagnose for ImportError {
    fn diagnostic(&self) -> Diagnostic {
        Diagnostic::of(&IMPORT, self.message.clone(), "")
    }
}
