//! Sparse direct solvers for families of matrices that share one structurally symmetric pattern: one symbolic
//! analysis, many factorisations into preallocated memory, solves without allocation.
//!
//! They are designed for saddle-point matrices `[A + p BᵀB, Bᵀ; B, 0]` whose first block is definite. Eliminated in
//! an order in which every multiplier follows the coordinates of its equations, these need no pivoting, and the whole
//! elimination is known before the values are. The solvers are independent of mechanics and of time.
//!
//! ```
//! use std::sync::Arc;
//! use lissom_solver::{Group, Pattern, Structure, kind};
//!
//! // Two coordinates, the second without stiffness of its own, and a multiplier that acts on both.
//! let pattern = Arc::new(Pattern::from_cliques(3, [&[0, 1, 2][..]]));
//! let groups = vec![
//!     Group { unknowns: vec![0, 1], hosts: vec![] },
//!     Group { unknowns: vec![2], hosts: vec![0] },
//! ];
//! let structure = Structure::new(pattern, groups).unwrap();
//! let mut solver = (kind("sparse").unwrap().real)(&structure);
//! solver.factor(&[4.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 0.0]).unwrap();
//! let mut unknowns = [4.0, -1.0, 0.0];
//! solver.solve(&mut unknowns);
//! assert_eq!(unknowns, [1.0, 1.0, 1.0]);
//! ```

mod condition;
mod entries;
pub mod interrupt;
mod kinds;
mod multifrontal;
mod ordering;
mod pattern;
mod pivoting;
mod report;
mod scalar;
mod solver;
mod structure;
mod thread_pool;

#[cfg(test)]
extern crate self as lissom_solver;
#[cfg(test)]
#[path = "../tests/samples.rs"]
mod samples;

pub use condition::condition_estimate;
pub use kinds::{KINDS, SYMMETRIC, SolverKind, kind};
pub use multifrontal::{Kernels, Multifrontal, Symmetric};
pub use ordering::minimum_degree_order;
pub use pattern::Pattern;
pub use pivoting::Pivoting;
pub use report::{FactorError, FactorReport, TINY_PIVOT};
pub use scalar::Scalar;
pub use solver::{LinearSolver, SEVERAL};
pub use structure::{Group, Structure, StructureError};
pub use thread_pool::in_parallel;
