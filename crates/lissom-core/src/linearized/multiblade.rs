//! A rotor on an anisotropic support, in axes at rest [Coleman and Feingold 1958; Bir 2008].
//!
//! In the axes of its nodes the coefficients of such a model change with its angle of rotation ψ. They are constant if the
//! rotor is invariant under rotation by 1/N of a turn, N ≥ 3, and its displacements x are written as
//!
//! ```text
//! x = exp(-ψ G) z,    ẋ = exp(-ψ G) (ż - Ω G z),    ẍ = exp(-ψ G) (z̈ - 2Ω G ż + Ω² G² z)
//! ```
//!
//! G rotates the vectors of nodes on the axis, and shifts the pattern of displacements over the N equal nodes around it by
//! their discrete Fourier series: these are the multi-blade coordinates, represented by values at the blades.
//!
//! ```text
//! M z̈ + (D - 2Ω M G) ż + (K - Ω D G + Ω² M G²) z + Bᵀ μ = 0,    B z = 0
//! ```
//!
//! with the matrices of one azimuth. This is verified: every mode is substituted into the equations of another azimuth
//! ([`LinearModel::departure_of`]).

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_motion::{Motion, Rotation, Vector3};
use lissom_solver::{Pattern, Structure};
use num_complex::Complex64;

use super::generator::Generator;
use super::mode::Mode;
use super::model::LinearModel;
use crate::kinematics::{Kinematics, LOCKED, NodeId};
use crate::round_off;

/// Maximum number of blades.
pub(super) const MAX_BLADES: usize = 12;

/// Why there are no multi-blade coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoMultiblade {
    /// Parts rotate at different rates or about different axes.
    SeveralAxes,
    /// The rotor is not invariant under rotation by a fraction of a turn.
    NotPeriodic,
    /// It is only invariant under half a turn: coefficients are periodic in all coordinates.
    TwoBlades,
}

impl NoMultiblade {
    /// The reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::SeveralAxes => "its parts rotate at different rates or about different axes",
            Self::NotPeriodic => "the rotor is not periodic over a third of a revolution or less",
            Self::TwoBlades => "a rotor of two blades has no constant coefficients in any coordinates",
        }
    }
}

impl<'a> LinearModel<'a> {
    /// This model in axes at rest, with the multi-blade coordinates of its rotor: the frequencies of its modes are those
    /// in these axes. They are valid only if [`departure_of`](Self::departure_of) confirms them.
    ///
    /// # Errors
    /// If the rotor has no such coordinates.
    pub fn in_axes_at_rest(&self) -> Result<LinearModel<'a>, NoMultiblade> {
        Ok(self.in_axes_of(generator(self)?))
    }

    /// This model in other axes.
    pub(super) fn in_axes_of(&self, generator: Generator) -> LinearModel<'a> {
        let pattern = self.pattern();
        let (mut damping, mut stiffness) = (BTreeMap::new(), BTreeMap::new());
        let rate = generator.rate;
        generator.multiply((&pattern, &self.parts.mass), -2.0 * rate, &mut damping);
        generator.multiply((&pattern, &self.parts.damping), -rate, &mut stiffness);
        generator.squared().multiply((&pattern, &self.parts.mass), rate * rate, &mut stiffness);
        let own = (0..pattern.size())
            .flat_map(|column| pattern.column(column).iter().map(move |&row| (row, column)));
        let added = damping.keys().chain(stiffness.keys()).map(|&(column, row)| (row, column));
        let wide = Pattern::from_entries(pattern.size(), own.chain(added));
        let widened = |values: &[f64], added: &BTreeMap<(usize, usize), f64>| {
            let mut wider = vec![0.0; wide.entries()];
            let mut add = |row: usize, column: usize, value: f64| {
                if let Some(at) = wide.position(row, column) {
                    wider[at] += value;
                }
            };
            for column in 0..pattern.size() {
                for at in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                    add(pattern.row_indices()[at], column, values[at]);
                }
            }
            for (&(column, row), &value) in added {
                add(row, column, value);
            }
            wider
        };
        let nothing = BTreeMap::new();
        let mut parts = self.system.empty_linearization();
        parts.mass = widened(&self.parts.mass, &nothing);
        parts.damping = widened(&self.parts.damping, &damping);
        parts.stiffness = widened(&self.parts.stiffness, &stiffness);
        parts.gram = widened(&self.parts.gram, &nothing);
        parts.constraint = widened(&self.parts.constraint, &nothing);
        let groups = self.structure().groups.clone();
        let structure = Structure { pattern: Arc::new(wide), groups };
        self.with_generator(parts, structure, generator)
    }

    /// Degree to which a mode in axes at rest moves with the rotation or against it: 1 for a circle in its sense, 0 for none.
    pub(super) fn sense_at_rest(&self, generator: &Generator, mode: &Mode) -> f64 {
        let count = self.coordinate_count();
        let pattern = self.pattern();
        let weighed = |vector: &[Complex64]| {
            let mut sum = vec![Complex64::default(); count];
            for (column, value) in vector.iter().enumerate() {
                for at in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                    let row = pattern.row_indices()[at];
                    if row < count {
                        sum[row] += value * self.parts.mass[at];
                    }
                }
            }
            sum
        };
        let product = |a: &[Complex64], b: &[Complex64]| -> Complex64 {
            a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
        };
        let whole = product(&mode.shape, &weighed(&mode.shape)).re;
        let round = product(&mode.shape, &weighed(&generator.apply(&mode.shape))).im;
        if whole > 0.0 { round / whole } else { 0.0 }
    }
}

