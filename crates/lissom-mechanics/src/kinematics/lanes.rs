//! Several numbers side by side in the lanes of a vector register: gathers the motions of several nodes, and evaluates
//! as many of them at once as the processor's vectors contain.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Block, Lanes, Pose, Real, Screw, WIDTH};
use pulp::Simd;

use crate::kinematics::{Kinematics, NodeId};

/// The fastest instructions for this number of elements: vectors, or none for one or two, which would leave most
/// lanes empty.
pub fn processor_for(count: usize) -> pulp::Arch {
    if count > FEW { pulp::Arch::new() } else { pulp::Arch::Scalar }
}

/// This number of elements takes longer in lanes than one by one.
const FEW: usize = 2;

/// Number of parts of a block with `count` elements, and number of lanes of these parts.
#[inline(always)]
pub fn parts<S: Simd>(count: usize) -> (usize, usize) {
    let parts = count.div_ceil(S::F64_LANES);
    (parts, parts * S::F64_LANES)
}

/// Components of a motion, see [`Pose::components`].
pub type Frames = [Block; 7];

/// Components of twists or wrenches.
pub type Screws = [Block; 6];

/// A part of every block: as many lanes as the processor's vectors contain.
#[derive(Clone, Copy)]
pub struct Part<S> {
    /// Instructions of the processor.
    pub simd: S,
    /// Index of the part in a block.
    pub index: usize,
}

impl<S: Simd> Part<S> {
    #[inline(always)]
    /// Reads one number for each of the part's lanes.
    pub fn number(self, block: &Block) -> Lanes<S> {
        Lanes::load(self.simd, block, self.index)
    }

    #[inline(always)]
    /// Reads the frames of the lanes.
    pub fn frame(self, frames: &Frames) -> Pose<Lanes<S>> {
        let mut components = [self.number(&frames[0]); 7];
        for i in 1..7 {
            components[i] = self.number(&frames[i]);
        }
        Pose::from_components(components)
    }

    #[inline(always)]
    /// Reads the screws of the lanes.
    pub fn screw(self, screws: &Screws) -> Screw<Lanes<S>> {
        let mut components = [self.number(&screws[0]); 6];
        for i in 1..6 {
            components[i] = self.number(&screws[i]);
        }
        Screw::from_components(components)
    }

    /// The product of a matrix, row by row, and a twist.
    #[inline(always)]
    pub fn product(self, matrix: &[Screws; 6], twist: Screw<Lanes<S>>) -> Screw<Lanes<S>> {
        let twist = twist.components();
        let mut result = twist;
        for i in 0..6 {
            result[i] = self.number(&matrix[i][0]) * twist[0];
            for j in 1..6 {
                result[i] = result[i].plus_product(self.number(&matrix[i][j]), twist[j]);
            }
        }
        Screw::from_components(result)
    }

    #[inline(always)]
    /// Writes the frames of the lanes.
    pub fn store_frame(self, frame: Pose<Lanes<S>>, frames: &mut Frames) {
        let components = frame.components();
        for i in 0..7 {
            components[i].store(&mut frames[i], self.index);
        }
    }

    #[inline(always)]
    /// Writes the screws of the lanes.
    pub fn store(self, screw: Screw<Lanes<S>>, screws: &mut Screws) {
        let components = screw.components();
        for i in 0..6 {
            components[i].store(&mut screws[i], self.index);
        }
    }
}

/// Arranges the numbers of `count` elements lane by lane; further lanes of the last vector repeat the first.
#[inline(always)]
pub fn gather<const N: usize>(
    count: usize,
    lanes: usize,
    of: impl Fn(usize) -> [f64; N],
    blocks: &mut [Block; N],
) {
    if count < lanes {
        let first = of(0);
        for i in 0..N {
            blocks[i] = [first[i]; WIDTH];
        }
    }
    for lane in 0..count.min(WIDTH) {
        let own = of(lane);
        for i in 0..N {
            blocks[i][lane] = own[i];
        }
    }
}

/// The frames of up to eight nodes, for as many lanes.
#[inline]
pub fn gather_frames(at: &Kinematics, nodes: &[NodeId], lanes: usize, frames: &mut Frames) {
    gather(nodes.len(), lanes, |lane| Pose::from(&at.nodes[nodes[lane]].frame).components(), frames);
}

/// The twists of up to eight nodes.
#[inline]
pub fn gather_twists(at: &Kinematics, nodes: &[NodeId], lanes: usize, twists: &mut Screws) {
    gather(nodes.len(), lanes, |lane| at.nodes[nodes[lane]].twist.into(), twists);
}

/// The accelerations of up to eight nodes.
#[inline]
pub fn gather_accelerations(at: &Kinematics, nodes: &[NodeId], lanes: usize, accelerations: &mut Screws) {
    gather(nodes.len(), lanes, |lane| at.nodes[nodes[lane]].acceleration.into(), accelerations);
}
