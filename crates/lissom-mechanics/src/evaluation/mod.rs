//! Interface of elements, their evaluation in batches of one kind, and the positions of local forces and derivatives in the equations of
//! the system. Independent of the system, the scheme and the step size.

pub mod batch;
pub mod blocks;
pub mod capabilities;
pub mod element;
pub mod limits;
pub mod linearization;
pub mod report;
pub mod scatter_map;
pub mod scratch;
pub mod switch_states;
pub mod tangent_assembler;
pub mod threads;
pub mod work;
pub mod wrench;

pub use linearization::{Linearization, Scratch};
pub use tangent_assembler::{Blend, Sum, TangentAssembler};
pub use threads::WORTH_WHILE;
