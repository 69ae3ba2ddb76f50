//! Joints of one kind in batches: one virtual call per kind, then eight joints at a time in the lanes of vector
//! registers.
//!
//! Constants are stored lane by lane in blocks of eight, independent of the processor, and so are values that are
//! constant over a step, in [`JointStarts`]. Motions and multipliers are gathered at each evaluation. The last block
//! repeats its last joint.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::any::Any;
use std::cell::RefCell;
use std::ops::Range;

use lissom_motion::{Block, Jet, Lanes, Pose, Real, Screw, Triple, WIDTH};
use pulp::{Simd, WithSimd};

use super::attached::AttachedJoint;
use super::derivatives::{Derivatives, LOCAL, OWN, TIP};
use super::relative_increment::{Angle, Axes, CoordinateIncrement, FrameChange, RelativeIncrement};
use super::relative_jets::{FrameMotion, angle, relative_motion};
use super::scalar_batch::ScalarJointBatch;
use super::starts::{JointStarts, StartBlock};
use super::{Coordinate, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::joints::evaluation_point::{Chart, Point};
use crate::kinematics::lanes::{
    Frames, Part, Screws, gather, gather_accelerations, gather_frames, gather_twists, parts, processor_for,
};
use crate::kinematics::{Kinematics, NodeId, Quantity};

/// Forces on the local unknowns and violations of eight joints, in the order of a joint's rows.
pub type Results = [Block; LOCAL + MAX_EQUATIONS];

/// Rates and accelerations of the violations of eight joints.
pub type ViolationRates = [[Block; MAX_EQUATIONS]; 2];

/// All joints, by kind.
#[derive(Default)]
pub struct Batches(Vec<Box<dyn JointBatch>>);

impl Batches {
    /// Builds the batches of `joints`.
    pub fn new(joints: &[AttachedJoint]) -> Self {
        let mut batches = Self::default();
        for (index, joint) in joints.iter().enumerate() {
            joint.joint().enter(index, joint, &mut batches);
        }
        for batch in &mut batches.0 {
            batch.pack(joints);
        }
        batches
    }

    /// Adds a joint to the batch of its kind.
    pub(super) fn enter<J: Joint>(&mut self, joint: J, index: usize, attached: &AttachedJoint) {
        for batch in &mut self.0 {
            if let Some(batch) = batch.as_any_mut().downcast_mut::<Batch<J>>() {
                batch.push(joint, index, attached);
                return;
            }
        }
        let mut batch = Batch::<J>::new();
        batch.push(joint, index, attached);
        self.0.push(Box::new(batch));
    }

    /// Adds a joint to the batch of those that are evaluated one by one.
    pub(super) fn enter_scalar(&mut self, index: usize, joint: AttachedJoint) {
        for batch in &mut self.0 {
            if let Some(batch) = batch.as_any_mut().downcast_mut::<ScalarJointBatch>() {
                batch.push(index, joint);
                return;
            }
        }
        let mut batch = ScalarJointBatch::new();
        batch.push(index, joint);
        self.0.push(Box::new(batch));
    }

    /// The batches, each with the values of its joints at the start of the step.
    pub fn with_starts<'a>(
        &'a self,
        starts: Option<&'a JointStarts>,
    ) -> impl Iterator<Item = (&'a dyn JointBatch, Option<&'a [StartBlock]>)> {
        self.0.iter().enumerate().map(move |(k, batch)| (&**batch, starts.map(|starts| &starts.0[k][..])))
    }

    /// The batches.
    pub fn iter(&self) -> impl Iterator<Item = &dyn JointBatch> {
        self.0.iter().map(|batch| &**batch)
    }

    /// Stores the start of a step.
    #[inline]
    pub fn begin(&self, start: &Kinematics, out: &mut JointStarts) {
        out.0.resize_with(self.0.len(), Vec::new);
        for (batch, blocks) in self.0.iter().zip(&mut out.0) {
            batch.begin(start, blocks);
        }
    }
}

