//! Evaluation of elements in batches of one kind, and the positions of local forces and derivatives in the equations of
//! the system. Knows no system, no scheme and no step size.

pub(crate) mod batch;
pub(crate) mod linearization;
pub(crate) mod scatter_map;
pub(crate) mod scratch;
pub(crate) mod tangent_assembler;
pub(crate) mod threads;
pub(crate) mod work;

pub use linearization::{Linearization, Scratch};
pub use tangent_assembler::{Blend, Sum, TangentAssembler};
pub use threads::WORTH_WHILE;
