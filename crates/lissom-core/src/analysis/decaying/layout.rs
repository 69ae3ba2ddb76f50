//! Numbering of the energy-decaying scheme's unknowns: jumps of all coordinates, glides of all coordinates,
//! multipliers of all constraints, and one multiplier per algebraic coordinate, which defines it after the
//! jump.

use std::sync::Arc;

use lissom_solver::{Group, Pattern, Structure};

use crate::joints::attached::AttachedJoint;
use crate::system::{LOCKED, System};

/// Pattern of the doubled system, and where its parts stand.
pub(crate) struct DoubledLayout {
    pub(crate) coordinates: usize,
    pub(crate) multipliers: usize,
    pub(crate) structure: Structure,
    /// For each entry of the single pattern between coordinates: its position there, and the positions of
    /// (jump, jump), (jump, glide), (glide, jump), (glide, glide).
    pub(crate) blocks: Vec<(usize, [usize; 4])>,
    /// For each joint, positions of its dense local matrix over [`local_rows`].
    pub(crate) joints: Vec<LocalPositions>,
    /// For each drive: (multiplier, glide), (glide, multiplier), and the augmented (glide, glide).
    pub(crate) drives: Vec<[usize; 3]>,
}

/// Rows and positions of a joint's local matrix.
pub(crate) struct LocalPositions {
    pub(crate) rows: Vec<u32>,
    pub(crate) positions: Vec<u32>,
}

impl DoubledLayout {
    pub(crate) fn new(system: &System) -> Self {
        let layout = system.layout();
        let count = layout.coordinate_count();
        let multipliers = layout.multiplier_rows().len();
        let size = 2 * count + multipliers + layout.coordinate_rows.len();
        let single = system.pattern();
        let joint_rows: Vec<Vec<u32>> = system
            .joints()
            .iter()
            .zip(&system.joint_rows)
            .map(|(joint, rows)| local_rows(joint, rows, count, multipliers))
            .collect();
        let mut entries = Vec::new();
        for column in 0..count {
            for &row in single.column(column).iter().filter(|&&row| row < count) {
                entries.extend([
                    (row, column),
                    (row, count + column),
                    (count + row, column),
                    (count + row, count + column),
                ]);
            }
        }
        for rows in &joint_rows {
            let free: Vec<usize> =
                rows.iter().filter(|&&row| row != LOCKED).map(|&row| row as usize).collect();
            entries.extend(free.iter().flat_map(|&row| free.iter().map(move |&column| (row, column))));
        }
        for drive in system.drives() {
            let coordinate = layout.row_of_coordinate(drive.prescribed.coordinate);
            let multiplier = 2 * count + drive.multiplier;
            entries.extend([(count + coordinate, multiplier), (multiplier, count + coordinate)]);
        }
        let pattern = Arc::new(Pattern::from_entries(size, entries));
        let at = |row: usize, column: usize| {
            pattern.position(row, column).expect("the pattern was made from these entries")
        };
        let mut blocks = Vec::new();
        for column in 0..count {
            let start = single.column_starts()[column];
            for (offset, &row) in single.column(column).iter().enumerate().filter(|&(_, &row)| row < count) {
                blocks.push((
                    start + offset,
                    [
                        at(row, column),
                        at(row, count + column),
                        at(count + row, column),
                        at(count + row, count + column),
                    ],
                ));
            }
        }
        let joints = joint_rows
            .into_iter()
            .map(|rows| LocalPositions { positions: crate::system::positions_of(&pattern, &rows), rows })
            .collect();
        let drives = system
            .drives()
            .iter()
            .map(|drive| {
                let coordinate = layout.row_of_coordinate(drive.prescribed.coordinate);
                let multiplier = 2 * count + drive.multiplier;
                [
                    at(multiplier, count + coordinate),
                    at(count + coordinate, multiplier),
                    at(count + coordinate, count + coordinate),
                ]
            })
            .collect();
        let groups = groups(system, count, multipliers);
        Self {
            coordinates: count,
            multipliers,
            structure: Structure { pattern, groups },
            blocks,
            joints,
            drives,
        }
    }

    pub(crate) fn size(&self) -> usize {
        self.structure.pattern.size()
    }

    /// Row of the multiplier that defines an algebraic coordinate after the jump.
    pub(crate) fn definition(&self, coordinate: usize) -> usize {
        2 * self.coordinates + self.multipliers + coordinate
    }

    /// The single system's unknown that `row` belongs to.
    pub(crate) fn single(&self, row: usize, system: &System) -> usize {
        let count = self.coordinates;
        if row < 2 * count {
            row % count
        } else if row < 2 * count + self.multipliers {
            row - count
        } else {
            system.layout().row_of_coordinate(row - 2 * count - self.multipliers)
        }
    }
}

/// A joint's local rows: jumps of its unknowns, glides, multipliers, definitions of its coordinates.
fn local_rows(joint: &AttachedJoint, rows: &[u32], count: usize, multipliers: usize) -> Vec<u32> {
    let unknowns = rows.len() - joint.equations();
    let shift = |row: u32, by: usize| if row == LOCKED { LOCKED } else { row + by as u32 };
    let jumps = rows[..unknowns].iter().copied();
    let glides = rows[..unknowns].iter().map(|&row| shift(row, count));
    let own = rows[unknowns..].iter().map(|&row| row + count as u32);
    let definitions =
        joint.coordinates.iter().map(|&coordinate| (2 * count + multipliers + coordinate) as u32);
    jumps.chain(glides).chain(own).chain(definitions).collect()
}

/// The groups of the single system, doubled; a joint's definitions go before its multipliers.
fn groups(system: &System, count: usize, multipliers: usize) -> Vec<Group> {
    let mut groups: Vec<Group> = system
        .structure()
        .groups
        .iter()
        .map(|group| {
            let double = |&row: &usize| if row < count { vec![row] } else { vec![] };
            let mut unknowns: Vec<usize> = group.unknowns.iter().flat_map(double).collect();
            let glides: Vec<usize> = unknowns.iter().map(|row| row + count).collect();
            unknowns.extend(glides);
            unknowns.extend(group.unknowns.iter().filter(|&&row| row >= count).map(|row| row + count));
            Group { unknowns, hosts: group.hosts.clone() }
        })
        .collect();
    for joint in system.joints() {
        let first = 2 * count + joint.first_multiplier;
        if let Some(group) = groups.iter_mut().find(|group| group.unknowns.contains(&first)) {
            let definitions = joint.coordinates.iter().map(|coordinate| 2 * count + multipliers + coordinate);
            group.unknowns.splice(0..0, definitions);
        }
    }
    groups
}