/// All joints of a kind.
pub trait JointBatch: Send + Sync {
    /// Index of each joint among all.
    fn indices(&self) -> &[u32];
    /// Offsets of each joint's local unknowns and equations, concatenated, and the end of the last ones.
    fn starts(&self) -> &[usize];
    /// Joints in a block.
    fn block_items(&self, block: usize) -> Range<usize>;
    /// Stores the start of a step.
    fn begin(&self, start: &Kinematics, out: &mut Vec<StartBlock>);
    /// Computes forces and violations of whole blocks, or violations only, and passes those of each block to `add`, in
    /// order.
    fn evaluate(
        &self,
        wanted: Wanted,
        point: &Point<'_>,
        starts: Option<&[StartBlock]>,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &Results),
    );
    /// Computes rates and accelerations of the violations for the motion `at`, at which the values `starts` are taken, and passes
    /// those of each block to `take`, in order.
    fn violation_rates(
        &self,
        at: &Kinematics,
        starts: &[StartBlock],
        take: &mut dyn FnMut(usize, &ViolationRates),
    );
    /// Passes the derivatives of each joint to `take`, with its index among all.
    fn linearize(
        &self,
        joints: &[AttachedJoint],
        point: &Point<'_>,
        starts: Option<&[StartBlock]>,
        chart: Chart<'_>,
        scratch: &mut Derivatives,
        take: &mut dyn FnMut(usize, &mut Derivatives),
    );
    /// Arranges the joints in lanes.
    fn pack(&mut self, joints: &[AttachedJoint]);
    /// For joints that join the batch of their kind.
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

/// Requested results of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Forces and violations.
    All,
    /// Violations; forces stay zero.
    Violations,
}

struct Batch<J> {
    joints: Vec<J>,
    indices: Vec<u32>,
    starts: Vec<usize>,
    packs: Vec<Pack>,
    processor: pulp::Arch,
}

/// Constants of eight joints.
struct Pack {
    count: usize,
    /// Base and tip node.
    nodes: [[NodeId; WIDTH]; 2],
    /// Base and tip joint frame in the nodes' frames.
    offsets: [Frames; 2],
    /// Whether the axes of one of them differ from its node's.
    is_turned: bool,
    constants: [Block; MAX_CONSTANTS],
    coordinates: [[u32; WIDTH]; MAX_COORDINATES],
    /// First multiplier and number of equations.
    equations: [(u32, u32); WIDTH],
}

/// Inputs and results of eight joints at an evaluation point.
struct BatchScratch {
    gathered: Gathered,
    results: Results,
}

thread_local! {
    /// One per thread: because of its size it is not cleared at each evaluation.
    static SCRATCH: RefCell<BatchScratch> = const {
        RefCell::new(BatchScratch {
            gathered: Gathered {
                changes: [[[0.0; WIDTH]; 12]; 2],
                coordinates: [[0.0; WIDTH]; MAX_COORDINATES],
                multipliers: [[0.0; WIDTH]; MAX_EQUATIONS],
                violations: [[0.0; WIDTH]; MAX_EQUATIONS],
            },
            results: [[0.0; WIDTH]; LOCAL + MAX_EQUATIONS],
        })
    };
}

/// Inputs of eight joints at an evaluation point.
struct Gathered {
    /// Rotation, column by column, and translation of base and tip node.
    changes: [[Block; 12]; 2],
    coordinates: [Block; MAX_COORDINATES],
    multipliers: [Block; MAX_EQUATIONS],
    violations: [Block; MAX_EQUATIONS],
}

impl<J: Joint> Batch<J> {
    fn new() -> Self {
        Self {
            joints: Vec::new(),
            indices: Vec::new(),
            starts: vec![0],
            packs: Vec::new(),
            processor: pulp::Arch::new(),
        }
    }

    fn push(&mut self, joint: J, index: usize, attached: &AttachedJoint) {
        self.joints.push(joint);
        self.indices.push(index as u32);
        let last = self.starts[self.starts.len() - 1];
        self.starts.push(last + LOCAL + attached.equations());
    }
}

impl<J: Joint> JointBatch for Batch<J> {
    fn indices(&self) -> &[u32] {
        &self.indices
    }

    fn starts(&self) -> &[usize] {
        &self.starts
    }

    fn block_items(&self, block: usize) -> Range<usize> {
        block * WIDTH..self.joints.len().min((block + 1) * WIDTH)
    }

    fn begin(&self, start: &Kinematics, out: &mut Vec<StartBlock>) {
        out.resize_with(self.packs.len(), StartBlock::zeros);
        begin(self.processor, Begin { packs: &self.packs, coordinates: J::COORDINATES, start, out });
    }

