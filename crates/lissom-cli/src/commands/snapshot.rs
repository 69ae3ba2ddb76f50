//! `lissom snapshot`: a picture of a mechanism at one or several instants, as SVG or PNG, without a browser.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use lissom::model::files;
use lissom::model::output::{DrawingError, Format};
use lissom::model::scene::Scene;
use lissom::motion::Motion;
use lissom::pictures::picture::{Field, Picture, PictureError, RecordedForces, View, instants};
use lissom::{FolderError, Override, RecordedModes, ResultFolder};

use super::initial_scene::{InitialScene, refuse_what_does_not_move};
use super::outcome::{Exit, Failure};
use super::results::warn_of_incomplete;
use super::run::Run;
use super::terminal;

/// Draw a mechanism at one or several instants, as SVG or PNG.
///
/// The shapes are those of `lissom view`. A model is simulated first, as by `lissom run`, unless `--initial` is given. Without
/// `--at` and `--strip` the last instant is drawn, or for natural modes the first twenty shapes.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom snapshot out/tip-crank --strip 6      writes out/tip-crank/snapshot.svg
  lissom snapshot out/tip-crank --at 0.1,0.2 --out crank.png
  lissom snapshot examples/four-bar.toml --initial --view front
  lissom snapshot examples/four-bar.toml --animate 4
  lissom snapshot out/four-bar-modes --mode 2 --animate 2

Exit code: 0 success; 2 wrong model or command line, or an instant without motion; 3 no solution: the picture then
shows the last instant before the failure.")]
#[expect(clippy::struct_excessive_bools, reason = "each is an option of the command line")]
pub(super) struct Snapshot {
    /// A folder of results, or a model file.
    #[arg(value_name = "RESULT|MODEL.toml")]
    what: PathBuf,

    /// Instants to be drawn side by side [s]; for an equilibrium path lengths along it, for a mode fractions of its period.
    #[arg(
        long,
        value_name = "TIME",
        value_delimiter = ',',
        allow_negative_numbers = true,
        conflicts_with = "strip"
    )]
    at: Vec<f64>,

    /// Number of instants, at equal intervals from the first to the last.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100))]
    strip: Option<u64>,

    /// For results of `lissom modes`: the mode of this number, over one period.
    #[arg(long, value_name = "N", conflicts_with = "initial", value_parser = clap::value_parser!(u32).range(1..))]
    mode: Option<u32>,

    /// Write an animation (APNG, which browsers can show, or GIF) of the whole motion with this duration [s].
    #[arg(long, value_name = "SECONDS", conflicts_with_all = ["at", "strip", "initial"])]
    animate: Option<f64>,

    /// File of the picture, with the extension .svg or .png, of an animation .png or .gif [default: snapshot.svg in the
    /// folder of results, snapshot.png if it moves].
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,

    /// Direction of view.
    #[arg(long, value_enum, default_value_t = From::Chosen)]
    view: From,

    /// Draw the paths of the observed points.
    #[arg(long)]
    paths: bool,

    /// Draw recorded reactions, contact forces and forces of springs as arrows.
    #[arg(long, conflicts_with_all = ["initial", "mode"])]
    forces: bool,

    /// Colour shells and solids by a quantity, with a scale.
    #[arg(long, value_enum, conflicts_with_all = ["initial", "mode"])]
    colour: Option<Colour>,

    /// Draw the initial state of the model, without simulating it.
    #[arg(long, conflicts_with_all = ["at", "strip"])]
    initial: bool,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// Print neither progress nor a summary.
    #[arg(long, short)]
    quiet: bool,
}

/// Maximum duration of an animation [s], and number of its pictures per second.
const MAX_SECONDS: f64 = 30.0;
const PICTURES_PER_SECOND: f64 = 20.0;
/// Maximum number of shapes of natural modes on a sheet.
const MAX_SHAPES: usize = 20;

/// Directions of view on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum From {
    /// The front for a model in a plane, otherwise oblique.
    Chosen,
    /// From the front, the right and above.
    Oblique,
    /// Along the global axis y.
    Front,
    /// Against the global axis x.
    Side,
    /// Against the global axis z.
    Top,
}

/// Quantities by which shells and solids are coloured, on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Colour {
    /// Distance from the stress-free position.
    Displacement,
    /// Von Mises stress on the side of the normal.
    MisesTop,
    /// Von Mises stress in the middle of the thickness.
    MisesMiddle,
    /// Von Mises stress on the other side.
    MisesBottom,
    /// Strain energy per area of shells.
    Energy,
    /// Von Mises stress of solids.
    Mises,
    /// Strain energy per volume of solids.
    EnergyDensity,
}

