//! Curves of runs over reference curves, compared at their common instants and drawn together.

use std::collections::BTreeMap;

use lissom::{Column, Record};
use lissom_model::output::{Figure, figures};

use crate::case::{Case, Curve};
use crate::formula::Columns;
use crate::outcome::{Row, Verdict};
use crate::runs::{Finished, Runs, short};

/// A reference table: numbers by column, the first being the time.
type Table = Vec<Vec<f64>>;

/// Compares and draws one curve.
pub(crate) fn curve(case: &Case, curve: &Curve, runs: &Runs) -> (Option<Row>, Vec<Figure>) {
    let open = curve.open.as_deref();
    let mut row = Row {
        quantity: curve.name.clone(),
        against: curve.against.clone().unwrap_or_else(|| case.source.clone()),
        reference: curve.file.clone().unwrap_or_default(),
        ours: String::new(),
        difference: None,
        tolerance: curve.tolerance.map(short).unwrap_or_default(),
        uncertainty: curve.uncertainty.or(case.uncertainty).map(short).unwrap_or_default(),
        grid: String::new(),
        wall: None,
        verdict: Verdict::Pass,
        is_comparison: true,
    };
    let finished = case
        .run(curve.run.as_deref())
        .map_err(|error| error.to_string())
        .and_then(|run| runs.get(case, run, &BTreeMap::new()));
    let compared = finished.and_then(|finished| {
        row.grid.clone_from(&finished.grid);
        row.wall = Some(finished.wall);
        let table = curve.file.as_ref().map(|file| table(case, file)).transpose()?;
        let drawn = draw(case, curve, &finished, table.as_ref())?;
        let found = table.map(|table| difference(curve, &finished, &table)).transpose()?;
        Ok((drawn, found))
    });
    match compared {
        Ok((drawn, None)) => (None, drawn),
        Ok((drawn, Some(found))) => {
            row.difference = Some(found.largest);
            row.ours = format!("{} instants to {}", found.instants, short(found.until));
            let words = format!("differs by {:.2e} at {}", found.largest, short(found.worst_at));
            let passed = curve.tolerance.is_none_or(|tolerance| found.largest <= tolerance);
            row.verdict = Verdict::of(passed, words, open);
            (Some(row), drawn)
        }
        Err(words) => {
            row.verdict = Verdict::of(false, words, open);
            (Some(row), Vec::new())
        }
    }
}

fn table(case: &Case, file: &str) -> Result<Table, String> {
    let path = case.folder.join(file);
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut table = Table::new();
    for (number, line) in
        text.lines().enumerate().filter(|(_, line)| !line.starts_with('#') && !line.is_empty())
    {
        let numbers: Result<Vec<f64>, _> = line.split(',').map(|field| field.trim().parse()).collect();
        let numbers = numbers.map_err(|_| format!("{file}: line {} is no row of numbers", number + 1))?;
        table.resize(numbers.len().max(table.len()), Vec::new());
        for (column, value) in table.iter_mut().zip(numbers) {
            column.push(value);
        }
    }
    Ok(table)
}

struct Difference {
    largest: f64,
    worst_at: f64,
    instants: usize,
    until: f64,
}

fn difference(curve: &Curve, finished: &Finished, table: &Table) -> Result<Difference, String> {
    let columns = Columns::new(&finished.record);
    let until = curve.until.unwrap_or(f64::INFINITY);
    let mut found = Difference { largest: 0.0, worst_at: 0.0, instants: 0, until: 0.0 };
    let mut most = 0.0_f64;
    for (index, &time) in table[0].iter().enumerate().filter(|(_, time)| **time <= until) {
        let Some(row) = columns.row_at(time) else { continue };
        found.instants += 1;
        found.until = time;
        for (formula, column) in curve.values.iter().zip(&curve.columns) {
            let reference =
                *table.get(*column).and_then(|column| column.get(index)).ok_or("no such column")?;
            most = most.max(reference.abs());
            let difference = (columns.value(formula, row)? - reference).abs();
            if difference.total_cmp(&found.largest).is_gt() {
                (found.largest, found.worst_at) = (difference, time);
            }
        }
    }
    let wanted = table[0].iter().filter(|time| **time <= until).count();
    if found.instants == 0 || 2 * found.instants < wanted {
        let failure = finished.failure.as_deref().unwrap_or("or records at other instants");
        return Err(format!("only {} of {wanted} instants are met: {failure}", found.instants));
    }
    found.largest /= curve.scale.unwrap_or(most);
    Ok(found)
}

/// Our curves and the reference's, in one figure.
fn draw(
    case: &Case,
    curve: &Curve,
    finished: &Finished,
    table: Option<&Table>,
) -> Result<Vec<Figure>, String> {
    let columns = Columns::new(&finished.record);
    let mut record = Record { times: columns.times().to_vec(), ..Record::default() };
    for (formula, label) in curve.values.iter().zip(&curve.labels) {
        record.columns.push(Column::new(&curve.name, label, "", &curve.unit));
        record.values.push(columns.values(formula)?);
    }
    for (column, label) in curve.columns.iter().zip(&curve.labels).filter(|_| table.is_some()) {
        let Some(table) = table else { break };
        // Where the reference has no instant there is a gap, which is not drawn.
        let mut values = vec![f64::NAN; record.times.len()];
        for (time, value) in table[0].iter().zip(&table[*column]) {
            if let Some(row) = columns.row_at(*time) {
                values[row] = *value;
            }
        }
        record.columns.push(Column::new(&curve.name, &format!("{label} reference"), "", &curve.unit));
        record.values.push(values);
    }
    Ok(figures(&record, &case.title))
}