    fn evaluate(
        &self,
        wanted: Wanted,
        point: &Point<'_>,
        starts: Option<&[StartBlock]>,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &Results),
    ) {
        // Analyses without steps have none.
        let mut own = Vec::new();
        let starts = starts.unwrap_or_else(|| {
            self.begin(point.increments.start, &mut own);
            &own
        });
        SCRATCH.with_borrow_mut(|scratch| {
            self.processor.dispatch(Evaluation { batch: self, wanted, point, starts, blocks, scratch, add });
        });
    }

    fn violation_rates(
        &self,
        at: &Kinematics,
        starts: &[StartBlock],
        take: &mut dyn FnMut(usize, &ViolationRates),
    ) {
        self.processor.dispatch(Rates { batch: self, at, starts, take });
    }

    fn linearize(
        &self,
        joints: &[AttachedJoint],
        point: &Point<'_>,
        starts: Option<&[StartBlock]>,
        chart: Chart<'_>,
        scratch: &mut Derivatives,
        take: &mut dyn FnMut(usize, &mut Derivatives),
    ) {
        for (item, (joint, &index)) in self.joints.iter().zip(&self.indices).enumerate() {
            let attached = &joints[index as usize];
            let start = match starts {
                Some(starts) => starts[item / WIDTH].relative(item % WIDTH),
                None => attached.start(point.increments.start),
            };
            let configuration = attached.configuration_from(start, &point.increments);
            attached.linearize_for(joint, &configuration, point, chart, scratch);
            take(index as usize, scratch);
        }
    }

    fn pack(&mut self, joints: &[AttachedJoint]) {
        self.processor = processor_for(self.joints.len());
        let constants: Vec<[f64; MAX_CONSTANTS]> = self.joints.iter().map(Joint::constants).collect();
        self.packs = packs(&self.indices, joints, &constants);
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

/// Arranges the constants of joints of any kind, given by their indices among all.
fn packs(indices: &[u32], joints: &[AttachedJoint], constants: &[[f64; MAX_CONSTANTS]]) -> Vec<Pack> {
    let of = |chunk: &[u32], lane: usize| &joints[chunk[lane.min(chunk.len() - 1)] as usize];
    indices
        .chunks(WIDTH)
        .zip(constants.chunks(WIDTH))
        .map(|(chunk, constants)| {
            let all: [&AttachedJoint; WIDTH] = std::array::from_fn(|lane| of(chunk, lane));
            let offsets = [0, 1].map(|side| {
                let poses = all.map(|joint| Pose::from(&joint.frames[side].offset).components());
                std::array::from_fn(|k| poses.map(|pose| pose[k]))
            });
            let is_turned = all
                .iter()
                .flat_map(|joint| &joint.frames)
                .any(|frame| frame.offset.rotation != lissom_motion::Rotation::IDENTITY);
            Pack {
                count: chunk.len(),
                nodes: [0, 1].map(|side| all.map(|joint| joint.frames[side].node)),
                offsets,
                is_turned,
                constants: std::array::from_fn(|k| {
                    std::array::from_fn(|lane| constants[lane.min(constants.len() - 1)][k])
                }),
                coordinates: std::array::from_fn(|k| {
                    all.map(|joint| {
                        joint.coordinates.get(k).map_or(0, |coordinate| coordinate.index() as u32)
                    })
                }),
                equations: all.map(|joint| (joint.first_multiplier as u32, joint.equations() as u32)),
            }
        })
        .collect()
}

impl Pack {
    #[inline(always)]
    fn begin<S: Simd>(
        &self,
        simd: S,
        coordinates: &[Coordinate],
        start: &Kinematics,
        frames: &mut [Frames; 2],
        out: &mut StartBlock,
    ) {
        let (parts, lanes) = parts::<S>(self.count);
        gather_frames(start, &self.nodes[0][..self.count], lanes, &mut frames[0]);
        gather_frames(start, &self.nodes[1][..self.count], lanes, &mut frames[1]);
        for index in 0..parts {
            let part = Part { simd, index };
            let base = part.frame(&frames[0]) * part.frame(&self.offsets[0]);
            let tip = part.frame(&frames[1]) * part.frame(&self.offsets[1]);
            let relative = tip.relative_to(base);
            let Axes(columns) = Axes::of(relative.rotation);
            for k in 0..3 {
                store(part, columns[k], &mut out.rotation[3 * k..3 * k + 3]);
            }
            store(part, relative.rotation.apply_inverse(relative.position), &mut out.place);
        }
        for (k, coordinate) in coordinates.iter().enumerate() {
            if coordinate.quantity == Quantity::Angle {
                for lane in 0..self.count {
                    let value = start.coordinates[self.coordinates[k][lane] as usize].value;
                    (out.angles[k][0][lane], out.angles[k][1][lane]) = value.sin_cos();
                }
            }
        }
    }

    /// Gathers the changes of the nodes. Compiled once for joints of all kinds.
    #[inline(never)]
    fn gather_changes(&self, lanes: usize, point: &Point<'_>, changes: &mut [[Block; 12]; 2]) {
        for side in 0..2 {
            let of = |lane: usize| {
                let change = &point.increments.nodes[self.nodes[side][lane]];
                let (turn, shift) = (change.turn.as_slice(), &change.shift);
                std::array::from_fn(|k| if k < 9 { turn[k] } else { shift[k - 9] })
            };
            gather(self.count, lanes, of, &mut changes[side]);
        }
    }

    #[inline(always)]
    fn gather<J: Joint>(&self, lanes: usize, point: &Point<'_>, gathered: &mut Gathered) {
        let increments = &point.increments;
        self.gather_changes(lanes, point, &mut gathered.changes);
        for k in 0..J::COORDINATES.len() {
            for lane in 0..lanes {
                gathered.coordinates[k][lane] = increments.coordinates[self.coordinates[k][lane] as usize];
            }
        }
        // No formula branches on the contents of lanes beyond the last joint.
        for lane in 0..self.count {
            let (first, count) = self.equations[lane];
            let own = first as usize..(first + count) as usize;
            let (multipliers, violations) = (&point.multipliers[own.clone()], &point.violations[own]);
            // The maximum number of the kind, in a loop of constant length if all exist.
            if multipliers.len() == J::EQUATIONS.sum() && violations.len() == J::EQUATIONS.sum() {
                for k in 0..J::EQUATIONS.sum() {
                    gathered.multipliers[k][lane] = multipliers[k];
                    gathered.violations[k][lane] = violations[k];
                }
            } else {
                for k in 0..multipliers.len().min(J::EQUATIONS.sum()) {
                    gathered.multipliers[k][lane] = multipliers[k];
                    gathered.violations[k][lane] = violations[k];
                }
                // Values of other joints that remain in storage may not be finite.
                for k in multipliers.len()..J::EQUATIONS.sum() {
                    gathered.multipliers[k][lane] = 0.0;
                    gathered.violations[k][lane] = 0.0;
                }
            }
        }
    }

    #[inline(always)]
    fn evaluate<J: Joint, S: Simd>(
        &self,
        part: Part<S>,
        wanted: Wanted,
        weights: [f64; 2],
        start: &StartBlock,
        gathered: &Gathered,
        out: &mut Results,
    ) {
        let [base, tip] = [0, 1].map(|side| {
            let frame = part.frame(&self.offsets[side]);
            (if self.is_turned { Some(Axes::of(frame.rotation)) } else { None }, frame.position)
        });
        let increment = RelativeIncrement::new(
            (axes(part, &start.rotation), triple(part, &start.place, 0)),
            change(part, &gathered.changes[0]).carried_at(base.0, base.1),
            change(part, &gathered.changes[1]).carried_at(tip.0, tip.1),
        );
        let own = coordinate_increment::<J, S>(part, start, gathered);
        let mut constants = [part.number(&self.constants[0]); MAX_CONSTANTS];
        for k in 1..MAX_CONSTANTS {
            constants[k] = part.number(&self.constants[k]);
        }
        let change = J::violation_change(&increment, &own, &constants);
        let mut mu = change;
        for k in 0..J::EQUATIONS.sum() {
            let violation = part.number(&gathered.violations[k]) + change[k];
            violation.store(&mut out[LOCAL + k], part.index);
            let weight = if k < J::EQUATIONS.lengths { weights[0] } else { weights[1] };
            mu[k] = part.number(&gathered.multipliers[k]) + violation.scaled(weight);
        }
        if wanted == Wanted::Violations {
            return;
        }
        let (wrench, forces) = J::wrench(&increment, &own, &constants, &mu);
        // The opposite wrench acts on the base, at the base's point.
        let rotation = increment.rotation();
        let couple = wrench.rotation.plus_cross(increment.place, wrench.translation);
        let opposite = Screw::new(-rotation.times(wrench.translation), -rotation.times(couple));
        store_screw(part, at_node(opposite, base), &mut out[..6]);
        store_screw(part, at_node(wrench, tip), &mut out[TIP..OWN]);
        for k in 0..MAX_COORDINATES {
            forces[k].store(&mut out[OWN + k], part.index);
        }
    }
}

#[inline(always)]
fn coordinate_increment<J: Joint, S: Simd>(
    part: Part<S>,
    start: &StartBlock,
    gathered: &Gathered,
) -> CoordinateIncrement<Lanes<S>> {
    let zero = Lanes::splat(part.simd, 0.0);
    let none = Angle { sine: zero, cosine: zero, sine_change: zero, cosine_change: zero };
    let mut own = CoordinateIncrement { change: [zero; MAX_COORDINATES], angles: [none; MAX_COORDINATES] };
    for k in 0..J::COORDINATES.len() {
        own.change[k] = part.number(&gathered.coordinates[k]);
        if J::COORDINATES[k].quantity == Quantity::Angle {
            let [sine, cosine] = &start.angles[k];
            own.angles[k] = Angle::turned([part.number(sine), part.number(cosine)], own.change[k]);
        }
    }
    own
}

/// Transforms a wrench on a joint frame to its node.
#[inline(always)]
fn at_node<R: Real>(wrench: Screw<R>, (axes, place): (Option<Axes<R>>, Triple<R>)) -> Screw<R> {
    let (force, moment) = match axes {
        None => (wrench.translation, wrench.rotation),
        Some(axes) => (axes.times(wrench.translation), axes.times(wrench.rotation)),
    };
    Screw::new(force, moment.plus_cross(place, force))
}

/// A vector from three consecutive blocks.
#[inline(always)]
fn triple<S: Simd>(part: Part<S>, blocks: &[Block], first: usize) -> Triple<Lanes<S>> {
    Triple::new(part.number(&blocks[first]), part.number(&blocks[first + 1]), part.number(&blocks[first + 2]))
}

/// A matrix from nine blocks, column by column.
#[inline(always)]
fn axes<S: Simd>(part: Part<S>, blocks: &[Block]) -> Axes<Lanes<S>> {
    Axes([triple(part, blocks, 0), triple(part, blocks, 3), triple(part, blocks, 6)])
}

#[inline(always)]
fn change<S: Simd>(part: Part<S>, blocks: &[Block; 12]) -> FrameChange<Lanes<S>> {
    FrameChange { turn: axes(part, blocks), shift: triple(part, blocks, 9) }
}

#[inline(always)]
fn store<S: Simd>(part: Part<S>, value: Triple<Lanes<S>>, out: &mut [Block]) {
    value.x.store(&mut out[0], part.index);
    value.y.store(&mut out[1], part.index);
    value.z.store(&mut out[2], part.index);
}

#[inline(always)]
fn store_screw<S: Simd>(part: Part<S>, value: Screw<Lanes<S>>, out: &mut [Block]) {
    store(part, value.translation, &mut out[..3]);
    store(part, value.rotation, &mut out[3..6]);
}

/// Compiled once for joints of all kinds.
#[inline(never)]
fn begin(processor: pulp::Arch, begin: Begin<'_>) {
    processor.dispatch(begin);
}

struct Begin<'a> {
    packs: &'a [Pack],
    /// Coordinates of the kind.
    coordinates: &'a [Coordinate],
    start: &'a Kinematics,
    out: &'a mut [StartBlock],
}

