//! Mobility and redundant constraints: the rank of B at a configuration, by elimination of its rows joint by joint.

use std::collections::{BTreeMap, BTreeSet};

use lissom_motion::Vector3;

use super::loops;
use super::redundancy::GEOMETRIC_TOLERANCE;
use crate::joints::Equations;
use crate::kinematics::{LOCKED, NodeId, Quantity};
use crate::round_off;
use crate::scaling::Representative;
use crate::system::{State, System};

/// Remainder of a row, relative to its largest entry, below which it depends on others: elimination enlarges what remains of
/// dependent rows.
const DEPENDENT: f64 = 10.0 * GEOMETRIC_TOLERANCE;
/// Smallest pivot, relative to the largest entry of its row.
const LARGE_ENOUGH: f64 = 0.1;

/// Count of degrees of freedom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mobility {
    /// Degrees of freedom of nodes and algebraic coordinates.
    pub coordinates: usize,
    /// Equations of joints and drives between positions.
    pub constraints: usize,
    /// Independent ones among them.
    pub rank: usize,
    /// Degrees of freedom: coordinates minus independent equations.
    pub freedoms: usize,
    /// Equations that depend linearly on earlier ones; those between velocities depend on those between positions as well.
    pub redundant: Vec<Redundant>,
}

/// A redundant equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundant {
    /// Name of its joint.
    pub joint: String,
    /// Name of the equation.
    pub equation: &'static str,
    /// Joints with the equations on which it depends.
    pub among: Vec<String>,
    /// The redundant direction of its joint in inertial axes, such as `translation along y`; none for drives and couplings.
    pub direction: Option<String>,
    /// Self-stress: multipliers and their values that are in equilibrium without load and may be added to any solution. The multiplier
    /// of this equation is 1.
    pub self_stress: Vec<(usize, f64)>,
}

/// A row of B after elimination with the rows before it.
struct Reduced {
    pivot: usize,
    entries: BTreeMap<usize, f64>,
    /// Multiplier of the row.
    multiplier: usize,
    /// Earlier reduced rows that were subtracted, with their factors.
    used: Vec<(usize, f64)>,
}

impl Redundant {
    /// Description of the redundant direction and of the joints that constrain it already.
    pub fn words(&self) -> String {
        let named = self.among.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let others = if named.is_empty() { "its own other equations".to_owned() } else { named };
        let what = self.direction.clone().unwrap_or_else(|| format!("its equation `{}`", self.equation));
        format!("joint `{}` repeats {what}, given by {others}", self.joint)
    }
}

/// Whether there are closed loops of joints, drives and relations; otherwise no constraint is redundant.
pub fn has_loops(system: &System) -> bool {
    !loops::of(system).is_empty()
}

/// Degrees of freedom and redundant constraints of `system` at `state`.
pub fn mobility(system: &System, state: &State) -> Mobility {
    let layout = system.layout();
    let mut result = Mobility {
        coordinates: layout.coordinate_count() - layout.state_count(),
        constraints: layout.multiplier_count - layout.of_velocities.len(),
        ..Mobility::default()
    };
    if layout.of_velocities.is_empty() && !has_loops(system) {
        result.rank = result.constraints;
        result.freedoms = result.coordinates.saturating_sub(result.rank);
        return result;
    }
    let mut reduced: Vec<Reduced> = Vec::new();
    let mut by_pivot: BTreeMap<usize, usize> = BTreeMap::new();
    // Columns of nodes precede those of joint coordinates.
    let of_nodes = layout.coordinate_count() - layout.coordinate_rows.len();
    for (k, row) in rows(system, state) {
        match eliminate(row, k, &reduced, &by_pivot, of_nodes) {
            Ok(row) => {
                by_pivot.insert(row.pivot, reduced.len());
                reduced.push(row);
            }
            Err(used) => {
                let (joint, equation) = layout.constraint_name(k);
                let self_stress = self_stress(k, used, &reduced);
                let names = self_stress.iter().map(|&(k, _)| layout.constraint_name(k).0);
                let among: BTreeSet<String> =
                    names.filter(|&name| name != joint).map(str::to_owned).collect();
                result.redundant.push(Redundant {
                    joint: joint.to_owned(),
                    equation,
                    among: among.into_iter().collect(),
                    direction: direction(system, state, k, &self_stress),
                    self_stress,
                });
            }
        }
    }
    result.rank = reduced.iter().filter(|row| !layout.is_of_velocities(row.multiplier)).count();
    result.freedoms = result.coordinates - result.rank;
    result
}

