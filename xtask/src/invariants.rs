//! Results that must not depend on how a model is written, checked on the project's examples.

use std::ops::Range;
use std::path::Path;

use lissom::{Model, Record};

use crate::case::{Change, Invariant};
use crate::outcome::{Row, Verdict};
use crate::runs::{finish, short};
use crate::transform::{in_millimetres, reversed, turned, unit_factor};

/// Tolerance of Newton's iteration, whose remaining error depends on units.
const TOLERANCE: f64 = 1e-12;

/// Runs an example as it is and changed, and compares all outputs.
pub(crate) fn invariant(root: &Path, invariant: &Invariant) -> Row {
    let change = match invariant.change {
        Change::Order => "parts in reverse order",
        Change::Turned => "turned in space",
        Change::Units => "in mm, t, s",
        Change::Threads => "four at a time in threads",
    };
    let mut row = Row {
        quantity: format!("{}: {change}", invariant.example),
        against: "the example as it stands".to_owned(),
        reference: String::new(),
        ours: format!("all outputs to {} s", short(invariant.end)),
        difference: None,
        tolerance: short(invariant.tolerance),
        uncertainty: "0".to_owned(),
        grid: String::new(),
        wall: None,
        verdict: Verdict::Pass,
        is_comparison: false,
    };
    match difference(root, invariant, &mut row) {
        Ok((difference, output)) => {
            row.difference = Some(difference);
            row.ours = format!("{}, worst `{output}`", row.ours);
            let words = format!("`{output}` differs by {difference:.2e}");
            row.verdict = Verdict::of(difference <= invariant.tolerance, words, invariant.open.as_deref());
        }
        Err(words) => row.verdict = Verdict::of(false, words, invariant.open.as_deref()),
    }
    row
}

fn difference(root: &Path, invariant: &Invariant, row: &mut Row) -> Result<(f64, String), String> {
    let path = match invariant.example.strip_prefix("case/") {
        Some(case) => root.join("verification").join(case).join("model.toml"),
        None => root.join("examples").join(format!("{}.toml", invariant.example)),
    };
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let table = || text.parse::<toml::Table>().map_err(|error| error.to_string());
    // Parameters name those above them: they stay in their order.
    let written = |table: &toml::Table| {
        let mut table = table.clone();
        table.remove("parameters");
        let rest = toml::to_string(&table).map_err(|error| error.to_string())?;
        Ok::<_, String>(rest + "\n" + &parameters(&text))
    };
    let changed = match invariant.change {
        Change::Order => reversed(&text),
        Change::Turned => written(&turned(&table()?))?,
        Change::Units => written(&in_millimetres(&table()?))?,
        Change::Threads => text.clone(),
    };
    let tight = |path: &str, value: f64| (path.to_owned(), format!("{value:?}"));
    let overrides = [tight("analysis.end", invariant.end), tight("analysis.tolerance", TOLERANCE)];
    let run = |name: &str, text: &str| {
        let document = Model::from_text(name, text)
            .with_overrides(&overrides)
            .document()
            .map_err(|report| report.render(false))?;
        let finished = finish(&document)?;
        match finished.failure {
            Some(failure) => Err(format!("{name} failed {failure}")),
            None => Ok(finished),
        }
    };
    let base = run(&invariant.example, &text)?;
    let others = if invariant.change == Change::Threads { 4 } else { 1 };
    let other = std::thread::scope(|scope| {
        let runs: Vec<_> = (0..others).map(|_| scope.spawn(|| run("changed", &changed))).collect();
        let mut worst = None;
        for run in runs {
            let other = run.join().map_err(|_| "a thread ended early".to_owned())??;
            let found = self::worst(invariant.change, &base.record, &other.record);
            if worst.as_ref().is_none_or(|(known, _): &(f64, String)| found.0.total_cmp(known).is_gt()) {
                worst = Some(found);
            }
        }
        worst.ok_or_else(|| "nothing was run".to_owned())
    })?;
    row.grid.clone_from(&base.grid);
    row.wall = Some(base.wall);
    Ok(other)
}

/// The table of parameters of a model file, as it is.
fn parameters(text: &str) -> String {
    let inside = |line: &&str| !line.starts_with('[');
    let mut lines = text.lines().skip_while(|line| *line != "[parameters]");
    let heading = lines.next();
    heading.into_iter().chain(lines.take_while(inside)).flat_map(|line| [line, "\n"]).collect()
}

/// Largest difference of an output, over the output's largest value. The components of an output share it: the
/// moment of a spherical joint is nothing but round-off of its force.
fn worst(change: Change, base: &Record, other: &Record) -> (f64, String) {
    let mut worst = (0.0_f64, String::new());
    let mut first = 0;
    while first < base.columns.len() {
        let output = &base.columns[first].output;
        let count = base.columns[first..].iter().take_while(|column| column.output == *output).count();
        let difference = of_output(change, base, other, first..first + count);
        if worst.1.is_empty() || difference.total_cmp(&worst.0).is_gt() {
            worst = (difference, output.clone());
        }
        first += count;
    }
    worst
}

fn of_output(change: Change, base: &Record, other: &Record, range: Range<usize>) -> f64 {
    let column = &base.columns[range.start];
    let Some(start) = other.columns.iter().position(|candidate| candidate == column) else { return f64::NAN };
    let (mut most, mut difference) = (0.0_f64, 0.0_f64);
    for row in 0..base.times.len().min(other.times.len()) {
        let ours = values(change, base, range.clone(), row, false);
        let theirs = values(change, other, start..start + range.len(), row, change == Change::Units);
        for (a, b) in ours.iter().zip(&theirs) {
            most = most.max(a.abs());
            difference = difference.max((a - b).abs());
        }
    }
    if most > 0.0 { difference / most } else { difference }
}

/// The values of an output in SI. Directions turn with the model, lengths do not: there, lengths of vectors.
fn values(change: Change, record: &Record, range: Range<usize>, row: usize, scaled: bool) -> Vec<f64> {
    let value = |k: usize| {
        let factor = if scaled { unit_factor(&record.columns[k].unit) } else { 1.0 };
        record.values[k][row] / factor
    };
    let values: Vec<f64> = range.clone().map(value).collect();
    if change != Change::Turned || !range.len().is_multiple_of(3) {
        return values;
    }
    values.chunks(3).map(|vector| vector.iter().map(|value| value * value).sum::<f64>().sqrt()).collect()
}
