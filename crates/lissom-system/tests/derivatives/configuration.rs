//! Random configurations to differentiate at, and high-order differences.

use std::sync::Arc;

use lissom_mechanics::joints::evaluation_point::{Augmentation, Increments, Point};
use lissom_mechanics::kinematics::{
    CoordinateId, DiscreteValueId, Kinematics, LOCKED, Layout, MotionChange, NodeId,
};
use lissom_mechanics::registry::{
    Constant, ForceFunction, Parameter, ParameterType, Parameters, TimeFunction, Value,
};
use lissom_mechanics::relation::{Relation, RelationPoint};
use lissom_motion::{Matrix6, Motion, Vector3, Vector6};
use lissom_system::{State, System};
use nalgebra::DMatrix;

/// A small generator of numbers in -1 … 1 that is the same on every machine.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self) -> Vector3 {
        Vector3::from_fn(|_, _| self.number())
    }

    pub(crate) fn screw(&mut self) -> Vector6 {
        Vector6::from_fn(|_, _| self.number())
    }

    pub(crate) fn motion(&mut self) -> Motion {
        Motion::exponential(&(1.5 * self.screw()))
    }
}

#[derive(Debug)]
pub(crate) struct Wave;

impl TimeFunction for Wave {
    fn value(&self, time: f64) -> f64 {
        0.4 + (1.3 * time).sin()
    }
    fn first_derivative(&self, time: f64) -> f64 {
        1.3 * (1.3 * time).cos()
    }
    fn second_derivative(&self, time: f64) -> f64 {
        -1.69 * (1.3 * time).sin()
    }
}

#[derive(Debug)]
struct Waves(f64);

impl ForceFunction for Waves {
    fn evaluate(&self, first: f64, second: f64) -> [f64; 3] {
        let [by_first, by_second] = [1.1 * self.0, 0.7 * self.0];
        let (a, b) = (by_first * first + 0.3, by_second * second + 0.2);
        [a.sin() * b.cos(), by_first * a.cos() * b.cos(), -by_second * a.sin() * b.sin()]
    }
    fn depends_on_second(&self) -> bool {
        true
    }
}

/// sin(q₀) q₁ + t q₀ + t² + q₁.
#[derive(Debug)]
pub(crate) struct Bent;

impl Relation for Bent {
    fn jet(&self, (time, q): RelationPoint<'_>, (of_time, v): RelationPoint<'_>) -> [f64; 3] {
        let (sine, cosine) = q[0].sin_cos();
        [
            sine * q[1] + time * q[0] + time * time + q[1],
            cosine * v[0] * q[1] + sine * v[1] + of_time * q[0] + time * v[0] + 2.0 * time * of_time + v[1],
            -sine * v[0] * v[0] * q[1] + 2.0 * (cosine * v[0] * v[1] + of_time * v[0] + of_time * of_time),
        ]
    }
}

/// Free play would leave most configurations without force; the others are another way to give `dissipation`.
/// Wheels touch the plane whatever their size; those that are round or creep are looked at apart.
/// A preload is another way to give the rest of a spring.
const LEFT_OUT: [&str; 24] = [
    "preload",
    "traction",
    "backlash",
    "restitution",
    "impact_velocity",
    "radius",
    "rim",
    "friction_coefficient",
    "creep",
    "axle",
    "cone_angle",
    "cant",
    "offset",
    "wheel_profile",
    "rail_profile",
    "tread",
    "shear_modulus",
    "poisson_number",
    "kalker",
    "ellipse",
    "velocity",
    "wheel_spin",
    "directions",
    "free",
];

