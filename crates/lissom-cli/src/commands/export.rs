//! `lissom export`: results for other programs.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use lissom::exchange::export::{ExportError, FORMATS, Format};
use lissom::exchange::import::{from_model, to_urdf};
use lissom::model::files;
use lissom::{Override, ResultFolder};

use super::model_arguments;
use super::outcome::{Exit, Failure};
use super::results::warn_of_incomplete;
use super::terminal;

/// Export results to ParaView, Blender, NumPy or pandas, or a model of rigid bodies as URDF.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom export out/turbine --format vtk       out/turbine/vtk/motion.pvd, for ParaView
  lissom export out/turbine --format gltf      out/turbine/motion.glb, an animation
  lissom export out/turbine --format npz       out/turbine/results.npz, for NumPy
  lissom export out/turbine --format parquet   out/turbine/history.parquet, for pandas
  lissom export arm.toml --format urdf         arm.urdf, a description of the robot

Exit code: 0 success; 2 no run with a motion in the folder, or a model that the format cannot express; 3 a file cannot be
written.")]
pub(super) struct Export {
    /// A folder of results; for `urdf` a model file.
    #[arg(value_name = "RESULT")]
    folder: PathBuf,

    /// The format.
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(FORMATS.iter().map(|format| format.name).chain([URDF])))]
    format: String,

    /// Destination: a file, or for `vtk` a folder [default: in the folder of results].
    #[arg(long, short, value_name = "PATH")]
    out: Option<PathBuf>,

    /// Maximum number of frames of the motion, at equal intervals.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..))]
    frames: u64,

    /// For `urdf`: override a value of the model, such as `bodies.arm.mass=2`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// For `urdf`: omit elements that the format cannot express, such as loads and springs.
    #[arg(long, value_name = "WHAT")]
    without: Option<Without>,
}

/// What may be omitted.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Without {
    Unsupported,
}

/// The format of models.
const URDF: &str = "urdf";

impl Export {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        if self.format == URDF {
            return self.describe();
        }
        let format: &Format = FORMATS
            .iter()
            .find(|format| format.name == self.format)
            .ok_or_else(|| Failure::request("there is no such format"))?;
        let run =
            ResultFolder::recorded(&self.folder).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        lissom::protect_results(&self.folder);
        warn_of_incomplete(&self.folder);
        let target = self.out.clone().unwrap_or_else(|| self.folder.join(format.target));
        if format.is_folder {
            files::create_folder(&target).map_err(|error| Failure::new(Exit::Failed, &error))?;
        }
        let mut last = target.clone();
        let mut sink = |name: &str, bytes: &[u8]| {
            let path = if name.is_empty() { target.clone() } else { target.join(name) };
            files::write(&path, bytes)?;
            if name.is_empty() || path.extension().is_some_and(|ending| ending == "pvd") {
                last = path;
            }
            Ok(())
        };
        (format.write)(&run, self.frames as usize, &mut sink).map_err(|error| match error {
            ExportError::File(error) => Failure::new(Exit::Failed, &error),
            error => Failure::new(Exit::Failed, &error),
        })?;
        terminal::print(&format!("{}\n", last.display()));
        Ok(Exit::Done)
    }

    /// Writes a model as a robot description.
    fn describe(self) -> Result<Exit, Failure> {
        let model = model_arguments::read(&self.folder, &self.set, &[])?;
        let document = model.document()?;
        let refused =
            |words: String| Failure::request(format!("`{}` as URDF: {words}", self.folder.display()));
        let found = from_model(&document).map_err(|error| refused(error.to_string()))?;
        let robot = &found.robot;
        if self.without.is_none() && !robot.unsupported.is_empty() {
            return Err(refused(format!(
                "the format cannot express: {}; the robot would move differently from the model; `--without unsupported` omits these",
                robot.unsupported.join("; ")
            )));
        }
        let stem = self.folder.file_stem().unwrap_or_default();
        let out = self.out.clone().unwrap_or_else(|| PathBuf::from(stem).with_extension(URDF));
        files::write(&out, to_urdf(robot).as_bytes()).map_err(|error| Failure::new(Exit::Failed, &error))?;
        let mut text = format!("{}\n", out.display());
        for what in robot.left_out.iter().chain(&robot.unsupported) {
            text.extend(["  omitted: ", what, "\n"]);
        }
        if !found.values.is_empty() {
            let values = found.values.iter().map(|(name, value)| format!(" --position {name}={value:?}"));
            text.push_str("  the joint coordinates of the model are not zero at the start: lissom import");
            text.extend(values);
            text.push('\n');
        }
        terminal::print(&text);
        Ok(Exit::Done)
    }
}
