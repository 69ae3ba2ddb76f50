//! Numbers of runs against reference numbers.

use std::collections::BTreeMap;

use crate::case::{Case, Measure, Quantity};
use crate::formula::Columns;
use crate::outcome::{Row, Verdict};
use crate::runs::{Finished, Runs, short};

/// Compares one quantity.
pub(crate) fn quantity(case: &Case, quantity: &Quantity, runs: &Runs) -> Row {
    let against = quantity.against.clone().unwrap_or_else(|| case.source.clone());
    let mut row = Row {
        quantity: quantity.name.clone(),
        against,
        reference: String::new(),
        ours: String::new(),
        difference: None,
        tolerance: short(quantity.tolerance),
        uncertainty: quantity.uncertainty.or(case.uncertainty).map(short).unwrap_or_default(),
        grid: String::new(),
        wall: None,
        verdict: Verdict::Pass,
        is_comparison: true,
    };
    let open = quantity.open.as_deref();
    let finished = case
        .run(quantity.run.as_deref())
        .map_err(|error| error.to_string())
        .and_then(|run| runs.get(case, run, &BTreeMap::new()));
    let compared = finished.and_then(|finished| {
        row.grid.clone_from(&finished.grid);
        row.wall = Some(finished.wall);
        worst(quantity, &finished)
    });
    match compared {
        Ok(worst) => {
            row.reference = full(worst.reference);
            row.ours = full(worst.ours);
            if quantity.entries.len() > 1 {
                row.quantity = format!("{} ({} values)", row.quantity, quantity.entries.len());
                row.ours = format!("{} (worst)", row.ours);
            }
            let is_number = quantity.measure != Measure::Completes;
            row.difference = is_number.then_some(worst.difference);
            let words = format!("differs by {:.2e}", worst.difference);
            row.verdict = Verdict::of(worst.difference <= quantity.tolerance, words, open);
        }
        Err(words) => row.verdict = Verdict::of(false, words, open),
    }
    row
}

/// Fourteen digits, fewer if the rest are zeros.
fn full(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.10e}");
    }
    let text = format!("{value:.12}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

struct Worst {
    reference: f64,
    ours: f64,
    difference: f64,
}

fn worst(quantity: &Quantity, finished: &Finished) -> Result<Worst, String> {
    if quantity.measure == Measure::Completes {
        let ours = if finished.failure.is_none() { 1.0 } else { 0.0 };
        let reference = quantity.reference.unwrap_or(1.0);
        return Ok(Worst { reference, ours, difference: (ours - reference).abs() });
    }
    if quantity.measure == Measure::Violation {
        if let Some(failure) = &finished.failure {
            return Err(format!("the run failed {failure}"));
        }
        let ours = finished.violation;
        return Ok(Worst { reference: 0.0, ours, difference: ours / quantity.scale.unwrap_or(1.0) });
    }
    let columns = Columns::new(&finished.record);
    let mut pairs = Vec::new();
    for (at, formula, reference) in &quantity.entries {
        pairs.push((value_at(&columns, finished, formula, Some(*at))?, *reference));
    }
    if let Some(reference) = quantity.reference {
        let formula = quantity.value.as_deref().ok_or("a quantity needs a value")?;
        pairs.push((measure(quantity, &columns, finished, formula)?, reference));
    }
    let most = pairs.iter().fold(0.0_f64, |most, pair| most.max(pair.1.abs()));
    let scale = quantity.scale.unwrap_or(most);
    if scale == 0.0 {
        return Err("a reference of zero needs a scale".to_owned());
    }
    let all = pairs.into_iter().map(|(ours, reference)| Worst {
        reference,
        ours,
        difference: (ours - reference).abs() / scale,
    });
    // `total_cmp` puts what is not a number last, where it is the worst.
    all.max_by(|a, b| a.difference.total_cmp(&b.difference)).ok_or_else(|| "nothing is compared".to_owned())
}

/// The value of `formula` at a time, or at the end.
pub(crate) fn value_at(
    columns: &Columns<'_>,
    finished: &Finished,
    formula: &str,
    at: Option<f64>,
) -> Result<f64, String> {
    let row = match at {
        Some(time) => columns.row_at(time),
        None if finished.failure.is_none() => columns.times().len().checked_sub(1),
        None => None,
    };
    let row = row.ok_or_else(|| match &finished.failure {
        Some(failure) => format!("the run failed {failure}"),
        None => format!("nothing is recorded at {}", at.unwrap_or_default()),
    })?;
    columns.value(formula, row)
}

fn measure(
    quantity: &Quantity,
    columns: &Columns<'_>,
    finished: &Finished,
    formula: &str,
) -> Result<f64, String> {
    if quantity.measure == Measure::Value {
        return value_at(columns, finished, formula, quantity.at);
    }
    let first = columns.times().partition_point(|time| *time < quantity.from.unwrap_or(f64::MIN));
    let times = &columns.times()[first..];
    let values = &columns.values(formula)?[first..];
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let middle = 0.5 * (low + high);
    match quantity.measure {
        Measure::Maximum => Ok(high),
        Measure::Range => Ok(high - low),
        Measure::Middle => Ok(middle),
        Measure::Frequency => {
            frequency(times, values, middle).ok_or_else(|| "it does not oscillate".to_owned())
        }
        Measure::Divergence => divergence(times, values, |time| time * time).map(f64::sqrt),
        Measure::DivergenceOneSided => divergence(times, values, |time| time),
        Measure::Limit => {
            let load = quantity.load.as_deref().ok_or("a limit point needs a load")?;
            limit(values, &columns.values(load)?[first..])
        }
        Measure::Value | Measure::Completes | Measure::Violation => {
            Err("this measure takes no formula".to_owned())
        }
    }
}

/// Circular frequency from the first to the last upward crossing of `middle`.
fn frequency(times: &[f64], values: &[f64], middle: f64) -> Option<f64> {
    let crossing = |i: usize| crossing(&times[i - 1..], &values[i - 1..], middle);
    let up: Vec<f64> = (1..values.len().saturating_sub(2))
        .filter(|&i| values[i - 1] < middle && values[i] >= middle)
        .map(crossing)
        .collect();
    let (first, last) = (up.first()?, up.last()?);
    (up.len() > 1).then(|| std::f64::consts::TAU * (up.len() - 1) as f64 / (last - first))
}

/// Where the cubic through the first four points (time as a function of the value) passes `middle`; linear where there
/// are fewer.
fn crossing(times: &[f64], values: &[f64], middle: f64) -> f64 {
    if values.len() < 3 {
        return times[0];
    }
    let slope = (times[1] - times[0]) / (values[1] - values[0]);
    let second = ((times[2] - times[1]) / (values[2] - values[1]) - slope) / (values[2] - values[0]);
    times[0] + (middle - values[0]) * (slope + (middle - values[1]) * second)
}

/// Largest value of the cubic through the last four points (displacement, load), up to three intervals beyond them.
fn limit(displacements: &[f64], loads: &[f64]) -> Result<f64, String> {
    let count = loads.len();
    if count < 5 {
        return Err("too few records".to_owned());
    }
    let (x, y) = (&displacements[count - 4..], &loads[count - 4..]);
    let cubic = |at: f64| -> f64 {
        (0..4)
            .map(|i| (0..4).filter(|&j| j != i).map(|j| (at - x[j]) / (x[i] - x[j])).product::<f64>() * y[i])
            .sum()
    };
    let (mut low, mut high) = (x[3], x[3] + 3.0 * (x[3] - x[2]));
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if cubic(a) < cubic(b) { low = a } else { high = b }
    }
    let top = 0.5 * (low + high);
    // A maximum at the far end is none.
    if (top - x[3]) / (x[3] - x[2]) < 2.99 {
        Ok(cubic(top))
    } else {
        Err("no limit point is in sight".to_owned())
    }
}

