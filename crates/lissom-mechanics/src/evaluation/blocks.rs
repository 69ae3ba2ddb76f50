//! Elements of one kind evaluated several at a time, in the lanes of vector registers.
//!
//! Blocks of eight store the elements' constants lane by lane, independent of the processor; node motions are
//! gathered into such blocks at each evaluation. The last block repeats its last element.

use std::ops::Range;

use lissom_motion::{Block, WIDTH};

use super::element::Tangents;
use crate::kinematics::{Kinematics, NodeId, Stressed};

/// All elements of a batch, in blocks of eight.
pub trait Blocks: Send + Sync {
    /// Computes the forces of whole blocks and passes those of each block to `add`, in order: the block's index, then
    /// the forces, local unknown by local unknown; lanes beyond the last element are undefined. The same elements
    /// have the same forces to the last bit, whichever blocks are requested.
    fn forces(
        &self,
        processor: pulp::Arch,
        at: &Kinematics,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &[Block]),
    );

    /// Passes the derivatives of the forces with respect to positions and to twists to `add` in the same way, row by row of the
    /// local matrices; those with respect to twists are empty if they are zero. The geometric stiffness has the stresses of another
    /// configuration. Returns `false` and computes nothing by default.
    fn linearize(
        &self,
        _processor: pulp::Arch,
        _at_stressed: (&Kinematics, Stressed<'_>),
        _blocks: Range<usize>,
        _add: &mut dyn FnMut(usize, [&[Block]; 2]),
    ) -> bool {
        false
    }
}

/// Adds the derivatives of the only element.
pub fn linearize_alone(element: &impl Blocks, at_stressed: (&Kinematics, Stressed<'_>), out: &mut Tangents) {
    element.linearize(pulp::Arch::Scalar, at_stressed, 0..1, &mut |_, entries| {
        for (values, entries) in [&mut out.stiffness, &mut out.damping].into_iter().zip(entries) {
            values.iter_mut().zip(entries).for_each(|(sum, entry)| *sum += entry[0]);
        }
    });
}

/// A constant of each element of a block.
pub fn block_of<E>(elements: &[E], number: impl Fn(&E) -> f64) -> Block {
    std::array::from_fn(|lane| number(&elements[lane.min(elements.len() - 1)]))
}

/// One node of each element of a block.
pub fn nodes_of<E>(elements: &[E], node: impl Fn(&E) -> NodeId) -> [NodeId; WIDTH] {
    std::array::from_fn(|lane| node(&elements[lane.min(elements.len() - 1)]))
}