/// Axis of rotation: a position on it, its direction, and the rate; and the nodes that rotate.
struct Axis {
    place: Vector3,
    direction: Vector3,
    rate: f64,
    turns: Vec<bool>,
    length: f64,
}

impl Axis {
    fn of(model: &LinearModel<'_>) -> Result<Self, NoMultiblade> {
        let spin = model.spin();
        let rate = spin.norm();
        let (at, length) = (model.kinematics(), model.length());
        if rate == 0.0 {
            return Err(NoMultiblade::SeveralAxes);
        }
        let direction = spin / rate;
        let mut place = None;
        let mut turns = Vec::with_capacity(at.nodes.len());
        for node in &at.nodes {
            let own = node.angular_velocity();
            if own.norm() <= round_off::GIVEN * rate {
                turns.push(false);
                continue;
            }
            let velocity = node.frame.rotation.apply(&node.twist.fixed_rows::<3>(0).into_owned());
            if (own - spin).norm() > round_off::GIVEN * rate
                || velocity.dot(&direction).abs() > round_off::GIVEN * rate * length
            {
                return Err(NoMultiblade::SeveralAxes);
            }
            // ω × (x - c) = v
            let center = node.frame.position + direction.cross(&velocity) / rate;
            let known: &Vector3 = place.get_or_insert(center);
            let apart = center - known;
            if (apart - direction * apart.dot(&direction)).norm() > round_off::GIVEN * length {
                return Err(NoMultiblade::SeveralAxes);
            }
            turns.push(true);
        }
        let place = place.unwrap_or_else(Vector3::zeros);
        Ok(Self { place, direction, rate, turns, length })
    }

    /// The rotation about the axis by an angle.
    fn rotation(&self, angle: f64) -> Motion {
        let rotation = Rotation::exponential(&(self.direction * angle));
        Motion::new(rotation, self.place - rotation.apply(&self.place))
    }

    fn is_on(&self, place: &Vector3) -> bool {
        let apart = place - self.place;
        (apart - self.direction * apart.dot(&self.direction)).norm() <= round_off::GIVEN * self.length
    }

    /// The node at the position of each rotating node off the axis after 1/`blades` of a turn; none if there is no such node.
    fn images(&self, at: &Kinematics, blades: usize) -> Option<Vec<Option<NodeId>>> {
        let part = self.rotation(std::f64::consts::TAU / blades as f64);
        // By the position along the axis and the distance from it, so that few are compared.
        let mut near: BTreeMap<i64, Vec<NodeId>> = BTreeMap::new();
        let cell = |place: &Vector3| {
            let height = (place - self.place).dot(&self.direction);
            (height / (round_off::GIVEN * self.length).max(f64::MIN_POSITIVE) * 1e-2).round() as i64
        };
        for node in self.beside(at) {
            near.entry(cell(&at.nodes[node].frame.position)).or_default().push(node);
        }
        let mut images = vec![None; at.nodes.len()];
        let mut taken = vec![false; at.nodes.len()];
        for node in self.beside(at) {
            let moved = part * at.nodes[node].frame;
            let own = cell(&moved.position);
            let candidates = (own - 1..=own + 1).filter_map(|cell| near.get(&cell)).flatten();
            let image = candidates.copied().find(|&other| {
                let change = at.nodes[other].frame.relative_to(&moved).logarithm();
                !taken[other.index()]
                    && (0..6)
                        .all(|k| change[k].abs() <= round_off::GIVEN * if k < 3 { self.length } else { 1.0 })
            })?;
            taken[image.index()] = true;
            images[node.index()] = Some(image);
        }
        Some(images)
    }

    fn beside<'k>(&'k self, at: &'k Kinematics) -> impl Iterator<Item = NodeId> + 'k {
        let turning = NodeId::first(at.nodes.len()).filter(|node| self.turns[node.index()]);
        turning.filter(|&node| !self.is_on(&at.nodes[node].frame.position))
    }
}

