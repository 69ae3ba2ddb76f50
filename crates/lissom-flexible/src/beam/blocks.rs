//! Beams in blocks of eight, see `blocks`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::cell::RefCell;
use std::ops::Range;

use lissom_motion::{Block, Lanes, Pose, Screw, WIDTH};
use pulp::{Simd, WithSimd};

use super::Beam;
use super::forces::{Constants, forces};
use super::linearize::{Matrices, Viscous, linearize, through_offsets};
use lissom_mechanics::evaluation::blocks::{Blocks, block_of, nodes_of};
use lissom_mechanics::kinematics::lanes::{Frames, Part, Screws, gather_frames, gather_twists, parts};
use lissom_mechanics::kinematics::{Kinematics, MAX_NODES, NodeId, Stressed};

/// Beams in blocks of eight.
pub(super) struct BeamBlocks<const N: usize> {
    blocks: Vec<BeamBlock<N>>,
    /// Shape functions at the Gauss points, the same in all elements.
    shapes: Vec<[f64; N]>,
}

/// Eight beams.
struct BeamBlock<const N: usize> {
    count: usize,
    nodes: [[NodeId; WIDTH]; N],
    /// Section frames relative to the nodes' frames, if any differs.
    offsets: Option<Box<[Frames; N]>>,
    /// Whether any of them is damped.
    damped: bool,
    stations: Vec<StationBlock<N>>,
}

/// One Gauss point of eight beams.
struct StationBlock<const N: usize> {
    slope: [Block; N],
    natural: Screws,
    damping: Block,
    /// Weight times stiffness, row after row.
    law: [Screws; 6],
}

/// Node motions and forces of one block.
struct Scratch {
    frames: [Frames; MAX_NODES],
    twists: [Screws; MAX_NODES],
    results: [Screws; MAX_NODES],
}

thread_local! {
    /// One per thread: because of its size it is not cleared at each evaluation.
    static SCRATCH: RefCell<Scratch> = const {
        RefCell::new(Scratch {
            frames: [[[0.0; WIDTH]; 7]; MAX_NODES],
            twists: [[[0.0; WIDTH]; 6]; MAX_NODES],
            results: [[[0.0; WIDTH]; 6]; MAX_NODES],
        })
    };
}

impl<const N: usize> BeamBlocks<N> {
    pub(super) fn new(beams: &[Beam<N>]) -> Self {
        let shapes = beams.first().map(|beam| beam.stations.iter().map(|station| station.shape).collect());
        Self { blocks: beams.chunks(WIDTH).map(BeamBlock::new).collect(), shapes: shapes.unwrap_or_default() }
    }
}

impl<const N: usize> BeamBlock<N> {
    fn new(beams: &[Beam<N>]) -> Self {
        let offset = |i: usize, k: usize| {
            block_of(beams, |beam| Pose::from(&beam.offsets[i].unwrap_or_default()).components()[k])
        };
        let offsets = beams
            .iter()
            .any(|beam| beam.offsets.iter().any(Option::is_some))
            .then(|| Box::new(std::array::from_fn(|i| std::array::from_fn(|k| offset(i, k)))));
        Self {
            count: beams.len(),
            nodes: std::array::from_fn(|i| nodes_of(beams, |beam| beam.nodes[i])),
            offsets,
            damped: beams.iter().any(Beam::is_damped),
            stations: (0..N - 1).map(|k| StationBlock::new(beams, k)).collect(),
        }
    }
}

impl<const N: usize> StationBlock<N> {
    fn new(beams: &[Beam<N>], k: usize) -> Self {
        let law = |i: usize, j: usize| {
            block_of(beams, |beam| beam.stations[k].weight * beam.stations[k].law.stiffness[(i, j)])
        };
        Self {
            slope: std::array::from_fn(|i| block_of(beams, |beam| beam.stations[k].slope[i])),
            natural: std::array::from_fn(|i| block_of(beams, |beam| beam.stations[k].natural[i])),
            damping: block_of(beams, |beam| beam.stations[k].law.damping),
            law: std::array::from_fn(|i| std::array::from_fn(|j| law(i, j))),
        }
    }
}

