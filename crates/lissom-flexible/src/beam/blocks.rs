//! Beams in blocks of eight, see `blocks`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::cell::RefCell;
use std::ops::Range;

use lissom_motion::{Block, Lanes, Pose, Real, Screw, WIDTH};
use pulp::{Simd, WithSimd};

use super::Beam;
use super::forces::{Constants, forces};
use super::linearize::{Laws, Matrices, Viscous, linearize, through_offsets};
use lissom_mechanics::evaluation::blocks::{Blocks, block_of, nodes_of};
use lissom_mechanics::kinematics::lanes::{Frames, Part, Screws, gather_frames, gather_twists, parts};
use lissom_mechanics::kinematics::{Kinematics, MAX_NODES, NodeId, Stressed};

/// Beams in blocks of eight.
pub(super) struct BeamBlocks {
    blocks: Vec<BeamBlock>,
    /// Shape functions at the Gauss points, the same in all elements.
    shapes: Vec<Vec<f64>>,
}

/// Eight beams.
struct BeamBlock {
    count: usize,
    nodes: Vec<[NodeId; WIDTH]>,
    /// Section frames relative to the nodes' frames, if any differs.
    offsets: Option<Vec<Frames>>,
    /// Whether any of them is damped.
    damped: bool,
    stations: Vec<StationBlock>,
}

/// One Gauss point of eight beams.
struct StationBlock {
    slope: Vec<Block>,
    natural: Screws,
    damping: Block,
    /// Weight times stiffness, row after row.
    law: [Screws; 6],
}

/// Node motions of one block, here and where stresses are taken, and its results.
struct Scratch {
    frames: [[Frames; MAX_NODES]; 2],
    twists: [[Screws; MAX_NODES]; 2],
    forces: [Screws; MAX_NODES],
    derivatives: [[Block; 36 * MAX_NODES * MAX_NODES]; 2],
}

thread_local! {
    /// One per thread: because of its size it is not cleared at each evaluation.
    static SCRATCH: RefCell<Scratch> = const {
        RefCell::new(Scratch {
            frames: [[[[0.0; WIDTH]; 7]; MAX_NODES]; 2],
            twists: [[[[0.0; WIDTH]; 6]; MAX_NODES]; 2],
            forces: [[[0.0; WIDTH]; 6]; MAX_NODES],
            derivatives: [[[0.0; WIDTH]; 36 * MAX_NODES * MAX_NODES]; 2],
        })
    };
}

impl BeamBlocks {
    pub(super) fn new<const N: usize>(beams: &[Beam<N>]) -> Self {
        let shapes =
            beams.first().map(|beam| beam.stations.iter().map(|station| station.shape.to_vec()).collect());
        Self { blocks: beams.chunks(WIDTH).map(BeamBlock::new).collect(), shapes: shapes.unwrap_or_default() }
    }
}

impl BeamBlock {
    fn new<const N: usize>(beams: &[Beam<N>]) -> Self {
        let offset = |i: usize, k: usize| {
            block_of(beams, |beam| Pose::from(&beam.offsets[i].unwrap_or_default()).components()[k])
        };
        let offsets = beams
            .iter()
            .any(|beam| beam.offsets.iter().any(Option::is_some))
            .then(|| (0..N).map(|i| std::array::from_fn(|k| offset(i, k))).collect());
        Self {
            count: beams.len(),
            nodes: (0..N).map(|i| nodes_of(beams, |beam| beam.nodes[i])).collect(),
            offsets,
            damped: beams.iter().any(Beam::is_damped),
            stations: (0..N - 1).map(|k| StationBlock::new(beams, k)).collect(),
        }
    }
}

impl StationBlock {
    fn new<const N: usize>(beams: &[Beam<N>], k: usize) -> Self {
        let law = |i: usize, j: usize| {
            block_of(beams, |beam| beam.stations[k].weight * beam.stations[k].law.stiffness[(i, j)])
        };
        Self {
            slope: (0..N).map(|i| block_of(beams, |beam| beam.stations[k].slope[i])).collect(),
            natural: std::array::from_fn(|i| block_of(beams, |beam| beam.stations[k].natural[i])),
            damping: block_of(beams, |beam| beam.stations[k].law.damping),
            law: std::array::from_fn(|i| std::array::from_fn(|j| law(i, j))),
        }
    }
}

impl Blocks for BeamBlocks {
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
        SCRATCH.with_borrow_mut(|scratch| {
            processor.dispatch(Linearization { beams: self, at_stressed, blocks, scratch, add });
        });
        true
    }
}

struct Evaluation<'a> {
    beams: &'a BeamBlocks,
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
            let block = &self.beams.blocks[index];
            match block.nodes.len() {
                2 => block.forces::<S, 2>(simd, self.at, &self.beams.shapes, self.scratch),
                3 => block.forces::<S, 3>(simd, self.at, &self.beams.shapes, self.scratch),
                _ => block.forces::<S, MAX_NODES>(simd, self.at, &self.beams.shapes, self.scratch),
            }
            (self.add)(index, self.scratch.forces[..block.nodes.len()].as_flattened());
        }
    }
}

struct Linearization<'a> {
    beams: &'a BeamBlocks,
    at_stressed: (&'a Kinematics, Stressed<'a>),
    blocks: Range<usize>,
    scratch: &'a mut Scratch,
    add: &'a mut dyn FnMut(usize, [&[Block]; 2]),
}

