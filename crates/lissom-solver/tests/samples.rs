//! Saddle-point systems like those of mechanisms, for tests and benches: nodes of six coordinates in elements, joints
//! with a coordinate of their own on which only constraints act, and multipliers. Random values; independent of any
//! solver.

#![allow(dead_code, unreachable_pub, reason = "a module of several programs, each of which uses a part")]

use std::sync::Arc;

use num_complex::Complex64;

use lissom_solver::{Group, Pattern, Scalar, Structure};

/// Small random numbers in (-1, 1), reproducible on every platform (`SplitMix64`, Steele et al. 2014).
pub struct Random(
    /// State; any initial value is valid.
    pub u64,
);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }
    /// The next number in (-1, 1).
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    /// The next index below the bound.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }
    /// Puts items in random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for index in (1..items.len()).rev() {
            items.swap(index, self.below(index + 1));
        }
    }
}

/// Kinds of numbers that can be drawn at random.
pub trait Sample: Scalar {
    /// The next number, its parts in (-1, 1).
    fn sample(random: &mut Random) -> Self;
}
impl Sample for f64 {
    fn sample(random: &mut Random) -> f64 {
        random.number()
    }
}
impl Sample for Complex64 {
    fn sample(random: &mut Random) -> Complex64 {
        Complex64::new(random.number(), 0.3 * random.number())
    }
}

/// Constraint equations.
pub struct Constraint {
    /// Unknowns on which its equations act.
    pub coordinates: Vec<usize>,
    /// Unknowns to which its equations belong.
    pub multipliers: Vec<usize>,
}

/// Groups, elements and constraints of a sample matrix.
#[derive(Default)]
pub struct Model {
    /// Groups of unknowns, numbered as they were added.
    pub groups: Vec<Group>,
    /// Number of unknowns.
    pub size: usize,
    /// Unknowns of each element; its matrix is definite.
    pub elements: Vec<Vec<usize>>,
    /// Constraints between coordinates without stiffness.
    pub constraints: Vec<Constraint>,
    /// Relative coordinates of joints: no element acts on them.
    pub massless: Vec<usize>,
}

impl Model {
    /// Adds a group of `count` unknowns.
    pub fn group(&mut self, count: usize, hosts: &[usize]) -> usize {
        let unknowns = (self.size..self.size + count).collect();
        self.size += count;
        self.groups.push(Group { unknowns, hosts: hosts.to_vec() });
        self.groups.len() - 1
    }

    /// Adds a group of six coordinates.
    pub fn node(&mut self) -> usize {
        self.group(6, &[])
    }

    fn unknowns(&self, groups: &[usize]) -> Vec<usize> {
        groups.iter().flat_map(|&group| self.groups[group].unknowns.iter().copied()).collect()
    }

    /// Couples groups by a definite matrix.
    pub fn element(&mut self, nodes: &[usize]) {
        let unknowns = self.unknowns(nodes);
        self.elements.push(unknowns);
    }

    /// Adds constraint equations on groups, and the group of their multipliers.
    pub fn constrain(&mut self, hosts: &[usize], equations: usize) -> usize {
        let group = self.group(equations, hosts);
        let coordinates = self.unknowns(hosts);
        let multipliers = self.groups[group].unknowns.clone();
        self.constraints.push(Constraint { coordinates, multipliers });
        group
    }

    /// A revolute joint: six equations between two nodes and a massless angle.
    pub fn joint(&mut self, first: usize, second: usize) -> usize {
        let angle = self.group(1, &[]);
        self.massless.push(self.groups[angle].unknowns[0]);
        self.constrain(&[first, second, angle], 6);
        angle
    }

    /// Consecutive cubic beam elements from a node; returns the last node.
    pub fn beam(&mut self, from: usize, elements: usize) -> usize {
        (0..elements).fold(from, |start, _| {
            let nodes = [start, self.node(), self.node(), self.node()];
            self.element(&nodes);
            nodes[3]
        })
    }

    /// Pattern and groups.
    ///
    /// # Panics
    /// If the hosts of the groups are not valid.
    pub fn structure(&self) -> Structure {
        let coupled: Vec<Vec<usize>> = self
            .constraints
            .iter()
            .map(|constraint| [&constraint.coordinates[..], &constraint.multipliers].concat())
            .collect();
        let cliques = self.elements.iter().chain(&coupled).map(|clique| &clique[..]);
        let pattern = Arc::new(Pattern::from_cliques(self.size, cliques));
        Structure::new(pattern, self.groups.clone()).expect("the model is well formed")
    }

