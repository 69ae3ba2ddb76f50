//! Shells in blocks of eight, see `evaluation::blocks`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::ops::Range;

use lissom_motion::{Block, Lanes, WIDTH};
use pulp::{Simd, WithSimd};

use super::Shell;
use super::constants::{COUNT, Constants};
use super::forces::{forces, stress};
use super::linearize::{SIZE, linearize, predicted};
use super::quadrilateral::NODES;
use super::strains::Deformed;
use lissom_mechanics::evaluation::blocks::{Blocks, block_of, nodes_of};
use lissom_mechanics::kinematics::lanes::{Frames, Part, gather_frames, parts};
use lissom_mechanics::kinematics::{Kinematics, NodeId, Stressed};

/// Shells in blocks of eight.
pub(super) struct ShellBlocks {
    blocks: Vec<ShellBlock>,
}

/// Eight shells.
struct ShellBlock {
    count: usize,
    nodes: [[NodeId; WIDTH]; NODES],
    numbers: Box<[Block; COUNT]>,
}

impl ShellBlocks {
    pub(super) fn new(shells: &[Shell]) -> Self {
        let block = |shells: &[Shell]| {
            let mut numbers = Box::new([[0.0; WIDTH]; COUNT]);
            for (place, numbers) in numbers.iter_mut().enumerate() {
                *numbers = block_of(shells, |shell| shell.numbers.0[place]);
            }
            ShellBlock {
                count: shells.len(),
                nodes: std::array::from_fn(|i| nodes_of(shells, |shell| shell.nodes[i])),
                numbers,
            }
        };
        Self { blocks: shells.chunks(WIDTH).map(block).collect() }
    }
}

/// Constants of part of a block.
struct Here<'a, S> {
    part: Part<S>,
    numbers: &'a [Block; COUNT],
}

impl<S: Simd> Constants<Lanes<S>> for Here<'_, S> {
    #[inline(always)]
    fn number(&self, place: usize) -> Lanes<S> {
        self.part.number(&self.numbers[place])
    }
}

impl ShellBlock {
    #[inline(always)]
    fn gather(&self, at: &Kinematics, frames: &mut [Frames; NODES]) {
        for i in 0..NODES {
            gather_frames(at, &self.nodes[i][..self.count], WIDTH, &mut frames[i]);
        }
    }
}

impl Blocks for ShellBlocks {
    fn forces(
        &self,
        processor: pulp::Arch,
        at: &Kinematics,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &[Block]),
    ) {
        processor.dispatch(Evaluation { shells: self, at, blocks, add });
    }

    fn linearize(
        &self,
        processor: pulp::Arch,
        at_stressed: (&Kinematics, Stressed<'_>),
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, [&[Block]; 2]),
    ) -> bool {
        processor.dispatch(Linearization { shells: self, at_stressed, blocks, add });
        true
    }
}

struct Evaluation<'a> {
    shells: &'a ShellBlocks,
    at: &'a Kinematics,
    blocks: Range<usize>,
    add: &'a mut dyn FnMut(usize, &[Block]),
}

impl WithSimd for Evaluation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut frames = [[[0.0; WIDTH]; 7]; NODES];
        let mut results = [[[0.0; WIDTH]; 6]; NODES];
        for index in self.blocks {
            let block = &self.shells.blocks[index];
            block.gather(self.at, &mut frames);
            for index in 0..parts::<S>(block.count).0 {
                let part = Part { simd, index };
                let here = Here { part, numbers: &block.numbers };
                let mut poses = [part.frame(&frames[0]); NODES];
                for i in 1..NODES {
                    poses[i] = part.frame(&frames[i]);
                }
                let wrenches = forces(&here, &poses);
                for i in 0..NODES {
                    part.store(wrenches[i], &mut results[i]);
                }
            }
            (self.add)(index, results.as_flattened());
        }
    }
}

struct Linearization<'a> {
    shells: &'a ShellBlocks,
    at_stressed: (&'a Kinematics, Stressed<'a>),
    blocks: Range<usize>,
    add: &'a mut dyn FnMut(usize, [&[Block]; 2]),
}

impl WithSimd for Linearization<'_> {
    type Output = ();

    #[expect(clippy::large_stack_arrays, reason = "36 kB once per evaluation: a tangent of a block")]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (at, stressed) = self.at_stressed;
        let mut frames = [[[[0.0; WIDTH]; 7]; NODES]; 2];
        let mut results = [[[0.0; WIDTH]; SIZE]; SIZE];
        let mut matrix = [[Lanes::splat(simd, 0.0); SIZE]; SIZE];
        for index in self.blocks {
            let block = &self.shells.blocks[index];
            block.gather(at, &mut frames[0]);
            block.gather(stressed.previous.unwrap_or(stressed.at), &mut frames[1]);
            for index in 0..parts::<S>(block.count).0 {
                let part = Part { simd, index };
                let here = Here { part, numbers: &block.numbers };
                let mut poses = [[part.frame(&frames[0][0]); NODES]; 2];
                for k in 0..2 {
                    for i in 0..NODES {
                        poses[k][i] = part.frame(&frames[k][i]);
                    }
                }
                let stress = if stressed.previous.is_some() {
                    predicted(&here, &poses[1], &poses[0])
                } else {
                    stress(&here, &Deformed::at(&here, &poses[1]).strains(&here))
                };
                linearize(&here, &poses[0], &stress, &mut matrix);
                for i in 0..SIZE {
                    for j in 0..SIZE {
                        matrix[i][j].store(&mut results[i][j], index);
                    }
                }
            }
            (self.add)(index, [results.as_flattened(), &[]]);
        }
    }
}