impl WithSimd for Begin<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut frames = [[[0.0; WIDTH]; 7]; 2];
        for (pack, out) in self.packs.iter().zip(self.out) {
            pack.begin(simd, self.coordinates, self.start, &mut frames, out);
        }
    }
}

/// Rates and accelerations of the violations of a batch.
struct Rates<'a, J> {
    batch: &'a Batch<J>,
    at: &'a Kinematics,
    starts: &'a [StartBlock],
    take: &'a mut dyn FnMut(usize, &ViolationRates),
}

impl<J: Joint> WithSimd for Rates<'_, J> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut motion = GatheredMotion::default();
        let mut rates = [[[0.0; WIDTH]; MAX_EQUATIONS]; 2];
        for (block, (pack, start)) in self.batch.packs.iter().zip(self.starts).enumerate() {
            let (parts, lanes) = parts::<S>(pack.count);
            pack.gather_motion(lanes, self.at, J::COORDINATES.len(), &mut motion);
            for index in 0..parts {
                let part = Part { simd, index };
                let jets = pack.violation_jets::<J, S>(part, start, &motion);
                for k in 0..J::EQUATIONS.sum() {
                    jets[k].first.store(&mut rates[0][k], index);
                    jets[k].second.store(&mut rates[1][k], index);
                }
            }
            (self.take)(block, &rates);
        }
    }
}