/// Degrees of freedom of all that constraints or inertias couple with these rows of the layout; other parts are not counted.
pub fn coupled_freedoms(system: &System, state: &State, rows: &[usize]) -> usize {
    let layout = system.layout();
    let count = layout.coordinate_count();
    let first = loops::coupled_rows(system, &state.kinematics);
    let own: BTreeSet<usize> = rows.iter().map(|&row| first[row]).collect();
    let is_own =
        |multiplier: usize| own.contains(&first[count + multiplier]) && !layout.is_of_velocities(multiplier);
    let rows = first[..count].iter().filter(|row| own.contains(row)).count();
    let equations = (0..layout.multiplier_count).filter(|&multiplier| is_own(multiplier)).count();
    // What repeats others is coupled with them.
    let redundant = mobility(system, state).redundant.into_iter();
    let redundant =
        redundant.filter(|own| own.self_stress.iter().all(|&(multiplier, _)| is_own(multiplier))).count();
    rows + redundant - equations
}

/// Nodes that constraints or inertias couple with a free node, and the node itself.
pub fn coupled_nodes(system: &System, state: &State, node: NodeId) -> Vec<NodeId> {
    let layout = system.layout();
    let first = loops::coupled_rows(system, &state.kinematics);
    let group = |node: NodeId| {
        let row = layout.rows_of_node(node).iter().find(|&&row| row != LOCKED)?;
        Some(first[*row as usize])
    };
    let own = group(node);
    layout.nodes().filter(|&other| own.is_some() && group(other) == own).collect()
}

/// Self-stress of the redundant row `repeating`, from the factors with which reduced rows were subtracted until it vanished.
fn self_stress(repeating: usize, used: Vec<(usize, f64)>, reduced: &[Reduced]) -> Vec<(usize, f64)> {
    let mut open: BTreeMap<usize, f64> = BTreeMap::new();
    for (row, factor) in used {
        *open.entry(row).or_default() -= factor;
    }
    let mut stress = vec![(repeating, 1.0)];
    // A reduced row is its original row minus earlier reduced ones.
    while let Some((row, share)) = open.pop_last() {
        stress.push((reduced[row].multiplier, share));
        for &(earlier, factor) in &reduced[row].used {
            *open.entry(earlier).or_default() -= share * factor;
        }
    }
    let largest = stress.iter().fold(0.0_f64, |most, (_, value)| most.max(value.abs()));
    stress.retain(|&(_, value)| value.abs() > round_off::NEGLIGIBLE * largest);
    stress.sort_unstable_by_key(|&(multiplier, _)| multiplier);
    stress
}

/// Redundant direction of the joint of an equation, in words: that of its force and moment under `stress`.
fn direction(system: &System, state: &State, equation: usize, stress: &[(usize, f64)]) -> Option<String> {
    let joint = system.joints().iter().find(|joint| joint.reacting().contains(&equation))?;
    let of = |share: f64| {
        let mut mu = Equations::default();
        for &(multiplier, value) in stress {
            if let Some(own) = multiplier.checked_sub(joint.first_multiplier)
                && own < joint.reacting().len()
            {
                mu[own] = share * value;
            }
        }
        joint.reaction(&state.kinematics, &mu)
    };
    let wrench = of(1.0) - of(0.0);
    let [force, moment] = [0, 3].map(|first| wrench.fixed_rows::<3>(first).into_owned());
    let largest = force.norm().max(moment.norm());
    let mut words = Vec::new();
    for (part, name) in [(force, "translation along"), (moment, "rotation about")] {
        if part.norm() > round_off::NEGLIGIBLE * largest {
            words.push(format!("{name} {}", axis(&part.normalize())));
        }
    }
    // A joint coordinate that is also prescribed otherwise has neither.
    (!words.is_empty()).then(|| words.join(" together with "))
}

