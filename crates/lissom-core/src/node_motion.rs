//! Motion of the nodes at a stage, from their increments since the start of the step, eight nodes side by side.
//! Independent of the step size and of the unknowns of the increments: weights are passed in.
//!
//! ```text
//! from the start:  H = H₀ exp(V₀ t + z),          V = rate,                        V̇ = curvature
//! inertial:        R = R₀ E,  E = exp(ω₀ t + z_θ),    x = x₀ + R (v₀ t + z_x),
//!                                                 V = rate,  v̇ = curvature + (v₀ - Eᵀ v₀)/t - ω × v,  ω̇ = curvature
//! departures:      H = H₀ exp(V₀ t) exp z,        V = Ad(exp(-z)) V₀ + W,  W = T(z) rate,
//!                                                 V̇ = T(z) curvature + Ṫ(z) rate - ad_W Ad(exp(-z)) V₀
//! ```
//!
//! H₀, V₀ frame and twist at the start, t time since then, z increment, rate and curvature linear combinations of the
//! increments of all stages and of the state at the start. Terms that depend on the start only are computed once per
//! step.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{
    Block, Lanes, Matrix3, Motion, Pose, Real, Screw, TangentOperator, Vector3, Vector6, Versor, WIDTH,
};
use pulp::{Simd, WithSimd};

use crate::kinematics::lanes::{
    Frames, Part, Screws, gather, gather_frames, gather_twists, parts, processor_for,
};
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, Layout, MotionChange, NodeId, NodeMotion};
use crate::schemes::MAX_STAGES;

/// Parametrization of the increments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IncrementKind {
    /// See the formulas.
    FromStart,
    /// See the formulas.
    RelativeToDrift,
    /// Increments with V - V₀ computed without cancellation: multiplied by [`StageTable::gain`] it replaces the acceleration.
    VelocityChange,
    /// See the formulas.
    Inertial,
}

/// A scheme's coefficients at a stage, in SI.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageTable {
    /// Parametrization of the increments.
    pub(crate) kind: IncrementKind,
    /// Time since the start of the step over which nodes are extrapolated [s].
    pub(crate) ahead: f64,
    /// Weights of all stages' increments in the velocity [1/s].
    pub(crate) velocity: [f64; MAX_STAGES],
    /// Weights of all stages' increments in the acceleration [1/s²].
    pub(crate) acceleration: [f64; MAX_STAGES],
    /// See [`IncrementKind::VelocityChange`] [1/s].
    pub(crate) gain: f64,
}

/// Known terms at the start of a step, by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known<'a> {
    /// Part of the velocity that does not depend on increments, without the twist itself [m/s, rad/s].
    pub(crate) velocity: &'a [f64],
    /// Part of the acceleration that does not depend on increments [m/s², rad/s²].
    pub(crate) acceleration: &'a [f64],
}

/// Which nodes move, and their state at the start of a step.
#[derive(Clone, Debug)]
pub(crate) struct Nodes {
    processor: pulp::Arch,
    blocks: Vec<NodeBlock>,
    fixed: Vec<NodeId>,
    /// By stage, then by block.
    starts: Vec<Vec<BlockStart>>,
}

/// Eight nodes; the last block repeats its last node.
#[derive(Clone, Debug)]
struct NodeBlock {
    count: usize,
    nodes: [NodeId; WIDTH],
    rows: [[u32; 6]; WIDTH],
    /// Whether the rows of each node are six consecutive ones.
    consecutive: bool,
}

/// State of eight nodes at the start of a step.
#[derive(Clone, Debug)]
struct BlockStart {
    frame: Frames,
    /// exp(V₀ t), for departures.
    ahead: Frames,
    /// V₀ t, for increments from the start.
    straight: Screws,
    twist: Screws,
    rate: Screws,
    curvature: Screws,
}

/// State at the start of a step of as many nodes as are processed side by side.
#[derive(Clone, Copy)]
struct Start<R> {
    frame: Pose<R>,
    ahead: Pose<R>,
    straight: Screw<R>,
    twist: Screw<R>,
}