/// A value for every parameter of a kind.
pub(crate) fn sample_parameters(parameters: &[Parameter], flag: bool, random: &mut Random) -> Parameters {
    let mut result = Parameters::new();
    for parameter in parameters.iter().filter(|own| !LEFT_OUT.contains(&own.name) || own.required) {
        let value = match parameter.holds {
            ParameterType::Positive if parameter.name == "exponent" => Value::Number(1.7),
            // Wider than the random positions, and longer than films may be.
            ParameterType::Positive if ["clearance", "radius"].contains(&parameter.name) => {
                Value::Number(20.0)
            }
            ParameterType::Number => Value::Number(random.number()),
            ParameterType::Between(low, high) => Value::Number(low + (high - low) * random.number().abs()),
            ParameterType::Positive | ParameterType::NotNegative => Value::Number(1.5 + random.number()),
            ParameterType::Vector
            | ParameterType::GlobalVector
            | ParameterType::Direction
            | ParameterType::DirectionOr(_) => Value::Vector(random.vector()),
            ParameterType::Flag => Value::Flag(flag),
            ParameterType::Function | ParameterType::Size => {
                Value::Function(if flag { Arc::new(Wave) } else { Arc::new(Constant(0.6)) })
            }
            ParameterType::Force(_) => Value::Force(Arc::new(Waves(1.0))),
            // Long waves, so that differences are exact enough.
            ParameterType::HeightField => Value::Force(Arc::new(Waves(0.2))),
            // They replace other parameters; a test of their own gives them.
            ParameterType::Coefficients => continue,
            // Only for coefficients.
            _ if parameter.name == "mounted" => continue,
            // Differences do not see kinks; tests of their own do. Stops are touched.
            ParameterType::Range if parameter.name == "range" => Value::Range([-3.0, -2.0]),
            ParameterType::Matrix => {
                let root = Matrix6::from_fn(|_, _| random.number());
                Value::Matrix(Box::new(root * root.transpose()))
            }
            ParameterType::Numbers => Value::Numbers(vec![random.number(), random.number()]),
            ParameterType::SquareMatrix => {
                let root = DMatrix::from_fn(2, 2, |_, _| random.number());
                Value::SquareMatrix(if parameter.name == "mass" { &root * root.transpose() } else { root })
            }
            ParameterType::Range => Value::Range([-1e3, 1e3]),
            ParameterType::Choice(words) if flag && ["form", "film"].contains(&parameter.name) => {
                Value::Text(words[1].to_owned())
            }
            ParameterType::Choice(words) => Value::Text(words[0].to_owned()),
            ParameterType::FunctionOf(_) => Value::Function(Arc::new(Wave)),
            ParameterType::Input => Value::Input(DiscreteValueId::new(0)),
            ParameterType::Equation => Value::Relation(Arc::new(Bent)),
            ParameterType::Choices(words) => {
                let chosen = words.iter().filter(|_| random.number() > 0.0);
                let mut chosen: Vec<String> = chosen.map(|&word| word.to_owned()).collect();
                if chosen.is_empty() {
                    chosen.push(words[0].to_owned());
                }
                Value::Words(chosen)
            }
        };
        result.insert(parameter.name, value);
    }
    result
}

/// A configuration some way from the start of a step, with everything moving.
pub(crate) struct Configuration {
    pub(crate) start: Kinematics,
    pub(crate) at: Kinematics,
    pub(crate) node_increments: Vec<Vector6>,
    pub(crate) changes: Vec<MotionChange>,
    pub(crate) coordinate_increments: Vec<f64>,
    pub(crate) multipliers: Vec<f64>,
    pub(crate) violations: Vec<f64>,
}

impl Configuration {
    pub(crate) fn random(system: &System, state: &State, size: f64, random: &mut Random) -> Self {
        let layout = system.layout();
        let start = state.kinematics.clone();
        let mut node_increments = Vec::new();
        let mut at = start.clone();
        at.time = 0.3;
        at.elapsed = 0.1;
        for node in layout.nodes() {
            let free = free(layout, node);
            let mut psi = size * random.screw();
            let mut twist = random.screw();
            let mut acceleration = random.screw();
            for k in 0..6 {
                if !free[k] {
                    (psi[k], twist[k], acceleration[k]) = (0.0, 0.0, 0.0);
                }
            }
            at.nodes[node].frame = start.nodes[node].frame * Motion::exponential(&psi);
            at.nodes[node].twist = twist;
            at.nodes[node].acceleration = acceleration;
            node_increments.push(psi);
        }
        let mut coordinate_increments = Vec::new();
        for coordinate in &mut at.coordinates {
            let change = size * random.number();
            coordinate.value += change;
            coordinate.rate = random.number();
            coordinate.acceleration = random.number();
            coordinate_increments.push(change);
        }
        // Wheels that creep are pressed to their rails: without that there is no force.
        let pressed = if system.sees_multipliers() { -2.0 } else { 0.0 };
        let multipliers: Vec<f64> = state.multipliers.iter().map(|_| pressed + random.number()).collect();
        at.show_multipliers(&multipliers);
        let mut violations = vec![0.0; state.multipliers.len()];
        system.violations(&start, &mut violations);
        let changes = node_increments.iter().map(MotionChange::exponential).collect();
        Self { start, at, node_increments, changes, coordinate_increments, multipliers, violations }
    }