impl Colour {
    fn field(self) -> Field {
        match self {
            Self::Displacement => Field::Displacement,
            Self::MisesTop => Field::StressTop,
            Self::MisesMiddle => Field::StressMiddle,
            Self::MisesBottom => Field::StressBottom,
            Self::Energy => Field::Energy,
            Self::Mises => Field::Stress,
            Self::EnergyDensity => Field::EnergyPerVolume,
        }
    }
}

impl Snapshot {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        // A name without a known extension is rejected before a model is simulated.
        let is_png = match self.out.as_deref().map(Path::extension) {
            None => false,
            Some(Some(ending)) if ending.eq_ignore_ascii_case("svg") => false,
            Some(Some(ending)) if ending.eq_ignore_ascii_case("png") => true,
            Some(_) if self.animate.is_some() && self.is_gif() => false,
            Some(_) => {
                let message =
                    "the name of the picture must end in .svg or .png, that of an animation in .png or .gif";
                return Err(Failure::request(message));
            }
        };
        let wrong = |message: String| Err(Failure::request(message));
        if self.animate.is_some() && self.out.is_some() && !is_png && !self.is_gif() {
            return wrong("an animation is a PNG or GIF file: its name must end in .png or .gif".to_owned());
        }
        if let Some(duration) = self.animate.filter(|duration| !(0.1..=MAX_SECONDS).contains(duration)) {
            return wrong(format!("`--animate {duration}` must be from 0.1 to {MAX_SECONDS} seconds"));
        }
        if let Some(time) = self.at.iter().find(|time| !time.is_finite()) {
            return Err(Failure::request(format!("`--at {time}` is not a valid time")));
        }
        if self.what.is_dir() {
            if self.initial || !self.set.is_empty() {
                let message = format!("`{}` is a folder of results", self.what.display());
                return Err(Failure::request(format!("{message}; --initial and --set need a model")));
            }
            self.of_folder(&self.what, is_png)?;
            warn_of_incomplete(&self.what);
            return Ok(Exit::Done);
        }
        let folder = Path::new("out").join(self.what.file_stem().unwrap_or_default());
        if self.initial {
            let InitialScene { title, scene, motion, .. } =
                InitialScene::of(&self.what, &self.set, self.quiet)?;
            let motion = Motion::from_bytes(&motion).map_err(|error| Failure::new(Exit::Failed, &error))?;
            let none = RecordedForces::default();
            return self.draw((&scene, &motion, &title), none, (&folder, is_png)).map(|()| Exit::Done);
        }
        refuse_what_does_not_move(&self.what, &self.set)?;
        // A failed run has results up to the failure; one that could not start has none to be drawn.
        match Run::of_model(&self.what, &self.set, &folder, self.quiet).run() {
            Ok(exit) => self.of_folder(&folder, is_png).map(|()| exit),
            Err(failure) if failure.exit == Exit::Failed && folder.join("motion.bin").is_file() => {
                self.of_folder(&folder, is_png)?;
                Err(failure)
            }
            Err(failure) => Err(failure),
        }
    }

    fn of_folder(&self, folder: &Path, is_png: bool) -> Result<(), Failure> {
        let foreign = |error: FolderError| Failure::new(Exit::BadModel, &error);
        if ResultFolder::holds_modes(folder) {
            if self.colour.is_some() {
                let message =
                    "shapes of natural modes have no magnitude: `--colour` needs results of `lissom run`";
                return Err(Failure::request(message));
            }
            return self.of_modes(&ResultFolder::recorded_modes(folder).map_err(foreign)?, folder, is_png);
        }
        if self.mode.is_some() {
            let message =
                format!("`{}` contains no natural modes, which `--mode` requires", folder.display());
            return Err(Failure::request(message));
        }
        let run = ResultFolder::recorded(folder).map_err(foreign)?;
        if self.colour.is_some_and(|colour| !colour.field().is_in(&run.scene)) {
            let message = "`--colour` applies to shells of one layer and to solids: the model has none with this quantity";
            return Err(Failure::request(message));
        }
        let forces =
            if self.forces { RecordedForces::of(&run.scene, &run.record) } else { RecordedForces::default() };
        if self.forces && forces.most() == 0.0 {
            let message = "no force is recorded: add outputs of kind `reaction` or `spring` to the model";
            return Err(Failure::request(message));
        }
        self.draw((&run.scene, &run.motion, &run.title), forces, (folder, is_png))
    }

    /// The first shapes side by side, or one mode over its period.
    fn of_modes(&self, modes: &RecordedModes, folder: &Path, is_png: bool) -> Result<(), Failure> {
        let labels = modes.labels();
        let Some(number) = self.mode.map(|number| number as usize) else {
            if self.strip.is_some() || self.animate.is_some() || !self.at.is_empty() {
                let message = "for natural modes `--at`, `--strip` and `--animate` draw a single one: choose it with `--mode N`";
                return Err(Failure::request(message));
            }
            let motion = modes.shapes(MAX_SHAPES);
            let picture = Picture { times: motion.times().to_vec(), labels, ..self.picture() };
            return self.write(&picture, (&modes.scene, &motion, &modes.title), (folder, is_png));
        };
        let shares: Vec<f64> = match (self.pictures(), self.strip.unwrap_or(1)) {
            // The first picture follows the last.
            (Some(count), _) => (0..count).map(|k| k as f64 / count as f64).collect(),
            (None, _) if !self.at.is_empty() => self.at.clone(),
            (None, count) => (0..count).map(|k| k as f64 / count.max(2).saturating_sub(1) as f64).collect(),
        };
        let mut ascending = shares.clone();
        ascending.sort_by(f64::total_cmp);
        let (Some(motion), Some(label)) = (modes.oscillation(number, &ascending), labels.get(number - 1))
        else {
            let message =
                format!("there is no mode {number}: `{}` contains {}", folder.display(), modes.count());
            return Err(Failure::request(message));
        };
        let below = |share: &f64| format!("mode {label}, {share:.3} of its period");
        let labels = shares.iter().map(below).collect();
        let picture = Picture { times: shares, labels, ..self.picture() };
        self.write(&picture, (&modes.scene, &motion, &modes.title), (folder, is_png))
    }

    /// Whether the name of the picture ends in .gif.
    fn is_gif(&self) -> bool {
        let ending = self.out.as_deref().and_then(Path::extension);
        ending.is_some_and(|ending| ending.eq_ignore_ascii_case("gif"))
    }

    /// Number of pictures of an animation.
    fn pictures(&self) -> Option<usize> {
        self.animate.map(|duration| (duration * PICTURES_PER_SECOND).round() as usize)
    }

    /// Without instants.
    fn picture(&self) -> Picture {
        let view = match self.view {
            From::Chosen => View::Chosen,
            From::Oblique => View::Oblique,
            From::Front => View::Front,
            From::Side => View::Side,
            From::Top => View::Top,
        };
        Picture { view, paths: self.paths, ..Picture::default() }
    }

    fn draw(
        &self,
        (scene, motion, title): (&Scene, &Motion, &str),
        forces: RecordedForces,
        target: (&Path, bool),
    ) -> Result<(), Failure> {
        let times = if self.at.is_empty() {
            let count = self.pictures().unwrap_or(self.strip.unwrap_or(1) as usize);
            instants(motion, count).map_err(|error| Failure::new(Exit::BadModel, &error))?
        } else {
            self.at.clone()
        };
        let field = self.colour.map(Colour::field);
        self.write(&Picture { times, forces, field, ..self.picture() }, (scene, motion, title), target)
    }

    fn write(
        &self,
        picture: &Picture,
        (scene, motion, title): (&Scene, &Motion, &str),
        (folder, is_png): (&Path, bool),
    ) -> Result<(), Failure> {
        let wrong = |error| Failure::new(Exit::BadModel, &error);
        let failed = |error: DrawingError| Failure::new(Exit::Failed, &PictureError::from(error));
        let bytes = if self.animate.is_some() {
            let format = if self.is_gif() { Format::Gif } else { Format::Apng };
            picture.moving((scene, motion, title), (format, 1.0 / PICTURES_PER_SECOND)).map_err(wrong)?
        } else {
            let drawing = picture.draw(scene, motion, title).map_err(wrong)?;
            if is_png { drawing.png().map_err(failed)? } else { drawing.svg().map_err(failed)?.into_bytes() }
        };
        let unwritable = |error| Failure::new(Exit::Failed, &error);
        let target = if let Some(file) = &self.out {
            file.clone()
        } else {
            files::create_folder(folder).map_err(unwritable)?;
            folder.join(if self.animate.is_some() { "snapshot.png" } else { "snapshot.svg" })
        };
        lissom::protect_results(folder);
        files::write(&target, &bytes).map_err(unwritable)?;
        if !self.quiet {
            terminal::print(&format!("{}\n", target.display()));
        }
        Ok(())
    }
}