/// Generator for a rotor that is invariant under rotation by 1/N of a turn, for the largest such N.
pub(super) fn generator(model: &LinearModel<'_>) -> Result<Generator, NoMultiblade> {
    let axis = Axis::of(model)?;
    let at = model.kinematics();
    let mut columns = vec![Vec::new(); model.coordinate_count()];
    on_the_axis(model, &axis, &mut columns);
    let generator = |columns| Ok(Generator { columns, rate: axis.rate });
    if axis.beside(at).next().is_none() {
        return generator(columns);
    }
    let Some((blades, images)) =
        (2..=MAX_BLADES).rev().find_map(|blades| Some((blades, axis.images(at, blades)?)))
    else {
        return Err(NoMultiblade::NotPeriodic);
    };
    if blades < 3 {
        return Err(NoMultiblade::TwoBlades);
    }
    let layout = model.system().layout();
    for first in axis.beside(at) {
        let orbit = orbit(first, blades, &|node| images[node.index()]);
        let Some(orbit) = orbit.filter(|orbit| orbit.iter().all(|&node| node >= first)) else { continue };
        let rows: Vec<[u32; 6]> = orbit.iter().map(|&node| *layout.rows_of_node(node)).collect();
        for k in 0..6 {
            let own: Vec<usize> =
                rows.iter().filter(|rows| rows[k] != LOCKED).map(|rows| rows[k] as usize).collect();
            around(&own, blades, &mut columns);
        }
    }
    // Coordinates of joints between nodes that are mapped to each other.
    let joints = model.system().joints();
    let image_of = |node: NodeId| {
        images[node.index()]
            .or((!axis.turns[node.index()] || axis.is_on(&at.nodes[node].frame.position)).then_some(node))
    };
    let image = |joint: usize| {
        let [base, tip] = [0, 1].map(|side| image_of(joints[joint].frames[side].node));
        let (base, tip) = (base?, tip?);
        let like = |other: &&usize| {
            let other = &joints[**other];
            other.kind == joints[joint].kind && other.frames[0].node == base && other.frames[1].node == tip
        };
        let all: Vec<usize> = (0..joints.len()).collect();
        all.iter().find(like).copied()
    };
    for first in (0..joints.len()).filter(|&joint| !joints[joint].coordinates.is_empty()) {
        let Some(orbit) = orbit(first, blades, &image) else { continue };
        if orbit
            .iter()
            .any(|&joint| joint < first || joints[joint].coordinates.len() != joints[first].coordinates.len())
        {
            continue;
        }
        for k in 0..joints[first].coordinates.len() {
            let own: Vec<usize> =
                orbit.iter().map(|&joint| layout.row_of_coordinate(joints[joint].coordinates[k])).collect();
            around(&own, blades, &mut columns);
        }
    }
    generator(columns)
}

/// Nodes to which `first` is mapped by repeated rotations by 1/`blades` of a turn, if the sequence is closed; none for a fixed node.
fn orbit<T: Copy + Ord>(first: T, blades: usize, image: &dyn Fn(T) -> Option<T>) -> Option<Vec<T>> {
    let mut orbit = vec![first];
    for _ in 1..blades {
        orbit.push(image(*orbit.last()?)?);
    }
    let comes_back = image(*orbit.last()?)? == first;
    let mut sorted = orbit.clone();
    sorted.sort_unstable();
    sorted.dedup();
    (comes_back && sorted.len() == blades).then_some(orbit)
}

/// Adds the rotation of vectors of nodes on the axis.
fn on_the_axis(model: &LinearModel<'_>, axis: &Axis, columns: &mut [Vec<(usize, f64)>]) {
    let layout = model.system().layout();
    for (node, motion) in NodeId::enumerate(&model.kinematics().nodes) {
        if !axis.turns[node.index()] || !axis.is_on(&motion.frame.position) {
            continue;
        }
        let rows = layout.rows_of_node(node);
        let own = motion.frame.rotation.apply_inverse(&axis.direction);
        let turning = own.cross_matrix();
        for first in [0, 3] {
            for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                let (row, column) = (rows[first + i], rows[first + j]);
                if row != LOCKED && column != LOCKED && turning[(i, j)] != 0.0 {
                    columns[column as usize].push((row as usize, turning[(i, j)]));
                }
            }
        }
    }
}

/// Adds the shift of values at equal angles, in the order of the rotation, by their Fourier series.
fn around(rows: &[usize], blades: usize, columns: &mut [Vec<(usize, f64)>]) {
    if rows.len() != blades {
        return;
    }
    let part = std::f64::consts::TAU / blades as f64;
    for (b, &row) in rows.iter().enumerate() {
        for (c, &column) in rows.iter().enumerate() {
            let angle = (b as f64 - c as f64) * part;
            let harmonics = 1..=(blades - 1) / 2;
            let sum: f64 = harmonics.map(|n| n as f64 * (n as f64 * angle).sin()).sum();
            let value = 2.0 / blades as f64 * sum;
            if value != 0.0 {
                columns[column].push((row, value));
            }
        }
    }
}
