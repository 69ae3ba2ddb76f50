//! Shapes of modes in global axes: displacement and rotation of every node, kinetic energy by part.

use std::collections::BTreeMap;

use lissom_motion::Vector3;
use num_complex::Complex64;

use super::mode::Mode;
use super::model::LinearModel;
use crate::elements::contribution::CoordinateMass;
use crate::kinematics::LOCKED;

/// Motion of a node in a mode, in global axes.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeShape {
    /// Name of the node.
    pub node: String,
    /// Position of the node in the state about which the mode oscillates [m].
    pub position: [f64; 3],
    /// Displacement [m, for unit modal mass].
    pub displacement: [Complex64; 3],
    /// Rotation [rad, for unit modal mass].
    pub rotation: [Complex64; 3],
}

impl LinearModel<'_> {
    /// The shape of a mode at every node except the ground.
    pub fn shape(&self, mode: &Mode) -> Vec<NodeShape> {
        self.complex_shape(&mode.shape)
    }

    /// Shape at every node except the ground of real displacements and rotations by row.
    pub fn shape_of(&self, rows: &[f64]) -> Vec<NodeShape> {
        let rows: Vec<Complex64> = rows.iter().copied().map(Complex64::from).collect();
        self.complex_shape(&rows)
    }

    /// Largest rotation of a node relative to the other model's state [rad].
    pub fn largest_turn(&self, other: &LinearModel<'_>) -> f64 {
        let nodes = self.at.nodes.iter().zip(&other.at.nodes);
        nodes.fold(0.0, |most, (one, two)| {
            let turn = one.frame.rotation.inverse() * two.frame.rotation;
            f64::max(most, turn.logarithm().norm())
        })
    }

    fn complex_shape(&self, values: &[Complex64]) -> Vec<NodeShape> {
        let layout = self.system.layout();
        layout
            .nodes()
            .skip(1)
            .map(|node| {
                let frame = self.at.nodes[node].frame;
                let rows = layout.rows_of_node(node);
                let turned = |first: usize| {
                    let part = |take: fn(&Complex64) -> f64| {
                        let own = Vector3::from_fn(|k, _| match rows[first + k] {
                            LOCKED => 0.0,
                            row => take(&values[row as usize]),
                        });
                        frame.rotation.apply(&own)
                    };
                    let (real, imaginary) = (part(|value| value.re), part(|value| value.im));
                    [0, 1, 2].map(|k| Complex64::new(real[k], imaginary[k]))
                };
                NodeShape {
                    node: layout.node_name(node).to_owned(),
                    position: [frame.position.x, frame.position.y, frame.position.z],
                    displacement: turned(0),
                    rotation: turned(3),
                }
            })
            .collect()
    }

    /// Share of each part in the kinetic energy of a mode, by name: a beam is one part, and so is a body. The sum is
    /// 1.
    pub fn kinetic_shares(&self, mode: &Mode) -> BTreeMap<String, f64> {
        let layout = self.system.layout();
        let mut shares = BTreeMap::new();
        for inertia in self.system.inertias() {
            let rows = layout.rows_of_node(inertia.node());
            let value = |k: usize| match rows[k] {
                LOCKED => Complex64::default(),
                row => mode.shape[row as usize],
            };
            let energy: f64 = (0..6)
                .flat_map(|i| (0..6).map(move |j| (i, j)))
                .map(|(i, j)| (value(i).conj() * inertia.mass()[(i, j)] * value(j)).re)
                .sum();
            *shares.entry(part_of(layout.node_name(inertia.node())).to_owned()).or_insert(0.0) += energy;
        }
        self.system.masses(&self.at, &mut |mass| {
            let value =
                |&row: &u32| if row == LOCKED { Complex64::default() } else { mode.shape[row as usize] };
            let local: Vec<Complex64> = mass.rows.iter().map(value).collect();
            let mut energy = 0.0;
            mass.times(&local, |row, momentum: Complex64| energy += (local[row].conj() * momentum).re);
            let name = mass.nodes.first().map_or("", |&node| part_of(layout.node_name(node)));
            *shares.entry(name.to_owned()).or_insert(0.0) += energy;
        });
        for CoordinateMass { coordinates, matrix } in &self.system.coordinate_masses {
            let value = |k: usize| mode.shape[layout.row_of_coordinate(coordinates[k])];
            for (i, &own) in coordinates.iter().enumerate() {
                let products =
                    (0..coordinates.len()).map(|j| (value(i).conj() * matrix[(i, j)] * value(j)).re);
                let name = layout.coordinate_name(own).to_owned();
                *shares.entry(name).or_insert(0.0) += products.sum::<f64>();
            }
        }
        let total: f64 = shares.values().sum();
        if total > 0.0 {
            for share in shares.values_mut() {
                *share /= total;
            }
        }
        shares
    }
}

/// The part of a node: the beam of `beam@0.5`, `beam.start` or `beam.end`, or the body itself.
pub(super) fn part_of(node: &str) -> &str {
    let base = node.split_once('@').map_or(node, |(beam, _)| beam);
    base.strip_suffix(".start").or_else(|| base.strip_suffix(".end")).unwrap_or(base)
}
