//! One interface to constraints of all types: joints between two nodes, drives and relations of coordinates, sliders along
//! beams; rolling and latches, whose equations are between velocities.
//!
//! Legend: q positions of the local unknowns, v their rates, c violations, μ multipliers.
//!
//! ```text
//! positions:    c(q, t) = 0,    ċ = B v + ∂c/∂t,    c̈ = B v̇ + (result of `acceleration`),    forces Bᵀ μ
//! velocities:   B(q) v = 0,     derivative B v̇ + (result of `acceleration`),                forces Bᵀ μ
//! ```
//!
//! Local unknowns are those of the constraint's ports, in their order: six body variations of a node, or one
//! coordinate. Matrices are row-major with [`Constraint::size`] columns.

use super::evaluation_point::Increments;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, Quantity};
use crate::law::VisitLaw;

/// A port: a node or coordinate on which a constraint acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// A node: six local unknowns.
    Node(NodeId),
    /// No node in this arrangement: six local unknowns that do not appear in the equations.
    NoNode,
    /// An algebraic coordinate: one local unknown.
    Coordinate(CoordinateId),
}

impl Port {
    /// Number of local unknowns.
    pub fn width(self) -> usize {
        match self {
            Self::Node(_) | Self::NoNode => 6,
            Self::Coordinate(_) => 1,
        }
    }

    /// Rates of the local unknowns; the first [`width`](Self::width) count [m/s, rad/s].
    fn rates(self, at: &Kinematics) -> [f64; 6] {
        match self {
            Self::Node(node) => at.nodes[node].twist.into(),
            Self::NoNode => [0.0; 6],
            Self::Coordinate(coordinate) => [at.coordinates[coordinate].rate, 0.0, 0.0, 0.0, 0.0, 0.0],
        }
    }

    /// Second derivatives of the local unknowns; the first [`width`](Self::width) count [m/s², rad/s²].
    fn accelerations(self, at: &Kinematics) -> [f64; 6] {
        match self {
            Self::Node(node) => at.nodes[node].acceleration.into(),
            Self::NoNode => [0.0; 6],
            Self::Coordinate(coordinate) => {
                [at.coordinates[coordinate].acceleration, 0.0, 0.0, 0.0, 0.0, 0.0]
            }
        }
    }
}

/// What the equations of a constraint relate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Positions. Velocities and accelerations follow.
    Position,
    /// Velocities only: there are no positions that violate the constraint.
    Velocity,
}

