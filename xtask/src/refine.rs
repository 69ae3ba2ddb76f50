//! Observed order of convergence over families of meshes or steps.

use crate::case::{Case, Refinement};
use crate::compare::value_at;
use crate::formula::Columns;
use crate::outcome::{Row, Verdict};
use crate::runs::{Runs, short};

/// Runs all levels; the order seen between the two finest errors above round-off.
pub(crate) fn refinement(case: &Case, refinement: &Refinement, runs: &Runs) -> Row {
    let mut row = Row {
        quantity: format!("order: {}", refinement.name),
        against: if refinement.reference.is_empty() { "finest level" } else { "exact values" }.to_owned(),
        reference: format!("order ≥ {}", short(refinement.order)),
        ours: String::new(),
        difference: None,
        tolerance: String::new(),
        uncertainty: String::new(),
        grid: String::new(),
        wall: None,
        verdict: Verdict::Pass,
        is_comparison: false,
    };
    let open = refinement.open.as_deref();
    match errors(case, refinement, runs) {
        Ok((errors, grid)) => {
            let orders = orders(&errors, refinement);
            let listed: Vec<String> = errors.iter().map(|error| format!("{error:.1e}")).collect();
            let shown: Vec<String> = orders.iter().map(|order| format!("{order:.2}")).collect();
            let shown = if shown.is_empty() { "below round-off".to_owned() } else { shown.join(", ") };
            row.ours = format!("{shown} (errors {})", listed.join(", "));
            row.grid = format!("finest: {grid}");
            // The finest usable pair is nearest to the limit; the best of the last two allows for a change of sign.
            let best = orders.iter().rev().take(2).copied().fold(f64::NEG_INFINITY, f64::max);
            let passed = best >= refinement.order || orders.is_empty();
            row.verdict = Verdict::of(passed, format!("order {best:.2}"), open);
        }
        Err(words) => row.verdict = Verdict::of(false, words, open),
    }
    row
}

fn errors(case: &Case, refinement: &Refinement, runs: &Runs) -> Result<(Vec<f64>, String), String> {
    let run = case.run(refinement.run.as_deref()).map_err(|error| error.to_string())?;
    let mut levels = Vec::new();
    let mut grid = String::new();
    for level in &refinement.levels {
        let finished = runs.get(case, run, level)?;
        let columns = Columns::new(&finished.record);
        let values: Result<Vec<f64>, String> = refinement
            .values
            .iter()
            .map(|formula| value_at(&columns, &finished, formula, refinement.at))
            .collect();
        levels.push(values?);
        grid.clone_from(&finished.grid);
    }
    let exact = if refinement.reference.is_empty() {
        levels.pop().ok_or("no levels")?
    } else {
        refinement.reference.clone()
    };
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>().sqrt();
    let size = norm(&mut exact.iter().copied());
    let error = |values: &Vec<f64>| norm(&mut values.iter().zip(&exact).map(|(a, b)| a - b)) / size;
    Ok((levels.iter().map(error).collect(), grid))
}

fn orders(errors: &[f64], refinement: &Refinement) -> Vec<f64> {
    errors
        .windows(2)
        .take_while(|pair| pair[1] > refinement.floor)
        .map(|pair| (pair[0] / pair[1]).ln() / refinement.ratio.ln())
        .collect()
}
