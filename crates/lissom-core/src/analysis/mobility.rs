//! How many freedoms the constraints leave, and which of them repeat others: rank of B at a configuration,
//! by elimination of its rows in the order of the joints.

use std::collections::{BTreeMap, BTreeSet};

use crate::system::{Linearization, State, System};

/// Entries below this part of a row's largest count as round-off.
const ROUND_OFF: f64 = 1e-9;

/// A pivot is at least this part of its row's largest entry.
const LARGE_ENOUGH: f64 = 0.1;

/// Count of freedoms.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mobility {
    /// Node freedoms and algebraic coordinates.
    pub coordinates: usize,
    /// Equations of joints and drives.
    pub constraints: usize,
    /// Independent ones among them.
    pub rank: usize,
    /// Freedoms left: coordinates less independent equations.
    pub freedoms: usize,
    /// Equations that follow from earlier ones.
    pub redundant: Vec<Redundant>,
}

/// An equation that repeats others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Redundant {
    /// Name of its joint.
    pub joint: String,
    /// Name of the equation.
    pub equation: &'static str,
    /// Joints whose equations it follows from.
    pub among: Vec<String>,
}

/// A row of B after elimination with the rows before it.
struct Reduced {
    pivot: usize,
    entries: BTreeMap<usize, f64>,
    /// Its multiplier.
    multiplier: usize,
    /// Earlier reduced rows that went into it.
    used: Vec<usize>,
}

/// Freedoms and redundant constraints of `system` at `state`.
pub fn mobility(system: &System, state: &State) -> Mobility {
    let layout = system.layout();
    let mut result = Mobility {
        coordinates: layout.coordinate_count() - layout.state_count() - layout.impulses.len(),
        constraints: layout.multiplier_rows().len(),
        ..Mobility::default()
    };
    let mut reduced: Vec<Reduced> = Vec::new();
    let mut by_pivot: BTreeMap<usize, usize> = BTreeMap::new();
    // Columns of nodes come before those of joints' own coordinates.
    let of_nodes = layout.coordinate_count() - layout.coordinate_rows.len();
    for (k, row) in rows(system, state).into_iter().enumerate() {
        match eliminate(row, k, &reduced, &by_pivot, of_nodes) {
            Ok(row) => {
                by_pivot.insert(row.pivot, reduced.len());
                reduced.push(row);
            }
            Err(used) => {
                let (joint, equation) = layout.constraint_name(k);
                let names = origins(used, &reduced).into_iter().map(|k| layout.constraint_name(k).0);
                let among: BTreeSet<String> =
                    names.filter(|&name| name != joint).map(str::to_owned).collect();
                result.redundant.push(Redundant {
                    joint: joint.to_owned(),
                    equation,
                    among: among.into_iter().collect(),
                });
            }
        }
    }
    result.rank = reduced.len();
    result.freedoms = result.coordinates - result.rank;
    result
}

/// Multipliers of all rows that went into the given ones.
fn origins(mut open: Vec<usize>, reduced: &[Reduced]) -> BTreeSet<usize> {
    let mut seen = BTreeSet::new();
    while let Some(row) = open.pop() {
        if seen.insert(row) {
            open.extend(&reduced[row].used);
        }
    }
    seen.into_iter().map(|row| reduced[row].multiplier).collect()
}

/// Eliminates a row with the earlier ones: a new independent row, or the reduced rows it follows from.
fn eliminate(
    mut entries: BTreeMap<usize, f64>,
    multiplier: usize,
    reduced: &[Reduced],
    by_pivot: &BTreeMap<usize, usize>,
    of_nodes: usize,
) -> Result<Reduced, Vec<usize>> {
    let largest = entries.values().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut used = Vec::new();
    // Earlier rows in their order: each is free of the pivots before it.
    let mut waiting: BTreeSet<usize> =
        entries.keys().filter_map(|column| by_pivot.get(column).copied()).collect();
    while let Some(earlier) = waiting.pop_first() {
        let row = &reduced[earlier];
        let Some(&value) = entries.get(&row.pivot) else { continue };
        if value.abs() > ROUND_OFF * largest {
            let factor = value / row.entries[&row.pivot];
            for (&column, &entry) in &row.entries {
                *entries.entry(column).or_insert(0.0) -= factor * entry;
                if let Some(&next) = by_pivot.get(&column)
                    && next > earlier
                {
                    waiting.insert(next);
                }
            }
            used.push(earlier);
        }
        entries.remove(&row.pivot);
    }
    entries.retain(|_, value| value.abs() > ROUND_OFF * largest);
    // Any entry that is not small will do: the joint's own coordinate, or else the first, so that eliminating along
    // a chain does not lead back to its beginning.
    let left = entries.values().fold(0.0_f64, |most, value| most.max(value.abs()));
    let large = entries.iter().filter(|(_, value)| value.abs() >= LARGE_ENOUGH * left);
    let pivot = large.min_by_key(|&(&column, _)| (column < of_nodes, column)).map(|(&column, _)| column);
    match pivot {
        Some(pivot) => Ok(Reduced { pivot, entries, multiplier, used }),
        None => Err(used),
    }
}

/// Rows of B by multiplier.
fn rows(system: &System, state: &State) -> Vec<BTreeMap<usize, f64>> {
    let layout = system.layout();
    let linearization = Linearization::of_state(system, &state.kinematics);
    let pattern = system.pattern();
    layout
        .multiplier_rows()
        .map(|column| {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            range
                .map(|position| (pattern.row_indices()[position], linearization.constraint[position]))
                .filter(|&(row, value)| row < layout.coordinate_count() && value != 0.0)
                .collect()
        })
        .collect()
}