    /// Values of `[A + p BᵀB, Bᵀ; B, 0]`: each element adds a definite, slightly unsymmetric matrix to A.
    ///
    /// # Panics
    /// If the pattern is not that of the model.
    pub fn values<S: Sample>(&self, pattern: &Pattern, seed: u64, penalty: f64) -> Vec<S> {
        let mut random = Random(seed);
        let mut values = vec![S::zero(); pattern.entries()];
        let mut add = |row: usize, column: usize, value: S| {
            values[pattern.position(row, column).expect("in the pattern")] += value;
        };
        for unknowns in &self.elements {
            let count = unknowns.len();
            let half: Vec<S> = (0..count * count).map(|_| S::sample(&mut random)).collect();
            for (i, &row) in unknowns.iter().enumerate() {
                for (j, &column) in unknowns.iter().enumerate() {
                    let sum =
                        (0..count).fold(S::zero(), |sum, k| sum + half[i * count + k] * half[j * count + k]);
                    let skew = S::sample(&mut random) * S::from_real(0.1);
                    let diagonal = if i == j { S::one() } else { S::zero() };
                    add(row, column, sum * S::from_real(1.0 / count as f64) + skew + diagonal);
                }
            }
        }
        for Constraint { coordinates, multipliers } in &self.constraints {
            let gradient: Vec<Vec<S>> = multipliers
                .iter()
                .map(|_| coordinates.iter().map(|_| S::sample(&mut random)).collect())
                .collect();
            for (row, &multiplier) in gradient.iter().zip(multipliers) {
                for (&value, &coordinate) in row.iter().zip(coordinates) {
                    add(multiplier, coordinate, value);
                    add(coordinate, multiplier, value);
                    for (&other, &column) in row.iter().zip(coordinates) {
                        add(coordinate, column, value * other * S::from_real(penalty));
                    }
                }
            }
        }
        values
    }
}

/// Cubic beams in a row, a revolute joint after every eight elements, the first one driven.
pub fn chain(unknowns: usize) -> Model {
    let mut model = Model::default();
    let mut last = model.node();
    let mut elements = 0;
    while model.size + 12 < unknowns.max(24) {
        last = model.beam(last, 1);
        elements += 1;
        if elements % 8 == 0 {
            let next = model.node();
            let angle = model.joint(last, next);
            if elements == 8 {
                model.constrain(&[angle], 1);
            }
            last = next;
        }
    }
    model
}

/// A binary tree of beams of two elements, one of the two branches at every fork on a joint.
pub fn tree(unknowns: usize) -> Model {
    let mut model = Model::default();
    let mut tips = vec![model.node()];
    let mut next = 0;
    while model.size + 12 < unknowns.max(90) {
        let fork = tips[next];
        next += 1;
        let rigid = model.beam(fork, 2);
        let hinge = model.node();
        model.joint(fork, hinge);
        let hinged = model.beam(hinge, 2);
        tips.extend([rigid, hinged]);
    }
    model
}

/// Rigid bodies in a row on spherical joints, the first one held.
pub fn spherical_chain(unknowns: usize) -> Model {
    let mut model = Model::default();
    let mut last = None;
    while model.size + 9 <= unknowns.max(9) {
        let next = model.node();
        model.element(&[next]);
        let hosts: Vec<usize> = last.into_iter().chain([next]).collect();
        model.constrain(&hosts, 3);
        last = Some(next);
    }
    model
}

/// Beams of two nodes in a row.
pub fn two_node_beam(unknowns: usize) -> Model {
    let mut model = Model::default();
    let mut last = model.node();
    while model.size + 6 <= unknowns.max(12) {
        let next = model.node();
        model.element(&[last, next]);
        last = next;
    }
    model
}

/// A plane frame of beams of two nodes.
pub fn grid(unknowns: usize) -> Model {
    let side = ((unknowns as f64 / 6.0).sqrt().round() as usize).max(2);
    let mut model = Model::default();
    let nodes: Vec<usize> = (0..side * side).map(|_| model.node()).collect();
    for row in 0..side {
        for column in 0..side {
            let here = nodes[row * side + column];
            if column + 1 < side {
                model.element(&[here, nodes[row * side + column + 1]]);
            }
            if row + 1 < side {
                model.element(&[here, nodes[(row + 1) * side + column]]);
            }
        }
    }
    model
}

/// A chain whose last node is joined to its first.
///
/// # Panics
/// Never: a chain has nodes.
pub fn closed_loop(unknowns: usize) -> Model {
    let mut model = chain(unknowns.saturating_sub(7));
    let is_node = |group: &Group| group.hosts.is_empty() && group.unknowns.len() == 6;
    let last = model.groups.iter().rposition(is_node);
    model.joint(last.expect("a node"), 0);
    model
}

/// Residual relative to the expected round-off of its terms: `max |b - A x| / (‖A‖ ‖x‖ + ‖b‖)` in the maximum norm.
pub fn backward_error<S: Scalar>(pattern: &Pattern, values: &[S], x: &[S], b: &[S], transposed: bool) -> f64 {
    let mut product = vec![S::zero(); b.len()];
    let sizes: Vec<f64> = values.iter().map(|value| value.magnitude()).collect();
    let mut row_sums = vec![0.0; b.len()];
    if transposed {
        for column in 0..pattern.size() {
            for entry in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
                product[column] += values[entry] * x[pattern.row_indices()[entry]];
                row_sums[column] += sizes[entry];
            }
        }
    } else {
        pattern.multiply(values, x, &mut product);
        pattern.multiply(&sizes, &vec![1.0; b.len()], &mut row_sums);
    }
    let largest = |numbers: &[S]| numbers.iter().fold(0.0, |largest: f64, x| largest.max(x.magnitude()));
    let norm = row_sums.iter().fold(0.0, |largest: f64, &sum| largest.max(sum));
    let residual: Vec<S> = product.iter().zip(b).map(|(&product, &b)| b - product).collect();
    let error = largest(&residual) / (norm * largest(x) + largest(b));
    if error.is_finite() { error } else { f64::INFINITY }
}

/// Random numbers.
pub fn right_hand_side<S: Sample>(size: usize, seed: u64) -> Vec<S> {
    let mut random = Random(seed);
    (0..size).map(|_| S::sample(&mut random)).collect()
}