/// Twists and accelerations of the nodes of eight joints, base and tip, and rates of their coordinates.
#[derive(Default)]
struct GatheredMotion {
    twists: [Screws; 2],
    accelerations: [Screws; 2],
    coordinates: [[Block; 2]; MAX_COORDINATES],
}

impl Pack {
    /// Compiled once for joints of all kinds.
    #[inline(never)]
    fn gather_motion(&self, lanes: usize, at: &Kinematics, coordinates: usize, out: &mut GatheredMotion) {
        for side in 0..2 {
            let nodes = &self.nodes[side][..self.count];
            gather_twists(at, nodes, lanes, &mut out.twists[side]);
            gather_accelerations(at, nodes, lanes, &mut out.accelerations[side]);
        }
        for k in 0..coordinates {
            for lane in 0..lanes {
                let own = &at.coordinates[self.coordinates[k][lane] as usize];
                out.coordinates[k][0][lane] = own.rate;
                out.coordinates[k][1][lane] = own.acceleration;
            }
        }
    }

    /// Relative motion in time. Compiled once for joints of all kinds.
    #[inline(always)]
    fn relative_jets<S: Simd>(
        &self,
        part: Part<S>,
        start: &StartBlock,
        motion: &GatheredMotion,
    ) -> RelativeIncrement<Jet<Lanes<S>>> {
        Lanes::splat(part.simd, 0.0).apart(
            #[inline(always)]
            || {
                let [base, tip] = [0, 1].map(|side| {
                    let offset = part.frame(&self.offsets[side]);
                    FrameMotion {
                        twist: offset.adjoint_inverse_times(part.screw(&motion.twists[side])),
                        rate: offset.adjoint_inverse_times(part.screw(&motion.accelerations[side])),
                    }
                });
                let here = (axes(part, &start.rotation), triple(part, &start.place, 0));
                relative_motion(here, base, tip)
            },
        )
    }

