//! Elements of one kind evaluated several at a time, in the lanes of vector registers.
//!
//! Blocks of eight hold the elements' constants lane by lane, whatever the processor; node motions are gathered into
//! such blocks at each evaluation. The last block repeats its last element.

use std::ops::Range;

use lissom_motion::{Block, WIDTH};

use crate::kinematics::{Kinematics, NodeId};

/// All elements of a batch, eight to a block.
pub trait Blocks: Send + Sync {
    /// Computes the forces of whole blocks and hands each block's to `add`, in order: first the block's number, then
    /// the forces, local unknown after local unknown; in lanes beyond the last element is anything. The same
    /// elements give the same forces to the last bit, whichever blocks are asked for.
    fn forces(
        &self,
        processor: pulp::Arch,
        at: &Kinematics,
        blocks: Range<usize>,
        add: &mut dyn FnMut(usize, &[Block]),
    );

    /// Hands the derivatives of the forces by positions to `add` in the same way, row after row of the local matrices,
    /// with the stresses of another configuration in the geometric stiffness. Default: `false`, and nothing is
    /// computed; so as well where forces depend on more than positions.
    fn stiffness(
        &self,
        _processor: pulp::Arch,
        _at_stressed: (&Kinematics, &Kinematics),
        _blocks: Range<usize>,
        _add: &mut dyn FnMut(usize, &[Block]),
    ) -> bool {
        false
    }
}

/// One number of each element of a block.
pub(super) fn block_of<E>(elements: &[E], number: impl Fn(&E) -> f64) -> Block {
    std::array::from_fn(|lane| number(&elements[lane.min(elements.len() - 1)]))
}

/// One node of each element of a block.
pub(super) fn nodes_of<E>(elements: &[E], node: impl Fn(&E) -> NodeId) -> [NodeId; WIDTH] {
    std::array::from_fn(|lane| node(&elements[lane.min(elements.len() - 1)]))
}
