//! Round-off of reactions at tiny steps.

use lissom::analyses::study::roundoff::{Request, study};

use super::fragment::{Fragment, overrides, study_command, texts};
use super::numbers::one;
use super::{BookError, Studio};

/// Reaction of the planar pendulum.
pub(super) fn pendulum(studio: &Studio) -> Result<Fragment, BookError> {
    one_model(studio, "pendulum", "force", &[], "Pendulum with a massless hinged arm")
}

/// Reaction of a spatial mechanism of rigid bodies and a beam.
pub(super) fn energy(studio: &Studio) -> Result<Fragment, BookError> {
    let set = [("analysis.scheme", "radau-iia")];
    one_model(studio, "energy", "shoulder", &set, "Rigid and flexible chain")
}

fn one_model(
    studio: &Studio,
    example: &str,
    output: &str,
    set: &[(&str, &str)],
    title: &str,
) -> Result<Fragment, BookError> {
    let steps = ["1e-4", "1e-5", "1e-6", "1e-7", "1e-8"];
    let request = Request { steps: texts(&steps), output: output.to_owned() };
    let set = overrides(set);
    let mut fragment = Fragment::default();
    let options = [("steps", steps.join(",")), ("output", output.to_owned())];
    let options: Vec<_> = options.iter().map(|(option, value)| (*option, value.as_str())).collect();
    fragment.commands(&[study_command("roundoff", example, &options, &set)]);
    let table = study(&studio.example(example)?.with_overrides(&set), &request, &studio.watch())?;
    let rows = table.rows.iter().map(|row| {
        let mut line = vec![row.step.clone()];
        match &row.outcome {
            Ok(measured) => {
                let doubt = if measured.is_doubtful() { "≈ " } else { "" };
                line.extend([format!("{doubt}{}", one(measured.error)), one(measured.noise)]);
            }
            Err(error) => line.extend([format!("failed: {error}"), String::new()]),
        }
        line
    });
    fragment.table(&["h [s]", "error", "noise"], &rows.collect::<Vec<_>>());
    fragment.figure(
        &format!("roundoff-{example}"),
        &format!("Error and noise of `{output}` over the step size"),
        &table.figure(&format!("{title}: {output}")),
    )?;
    Ok(fragment)
}
