//! `cargo xtask precision`: work and error of adaptive steps. Runs scenes and model files without records, with several schemes and
//! tolerances, and prints steps, iterations, processor time and the error of the poses at the end. Independent of mechanics.

use lissom::core::kinematics::Kinematics;
use lissom::core::settings::Unwatched;
use lissom::core::simulation::Simulation;
use lissom::start::lower;
use lissom::{Model, Override};

use crate::bench::processor_time;
use crate::scenes;

/// Tolerance of the run that the others are compared with.
const FINE: f64 = 1e-10;
/// Runs of which the fastest counts.
const REPETITIONS: usize = 3;

/// Runs to perform.
#[derive(clap::Args)]
pub(crate) struct PrecisionArguments {
    /// Names of scenes, or paths of model files
    #[arg(required = true)]
    models: Vec<String>,
    /// Schemes, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "radau-iia,radau-iia-5")]
    schemes: Vec<String>,
    /// Relative tolerances, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "1e-3,1e-4,1e-5,1e-6")]
    tolerances: Vec<f64>,
    /// Scheme of the reference
    #[arg(long, default_value = "radau-iia-5")]
    reference: String,
    /// Last time of every model, in place of its own [s]
    #[arg(long)]
    end: Option<f64>,
}

/// Result of a run.
struct Ran {
    steps: usize,
    rejected: usize,
    iterations: usize,
    tangents: usize,
    seconds: f64,
    end: Kinematics,
}

/// Prints a table for each model. Whether all references were found.
pub(crate) fn precision(arguments: &PrecisionArguments) -> bool {
    let mut is_complete = true;
    for name in &arguments.models {
        let model = scenes::scene(name).map(|scene| Model::from_text(&scene.name, &scene.text));
        let Some(model) = model.or_else(|| Model::read(std::path::Path::new(name)).ok()) else {
            println!("there is no scene or model file `{name}`");
            is_complete = false;
            continue;
        };
        let model = without_steps(&model);
        let fine = run(&model, &arguments.reference, FINE, arguments.end);
        if let Err(error) = &fine {
            println!("`{name}` has no reference: {error}");
            is_complete = false;
        }
        let title = std::path::Path::new(name).file_stem().map_or(name.into(), |stem| stem.to_string_lossy());
        println!(
            "\n| {title} | τ | steps | rejected | iterations | tangents | error | ms |\n\
             |---|---|---|---|---|---|---|---|"
        );
        for scheme in &arguments.schemes {
            for &tolerance in &arguments.tolerances {
                let runs = (0..REPETITIONS).map_while(|_| run(&model, scheme, tolerance, arguments.end).ok());
                let best = runs.min_by(|one, other| one.seconds.total_cmp(&other.seconds));
                let Some(ran) = best else {
                    println!("| {scheme} | {tolerance:.0e} | – |");
                    continue;
                };
                let error = fine.as_ref().map_or(f64::NAN, |fine| distance(&ran.end, &fine.end));
                println!(
                    "| {scheme} | {tolerance:.0e} | {} | {} | {} | {} | {error:.1e} | {:.2} |",
                    ran.steps,
                    ran.rejected,
                    ran.iterations,
                    ran.tangents,
                    1e3 * ran.seconds
                );
            }
        }
    }
    is_complete
}

fn run(model: &Model, scheme: &str, tolerance: f64, end: Option<f64>) -> Result<Ran, String> {
    let set = |path: &str, value: String| -> Override { (format!("analysis.{path}"), value) };
    let mut overrides =
        vec![set("scheme", format!("\"{scheme}\"")), set("relative_tolerance", format!("{tolerance:e}"))];
    overrides.extend(end.map(|end| set("end", format!("{end:e}"))));
    let document = model.with_overrides(&overrides).document().map_err(|report| report.render(false))?;
    let end = document.analysis.end;
    let lowered = lower(&document).map_err(|report| report.render(false))?;
    let mut simulation = Simulation::new(lowered.system, lowered.state, lowered.settings)
        .map_err(|error| error.to_string())?;
    let before = processor_time();
    while simulation.state().kinematics.time < end {
        simulation.step_watched(end, &mut Unwatched).map_err(|error| error.to_string())?;
    }
    let busy = processor_time().zip(before).map_or(0.0, |(now, then)| now.saturating_sub(then).as_secs_f64());
    let totals = simulation.totals();
    Ok(Ran {
        steps: totals.steps,
        rejected: totals.rejected_steps,
        iterations: totals.newton_iterations,
        tangents: totals.factorizations,
        seconds: busy,
        end: simulation.state().kinematics.clone(),
    })
}

/// The model without settings of a scheme and of fixed steps, as far as it has them.
fn without_steps(model: &Model) -> Model {
    let keys = [
        "spectral_radius",
        "alpha",
        "step",
        "tolerance",
        "relative_tolerance",
        "output_step",
        "output_every",
    ];
    let paths = keys.map(|key| format!("analysis.{key}"));
    let is_known = |path: &&String| model.without(path).document().is_ok();
    paths.iter().filter(is_known).fold(model.clone(), |model, path| model.without(path))
}

/// The largest difference of positions [m] and rotations [rad].
fn distance(one: &Kinematics, other: &Kinematics) -> f64 {
    let nodes = one.nodes.iter().zip(&other.nodes);
    nodes.fold(0.0, |most: f64, (a, b)| {
        let shift = (a.frame.position - b.frame.position).norm();
        let [p, q] = [a, b].map(|node| node.frame.rotation.quaternion());
        let chord = |sign: f64| p.iter().zip(&q).map(|(p, q)| (p - sign * q).powi(2)).sum::<f64>();
        most.max(shift).max(2.0 * chord(1.0).min(chord(-1.0)).sqrt())
    })
}