impl WithSimd for Linearization<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (at, stressed) = self.at_stressed;
        let zero = Lanes::splat(simd, 0.0);
        // Most beams are not damped: because of their size, these are cleared only where they are used.
        let mut matrices = [[[Screw::zero(zero); 6]; MAX_NODES]; MAX_NODES];
        let mut viscous = None;
        for index in self.blocks {
            let block = &self.beams.blocks[index];
            if block.damped && viscous.is_none() {
                viscous = Some(matrices);
            }
            for (j, motion) in [at, stressed.at].into_iter().enumerate() {
                block.gather(motion, WIDTH, j, self.scratch);
            }
            let viscous = if block.damped { viscous.as_mut() } else { None };
            block.linearize(simd, &self.beams.shapes, self.scratch, &mut matrices, viscous);
            let size = 36 * block.nodes.len() * block.nodes.len();
            let [stiffness, damping] = &self.scratch.derivatives;
            (self.add)(index, [&stiffness[..size], if block.damped { &damping[..size] } else { &[] }]);
        }
    }
}

/// Constants of part of a block.
struct Here<'a, S> {
    part: Part<S>,
    stations: &'a [StationBlock],
    shapes: &'a [Vec<f64>],
}

impl<S: Simd> Laws<Lanes<S>> for Here<'_, S> {
    #[inline(always)]
    fn law(&self, k: usize) -> [Screw<Lanes<S>>; 6] {
        let law = &self.stations[k].law;
        let mut rows = [self.part.screw(&law[0]); 6];
        for i in 1..6 {
            rows[i] = self.part.screw(&law[i]);
        }
        rows
    }
}

impl<S: Simd> Constants<Lanes<S>> for Here<'_, S> {
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
    fn stress(&self, k: usize, strain: Screw<Lanes<S>>) -> Screw<Lanes<S>> {
        self.part.product(&self.stations[k].law, strain)
    }
}

impl BeamBlock {
    /// Gathers the motions `j`.
    fn gather(&self, at: &Kinematics, lanes: usize, j: usize, scratch: &mut Scratch) {
        for (i, nodes) in self.nodes.iter().enumerate() {
            gather_frames(at, &nodes[..self.count], lanes, &mut scratch.frames[j][i]);
            if self.damped {
                gather_twists(at, &nodes[..self.count], lanes, &mut scratch.twists[j][i]);
            }
        }
    }

    #[inline(always)]
    fn forces<S: Simd, const N: usize>(
        &self,
        simd: S,
        at: &Kinematics,
        shapes: &[Vec<f64>],
        scratch: &mut Scratch,
    ) {
        let (parts, lanes) = parts::<S>(self.count);
        self.gather(at, lanes, 0, scratch);
        for index in 0..parts {
            let part = Part { simd, index };
            let mut sections = [part.frame(&scratch.frames[0][0]); N];
            let mut moving = [part.screw(&scratch.twists[0][0]); N];
            for i in 0..N {
                sections[i] = part.frame(&scratch.frames[0][i]);
                moving[i] = part.screw(&scratch.twists[0][i]);
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
                part.store(forces[i], &mut scratch.forces[i]);
            }
        }
    }

    #[inline(always)]
    fn linearize<S: Simd>(
        &self,
        simd: S,
        shapes: &[Vec<f64>],
        scratch: &mut Scratch,
        stiffness: &mut Matrices<Lanes<S>>,
        mut damping: Option<&mut Matrices<Lanes<S>>>,
    ) {
        let nodes = self.nodes.len();
        for index in 0..parts::<S>(self.count).0 {
            let part = Part { simd, index };
            let mut frames = [[part.frame(&scratch.frames[0][0]); MAX_NODES]; 2];
            let zero = Screw::zero(frames[0][0].position.x);
            let mut twists = [[part.screw(&scratch.twists[0][0]); MAX_NODES]; 2];
            let mut offsets = frames[0];
            for i in 0..nodes {
                if let Some(own) = &self.offsets {
                    offsets[i] = part.frame(&own[i]);
                }
                for j in 0..2 {
                    frames[j][i] = part.frame(&scratch.frames[j][i]);
                    twists[j][i] = part.screw(&scratch.twists[j][i]);
                    if self.offsets.is_some() {
                        frames[j][i] = frames[j][i] * offsets[i];
                        twists[j][i] = offsets[i].adjoint_inverse_times(twists[j][i]);
                    }
                }
            }
            let here = Here { part, stations: &self.stations, shapes };
            let offsets = self.offsets.is_some().then_some(&offsets[..nodes]);
            clear(nodes, zero, stiffness);
            if let Some(damping) = &mut damping {
                clear(nodes, zero, damping);
            }
            let twists = [&twists[0][..nodes], &twists[1][..nodes]];
            let viscous = damping.as_deref_mut().map(|damping| Viscous { twists, damping });
            linearize(&here, &frames[0][..nodes], &frames[1][..nodes], stiffness, viscous);
            let [out, damping_out] = &mut scratch.derivatives;
            store(part, nodes, stiffness, offsets, out);
            if let Some(damping) = &mut damping {
                store(part, nodes, damping, offsets, damping_out);
            }
        }
    }
}

#[inline(always)]
fn clear<R: Real>(nodes: usize, zero: Screw<R>, matrices: &mut Matrices<R>) {
    for i in 0..nodes {
        for m in 0..nodes {
            matrices[i][m] = [zero; 6];
        }
    }
}

#[inline(always)]
fn store<S: Simd>(
    part: Part<S>,
    nodes: usize,
    matrices: &mut Matrices<Lanes<S>>,
    offsets: Option<&[Pose<Lanes<S>>]>,
    out: &mut [Block],
) {
    if let Some(offsets) = offsets {
        through_offsets(matrices, offsets);
    }
    for i in 0..nodes {
        for m in 0..nodes {
            for row in 0..6 {
                let first = 6 * ((6 * i + row) * nodes + m);
                let components = matrices[i][m][row].components();
                let own = &mut out[first..first + 6];
                for column in 0..6 {
                    components[column].store(&mut own[column], part.index);
                }
            }
        }
    }
}