impl<const N: usize> Blocks for BeamBlocks<N> {
    fn forces(
        &self,
        processor: pulp::Arch,
        at: &Kinematics,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &[Block]),
    ) {
        SCRATCH.with_borrow_mut(|scratch| {
            processor.dispatch(Evaluation { beams: self, at, blocks, scratch, add });
        });
    }

    fn linearize(
        &self,
        processor: pulp::Arch,
        at_stressed: (&Kinematics, Stressed<'_>),
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, [&[Block]; 2]),
    ) -> bool {
        processor.dispatch(Linearization { beams: self, at_stressed, blocks, add });
        true
    }
}

struct Evaluation<'a, const N: usize> {
    beams: &'a BeamBlocks<N>,
    at: &'a Kinematics,
    blocks: Range<usize>,
    scratch: &'a mut Scratch,
    add: &'a mut dyn FnMut(usize, &[Block]),
}

impl<const N: usize> WithSimd for Evaluation<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for index in self.blocks {
            self.beams.blocks[index].forces(simd, self.at, &self.beams.shapes, self.scratch);
            (self.add)(index, self.scratch.results[..N].as_flattened());
        }
    }
}

struct Linearization<'a, const N: usize> {
    beams: &'a BeamBlocks<N>,
    at_stressed: (&'a Kinematics, Stressed<'a>),
    blocks: Range<usize>,
    add: &'a mut dyn FnMut(usize, [&[Block]; 2]),
}

/// Motions of two configurations of one block.
struct Gathered<const N: usize> {
    frames: [[Frames; N]; 2],
    twists: [[Screws; N]; 2],
}

/// Derivatives of the forces of one block, by node and component of the force, then of the variation.
type Local<const N: usize> = [[[Screws; N]; 6]; N];

impl<const N: usize> WithSimd for Linearization<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (at, stressed) = self.at_stressed;
        let mut gathered =
            Gathered { frames: [[[[0.0; WIDTH]; 7]; N]; 2], twists: [[[[0.0; WIDTH]; 6]; N]; 2] };
        let mut results = [[[[[[0.0; WIDTH]; 6]; N]; 6]; N]; 2];
        for index in self.blocks {
            let block = &self.beams.blocks[index];
            for i in 0..N {
                let nodes = &block.nodes[i][..block.count];
                for (j, motion) in [at, stressed.at].into_iter().enumerate() {
                    gather_frames(motion, nodes, WIDTH, &mut gathered.frames[j][i]);
                    if block.damped {
                        gather_twists(motion, nodes, WIDTH, &mut gathered.twists[j][i]);
                    }
                }
            }
            block.linearize(simd, &gathered, &self.beams.shapes, &mut results);
            let [stiffness, damping] =
                [0, 1].map(|k| results[k].as_flattened().as_flattened().as_flattened());
            (self.add)(index, [stiffness, if block.damped { damping } else { &[] }]);
        }
    }
}

/// Constants of part of a block.
struct Here<'a, S, const N: usize> {
    part: Part<S>,
    stations: &'a [StationBlock<N>],
    shapes: &'a [[f64; N]],
}

impl<S: Simd, const N: usize> Constants<Lanes<S>> for Here<'_, S, N> {
    #[inline(always)]
    fn shape(&self, k: usize, i: usize) -> f64 {
        self.shapes[k][i]
    }

    #[inline(always)]
    fn slope(&self, k: usize, i: usize) -> Lanes<S> {
        self.part.number(&self.stations[k].slope[i])
    }

    #[inline(always)]
    fn natural(&self, k: usize) -> Screw<Lanes<S>> {
        self.part.screw(&self.stations[k].natural)
    }

    #[inline(always)]
    fn damping(&self, k: usize) -> Lanes<S> {
        self.part.number(&self.stations[k].damping)
    }

    #[inline(always)]
    fn law(&self, k: usize) -> [Screw<Lanes<S>>; 6] {
        let law = &self.stations[k].law;
        let mut rows = [self.part.screw(&law[0]); 6];
        for i in 1..6 {
            rows[i] = self.part.screw(&law[i]);
        }
        rows
    }

    #[inline(always)]
    fn stress(&self, k: usize, strain: Screw<Lanes<S>>) -> Screw<Lanes<S>> {
        self.part.product(&self.stations[k].law, strain)
    }
}

