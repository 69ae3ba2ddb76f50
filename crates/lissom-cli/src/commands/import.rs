//! `lissom import`: a model file from a robot description of another program.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use lissom::exchange::import::{
    ChosenStart, Freedom, Motors, Options, Pose, Robot, Root, Unsupported, chosen_starts, from_file,
    model_text, omissions,
};
use lissom::model::files;
use lissom::{Diagnose, Diagnostic, Model, SessionError};

use super::outcome::{Exit, Failure};
use super::terminal;

/// Convert a robot description (URDF, MJCF, SDF) to a model file: bodies, joints, limits, springs, damping and friction.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom import ur5.urdf                           writes ur5.toml
  lissom import ur5.urdf --position elbow_joint=0.5 --out elbow.toml
  lissom import ur5.urdf --motors                  an input and a torque for each motor
  lissom import solo12.urdf --floating --without limits,friction
  lissom import hopper.xml                         MJCF, the description of MuJoCo
  lissom import humanoid.xml --keyframe squat      starts at one of its key frames
  lissom import world.sdf                          SDF, the description of Gazebo, with all its models
  lissom import robots/                            a table: which descriptions in the folder open, and why others do not
  lissom import robots/ --out models/              writes their models, too")]
pub(super) struct Import {
    /// The description: URDF, MJCF or SDF, regardless of the file extension; or a folder of them.
    #[arg(value_name = "ROBOT|FOLDER")]
    file: PathBuf,
    /// The model file to write [default: the name of the description with the extension toml, in the current folder]; for a folder of
    /// descriptions a folder [default: nothing is written].
    #[arg(long, short, value_name = "MODEL.toml|DIR")]
    out: Option<PathBuf>,
    /// Initial coordinate of a joint [rad, m]; may be repeated.
    #[arg(long = "position", value_name = "JOINT=VALUE", value_parser = joint_value)]
    positions: Vec<(String, f64)>,
    /// Start at a key frame of MJCF; `--position` changes joints of it.
    #[arg(long, value_name = "NAME")]
    keyframe: Option<String>,
    /// Leave the root free instead of fixing it to the ground.
    #[arg(long)]
    floating: bool,
    /// Write an input for each motor, and its torque or force within the limits of the description.
    #[arg(long)]
    motors: bool,
    /// Omit stops at limits, damping and friction, mimic joints, contacts, or what a model cannot express; several are separated by
    /// commas.
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    without: Vec<Part>,
}

/// What may be omitted.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    Limits,
    Friction,
    Mimic,
    Contacts,
    Unsupported,
}

fn joint_value(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("write JOINT=VALUE")?;
    let value: f64 = value.trim().parse().map_err(|_| format!("`{value}` is no number"))?;
    if value.is_finite() {
        Ok((name.trim().to_owned(), value))
    } else {
        Err("give a finite number".to_owned())
    }
}

/// Endings of files in a folder that may be descriptions.
const ENDINGS: [&str; 5] = ["urdf", "xml", "mjcf", "sdf", "world"];

/// What becomes of a description.
struct Imported {
    robot: Robot,
    pose: Pose,
    options: Options,
    /// The text of the model file.
    model: String,
}

