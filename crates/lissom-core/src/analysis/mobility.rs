//! How many freedoms the constraints leave, and which of them repeat others: rank of B at a configuration,
//! by elimination of its rows in the order of the joints.

use std::collections::{BTreeMap, BTreeSet};

use crate::joints::attached::Increments;
use crate::system::{Augmentation, Chart, Linearization, MotionChange, Point, State, System};

/// Entries below this part of a row's largest count as round-off.
const ROUND_OFF: f64 = 1e-9;

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
    /// Joints whose rows went into it.
    joints: BTreeSet<String>,
}

/// Freedoms and redundant constraints of `system` at `state`.
pub fn mobility(system: &System, state: &State) -> Mobility {
    let layout = system.layout();
    let mut result = Mobility {
        coordinates: layout.coordinate_count(),
        constraints: layout.multiplier_rows().len(),
        ..Mobility::default()
    };
    let mut reduced: Vec<Reduced> = Vec::new();
    let mut by_pivot: BTreeMap<usize, usize> = BTreeMap::new();
    for (k, row) in rows(system, state).into_iter().enumerate() {
        let (joint, equation) = layout.constraint_name(k);
        match eliminate(row, joint, &reduced, &by_pivot) {
            Ok(row) => {
                by_pivot.insert(row.pivot, reduced.len());
                reduced.push(row);
            }
            Err(joints) => result.redundant.push(Redundant {
                joint: joint.to_owned(),
                equation,
                among: joints.into_iter().filter(|name| name != joint).collect(),
            }),
        }
    }
    result.rank = reduced.len();
    result.freedoms = result.coordinates - result.rank;
    result
}

/// Eliminates a row with the earlier ones: a new independent row, or the joints it follows from.
fn eliminate(
    mut entries: BTreeMap<usize, f64>,
    joint: &str,
    reduced: &[Reduced],
    by_pivot: &BTreeMap<usize, usize>,
) -> Result<Reduced, BTreeSet<String>> {
    let largest = entries.values().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut joints = BTreeSet::from([joint.to_owned()]);
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
            joints.extend(row.joints.iter().cloned());
        }
        entries.remove(&row.pivot);
    }
    entries.retain(|_, value| value.abs() > ROUND_OFF * largest);
    let pivot = entries.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map(|(&column, _)| column);
    match pivot {
        Some(pivot) => Ok(Reduced { pivot, entries, joints }),
        None => Err(joints),
    }
}

/// Rows of B by multiplier.
fn rows(system: &System, state: &State) -> Vec<BTreeMap<usize, f64>> {
    let still = vec![MotionChange::none(); state.kinematics.nodes.len()];
    let unchanged = vec![0.0; state.kinematics.coordinates.len()];
    let layout = system.layout();
    let zero = vec![0.0; layout.multiplier_rows().len()];
    let point = Point {
        at: &state.kinematics,
        stressed: &state.kinematics,
        increments: Increments { start: &state.kinematics, nodes: &still, coordinates: &unchanged },
        multipliers: &zero,
        violations: &zero,
        augmentation: Augmentation::none(),
    };
    let mut linearization = Linearization::new(system);
    system.linearize(&point, Chart::Body, &mut linearization);
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