/// Poses and motion of the nodes at a stage.
#[derive(Clone, Copy)]
struct Reached<R> {
    change: Pose<R>,
    frame: Pose<R>,
    twist: Screw<R>,
    acceleration: Screw<R>,
}

impl Nodes {
    pub(crate) fn new(layout: &Layout, stages: usize) -> Self {
        let is_fixed = |&node: &NodeId| layout.node_rows[node].iter().all(|&row| row == LOCKED);
        let (fixed, moving): (Vec<_>, Vec<_>) = layout.nodes().partition(is_fixed);
        let blocks: Vec<_> = moving.chunks(WIDTH).map(|nodes| NodeBlock::new(nodes, layout)).collect();
        let start = BlockStart {
            frame: [[0.0; WIDTH]; 7],
            ahead: [[0.0; WIDTH]; 7],
            straight: [[0.0; WIDTH]; 6],
            twist: [[0.0; WIDTH]; 6],
            rate: [[0.0; WIDTH]; 6],
            curvature: [[0.0; WIDTH]; 6],
        };
        let starts = vec![vec![start; blocks.len()]; stages];
        Self { processor: processor_for(moving.len()), blocks, fixed, starts }
    }

    /// Computes the terms of one stage that depend only on the start of a step.
    pub(crate) fn enter(&mut self, stage: usize, table: &StageTable, start: &Kinematics, known: Known<'_>) {
        self.processor.dispatch(Entry {
            blocks: &self.blocks,
            starts: &mut self.starts[stage],
            table,
            start,
            known,
        });
    }

    /// Poses of the nodes at a stage, from the increments of all stages by row, and the changes of their frames.
    pub(crate) fn update_nodes(
        &self,
        stage: usize,
        table: &StageTable,
        start: &Kinematics,
        increments: &[Vec<f64>],
        (at, changes): (&mut Kinematics, &mut [MotionChange]),
    ) {
        for &node in &self.fixed {
            at.nodes[node] = start.nodes[node];
        }
        self.processor.dispatch(StageKinematics {
            blocks: &self.blocks,
            starts: &self.starts[stage],
            stage,
            table,
            increments,
            at,
            changes,
        });
    }
}

impl NodeBlock {
    fn new(nodes: &[NodeId], layout: &Layout) -> Self {
        let nodes_of_lanes = std::array::from_fn(|lane| nodes[lane.min(nodes.len() - 1)]);
        let rows = nodes_of_lanes.map(|node: NodeId| layout.node_rows[node]);
        let in_a_row = |rows: &[u32; 6]| rows[5] != LOCKED && (1..6).all(|k| rows[k] == rows[k - 1] + 1);
        let consecutive = rows.iter().all(in_a_row);
        Self { count: nodes.len(), nodes: nodes_of_lanes, rows, consecutive }
    }

    /// Values by row, zero if a node lacks the row.
    #[inline(always)]
    fn gather(&self, lanes: usize, values: &[f64], screws: &mut Screws) {
        let of = |lane: usize| {
            let rows = &self.rows[lane];
            if self.consecutive {
                let first = rows[0] as usize;
                *values[first..].first_chunk().expect("six rows in a row")
            } else {
                rows.map(|row| if row == LOCKED { 0.0 } else { values[row as usize] })
            }
        };
        gather(self.count, lanes, of, screws);
    }
}

struct Entry<'a> {
    blocks: &'a [NodeBlock],
    starts: &'a mut [BlockStart],
    table: &'a StageTable,
    start: &'a Kinematics,
    known: Known<'a>,
}