    pub(crate) fn point(&self, augmentation: f64) -> Point<'_> {
        Point {
            at: &self.at,
            stressed: (&self.at).into(),
            increments: Increments {
                start: &self.start,
                nodes: &self.changes,
                coordinates: &self.coordinate_increments,
                joints: None,
            },
            multipliers: &self.multipliers,
            violations: &self.violations,
            augmentation: Augmentation { weight: augmentation, ..Augmentation::of_lengths(0.75) },
        }
    }

    /// The configuration with one unknown's position moved: by a body variation, or in its increment.
    pub(crate) fn displaced(&self, system: &System, row: usize, change: f64, chart: bool) -> Self {
        let mut moved = self.copy();
        match unknown(system.layout(), row) {
            Unknown::Node(node, k) => {
                let mut step = Vector6::zeros();
                step[k] = change;
                let start = self.start.nodes[node].frame;
                if chart {
                    moved.node_increments[node.index()] += step;
                    moved.at.nodes[node].frame =
                        start * Motion::exponential(&moved.node_increments[node.index()]);
                } else {
                    let frame = self.at.nodes[node].frame * Motion::exponential(&step);
                    moved.at.nodes[node].frame = frame;
                    moved.node_increments[node.index()] = frame.relative_to(&start).logarithm();
                }
                moved.changes[node] = MotionChange::exponential(&moved.node_increments[node.index()]);
            }
            Unknown::Coordinate(coordinate) => {
                moved.at.coordinates[coordinate].value += change;
                moved.coordinate_increments[coordinate.index()] += change;
            }
            Unknown::Multiplier(k) => {
                moved.multipliers[k] += change;
                moved.at.show_multipliers(&moved.multipliers);
            }
        }
        moved
    }

    pub(crate) fn accelerated(&self, system: &System, row: usize, change: f64, order: usize) -> Self {
        let mut moved = self.copy();
        match (unknown(system.layout(), row), order) {
            (Unknown::Node(node, k), 1) => moved.at.nodes[node].twist[k] += change,
            (Unknown::Node(node, k), _) => moved.at.nodes[node].acceleration[k] += change,
            (Unknown::Coordinate(coordinate), 1) => moved.at.coordinates[coordinate].rate += change,
            (Unknown::Coordinate(coordinate), _) => moved.at.coordinates[coordinate].acceleration += change,
            (Unknown::Multiplier(_), _) => {}
        }
        moved
    }

    fn copy(&self) -> Self {
        Self {
            start: self.start.clone(),
            at: self.at.clone(),
            node_increments: self.node_increments.clone(),
            changes: self.changes.clone(),
            coordinate_increments: self.coordinate_increments.clone(),
            multipliers: self.multipliers.clone(),
            violations: self.violations.clone(),
        }
    }

    pub(crate) fn residual(&self, system: &System, augmentation: f64) -> Vec<f64> {
        let mut out = vec![0.0; system.layout().size()];
        system.residual(&self.point(augmentation), &mut out);
        out
    }
}

pub(crate) enum Unknown {
    Node(NodeId, usize),
    Coordinate(CoordinateId),
    Multiplier(usize),
}

pub(crate) fn unknown(layout: &Layout, row: usize) -> Unknown {
    if row >= layout.coordinate_count() {
        return Unknown::Multiplier(row - layout.coordinate_count());
    }
    for node in layout.nodes() {
        if let Some(k) = layout.rows_of_node(node).iter().position(|&r| r != LOCKED && r as usize == row) {
            return Unknown::Node(node, k);
        }
    }
    let coordinate =
        layout.coordinates().find(|&c| layout.row_of_coordinate(c) == row).expect("every row has an unknown");
    Unknown::Coordinate(coordinate)
}

pub(crate) fn free(layout: &Layout, node: NodeId) -> [bool; 6] {
    layout.rows_of_node(node).map(|row| row != LOCKED)
}

/// Sixth-order central difference of a vector function of one number, at 0.
pub(crate) fn difference(function: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let width = 5e-3;
    let weights = [(1.0, 0.75), (2.0, -0.15), (3.0, 1.0 / 60.0)];
    let mut sum: Vec<f64> = Vec::new();
    for (steps, weight) in weights {
        let (plus, minus) = (function(steps * width), function(-steps * width));
        sum.resize(plus.len(), 0.0);
        for (value, (p, m)) in sum.iter_mut().zip(plus.iter().zip(&minus)) {
            *value += weight * (p - m) / width;
        }
    }
    sum
}