/// Direction of an axis, by name if it is an inertial one.
fn axis(direction: &Vector3) -> String {
    let named = ["x", "y", "z"].into_iter().zip(direction.iter());
    let found =
        named.into_iter().find(|(_, part)| part.abs() > 1.0 - round_off::NEGLIGIBLE * round_off::NEGLIGIBLE);
    // The sign is chosen so that the first nonzero component is positive.
    let first = direction.iter().find(|part| part.abs() > round_off::NEGLIGIBLE).copied().unwrap_or(1.0);
    let round = |value: f64| (1e3 * value * first.signum()).round() / 1e3 + 0.0;
    found.map_or_else(
        || format!("({}, {}, {})", round(direction.x), round(direction.y), round(direction.z)),
        |(name, _)| name.to_owned(),
    )
}

/// Eliminates a row with the earlier ones: returns a new independent row, or the reduced rows on which it depends.
fn eliminate(
    mut entries: BTreeMap<usize, f64>,
    multiplier: usize,
    reduced: &[Reduced],
    by_pivot: &BTreeMap<usize, usize>,
    of_nodes: usize,
) -> Result<Reduced, Vec<(usize, f64)>> {
    let largest = entries.values().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut used = Vec::new();
    // Earlier rows in their order: each has zeros in the pivot columns before it.
    let mut waiting: BTreeSet<usize> =
        entries.keys().filter_map(|column| by_pivot.get(column).copied()).collect();
    while let Some(earlier) = waiting.pop_first() {
        let row = &reduced[earlier];
        let Some(&value) = entries.get(&row.pivot) else { continue };
        if value.abs() > round_off::FORCE * largest {
            let factor = value / row.entries[&row.pivot];
            for (&column, &entry) in &row.entries {
                *entries.entry(column).or_insert(0.0) -= factor * entry;
                if let Some(&next) = by_pivot.get(&column)
                    && next > earlier
                {
                    waiting.insert(next);
                }
            }
            used.push((earlier, factor));
        }
        entries.remove(&row.pivot);
    }
    entries.retain(|_, value| value.abs() > round_off::FORCE * largest);
    // The pivot may be any entry that is not small: the joint's own coordinate, otherwise the first, so that elimination along a chain
    // does not return to its beginning.
    let left = entries.values().fold(0.0_f64, |most, value| most.max(value.abs()));
    let is_large = |value: f64| value.abs() >= LARGE_ENOUGH * left && left > DEPENDENT * largest;
    let large = entries.iter().filter(|(_, value)| is_large(**value));
    let pivot = large.min_by_key(|&(&column, _)| (column < of_nodes, column)).map(|(&column, _)| column);
    match pivot {
        Some(pivot) => Ok(Reduced { pivot, entries, multiplier, used }),
        None => Err(used),
    }
}

/// Multipliers with their rows of B: first the position constraints, then the velocity constraints that are not released.
fn rows(system: &System, state: &State) -> Vec<(usize, BTreeMap<usize, f64>)> {
    let layout = system.layout();
    let linearization = system.linearization_at(&state.kinematics);
    let pattern = system.pattern();
    let length = Representative::of(system, &state.kinematics, &linearization).length;
    // Angles as arcs: the geometric tolerance does not depend on units.
    let unit =
        |row: usize| if layout.quantities()[row] == Quantity::Angle && length > 0.0 { length } else { 1.0 };
    let row = |multiplier: usize| -> BTreeMap<usize, f64> {
        let column = layout.coordinate_count() + multiplier;
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        range
            .map(|position| (pattern.row_indices()[position], linearization.constraint[position]))
            .filter(|&(row, value)| row < layout.coordinate_count() && value != 0.0)
            .map(|(row, value)| (row, value / unit(row)))
            .collect()
    };
    let of_positions = (0..layout.multiplier_count).filter(|&own| !layout.is_of_velocities(own));
    let of_velocities = layout.of_velocities.iter().map(|&own| (own, row(own)));
    let acting = of_velocities.filter(|(_, row)| !row.is_empty());
    of_positions.map(|own| (own, row(own))).chain(acting).collect()
}
