//! Condition numbers of the pendulum beside the published ones, and of the tip crank. Refers to the models only by name.

use lissom::Override;
use lissom::analyses::study::conditioning::{Measured, Request, Row, SCALINGS, Table, study};

use super::fragment::{Fragment, overrides, study_command, texts};
use super::numbers::two;
use super::published::{self, MASSES, STEPS};
use super::{BookError, Studio};

/// The mass of the pendulum's point, as a path into its model.
const MASS: &str = "point_masses.bob.mass";
/// Step sizes for the tip crank [s].
const CRANK_STEPS: [&str; 6] = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7"];

/// Table 2.1 of the source.
pub(super) fn steps(studio: &Studio) -> Result<Fragment, BookError> {
    let request = of_steps(&STEPS.map(|(step, _)| step));
    let mut fragment = Fragment::default();
    let table = run(studio, "pendulum", (&request, &[]), &mut fragment)?;
    let heading = [
        "h [s]",
        "none: table 2.1",
        "none: Lissom",
        "s = 1: table 2.1",
        "s = 1: Lissom",
        "s of (2.6): table 2.1",
        "s of (2.6): Lissom",
        "equilibrated: Lissom",
    ];
    let rows = STEPS.iter().zip(&table.rows).map(|((step, published), row)| {
        let [none, unit, physical, equilibrated] = cells(row);
        let [p, q, r] = published.map(str::to_owned);
        vec![(*step).to_owned(), p, none, q, unit, r, physical, equilibrated]
    });
    fragment.table(&heading, &rows.collect::<Vec<_>>());
    fragment.figure(
        "conditioning-steps",
        "Condition numbers of the pendulum over the step size",
        &table.figure("Pendulum of tables 2.1 and 2.2"),
    )?;
    Ok(fragment)
}

/// Table 2.2 of the source, and our figures at the printed mass and at ten times it.
pub(super) fn mass(studio: &Studio) -> Result<Fragment, BookError> {
    let mut masses = texts(&MASSES.map(|(mass, _)| mass));
    masses.push("1e5".to_owned());
    let request = Request { steps: texts(&["1e-2"]), vary: Some((MASS.to_owned(), masses)) };
    let mut fragment = Fragment::default();
    let table = run(studio, "pendulum", (&request, &[]), &mut fragment)?;
    let heading = [
        "mass in table 2.2 [kg]",
        "none: table 2.2",
        "none: Lissom, that mass",
        "none: Lissom, ten times it",
        "s = 1: table 2.2",
        "s = 1: Lissom, that mass",
        "s = 1: Lissom, ten times it",
        "s of (2.6): table 2.2",
        "s of (2.6): Lissom",
        "equilibrated: Lissom",
    ];
    let rows = MASSES.iter().zip(table.rows.windows(2)).map(|((mass, published), pair)| {
        let [none, unit, physical, equilibrated] = cells(&pair[0]);
        let [none_ten, unit_ten, ..] = cells(&pair[1]);
        let [p, q, r] = published.map(str::to_owned);
        vec![(*mass).to_owned(), p, none, none_ten, q, unit, unit_ten, r, physical, equilibrated]
    });
    fragment.table(&heading, &rows.collect::<Vec<_>>());
    fragment.figure(
        "conditioning-mass",
        "Condition numbers of the pendulum over its mass",
        &table.figure("Pendulum of tables 2.1 and 2.2, h = 0.01 s"),
    )?;
    Ok(fragment)
}

/// The rows in which the two published tables say different things of one model, and Lissom's at both masses.
pub(super) fn contradiction(studio: &Studio) -> Result<Fragment, BookError> {
    let masses = ["0.1", "1", "10"];
    let request = Request { steps: texts(&["1e-2"]), vary: Some((MASS.to_owned(), texts(&masses))) };
    let mut fragment = Fragment::default();
    let table = run(studio, "pendulum", (&request, &[]), &mut fragment)?;
    let of = |table: &[published::Row], label: &str| {
        table.iter().find(|(name, _)| *name == label).map_or([""; 3], |(_, values)| *values)
    };
    let published = [
        ("table 2.1, row h = 0.01 s", "1 (by the text)", of(&STEPS, "1e-2")),
        ("table 2.2", "0.1", of(&MASSES, "1e-1")),
        ("table 2.2", "1", of(&MASSES, "1e0")),
        ("table 2.2", "10", of(&MASSES, "1e1")),
    ];
    let mut rows: Vec<Vec<String>> = published
        .iter()
        .map(|(whose, mass, values)| {
            let mut line = vec![(*whose).to_owned(), (*mass).to_owned()];
            line.extend(values.map(str::to_owned));
            line
        })
        .collect();
    rows.extend(masses.iter().zip(&table.rows).map(|(mass, row)| {
        let [none, unit, physical, _] = cells(row);
        vec!["Lissom".to_owned(), (*mass).to_owned(), none, unit, physical]
    }));
    fragment.table(&["h = 0.01 s", "mass [kg]", "none", "s = 1", "s of (2.6)"], &rows);
    Ok(fragment)
}