impl<const N: usize> BeamBlock<N> {
    #[inline(always)]
    fn forces<S: Simd>(&self, simd: S, at: &Kinematics, shapes: &[[f64; N]], scratch: &mut Scratch) {
        let Scratch { frames, twists, results } = scratch;
        let (parts, lanes) = parts::<S>(self.count);
        for i in 0..N {
            let nodes = &self.nodes[i][..self.count];
            gather_frames(at, nodes, lanes, &mut frames[i]);
            if self.damped {
                gather_twists(at, nodes, lanes, &mut twists[i]);
            }
        }
        for index in 0..parts {
            let part = Part { simd, index };
            let mut sections = [part.frame(&frames[0]); N];
            let mut moving = [part.screw(&twists[0]); N];
            for i in 0..N {
                sections[i] = part.frame(&frames[i]);
                moving[i] = part.screw(&twists[i]);
                if let Some(offsets) = &self.offsets {
                    let offset = part.frame(&offsets[i]);
                    sections[i] = sections[i] * offset;
                    moving[i] = offset.adjoint_inverse_times(moving[i]);
                }
            }
            let here = Here { part, stations: &self.stations, shapes };
            let mut forces = forces(&here, &sections, self.damped.then_some(&moving));
            for i in 0..N {
                if let Some(offsets) = &self.offsets {
                    forces[i] = part.frame(&offsets[i]).adjoint_inverse_transpose_times(forces[i]);
                }
                part.store(forces[i], &mut results[i]);
            }
        }
    }

    #[inline(always)]
    fn linearize<S: Simd>(
        &self,
        simd: S,
        gathered: &Gathered<N>,
        shapes: &[[f64; N]],
        results: &mut [Local<N>; 2],
    ) {
        for index in 0..parts::<S>(self.count).0 {
            let part = Part { simd, index };
            let mut frames = [[part.frame(&gathered.frames[0][0]); N]; 2];
            let zero = Screw::zero(frames[0][0].position.x);
            let mut twists = [[zero; N]; 2];
            let mut offsets = frames[0];
            for i in 0..N {
                if let Some(own) = &self.offsets {
                    offsets[i] = part.frame(&own[i]);
                }
                for j in 0..2 {
                    frames[j][i] = part.frame(&gathered.frames[j][i]);
                    twists[j][i] = part.screw(&gathered.twists[j][i]);
                    if self.offsets.is_some() {
                        frames[j][i] = frames[j][i] * offsets[i];
                        twists[j][i] = offsets[i].adjoint_inverse_times(twists[j][i]);
                    }
                }
            }
            let here = Here { part, stations: &self.stations, shapes };
            let mut stiffness = [[[zero; 6]; N]; N];
            if self.damped {
                let mut damping = [[[zero; 6]; N]; N];
                let viscous = Viscous { twists: [&twists[0], &twists[1]], damping: &mut damping };
                linearize(&here, &frames[0], &frames[1], &mut stiffness, Some(viscous));
                self.store(part, &mut damping, &offsets, &mut results[1]);
            } else {
                linearize(&here, &frames[0], &frames[1], &mut stiffness, None);
            }
            self.store(part, &mut stiffness, &offsets, &mut results[0]);
        }
    }

    #[inline(always)]
    fn store<S: Simd>(
        &self,
        part: Part<S>,
        matrices: &mut Matrices<Lanes<S>, N>,
        offsets: &[Pose<Lanes<S>>; N],
        results: &mut Local<N>,
    ) {
        if self.offsets.is_some() {
            through_offsets(matrices, offsets);
        }
        for i in 0..N {
            for m in 0..N {
                for row in 0..6 {
                    part.store(matrices[i][m][row], &mut results[i][row][m]);
                }
            }
        }
    }
}
