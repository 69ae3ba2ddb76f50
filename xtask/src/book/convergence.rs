//! How fast the schemes converge on the tip crank: figure 2.4 of [Epple 2008].

use lissom::analyses::study::convergence::{Request, Row, Table, study};

use super::fragment::{Fragment, overrides, study_command, texts};
use super::numbers::two;
use super::{BookError, Studio};

const EXAMPLE: &str = "tip-crank";
/// Down to the smallest of the source's figure [s].
const STEPS: [&str; 9] = ["4e-3", "2e-3", "1e-3", "5e-4", "2e-4", "1e-4", "5e-5", "2e-5", "1e-5"];
/// Reference of order nine, three decades below the smallest error of the source's figure, whose reference is Radau IIA of two stages at 5 µs.
const REFERENCE: (&str, &str) = ("radau-iia-9", "1e-5");
/// A drive without a jump of the acceleration at the start.
const SMOOTH: (&str, &str) = ("joints.drive.rotation", "\"0.12*sin(pi*t/0.2)^6\"");

/// The three schemes of the source to 0.1 s.
pub(super) fn tip_crank(studio: &Studio) -> Result<Fragment, BookError> {
    all_schemes(studio, &[("analysis.end", "0.1")], "convergence-tip-crank")
}

/// All schemes with a drive that starts smoothly.
pub(super) fn tip_crank_smooth(studio: &Studio) -> Result<Fragment, BookError> {
    all_schemes(studio, &[("analysis.end", "0.1"), SMOOTH], "convergence-tip-crank-smooth")
}

/// The three schemes of the source to 0.4 s, through the buckling and back.
pub(super) fn tip_crank_long(studio: &Studio) -> Result<Fragment, BookError> {
    all_schemes(studio, &[("analysis.end", "0.4")], "convergence-tip-crank-long")
}

fn all_schemes(studio: &Studio, set: &[(&str, &str)], name: &str) -> Result<Fragment, BookError> {
    let schemes = ["radau-iia", "hht(-0.3)", "energy-decaying", "energy-decaying(0.5)"];
    let end = set[0].1;
    let mut fragment = Fragment::default();
    let (command, table) = run(studio, &schemes, "midspan.u2", set)?;
    fragment.commands(&[command]);
    let mut heading = vec!["h [s]"];
    heading.extend(schemes.iter().flat_map(|scheme| [scheme, "order"]));
    let rows = STEPS.iter().map(|step| {
        let mut line = vec![(*step).to_owned()];
        for scheme in schemes {
            let (error, order) = error_and_order(&table, scheme, step);
            line.extend([error, order]);
        }
        line
    });
    fragment.table(&heading, &rows.collect::<Vec<_>>());
    fragment.figure(
        name,
        &format!("Relative error of the lateral displacement at mid-span up to {end} s"),
        &table.figure(&format!("Beam actuated by a tip crank, u2 at mid-span to {end} s")),
    )?;
    Ok(fragment)
}

/// The three components of the displacement, separately, at the start of the drive of the model.
pub(super) fn components(studio: &Studio) -> Result<Fragment, BookError> {
    each_component(studio, &[])
}

/// The three components of the displacement, separately, with a drive that starts smoothly.
pub(super) fn smooth_start(studio: &Studio) -> Result<Fragment, BookError> {
    each_component(studio, &[SMOOTH])
}

fn each_component(studio: &Studio, set: &[(&str, &str)]) -> Result<Fragment, BookError> {
    let schemes = ["radau-iia", "hht(-0.3)"];
    let components = ["u1", "u2", "u3"];
    let set = [&[("analysis.end", "0.1")], set].concat();
    let (mut commands, mut tables) = (Vec::new(), Vec::new());
    for component in components {
        let (command, table) = run(studio, &schemes, &format!("midspan.{component}"), &set)?;
        commands.push(command);
        tables.push(table);
    }
    let mut fragment = Fragment::default();
    fragment.commands(&commands);
    let mut heading = vec!["h [s]".to_owned()];
    for scheme in schemes {
        heading.extend(components.map(|component| format!("{scheme}: {component}")));
    }
    let heading: Vec<&str> = heading.iter().map(String::as_str).collect();
    let rows = STEPS.iter().map(|step| {
        let mut line = vec![(*step).to_owned()];
        for scheme in schemes {
            line.extend(tables.iter().map(|table| {
                let (error, order) = error_and_order(table, scheme, step);
                if order.is_empty() { error } else { format!("{error} ({order})") }
            }));
        }
        line
    });
    fragment.table(&heading, &rows.collect::<Vec<_>>());
    Ok(fragment)
}

fn run(
    studio: &Studio,
    schemes: &[&str],
    output: &str,
    set: &[(&str, &str)],
) -> Result<(String, Table), BookError> {
    let request = Request {
        schemes: texts(schemes),
        steps: texts(&STEPS),
        reference: (REFERENCE.0.to_owned(), REFERENCE.1.to_owned()),
        output: output.to_owned(),
    };
    let set = overrides(set);
    let options = [
        ("schemes", request.schemes.join(",")),
        ("steps", request.steps.join(",")),
        ("reference", format!("{}:{}", REFERENCE.0, REFERENCE.1)),
        ("output", output.to_owned()),
    ];
    let options: Vec<_> = options.iter().map(|(option, value)| (*option, value.as_str())).collect();
    let command = study_command("convergence", EXAMPLE, &options, &set);
    Ok((command, study(&studio.example(EXAMPLE)?.with_overrides(&set), &request, &studio.watch())?))
}

fn error_and_order(table: &Table, scheme: &str, step: &str) -> (String, String) {
    let wanted = |row: &&Row| row.scheme == scheme && row.step == step;
    let Some(row) = table.rows.iter().find(wanted) else { return (String::new(), String::new()) };
    let error = row.outcome.as_ref().map_or_else(|error| format!("failed: {error}"), |&error| two(error));
    (error, row.order.map_or_else(String::new, |order| format!("{order:.1}")))
}
