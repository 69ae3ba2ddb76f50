//! Round-off of reactions at tiny steps: their error after a few steps, and their noise from step to step.

use lissom::Model;
use lissom_model::output::LogFigure;

use super::fragment::{Fragment, overrides};
use super::numbers::one;
use super::{BookError, Studio};

/// Step sizes [s].
const SIZES: [&str; 5] = ["1e-4", "1e-5", "1e-6", "1e-7", "1e-8"];
/// Number of steps for every step size.
const STEPS: usize = 50;
/// Number of last steps whose noise is measured.
const NOISY_STEPS: usize = 20;

/// Values of all components, instant by instant.
type History = Vec<Vec<f64>>;

/// Result of a step size.
#[derive(Clone, Copy, Debug)]
struct Measured {
    /// Difference after [`STEPS`] steps from the same time reached in eight times as many, relative to the magnitude
    /// of the output there [-].
    error: f64,
    /// Error in four times as many steps: the accuracy of the reference [-].
    doubt: f64,
    /// Largest second difference over the last [`NOISY_STEPS`] steps, relative to the largest magnitude of the output
    /// there [-]. It decreases as h² if the output is smooth; the remainder is round-off.
    noise: f64,
}

/// Reaction of the planar pendulum.
pub(super) fn pendulum(studio: &Studio) -> Result<Fragment, BookError> {
    one_model(studio, "pendulum", "force", "generalized-alpha", "Pendulum with a massless hinged arm")
}

/// Reaction of a spatial mechanism of rigid bodies and a beam.
pub(super) fn energy(studio: &Studio) -> Result<Fragment, BookError> {
    one_model(studio, "energy", "shoulder", "radau-iia", "Rigid and flexible chain")
}

fn one_model(
    studio: &Studio,
    example: &'static str,
    output: &str,
    scheme: &str,
    title: &str,
) -> Result<Fragment, BookError> {
    let model = studio.example(example)?;
    let measured: Vec<(f64, Measured)> = SIZES
        .iter()
        .map(|step| {
            let size = step.parse().unwrap_or(f64::NAN);
            let history = |finer| history(&model, example, (output, scheme), size, finer);
            Ok((size, measure(&history(1)?, &history(8)?, &history(4)?)))
        })
        .collect::<Result<_, BookError>>()?;
    let rows = SIZES.iter().zip(&measured).map(|(step, (_, Measured { error, doubt, noise }))| {
        // The reference is then no more accurate than the compared run.
        let mark = if *doubt > 0.5 * error { "≈ " } else { "" };
        vec![(*step).to_owned(), format!("{mark}{}", one(*error)), one(*noise)]
    });
    let mut fragment = Fragment::default();
    fragment.table(&["h [s]", "error", "noise"], &rows.collect::<Vec<_>>());
    let curve = |name: &str, pick: fn(&Measured) -> f64| {
        (name.to_owned(), measured.iter().map(|(size, own)| (*size, pick(own))).collect())
    };
    let figure = LogFigure {
        name: "roundoff".to_owned(),
        title: format!("{title}: {output}"),
        x_label: "step size [s]".to_owned(),
        y_label: "relative error and noise [-]".to_owned(),
        curves: vec![curve("error", |own| own.error), curve("noise", |own| own.noise)],
        guides: Vec::new(),
    };
    let caption = format!("Error and noise of `{output}` over the step size");
    fragment.figure(&format!("roundoff-{example}"), &caption, &figure)?;
    Ok(fragment)
}