    /// Violations in time; their values are zero.
    #[inline(always)]
    fn violation_jets<J: Joint, S: Simd>(
        &self,
        part: Part<S>,
        start: &StartBlock,
        motion: &GatheredMotion,
    ) -> [Jet<Lanes<S>>; MAX_EQUATIONS] {
        let increment = self.relative_jets(part, start, motion);
        let zero = Lanes::splat(part.simd, 0.0);
        let mut own = CoordinateIncrement {
            change: [Jet::constant(zero); MAX_COORDINATES],
            angles: [angle([zero; 2], zero, zero); MAX_COORDINATES],
        };
        for k in 0..J::COORDINATES.len() {
            let [first, second] = &motion.coordinates[k];
            let (first, second) = (part.number(first), part.number(second));
            own.change[k] = Jet { value: zero, first, second };
            if J::COORDINATES[k].quantity == Quantity::Angle {
                let [sine, cosine] = &start.angles[k];
                own.angles[k] = angle([part.number(sine), part.number(cosine)], first, second);
            }
        }
        let mut constants = [Jet::constant(zero); MAX_CONSTANTS];
        for k in 0..MAX_CONSTANTS {
            constants[k] = Jet::constant(part.number(&self.constants[k]));
        }
        J::violation_change(&increment, &own, &constants)
    }
}

struct Evaluation<'a, J> {
    batch: &'a Batch<J>,
    wanted: Wanted,
    point: &'a Point<'a>,
    starts: &'a [StartBlock],
    blocks: Range<usize>,
    scratch: &'a mut BatchScratch,
    add: &'a mut dyn FnMut(usize, &Results),
}

impl<J: Joint> WithSimd for Evaluation<'_, J> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let augmentation = &self.point.augmentation;
        let weights = [Quantity::Length, Quantity::Angle]
            .map(|quantity| augmentation.weight * augmentation.relative(quantity));
        let BatchScratch { gathered, results } = self.scratch;
        for block in self.blocks {
            let pack = &self.batch.packs[block];
            let (parts, lanes) = parts::<S>(pack.count);
            pack.gather::<J>(lanes, self.point, gathered);
            for index in 0..parts {
                let part = Part { simd, index };
                pack.evaluate::<J, S>(part, self.wanted, weights, &self.starts[block], gathered, results);
            }
            (self.add)(block, results);
        }
    }
}