impl WithSimd for Entry<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (block, start) in self.blocks.iter().zip(self.starts) {
            let (parts, lanes) = parts::<S>(block.count);
            let nodes = &block.nodes[..block.count];
            gather_frames(self.start, nodes, lanes, &mut start.frame);
            gather_twists(self.start, nodes, lanes, &mut start.twist);
            block.gather(lanes, self.known.velocity, &mut start.rate);
            block.gather(lanes, self.known.acceleration, &mut start.curvature);
            for index in 0..parts {
                let part = Part { simd, index };
                let twist = part.screw(&start.twist);
                let straight = twist.scaled(self.table.ahead);
                if matches!(self.table.kind, IncrementKind::FromStart | IncrementKind::Inertial) {
                    part.store(straight, &mut start.straight);
                    part.store(twist + part.screw(&start.rate), &mut start.rate);
                } else {
                    part.store_frame(Pose::exponential(straight), &mut start.ahead);
                }
            }
        }
    }
}

struct StageKinematics<'a> {
    blocks: &'a [NodeBlock],
    starts: &'a [BlockStart],
    stage: usize,
    table: &'a StageTable,
    increments: &'a [Vec<f64>],
    at: &'a mut Kinematics,
    changes: &'a mut [MotionChange],
}

impl WithSimd for StageKinematics<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [mut own, mut other] = [[[0.0; WIDTH]; 6]; 2];
        for (block, start) in self.blocks.iter().zip(self.starts) {
            let (parts, lanes) = parts::<S>(block.count);
            let [mut rate, mut curvature] = [start.rate, start.curvature];
            for (stage, increments) in self.increments.iter().enumerate() {
                let increment = if stage == self.stage { &mut own } else { &mut other };
                block.gather(lanes, increments, increment);
                for index in 0..parts {
                    let part = Part { simd, index };
                    for (sum, weights) in
                        [(&mut rate, &self.table.velocity), (&mut curvature, &self.table.acceleration)]
                    {
                        let weight = Lanes::splat(simd, weights[stage]);
                        part.store(part.screw(sum).plus_scaled(part.screw(increment), weight), sum);
                    }
                }
            }
            for index in 0..parts {
                let part = Part { simd, index };
                let own = part.screw(&own);
                let start = Start {
                    frame: part.frame(&start.frame),
                    ahead: part.frame(&start.ahead),
                    straight: part.screw(&start.straight),
                    twist: part.screw(&start.twist),
                };
                let reached =
                    stage_kinematics(self.table, &start, own, [part.screw(&rate), part.screw(&curvature)]);
                let first = index * S::F64_LANES;
                let nodes = &block.nodes[first..block.count.min(first + S::F64_LANES)];
                Places::new(&reached).scatter(nodes, self.at, self.changes);
            }
        }
    }
}

#[inline(always)]
fn stage_kinematics<R: Real>(
    table: &StageTable,
    start: &Start<R>,
    own: Screw<R>,
    [rate, curvature]: [Screw<R>; 2],
) -> Reached<R> {
    if table.kind == IncrementKind::FromStart {
        let change = Pose::exponential(own + start.straight);
        return Reached { change, frame: start.frame * change, twist: rate, acceleration: curvature };
    }
    if table.kind == IncrementKind::Inertial {
        let path = own + start.straight;
        let rotation = Versor::exponential(path.rotation);
        let change = Pose::new(rotation, rotation.apply(path.translation));
        let kept = rotation.apply_inverse_gain(start.twist.translation).scaled(table.gain);
        let turned = rate.rotation.cross(rate.translation);
        let acceleration = Screw::new(curvature.translation - kept - turned, curvature.rotation);
        return Reached { change, frame: start.frame * change, twist: rate, acceleration };
    }
    let motion = Pose::exponential(own);
    let change = start.ahead * motion;
    let frame = start.frame * change;
    if table.kind == IncrementKind::VelocityChange {
        let gained = motion.adjoint_inverse_gain(start.twist) + own.tangent_times(rate);
        return Reached {
            change,
            frame,
            twist: start.twist + gained,
            acceleration: gained.scaled(table.gain),
        };
    }
    let tangent = TangentOperator::new(own);
    let carried = motion.adjoint_inverse_times(start.twist);
    let gained = tangent.times(rate);
    let acceleration =
        tangent.times(curvature) + tangent.rate_times(rate, rate) - gained.lie_bracket(carried);
    Reached { change, frame, twist: carried + gained, acceleration }
}