/// A constraint at both stages of a step whose violations are integrated, see `step_stages`.
#[derive(Debug)]
pub struct Visit<'a> {
    /// B̃ by stage, all zero at first.
    pub rows: [&'a mut [f64]; STAGES],
    /// Integrated violations by stage, all zero at first.
    pub violations: [&'a mut [f64]; STAGES],
    /// Scratch, one value per equation.
    pub changes: &'a mut [f64],
}

/// Equations between the positions or the velocities of nodes and coordinates, with their position among all multipliers.
pub trait Constraint: Send + Sync + std::fmt::Debug {
    /// Name in the model.
    fn name(&self) -> &str;

    /// What its equations relate.
    fn level(&self) -> Level {
        Level::Position
    }

    /// Whether it admits every motion at present: its gradient is zero, and so are its multipliers.
    fn is_released(&self, _at: &Kinematics) -> bool {
        false
    }

    /// Position of its first multiplier among all.
    fn first_multiplier(&self) -> usize;

    /// Number of equations. Default: one.
    fn equations(&self) -> usize {
        1
    }

    /// The quantity of an equation's violation.
    fn quantity(&self, equation: usize) -> Quantity;

    /// Number of arrangements: a slider acts on different nodes in each interval between two of them.
    fn arrangements(&self) -> usize {
        1
    }

    /// The arrangement in which it acts at a configuration.
    fn arrangement(&self, _at: &Kinematics) -> usize {
        0
    }

    /// Number of ports, in every arrangement.
    fn ports(&self) -> usize;

    /// A port in an arrangement.
    fn port(&self, arrangement: usize, index: usize) -> Port;

    /// Number of local unknowns, in every arrangement.
    fn size(&self) -> usize {
        (0..self.ports()).map(|index| self.port(0, index).width()).sum()
    }

    /// Groups of nodes each of which could satisfy the equations alone if it were free. Default: each node by itself.
    fn sides(&self) -> Vec<Vec<NodeId>> {
        let ports = (0..self.ports()).map(|index| self.port(0, index));
        let node = |port| if let Port::Node(node) = port { Some(vec![node]) } else { None };
        ports.filter_map(node).collect()
    }

    /// Violations, evaluated from absolute positions [m, rad]; zero for constraints of velocities.
    fn violation(&self, at: &Kinematics, out: &mut [f64]);

    /// Changes of the violations since the start of a step, without cancellation [m, rad]; the time interval `elapsed`
    /// [s] ends at `time`.
    fn violation_change(&self, increments: &Increments<'_>, time_elapsed: (f64, f64), out: &mut [f64]);

    /// B, by equation and local unknown; `out` is zero.
    fn gradient(&self, at: &Kinematics, out: &mut [f64]);

    /// Derivatives of Bᵀ μ at constant multipliers, local unknowns by local unknowns; `out` is zero.
    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]);

    /// ∂(B v)/∂q of a constraint of velocities, by equation and local unknown; `out` is zero. Default: B is constant.
    fn rate_derivatives(&self, _at: &Kinematics, _out: &mut [f64]) {}

    /// ∂c/∂t by equation; `out` is zero. Default: no equation depends explicitly on time.
    fn time_derivative(&self, _at: &Kinematics, _out: &mut [f64]) {}

    /// The terms of c̈ other than B v̇, by equation [m/s², rad/s²].
    fn acceleration(&self, at: &Kinematics, out: &mut [f64]);

    /// Whether it may depend explicitly on time at any instant.
    fn may_depend_on_time(&self) -> bool {
        false
    }

    /// Whether it depends explicitly on time at a configuration.
    fn depends_on_time(&self, _at: &Kinematics) -> bool {
        false
    }

    /// Work due to its explicit dependence on time, between two configurations with all multipliers [J].
    fn work(&self, _from: (&Kinematics, &[f64]), _to: (&Kinematics, &[f64])) -> f64 {
        0.0
    }

    /// Power due to its explicit dependence on time, with all multipliers [W].
    fn power(&self, _at: &Kinematics, _multipliers: &[f64]) -> f64 {
        0.0
    }

    /// Passes its scalar laws with their arguments to `visit`, always in the same order. Default: it has none.
    fn laws(&self, _at: &Kinematics, _visit: &mut VisitLaw<'_>) {}

    /// Known breakpoints of its functions of time [s].
    fn breakpoints(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Gradients and integrated violations at the stages of a step that ends with the increments `end`; `before` are the
    /// violations at its start. By default the rates at the stages leave no violation at the end, and forces are those of the
    /// gradients there. Their work is then of the order of the scheme's error, and not zero as that of joints.
    fn visit(&self, step: &StepStages<'_>, end: &Increments<'_>, before: &[f64], out: &mut Visit<'_>) {
        let size = self.size();
        for (j, at) in step.stages.iter().enumerate() {
            let (rows, rates) = (&mut *out.rows[j], &mut *out.violations[j]);
            self.gradient(at, rows);
            self.time_derivative(at, rates);
            let arrangement = self.arrangement(at);
            let mut first = 0;
            for port in (0..self.ports()).map(|index| self.port(arrangement, index)) {
                let own = port.rates(at);
                for (rate, row) in rates.iter_mut().zip(rows.chunks_exact(size)) {
                    let row = &row[first..first + port.width()];
                    *rate += row.iter().zip(own).map(|(by, rate)| by * rate).sum::<f64>();
                }
                first += port.width();
            }
        }
        self.violation_change(end, (step.end.time, step.end.elapsed), out.changes);
        let whole: f64 = step.lasting.iter().sum();
        let [first, second] = &mut out.violations;
        for (e, (first, second)) in first.iter_mut().zip(second.iter_mut()).enumerate() {
            let rates = [*first, *second];
            let behind = (out.changes[e] - step.whole(rates) + before[e]) / whole;
            [*first, *second] = step.at_stages(0.0, rates.map(|rate| rate + behind));
        }
    }
}

/// B v of a constraint; `gradient` is zero and receives B.
pub fn rates<C: Constraint + ?Sized>(constraint: &C, at: &Kinematics, gradient: &mut [f64], out: &mut [f64]) {
    out.fill(0.0);
    constraint.gradient(at, gradient);
    let (size, arrangement) = (constraint.size(), constraint.arrangement(at));
    let mut first = 0;
    for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
        let rates = port.rates(at);
        for (value, row) in out.iter_mut().zip(gradient.chunks_exact(size)) {
            let own = row[first..first + port.width()].iter().zip(rates);
            *value += own.map(|(by, rate)| by * rate).sum::<f64>();
        }
        first += port.width();
    }
}

/// Rates ċ and accelerations c̈ of a constraint's violations for the motion `at`, of a constraint of velocities B v and its
/// derivative; `gradient` is zero and receives B.
pub fn violation_rates<C: Constraint + ?Sized>(
    constraint: &C,
    at: &Kinematics,
    gradient: &mut [f64],
    [rates, accelerations]: [&mut [f64]; 2],
) {
    rates.fill(0.0);
    constraint.time_derivative(at, rates);
    constraint.acceleration(at, accelerations);
    let size = constraint.size();
    constraint.gradient(at, gradient);
    let arrangement = constraint.arrangement(at);
    let mut first = 0;
    for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
        let (by_rate, by_acceleration) = (port.rates(at), port.accelerations(at));
        for (e, row) in gradient.chunks_exact(size).enumerate() {
            for (k, by) in row[first..first + port.width()].iter().enumerate() {
                rates[e] += by * by_rate[k];
                accelerations[e] += by * by_acceleration[k];
            }
        }
        first += port.width();
    }
}

/// Nodes and coordinates on which a constraint acts, in all arrangements.
pub fn ports_of(constraint: &dyn Constraint) -> Vec<Port> {
    let mut all = Vec::new();
    for arrangement in 0..constraint.arrangements() {
        for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
            if port != Port::NoNode && !all.contains(&port) {
                all.push(port);
            }
        }
    }
    all
}