impl Import {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        if self.file.is_dir() { self.folder() } else { self.single() }
    }

    /// Reads the description in `file`; `out` is where its model will be.
    fn read(&self, file: &Path, out: &Path) -> Result<Imported, Failure> {
        let subject = format!("`{}`", file.display());
        let bad = |error: Diagnostic| Failure::with_details(Exit::BadModel, &error.within(&subject), "");
        if !file.is_file() {
            files::read_input_text(file).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        }
        let mut robot = from_file(file).map_err(|error| bad(error.diagnostic()))?;
        robot.locate_meshes(file, out);
        let mut values = match &self.keyframe {
            Some(name) => robot.start_at(name).map_err(|error| bad(error.diagnostic()))?,
            None => BTreeMap::new(),
        };
        values.extend(self.positions.iter().cloned());
        let pose = Pose { values, ..Pose::default() };
        let options = Options {
            root: if self.floating || robot.is_object() { Root::Floating } else { Root::Held },
            limits: !self.without.contains(&Part::Limits),
            friction: !self.without.contains(&Part::Friction),
            mimic: !self.without.contains(&Part::Mimic),
            contacts: !self.without.contains(&Part::Contacts),
            motors: if self.motors { Motors::Written } else { Motors::Omitted },
            unsupported: if self.without.contains(&Part::Unsupported) {
                Unsupported::LeftOut
            } else {
                Unsupported::Refused
            },
        };
        let model = model_text(&robot, &pose, options).map_err(|error| bad(error.diagnostic()))?;
        // A model without a consistent initial state is not written.
        match Model::from_text(&out.display().to_string(), &model).session() {
            Ok(_) => Ok(Imported { robot, pose, options, model }),
            Err(SessionError::Model(report)) => Err(report.into()),
            Err(error) => Err(bad(error.diagnostic())),
        }
    }

    /// A table of all descriptions in a folder: which open, what is omitted, and why others do not.
    fn folder(&self) -> Result<Exit, Failure> {
        let is_description = |path: &PathBuf| {
            let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
        };
        let described = files::entries(&self.file).filter(is_description);
        let mut names: Vec<String> =
            described.filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())).collect();
        names.sort_unstable();
        if names.is_empty() {
            let endings = ENDINGS.join(", ");
            return Err(Failure::request(format!(
                "there is no description in `{}`: files that end in {endings}",
                self.file.display()
            )));
        }
        let width = names.iter().map(|name| name.chars().count()).max().unwrap_or_default();
        let (mut opened, mut unwritten) = (0, 0);
        for name in &names {
            let file = self.file.join(name);
            let folder = self.out.as_deref().unwrap_or(Path::new(""));
            let out = folder.join(Path::new(name).with_extension("toml"));
            let said = match self.read(&file, &out) {
                Ok(Imported { robot, options, model, .. }) => {
                    opened += 1;
                    let is_kept = self.out.is_some() && out.exists();
                    unwritten += usize::from(is_kept);
                    if self.out.is_some() && !is_kept {
                        files::create_folder(folder)
                            .and_then(|()| files::write(&out, model.as_bytes()))
                            .map_err(|error| Failure::new(Exit::Failed, &error))?;
                    }
                    let left_out = omissions(&robot, options);
                    let links = robot.links.len();
                    let kept = if is_kept {
                        format!("; not written: `{}` already exists", out.display())
                    } else {
                        String::new()
                    };
                    if left_out.is_empty() {
                        format!("opens: {links} links{kept}")
                    } else {
                        format!("opens: {links} links, without {}{kept}", left_out.join("; "))
                    }
                }
                Err(failure) => {
                    let words = failure
                        .words
                        .trim_start_matches("error: ")
                        .trim_start_matches([' ', '×'])
                        .lines()
                        .next()
                        .unwrap_or_default();
                    let about = format!("`{}`: ", file.display());
                    format!("not: {}", words.trim_start_matches(&about))
                }
            };
            terminal::print(&format!("{name:width$}  {said}\n"));
        }
        terminal::print(&format!("{opened} of {} descriptions open\n", names.len()));
        Ok(if opened == names.len() && unwritten == 0 { Exit::Done } else { Exit::BadModel })
    }

    fn single(&self) -> Result<Exit, Failure> {
        let stem = self.file.file_stem().unwrap_or_default();
        let out = self.out.clone().unwrap_or_else(|| PathBuf::from(stem).with_extension("toml"));
        if out.exists() {
            let message =
                format!("`{}` already exists and is not overwritten: name another with --out", out.display());
            return Err(Failure::request(message));
        }
        let Imported { robot, pose, options, model } = self.read(&self.file, &out)?;
        files::write(&out, model.as_bytes()).map_err(|error| Failure::new(Exit::Failed, &error))?;
        let moving =
            robot.joints.iter().filter(|joint| joint.moves() || joint.freedom == Freedom::Ball).count();
        let left_out: String = omissions(&robot, options)
            .into_iter()
            .flat_map(|what| ["  omitted: ".to_owned(), what, "\n".to_owned()])
            .collect();
        let base = &robot.links[0].name;
        let root = match options.root {
            Root::Floating if !self.floating => {
                format!("  root: `{base}` is a free body, because nothing else moves\n")
            }
            Root::Held if robot.may_float() => {
                format!("  root: `{base}` is fixed to the ground; --floating lets it move\n")
            }
            _ => String::new(),
        };
        let names: Vec<&str> = robot.keyframes.iter().map(|own| own.name.as_str()).collect();
        let keyframes = match &self.keyframe {
            None if !names.is_empty() => format!("  start: --keyframe chooses one of {}\n", names.join(", ")),
            _ => String::new(),
        };
        let chosen = chosen_starts(&robot, &pose, options);
        let starts = self.starts(&chosen, &out);
        terminal::print(&format!(
            "{} is written: {} links, {moving} moving joints.\n{root}{left_out}{keyframes}{starts}Next:\n  lissom view {} --open    simulate it and watch the \
             motion\n",
            out.display(),
            robot.links.len(),
            out.display()
        ));
        Ok(Exit::Done)
    }

    /// Start positions that were chosen because limits exclude others, and the command that chooses them.
    fn starts(&self, chosen: &[ChosenStart], out: &Path) -> String {
        if chosen.is_empty() {
            return String::new();
        }
        let sentences: Vec<String> =
            chosen.iter().map(|own| format!("  start: {}", own.sentence())).collect();
        let mut words = vec!["lissom import".to_owned(), self.file.display().to_string()];
        let given = self.positions.iter().map(|(joint, value)| (joint, *value));
        let all = given.chain(chosen.iter().map(|own| (&own.joint, own.value)));
        words.extend(all.map(|(joint, value)| format!("--position {joint}={value}")));
        words.extend(self.keyframe.iter().map(|name| format!("--keyframe {name}")));
        words.extend(self.floating.then(|| "--floating".to_owned()));
        let without: Vec<String> = self
            .without
            .iter()
            .filter_map(|part| Some(part.to_possible_value()?.get_name().to_owned()))
            .collect();
        words.extend((!without.is_empty()).then(|| format!("--without {}", without.join(","))));
        words.push(format!("--out {}", out.display()));
        format!(
            "{}\nOther positions, after removing the file:\n  {}\n",
            sentences.join("\n"),
            words.join(" ")
        )
    }
}