/// The output at the start and after every one of [`STEPS`] steps of this size, each of which is divided into `finer` ones.
fn history(
    model: &Model,
    example: &'static str,
    (output, scheme): (&str, &str),
    size: f64,
    finer: usize,
) -> Result<History, BookError> {
    let number = |value: f64| format!("{value:e}");
    let set = overrides(&[
        ("analysis.scheme", scheme),
        ("analysis.step", &number(size / finer as f64)),
        ("analysis.end", &number(size * STEPS as f64)),
        ("analysis.output_every", &finer.to_string()),
        // Below round-off.
        ("analysis.tolerance", "1e-12"),
    ]);
    let mut session = model.with_overrides(&set).session().map_err(BookError::run(example))?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Err(BookError::run(example)(error));
    }
    let columns = record.columns.iter().zip(&record.values);
    let own: Vec<_> = columns.filter(|(column, _)| column.output == output).map(|(_, own)| own).collect();
    Ok((0..record.times.len()).map(|index| own.iter().map(|own| own[index]).collect()).collect())
}

fn measure(own: &History, reference: &History, other: &History) -> Measured {
    let norm = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
    let end = |history: &History| history[history.len() - 1].clone();
    let size = norm(&end(reference));
    let last = &own[own.len() - NOISY_STEPS - 1..];
    let second = |three: &[Vec<f64>]| {
        norm(&difference(&difference(&three[2], &three[1]), &difference(&three[1], &three[0])))
    };
    let largest = last.iter().map(|values| norm(values)).fold(0.0, f64::max);
    Measured {
        error: norm(&difference(&end(own), &end(reference))) / size,
        doubt: norm(&difference(&end(other), &end(reference))) / size,
        noise: last.windows(3).map(second).fold(0.0, f64::max) / largest,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_the_second_difference_and_slopes_are_none() {
        let line = |jump: f64| -> History {
            (0..=50).map(|i| vec![3.0 + if i == 40 { jump } else { 0.0 }, 4.0]).collect()
        };
        let measured = measure(&line(0.0), &line(0.0), &line(0.0));
        assert_eq!((measured.error, measured.noise), (0.0, 0.0));
        let measured = measure(&line(1e-6), &line(0.0), &line(0.0));
        // The value in the middle counts twice; the magnitude is 5.
        assert!((measured.noise - 2e-6 / 5.0).abs() < 1e-12, "{}", measured.noise);
        let slope: History = (0..=50).map(|i| vec![f64::from(i)]).collect();
        assert_eq!(measure(&slope, &slope, &slope).noise, 0.0);
    }

    #[test]
    fn tiny_steps_leave_reactions_smooth() {
        let model = Studio::silent().example("pendulum").unwrap();
        let at = |size| {
            let history =
                |finer| history(&model, "pendulum", ("force", "generalized-alpha"), size, finer).unwrap();
            measure(&history(1), &history(8), &history(4))
        };
        // At 1 ms the output bends: omega^2 h^2 of about 10 rad^2/s^2.
        let coarse = at(1e-3);
        assert!(coarse.noise > 1e-6 && coarse.noise < 1e-3, "{coarse:?}");
        assert!(coarse.error > 1e-7 && coarse.doubt <= 0.5 * coarse.error, "{coarse:?}");
        let fine = at(1e-7);
        assert!(fine.noise < 1e-6 && fine.error < 1e-6, "{fine:?}");
    }

    #[test]
    fn reactions_keep_their_digits_however_small_the_step() {
        let studio = Studio::silent();
        for (example, output, scheme, sizes, bound) in [
            ("pendulum", "force", "generalized-alpha", &[1e-5, 1e-6, 1e-7, 1e-8][..], 1e-8),
            // Two rigid bodies and a beam in space. At 1e-5 s the error is the scheme's.
            ("energy", "shoulder", "radau-iia", &[1e-5], 2e-6),
            ("energy", "shoulder", "radau-iia", &[1e-6, 1e-7, 1e-8], 1e-8),
        ] {
            let model = studio.example(example).unwrap();
            for &size in sizes {
                let history = |finer| history(&model, example, (output, scheme), size, finer).unwrap();
                let measured = measure(&history(1), &history(8), &history(4));
                assert!(measured.error < bound, "{example} {size:e}: {measured:?}");
            }
        }
    }
}
