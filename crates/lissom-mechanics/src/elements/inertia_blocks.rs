//! Inertias in blocks of eight, see `blocks`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::cell::RefCell;
use std::ops::Range;

use lissom_motion::{Block, Screw, Triple, WIDTH};
use pulp::{Simd, WithSimd};

use super::inertia::Inertia;
use crate::evaluation::blocks::{Blocks, block_of, nodes_of};
use crate::kinematics::lanes::{
    Frames, Part, Screws, gather_accelerations, gather_frames, gather_twists, parts,
};
use crate::kinematics::{Kinematics, NodeId};
use crate::registry::Function;

/// Inertias in blocks of eight.
pub(super) struct InertiaBlocks(Vec<InertiaBlock>);

/// Eight inertias.
struct InertiaBlock {
    count: usize,
    nodes: [NodeId; WIDTH],
    /// Row after row.
    mass: [Screws; 6],
    gravity: [Block; 3],
    /// The factor of gravity, the same for all.
    factor: Option<Function>,
}

/// Node motions and forces of one block.
struct Scratch {
    frames: Frames,
    twists: Screws,
    accelerations: Screws,
    results: Screws,
}

thread_local! {
    /// One per thread: because of its size it is not cleared at each evaluation.
    static SCRATCH: RefCell<Scratch> = const {
        RefCell::new(Scratch {
            frames: [[0.0; WIDTH]; 7],
            twists: [[0.0; WIDTH]; 6],
            accelerations: [[0.0; WIDTH]; 6],
            results: [[0.0; WIDTH]; 6],
        })
    };
}

impl InertiaBlocks {
    pub(super) fn new(inertias: &[Inertia]) -> Self {
        Self(inertias.chunks(WIDTH).map(InertiaBlock::new).collect())
    }
}

impl InertiaBlock {
    fn new(inertias: &[Inertia]) -> Self {
        let mass = |i: usize, j: usize| block_of(inertias, |inertia| inertia.mass()[(i, j)]);
        Self {
            count: inertias.len(),
            nodes: nodes_of(inertias, Inertia::node),
            mass: std::array::from_fn(|i| std::array::from_fn(|j| mass(i, j))),
            gravity: std::array::from_fn(|i| block_of(inertias, |inertia| inertia.gravity.acceleration[i])),
            factor: inertias.first().and_then(|inertia| inertia.gravity.factor.clone()),
        }
    }

    #[inline(always)]
    fn forces<S: Simd>(&self, simd: S, at: &Kinematics, scratch: &mut Scratch) {
        let Scratch { frames, twists, accelerations, results } = scratch;
        let (parts, lanes) = parts::<S>(self.count);
        let nodes = &self.nodes[..self.count];
        gather_frames(at, nodes, lanes, frames);
        gather_twists(at, nodes, lanes, twists);
        gather_accelerations(at, nodes, lanes, accelerations);
        let acting = self.factor.as_ref().map(|factor| {
            let factor = factor.value(at.time);
            self.gravity.map(|component| component.map(|value| factor * value))
        });
        for index in 0..parts {
            let part = Part { simd, index };
            let [x, y, z] = acting.as_ref().unwrap_or(&self.gravity);
            let gravity = Triple::new(part.number(x), part.number(y), part.number(z));
            let twist = part.screw(twists);
            let acceleration = part.screw(accelerations);
            let against = Screw::new(
                acceleration.translation - part.frame(frames).rotation.apply_inverse(gravity),
                acceleration.rotation,
            );
            let momentum = part.product(&self.mass, twist);
            part.store(part.product(&self.mass, against) - twist.coadjoint_times(momentum), results);
        }
    }
}

impl Blocks for InertiaBlocks {
    fn forces(
        &self,
        processor: pulp::Arch,
        at: &Kinematics,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &[Block]),
    ) {
        SCRATCH.with_borrow_mut(|scratch| {
            processor.dispatch(Evaluation { inertias: &self.0, at, blocks, scratch, add });
        });
    }
}

struct Evaluation<'a> {
    inertias: &'a [InertiaBlock],
    at: &'a Kinematics,
    blocks: Range<usize>,
    scratch: &'a mut Scratch,
    add: &'a mut dyn FnMut(usize, &[Block]),
}

impl WithSimd for Evaluation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for index in self.blocks {
            self.inertias[index].forces(simd, self.at, self.scratch);
            (self.add)(index, &self.scratch.results);
        }
    }
}