/// Root beyond the last record of the parabola through the last three inverses, over `of(time)`.
fn divergence(times: &[f64], values: &[f64], of: impl Fn(f64) -> f64) -> Result<f64, String> {
    let count = times.len();
    if count < 4 {
        return Err("too few records".to_owned());
    }
    let points: Vec<(f64, f64)> = (count - 3..count).map(|i| (of(times[i]), 1.0 / values[i])).collect();
    let parabola = |x: f64| -> f64 {
        (0..3)
            .map(|i| {
                let others = (0..3).filter(|&j| j != i);
                others.map(|j| (x - points[j].0) / (points[i].0 - points[j].0)).product::<f64>() * points[i].1
            })
            .sum()
    };
    let (mut low, mut high) = (points[2].0, points[2].0 + 3.0 * (points[2].0 - points[0].0).abs());
    if parabola(low) * parabola(high) > 0.0 {
        return Err("no divergence is in sight".to_owned());
    }
    let sign = parabola(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if parabola(middle) * sign > 0.0 { low = middle } else { high = middle }
    }
    Ok(low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequency_of_a_sine_is_found() {
        let times: Vec<f64> = (0..1000).map(|i| f64::from(i) * 0.01).collect();
        let values: Vec<f64> = times.iter().map(|time| (7.3 * time).sin() + 2.0).collect();
        let found = frequency(&times, &values, 2.0).unwrap();
        assert!((found / 7.3 - 1.0).abs() < 1e-5, "{found}");
    }

    #[test]
    fn limit_of_a_path_is_found() {
        let displacements: Vec<f64> = (0..10).map(|i| f64::from(i) * 0.1).collect();
        let loads: Vec<f64> = displacements.iter().map(|u| 3.0 - (u - 1.0) * (u - 1.0)).collect();
        assert!((limit(&displacements, &loads).unwrap() - 3.0).abs() < 1e-12);
        assert!(limit(&displacements, &displacements).is_err());
    }

    #[test]
    fn divergence_of_a_pole_is_found() {
        let times: Vec<f64> = (1..10).map(|i| f64::from(i) * 0.1).collect();
        let values: Vec<f64> = times.iter().map(|time| 1e-6 / (1.21 - time * time)).collect();
        let found = divergence(&times, &values, |time| time * time).unwrap().sqrt();
        assert!((found - 1.1).abs() < 1e-10, "{found}");
        let values: Vec<f64> = times.iter().map(|time| 1e-6 / (1.21 + time * time)).collect();
        assert!(divergence(&times, &values, |time| time * time).is_err());
    }
}