/// All scalings on the tip crank.
pub(super) fn tip_crank(studio: &Studio) -> Result<Fragment, BookError> {
    let (request, set) = (of_steps(&CRANK_STEPS), overrides(&[("analysis.end", "0.01")]));
    let mut fragment = Fragment::default();
    let table = run(studio, "tip-crank", (&request, &set), &mut fragment)?;
    let rows = table.rows.iter().map(|row| {
        let mut line = vec![row.step.clone()];
        line.extend(cells(row));
        line
    });
    let heading = ["h [s]", "none", "s = 1", "s of (2.6)", "equilibrated"];
    fragment.table(&heading, &rows.collect::<Vec<_>>());
    fragment.figure(
        "conditioning-tip-crank",
        "Condition numbers of the tip crank over the step size",
        &table.figure("Beam actuated by a tip crank"),
    )?;
    Ok(fragment)
}

/// Positions of the joints when the plane of the crank lies further from the beam.
const FAR: [(&str, &str); 3] =
    [("points.C", "[1, 0.05, 0]"), ("points.L", "[1, 0.05, -0.5]"), ("points.G", "[0.97, 0.05, -0.5]")];
/// A connector of a single short element.
const ONE_ELEMENT: [(&str, &str); 2] = [("beams.connector.elements", "1"), ("beams.connector.order", "1")];
/// A fifth of the thinness.
const THICK: [(&str, &str); 1] = [("sections.strip.width", "0.0125")];
/// Fewer elements everywhere.
const COARSE: [(&str, &str); 4] = [
    ("beams.beam.elements", "2"),
    ("beams.connector.elements", "1"),
    ("beams.link.elements", "1"),
    ("beams.crank.elements", "1"),
];

/// What is changed, and how.
type Variant = (&'static str, Vec<(&'static str, &'static str)>);

/// The equilibrated tangent of the tip crank at large steps, with parts of the model changed.
pub(super) fn limits(studio: &Studio) -> Result<Fragment, BookError> {
    let variants: [Variant; 6] = [
        ("as it is: connector of 5 mm, two cubic elements", vec![]),
        ("strip five times as thick", THICK.to_vec()),
        ("connector of a single two-node element", ONE_ELEMENT.to_vec()),
        ("connector of 50 mm", FAR.to_vec()),
        ("connector of 50 mm, strip five times as thick", [&FAR[..], &THICK].concat()),
        ("connector of 50 mm, 2 + 1 + 1 + 1 elements", [&FAR[..], &COARSE].concat()),
    ];
    let chosen = ["1e-2", "1e-3", "1e-4"];
    let mut fragment = Fragment::default();
    let model = studio.example("tip-crank")?;
    let request = of_steps(&chosen);
    let (mut commands, mut rows) = (Vec::new(), Vec::new());
    for (name, changes) in variants {
        let set = overrides(&[&[("analysis.end", "0.01")][..], &changes].concat());
        commands.push(command("tip-crank", &request, &set));
        let table = study(&model.with_overrides(&set), &request, &studio.watch())?;
        let mut line = vec![name.to_owned()];
        line.extend(table.rows.iter().map(|row| cells(row)[3].clone()));
        rows.push(line);
    }
    fragment.commands(&commands);
    fragment.table(&["κ of the equilibrated tangent", "h = 0.01 s", "1e-3 s", "1e-4 s"], &rows);
    Ok(fragment)
}

fn of_steps(steps: &[&str]) -> Request {
    Request { steps: texts(steps), vary: None }
}

fn command(example: &str, request: &Request, set: &[Override]) -> String {
    let steps = request.steps.join(",");
    let vary = request.vary.as_ref().map(|(path, values)| format!("{path}={}", values.join(",")));
    let mut options = vec![("steps", steps.as_str())];
    options.extend(vary.as_deref().map(|vary| ("vary", vary)));
    study_command("conditioning", example, &options, set)
}

fn run(
    studio: &Studio,
    example: &str,
    (request, set): (&Request, &[Override]),
    fragment: &mut Fragment,
) -> Result<Table, BookError> {
    fragment.commands(&[command(example, request, set)]);
    Ok(study(&studio.example(example)?.with_overrides(set), request, &studio.watch())?)
}

/// Condition numbers by [`SCALINGS`].
fn cells(row: &Row) -> [String; SCALINGS.len()] {
    match &row.outcome {
        Ok(Measured { conditions, .. }) => conditions.map(two),
        Err(_) => std::array::from_fn(|_| "failed".to_owned()),
    }
}
