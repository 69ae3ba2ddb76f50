//! Columns and rows of an assembly's equations: translations and rotations of rigid groups, coordinates, and the equations of joints
//! and relations, all relative to the model's size.

use lissom_motion::Vector3;

use super::groups::Groups;
use crate::kinematics::{CoordinateId, GROUND, LOCKED, NodeId, Quantity};
use crate::system::System;

/// Node or coordinate of a row of the system's equations of motion.
#[derive(Clone, Copy)]
enum Owner {
    Node(NodeId, usize),
    Coordinate(CoordinateId),
}

/// Column and row indices.
pub(super) struct Columns<'a> {
    pub(super) system: &'a System,
    pub(super) groups: &'a Groups,
    owners: Vec<Owner>,
    /// Columns of the translations and rotations of every group.
    pub(super) of_group: Vec<[Option<usize>; 6]>,
    /// Column of every coordinate, after those of the groups.
    pub(super) of_coordinate: Vec<Option<usize>>,
    /// Multipliers of the equations in use. Those of drives are excluded, because driven coordinates are held.
    pub(super) rows: Vec<usize>,
    /// Number of all columns, and of those of groups.
    pub(super) count: [usize; 2],
}

impl<'a> Columns<'a> {
    pub(super) fn new(system: &'a System, groups: &'a Groups, held: &[CoordinateId]) -> Self {
        let layout = system.layout();
        let mut count = 0;
        let mut next = |is_free: bool| {
            count += usize::from(is_free);
            is_free.then(|| count - 1)
        };
        let of_group: Vec<[Option<usize>; 6]> =
            groups.all.iter().map(|group| group.free.map(&mut next)).collect();
        let is_free = |coordinate: CoordinateId| {
            layout.coordinate_quantity(coordinate) != Quantity::State && !held.contains(&coordinate)
        };
        let of_coordinate: Vec<Option<usize>> =
            layout.coordinates().map(|coordinate| next(is_free(coordinate))).collect();
        let driven: Vec<usize> = system.drives().iter().map(|drive| drive.multiplier).collect();
        let mut owners = vec![Owner::Node(GROUND, 0); layout.coordinate_count()];
        for node in layout.nodes() {
            for (k, &row) in layout.rows_of_node(node).iter().enumerate().filter(|(_, row)| **row != LOCKED) {
                owners[row as usize] = Owner::Node(node, k);
            }
        }
        for coordinate in layout.coordinates() {
            owners[layout.row_of_coordinate(coordinate)] = Owner::Coordinate(coordinate);
        }
        let is_closed =
            |multiplier: &usize| !driven.contains(multiplier) && !layout.is_of_velocities(*multiplier);
        let rows = (0..layout.multiplier_count).filter(is_closed).collect();
        let count = [count, of_group.as_flattened().iter().flatten().count()];
        Self { system, groups, owners, of_group, of_coordinate, rows, count }
    }

    /// Factor that makes a violation relative to the model's size.
    pub(super) fn row_scale(&self, multiplier: usize) -> f64 {
        let layout = self.system.layout();
        match layout.quantities()[layout.coordinate_count() + multiplier] {
            Quantity::Angle => 1.0,
            Quantity::Length | Quantity::State => self.groups.length.recip(),
        }
    }

    /// Change of a coordinate per unit of its column [m, rad].
    pub(super) fn unit(&self, coordinate: CoordinateId) -> f64 {
        match self.system.layout().coordinate_quantity(coordinate) {
            Quantity::Angle => 1.0,
            Quantity::Length | Quantity::State => self.groups.length,
        }
    }

    /// Passes the entries of B to `hand`: row, column, value. Without `values`, those of the system's sparsity pattern.
    pub(super) fn each_entry(&self, values: Option<&[f64]>, mut hand: impl FnMut(usize, usize, f64)) {
        let layout = self.system.layout();
        let pattern = self.system.pattern();
        for (row, &multiplier) in self.rows.iter().enumerate() {
            let (row, scale) = (self.count[0] + row, self.row_scale(multiplier));
            let column = layout.coordinate_count() + multiplier;
            for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                let unknown = pattern.row_indices()[position];
                if unknown >= layout.coordinate_count() {
                    continue;
                }
                let value = values.map_or(1.0, |values| scale * values[position]);
                match self.owners[unknown] {
                    Owner::Coordinate(coordinate) => {
                        if let Some(column) = self.of_coordinate[coordinate.index()] {
                            hand(row, column, value * self.unit(coordinate));
                        }
                    }
                    Owner::Node(node, freedom) => {
                        self.of_node((node, freedom), value, &mut |column, value| hand(row, column, value));
                    }
                }
            }
        }
    }

    /// Converts a derivative by a degree of freedom of a node to those of its group.
    fn of_node(&self, (node, freedom): (NodeId, usize), value: f64, hand: &mut dyn FnMut(usize, f64)) {
        let (index, place) = self.groups.of_node[node.index()];
        let group = &self.groups.all[index];
        let frame = group.nodes[place].1;
        let mut direction = Vector3::zeros();
        direction[freedom % 3] = value;
        let direction = frame.rotation.apply(&direction);
        let (force, moment) = if freedom < 3 {
            (direction, frame.position.cross(&direction))
        } else {
            (Vector3::zeros(), direction)
        };
        let length = self.groups.length;
        for k in 0..3 {
            if let Some(column) = self.of_group[index][k] {
                hand(column, force[k] * length);
            }
            if let Some(column) = self.of_group[index][3 + k] {
                hand(column, moment[k] * length / group.radius);
            }
        }
    }
}
