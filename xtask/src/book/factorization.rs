//! Effects of scaling, augmented term and pivoting on the first tangent of the tip crank.

use lissom::analyses::study::factorization::{Table, scaling_name, study};
use lissom::core::studies::factorization::{Case, Factored};

use super::fragment::{Fragment, overrides, study_command};
use super::numbers::{one, two};
use super::{BookError, Studio};

const EXAMPLE: &str = "tip-crank";

/// Every combination at the step of the model.
pub(super) fn tip_crank(studio: &Studio) -> Result<Fragment, BookError> {
    let mut fragment = Fragment::default();
    fragment.commands(&[study_command("factorization", EXAMPLE, &[], &[])]);
    let table = study(&studio.example(EXAMPLE)?)?;
    let heading = [
        "scaling",
        "augmented",
        "solver",
        "smallest / largest pivot",
        "growth",
        "error of coordinates",
        "error of multipliers",
        "backward error",
        "last update",
        "residual [N]",
        "violation [m]",
    ];
    let rows: Vec<_> = table.cases.iter().map(line).collect();
    fragment.table(&heading, &rows);
    Ok(fragment)
}

fn line(case: &Case) -> Vec<String> {
    let augmented = if case.augmented { "yes" } else { "no" };
    let mut cells = vec![scaling_name(case).to_owned(), augmented.to_owned(), case.solver.to_owned()];
    match &case.outcome {
        Err(stopped) => {
            cells.push(format!("stops at the {}", stopped.unknown));
            cells.resize(11, String::new());
        }
        Ok(factored) => {
            let growth = factored.report.growth;
            cells.push(one(factored.report.relative_pivot()));
            cells.push(if growth.is_nan() { String::new() } else { two(growth) });
            cells.extend([factored.coordinate_error, factored.multiplier_error].map(|e| error(factored, e)));
            cells.push(one(factored.backward_error));
            let newton = &factored.newton;
            cells.extend([newton.update, newton.residual, newton.violation].map(one));
        }
    }
    cells
}

/// An error, with a mark where it is not known for sure.
fn error(factored: &Factored, value: f64) -> String {
    format!("{}{}", if factored.errors_known { "" } else { "~" }, one(value))
}

/// The sparse solver without pivoting at several steps: what is lost without scaling.
pub(super) fn steps(studio: &Studio) -> Result<Fragment, BookError> {
    let model = studio.example(EXAMPLE)?;
    let (mut commands, mut rows) = (Vec::new(), Vec::new());
    for step in ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7"] {
        let set = overrides(&[("analysis.step", step), ("analysis.end", "0.01")]);
        commands.push(study_command("factorization", EXAMPLE, &[], &set));
        let table = study(&model.with_overrides(&set))?;
        let mut line = vec![step.to_owned()];
        for scaling in ["none", "physical", "equilibrated"] {
            let [pivot, coordinates, multipliers, update] = sparse(&table, scaling);
            line.extend([pivot, format!("{coordinates}, {multipliers}"), update]);
        }
        rows.push(line);
    }
    let mut fragment = Fragment::default();
    fragment.commands(&commands);
    let heading = [
        "h [s]",
        "none: pivots",
        "errors",
        "update",
        "s of (2.6): pivots",
        "errors",
        "update",
        "equilibrated: pivots",
        "errors",
        "update",
    ];
    fragment.table(&heading, &rows);
    Ok(fragment)
}

/// Where Newton's method ends in one step of any size, on three models.
pub(super) fn any_step(studio: &Studio) -> Result<Fragment, BookError> {
    let steps = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"];
    let examples = ["pendulum", "top", EXAMPLE];
    let mut commands = Vec::new();
    let mut rows: Vec<Vec<String>> = steps.map(|step| vec![step.to_owned()]).to_vec();
    for example in examples {
        let model = studio.example(example)?;
        for (step, row) in steps.iter().zip(&mut rows) {
            let set = overrides(&[("analysis.step", step), ("analysis.end", "0.01")]);
            if step == &steps[0] {
                commands.push(study_command("factorization", example, &[], &set));
            }
            row.extend(attained(&study(&model.with_overrides(&set))?));
        }
    }
    let mut fragment = Fragment::default();
    fragment.commands(&commands);
    let mut heading = vec!["h [s]".to_owned()];
    for example in examples {
        heading.extend([format!("{example}: residual [N]"), "violation [m]".to_owned()]);
    }
    let heading: Vec<&str> = heading.iter().map(String::as_str).collect();
    fragment.table(&heading, &rows);
    Ok(fragment)
}

/// Residual and violation of the combination that runs use.
fn attained(table: &Table) -> [String; 2] {
    match combination(table, "equilibrated") {
        Some(factored) => [one(factored.newton.residual), one(factored.newton.violation)],
        None => std::array::from_fn(|_| "none".to_owned()),
    }
}

/// Pivot ratio, errors of coordinates and multipliers and last update of the augmented, sparse combination.
fn sparse(table: &Table, scaling: &str) -> [String; 4] {
    let Some(factored) = combination(table, scaling) else {
        return std::array::from_fn(|_| "none".to_owned());
    };
    [
        one(factored.report.relative_pivot()),
        error(factored, factored.coordinate_error),
        error(factored, factored.multiplier_error),
        one(factored.newton.update),
    ]
}

/// Result of the augmented, sparse combination with a scaling, if it has factors.
fn combination<'a>(table: &'a Table, scaling: &str) -> Option<&'a Factored> {
    let wanted = |case: &&Case| case.augmented && case.solver == "sparse" && scaling_name(case) == scaling;
    table.cases.iter().find(wanted).and_then(|case| case.outcome.as_ref().ok())
}