/// Moves nodes and coordinates by `share` of displacements by row: nodes along body axes.
pub(crate) fn displace(at: &mut Kinematics, layout: &Layout, rows: &[f64], share: f64) {
    for (node, motion) in NodeId::enumerate(&mut at.nodes) {
        let own = layout.rows_of_node(node);
        let psi = Vector6::from_fn(|k, _| match own[k] {
            LOCKED => 0.0,
            row => share * rows[row as usize],
        });
        motion.frame = motion.frame * Motion::exponential(&psi);
    }
    for (coordinate, motion) in CoordinateId::enumerate(&mut at.coordinates) {
        motion.value += share * rows[layout.row_of_coordinate(coordinate)];
    }
}

/// Motion of one node that departs from extrapolation over `ahead` [s] by `place`, with these rate and curvature.
pub(crate) fn depart(
    from: &NodeMotion,
    ahead: f64,
    place: &Vector6,
    [rate, curvature]: [&Vector6; 2],
) -> NodeMotion {
    let table = StageTable {
        kind: IncrementKind::RelativeToDrift,
        ahead,
        velocity: [0.0; MAX_STAGES],
        acceleration: [0.0; MAX_STAGES],
        gain: 0.0,
    };
    let twist = Screw::from(&from.twist);
    let straight = twist.scaled(ahead);
    let start = Start { frame: Pose::from(&from.frame), ahead: Pose::exponential(straight), straight, twist };
    let Reached { frame, twist, acceleration, .. } =
        stage_kinematics::<f64>(&table, &start, place.into(), [rate.into(), curvature.into()]);
    NodeMotion { frame: frame.into(), twist: twist.into(), acceleration: acceleration.into() }
}

/// Result for one part of a block, lane by lane.
struct Places {
    frame: Frames,
    twist: Screws,
    acceleration: Screws,
    /// E - I, row after row.
    turn: [Block; 9],
    shift: [Block; 3],
}

impl Places {
    #[inline(always)]
    fn new<S: Simd>(reached: &Reached<Lanes<S>>) -> Self {
        let shift = reached.change.position;
        Self {
            frame: spread(reached.frame.components()),
            twist: spread(reached.twist.components()),
            acceleration: spread(reached.acceleration.components()),
            turn: spread(reached.change.rotation.minus_identity()),
            shift: spread([shift.x, shift.y, shift.z]),
        }
    }

    /// Writes to as many nodes as there are.
    #[inline(always)]
    fn scatter(&self, nodes: &[NodeId], at: &mut Kinematics, changes: &mut [MotionChange]) {
        for (lane, &node) in nodes.iter().enumerate().take(WIDTH) {
            let to = &mut at.nodes[node];
            to.frame = Motion::from(Pose::from_components(of_lane(&self.frame, lane)));
            to.twist = Vector6::from(of_lane(&self.twist, lane));
            to.acceleration = Vector6::from(of_lane(&self.acceleration, lane));
            changes[node] = MotionChange {
                turn: Matrix3::from_row_slice(&of_lane(&self.turn, lane)),
                shift: Vector3::from(of_lane(&self.shift, lane)),
            };
        }
    }
}

/// Numbers in the order of the lanes.
#[inline(always)]
fn spread<S: Simd, const N: usize>(numbers: [Lanes<S>; N]) -> [Block; N] {
    let mut blocks = [[0.0; WIDTH]; N];
    for i in 0..N {
        numbers[i].store(&mut blocks[i], 0);
    }
    blocks
}

#[inline(always)]
fn of_lane<const N: usize>(blocks: &[Block; N], lane: usize) -> [f64; N] {
    let mut numbers = [0.0; N];
    for i in 0..N {
        numbers[i] = blocks[i][lane];
    }
    numbers
}

#[cfg(test)]
#[path = "../tests/unit/node_motion.rs"]
mod tests;
