//! `lissom export`: results for other programs.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use lissom::ResultFolder;
use lissom::export::{ExportError, FORMATS, Format};
use lissom_model::files;

use super::{Exit, Failure};
use crate::terminal;

/// Hand results to other programs: ParaView, Blender, NumPy.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom export out/turbine --format vtk       out/turbine/vtk/motion.pvd, for ParaView
  lissom export out/turbine --format gltf      out/turbine/motion.glb, an animation
  lissom export out/turbine --format npz       out/turbine/results.npz, for NumPy

Exit code: 0 all is done; 2 a folder without a run and its motion; 3 a file that cannot be written.")]
pub(super) struct Export {
    /// A folder of results.
    #[arg(value_name = "RESULT")]
    folder: PathBuf,

    /// The format.
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(FORMATS.iter().map(|format| format.name)))]
    format: String,

    /// Where it goes: a file, of vtk a folder [default: in the folder of results].
    #[arg(long, value_name = "PATH")]
    out: Option<PathBuf>,

    /// At most so many frames of the motion, at equal distances.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..))]
    frames: u64,
}

impl Export {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let format: &Format = FORMATS
            .iter()
            .find(|format| format.name == self.format)
            .ok_or_else(|| Failure::new(Exit::BadModel, "there is no such format"))?;
        let run =
            ResultFolder::recorded(&self.folder).map_err(|error| Failure::folder(Exit::BadModel, &error))?;
        let target = self.out.clone().unwrap_or_else(|| self.folder.join(format.target));
        if format.is_folder {
            files::create_folder(&target).map_err(|error| Failure::file(Exit::Failed, &error))?;
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
            ExportError::File(error) => Failure::file(Exit::Failed, &error),
            error => Failure::new(Exit::Failed, error),
        })?;
        terminal::print(&format!("{}\n", last.display()));
        Ok(Exit::Done)
    }
}
