//! The pictures of examples in the manual, made anew by `cargo xtask pictures`.

use std::fmt::{Display, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use lissom::analyses::campbell::{CampbellError, CampbellRequest, Variation, campbell};
use lissom::motion::{Motion, MotionRecorder};
use lissom::pictures::picture::{Picture, PictureError, View, instants};
use lissom::start::lower;
use lissom::{FileError, FolderError, Model, ResultFolder};
use lissom_model::files;
use lissom_model::output::{DrawingError, Format};
use lissom_model::scene::Scene;

use crate::verify;

/// Instants of a picture.
enum Instants {
    /// These [s].
    At(&'static [f64]),
    /// These [s], of a model that travels in a plane, seen obliquely.
    Oblique(&'static [f64]),
    /// So many at equal distances.
    Strip(usize),
    /// So many, one after the other.
    Moving(usize),
}

use Instants::{At, Moving, Oblique, Strip};

/// Names of pictures in docs/images, examples, and their instants.
const PICTURES: &[(&str, &str, Instants)] = &[
    ("belt-drive", "belt-drive", At(&[0.2])),
    ("boom", "shells/boom", At(&[0.3, 0.6, 1.0])),
    ("bridge-crossing", "bridge-crossing", Strip(4)),
    ("car", "car", Oblique(&[2.4])),
    ("cam-follower", "cam-follower", At(&[0.02, 0.05])),
    ("computed-torque", "computed-torque", Strip(4)),
    ("conveyor", "contacts/conveyor", At(&[1.2])),
    ("crane-slack-cable", "crane-slack-cable", At(&[0.0, 0.42, 0.6])),
    ("cushion", "shells/cushion", At(&[1.0])),
    ("delta-robot", "delta-robot", Strip(4)),
    ("deployable-mast", "deployable-mast", Strip(5)),
    ("double-wishbone", "double-wishbone", At(&[2.1])),
    ("excavator-arm", "excavator-arm", At(&[0.0, 2.0, 4.0])),
    ("geneva-drive", "geneva-drive", At(&[0.6, 0.78, 0.95])),
    ("leaf-spring", "shells/leaf-spring", At(&[0.0, 1.0])),
    ("mecanum-platform", "mecanum-platform", At(&[0.0, 2.0, 3.5])),
    ("oil-whirl", "oil-whirl", At(&[0.1])),
    ("roller-chain", "contacts/roller-chain", At(&[0.1])),
    ("rolling-disc", "rolling-disc", Strip(4)),
    ("satellite-latching-booms", "satellite-latching-booms", Strip(4)),
    ("slider-crank-3500rpm", "slider-crank-3500rpm", At(&[0.0, 0.002, 0.006, 0.01])),
    ("slider-crank-elastic", "slider-crank-elastic", Strip(4)),
    ("solar-panels", "shells/solar-panels", At(&[0.0, 1.8, 2.7, 6.0])),
    ("tracked-undercarriage", "contacts/tracked-undercarriage", At(&[0.3])),
    ("tip-crank", "tip-crank", At(&[0.0, 0.1, 0.2, 0.4])),
    ("tip-crank-moving", "tip-crank", Moving(25)),
    ("turning-chatter", "turning-chatter", At(&[0.5])),
    ("turbine-rotor", "turbine-rotor", At(&[0.0, 0.25, 0.5, 0.75])),
    ("walking-linkage", "walking-linkage", At(&[0.75])),
    ("wheelset", "wheelset", At(&[1.0])),
    ("wing-flutter", "wing-flutter", At(&[2.9, 2.92])),
];

/// Makes the bytes of a file.
type Make = fn() -> Result<Vec<u8>, PicturesError>;

/// Names and extensions of pictures of other models, and what makes them.
const OTHERS: &[(&str, &str, Make)] = &[
    ("campbell", "svg", campbell_diagram),
    ("first-model", "png", first_model),
    ("joints", "png", joints),
    ("modes", "png", modes),
    ("tyre", "svg", tyre),
];

/// The kinds of joints by rows, with the keys that they need.
const KINDS: [[(&str, &str); 5]; 3] = [
    [
        ("clamp", ""),
        ("spherical", ""),
        ("revolute", "axis = [0, 1, 0]"),
        ("universal", "axis = [0, 1, 0]\nsecond_axis = [0, 0, 1]"),
        ("constant_velocity", "axis = [1, 0, 0]\ntip_axis = [1, 0, 0]"),
    ],
    [
        ("prismatic", "axis = [1, 0, 0]"),
        ("cylindrical", "axis = [1, 0, 0]"),
        ("screw", "axis = [1, 0, 0]\nlead = 0.01"),
        ("planar", "axis = [0, 0, 1]"),
        ("point_in_plane", "axis = [0, 0, 1]"),
    ],
    [
        ("point_on_line", "axis = [0, 1, 0]"),
        ("inline", "axis = [0, 1, 0]"),
        ("parallel_axes", "axis = [0, 1, 0]"),
        ("perpendicular_axes", "axis = [0, 1, 0]\nsecond_axis = [0, 0, 1]"),
        ("distance", ""),
    ],
];

/// An overhung disc.
const ROTOR: &str = concat!(
    "lissom = 1\n[parameters]\nspeed = 10.0\n[initial]\nangular_velocity = [\"speed\", 0, 0]\n",
    include_str!("../../crates/lissom/tests/support/rotor.toml"),
    "stiffness = 2000\n[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"bearing\"\nrotation = \"speed*t\"\n",
    "[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-3\n"
);

/// The model that `lissom new` writes, and its instant [s].
const FIRST_MODEL: &str = include_str!("../../crates/lissom-cli/src/commands/templates/slider-crank.toml");
const FIRST_INSTANT: f64 = 2.7;

/// Number of natural modes in their picture.
const SHAPES: usize = 2;

/// Pixels of the files for each of the drawings'.
const SCALE: f64 = 1.0;
/// Time between moving pictures [s].
const DELAY: f64 = 0.1;

/// Why pictures are not made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PicturesError {
    #[error("`lissom {0}` failed")]
    Run(String),
    #[error("the joints cannot be drawn: {0}")]
    Joints(String),
    #[error(transparent)]
    Campbell(#[from] CampbellError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    #[error(transparent)]
    File(#[from] FileError),
}

fn images() -> PathBuf {
    verify::root().join("docs/images")
}

/// Makes all pictures, or those of these names.
pub(crate) fn pictures(names: &[String]) -> Result<(), PicturesError> {
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|known| known == name);
    for (name, example, instants) in PICTURES {
        if !is_wanted(name) {
            continue;
        }
        let folder = simulated(&format!("examples/{example}.toml"), example)?;
        let target = images().join(format!("{name}.png"));
        files::write(&target, &drawn(&folder, instants)?)?;
        println!("{}", target.display());
    }
    for (name, extension, make) in OTHERS {
        if is_wanted(name) {
            let target = images().join(format!("{name}.{extension}"));
            files::write(&target, &make()?)?;
            println!("{}", target.display());
        }
    }
    Ok(())
}

/// The picture of the model that `lissom new press` writes, as the bytes of a PNG file.
fn first_model() -> Result<Vec<u8>, PicturesError> {
    let model = "target/first-model.toml";
    files::write(&verify::root().join(model), FIRST_MODEL.replace("@title@", "press").as_bytes())?;
    drawn(&simulated(model, "first-model")?, &At(&[FIRST_INSTANT]))
}

/// The picture of the first natural modes of the tip crank, as the bytes of a PNG file.
fn modes() -> Result<Vec<u8>, PicturesError> {
    let (folder, count) = ("target/pictures/modes", SHAPES.to_string());
    run_program(&[
        "modes",
        "examples/tip-crank.toml",
        "--about",
        "undeformed",
        "--count",
        &count,
        "--out",
        folder,
    ])?;
    let found = ResultFolder::recorded_modes(&verify::root().join(folder))?;
    let motion = found.shapes(SHAPES);
    let picture = Picture {
        times: motion.times().to_vec(),
        view: View::Chosen,
        labels: found.labels(),
        ..Picture::default()
    };
    let drawing = picture.draw(&found.scene, &motion, &found.title)?;
    Ok(drawing.png_at(SCALE)?)
}

/// Two rods for each kind of joint, in rows that are level in an oblique view.
fn model_of_joints() -> String {
    let mut text = "lissom = 1\n[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1\n".to_owned();
    for (row, kinds) in KINDS.iter().enumerate() {
        for (column, (kind, keys)) in kinds.iter().enumerate() {
            let (x, z) = (0.36 * column as f64, 0.095 * column as f64 - 0.26 * row as f64);
            let reach = if *kind == "distance" { 0.1 } else { 0.065 };
            for (end, x) in [("base", x - reach), ("tip", x + reach)] {
                // Writing to a string cannot fail.
                let _ = write!(
                    text,
                    "[bodies.{kind}_{end}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{x}, 0, {z}]\n\
                     shape = {{ cylinder = [0.009, 0.13], axis = \"x\" }}\n"
                );
            }
            let at = if *kind == "distance" { String::new() } else { format!("at = [{x}, 0, {z}]\n") };
            let _ = write!(
                text,
                "[joints.{kind}]\nkind = \"{kind}\"\nbase = \"{kind}_base\"\ntip = \"{kind}_tip\"\n{at}{keys}\n"
            );
        }
    }
    text
}

/// The picture of the kinds of joints, as the bytes of a PNG file.
fn joints() -> Result<Vec<u8>, PicturesError> {
    let wrong = |error: &dyn Display| PicturesError::Joints(error.to_string());
    let model = Model::from_text("joints.toml", &model_of_joints());
    let document = model.document().map_err(|error| wrong(&error))?;
    let lowered = lower(&document).map_err(|error| wrong(&error))?;
    let mut motion = Vec::new();
    let mut recorder = MotionRecorder::new(&lowered, None, &mut motion);
    recorder.write_still(&lowered.state.kinematics).map_err(|error| wrong(&error))?;
    let motion = Motion::from_bytes(&motion).map_err(|error| wrong(&error))?;
    let picture = Picture {
        times: instants(&motion, 1)?,
        view: View::Oblique,
        labels: vec![String::new()],
        ..Picture::default()
    };
    let drawing = picture.draw(&Scene::of(&document, &lowered.placed()), &motion, "")?;
    Ok(drawing.png_at(SCALE)?)
}

/// The diagram of the overhung disc, as the bytes of an SVG file.
fn campbell_diagram() -> Result<Vec<u8>, PicturesError> {
    let vary = Variation { path: "parameters.speed".to_owned(), from: 5.0, to: 200.0, values: 27 };
    let request = CampbellRequest { vary, count: 4, shift: None, averaged: false, rays: vec![1, 2, 3] };
    let found = campbell(&Model::from_text("rotor.toml", ROTOR), &request)?;
    Ok(found.diagram("Overhung disc").and_then(|drawn| drawn.svg()).map_err(FolderError::from)?.into_bytes())
}

/// The curves of the tyre of the examples, as the bytes of an SVG file.
fn tyre() -> Result<Vec<u8>, PicturesError> {
    run_program(&["tyre", "examples/parts/passenger-car.tir", "--out", "target/pictures/tyre"])?;
    let path = verify::root().join("target/pictures/tyre/tyre.svg");
    Ok(files::read_text(&path)?.into_bytes())
}

/// Simulates a model into a folder of this name.
fn simulated(model: &str, name: &str) -> Result<PathBuf, PicturesError> {
    let folder = format!("target/pictures/{name}");
    run_program(&["run", "--quiet", model, "--out", &folder])?;
    Ok(verify::root().join(folder))
}

/// Runs the program in the folder of the repository.
fn run_program(arguments: &[&str]) -> Result<(), PicturesError> {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(verify::root());
    command.args(["run", "--release", "--quiet", "-p", "lissom-cli", "--"]).args(arguments);
    let succeeded = command.status().is_ok_and(|status| status.success());
    succeeded.then_some(()).ok_or_else(|| PicturesError::Run(arguments.join(" ")))
}

/// A picture of the results in a folder, as the bytes of a PNG file.
fn drawn(folder: &Path, chosen: &Instants) -> Result<Vec<u8>, PicturesError> {
    let found = ResultFolder::recorded(folder)?;
    let times = match *chosen {
        At(times) | Oblique(times) => times.to_vec(),
        Strip(count) | Moving(count) => instants(&found.motion, count)?,
    };
    let view = if matches!(chosen, Oblique(_)) { View::Oblique } else { View::Chosen };
    let picture = Picture { times, view, ..Picture::default() };
    if matches!(chosen, Moving(_)) {
        let model = (&found.scene, &found.motion, found.title.as_str());
        return Ok(picture.moving(model, (Format::Apng, DELAY))?);
    }
    let drawing = picture.draw(&found.scene, &found.motion, &found.title)?;
    // The manual has no need of the double resolution of others.
    Ok(drawing.png_at(SCALE)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pictures that `cargo xtask figures` and `cargo xtask bench --sizes` make.
    const FIGURES: [&str; 2] = ["scale.svg", "tip-crank.svg"];

    #[test]
    fn every_picture_of_the_manual_is_made_by_a_command_and_shown() {
        let docs = verify::root().join("docs");
        let viewing = docs.join("viewing");
        let pages = files::entries(&docs).chain(files::entries(&viewing));
        let pages = pages.chain([verify::root().join("README.md")]);
        let pages = pages.filter(|page| page.extension().is_some_and(|ending| ending == "md"));
        let text: String = pages.map(|page| files::read_text(&page).unwrap()).collect();
        for file in files::entries(&images()) {
            let name = file.file_name().unwrap().to_string_lossy().into_owned();
            let is_made = PICTURES.iter().any(|(known, ..)| name == format!("{known}.png"))
                || OTHERS.iter().any(|(known, extension, _)| name == format!("{known}.{extension}"));
            assert!(is_made || FIGURES.contains(&&*name), "no command makes {name}");
            assert!(text.contains(&format!("images/{name}")), "no page shows {name}");
        }
        for (name, example, _) in PICTURES {
            assert!(images().join(format!("{name}.png")).is_file(), "{name}");
            assert!(verify::root().join(format!("examples/{example}.toml")).is_file(), "{example}");
        }
        for (name, extension, _) in OTHERS {
            assert!(images().join(format!("{name}.{extension}")).is_file(), "{name}");
        }
        joints().unwrap();
    }
}
