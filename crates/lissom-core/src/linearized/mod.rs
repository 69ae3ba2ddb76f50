//! The linearised model at a state, and analyses without time integration: natural modes, linear buckling, the
//! response to harmonic inputs.
//!
//! ```text
//! M η̈ + (D + M ad_V) η̇ + (K + D ad_V + M ad_V̇) η + Bᵀ μ = 0,    B η = 0
//! ```
//!
//! η body-frame variation of each node (displacement and rotation in the node's axes) and change of each algebraic
//! coordinate, V twist; K contains the geometric stiffness of stresses and of constraints at the multipliers of the
//! state. No constraint is eliminated: every solve uses the sparse saddle-point matrix, without pivoting.

mod arnoldi;
mod averaged;
mod buckling;
mod carried_fields;
mod carried_points;
mod completion;
mod corrections;
mod cubic;
mod energy_shares;
mod free;
mod generator;
mod geometric;
mod inertia;
mod kinks;
mod krylov;
mod lanczos;
mod mode;
mod model;
mod multiblade;
mod natural_modes;
mod output;
mod reduction;
mod response;
mod rolling_axes;
mod schur;
mod shapes;
mod shifted;
mod state_space;
mod steady;
mod velocity_constraints;
mod whirl;

pub use averaged::AveragedModel;
pub use buckling::{Buckling, BucklingError, BucklingMode};
pub use energy_shares::EffectiveMasses;
pub(crate) use inertia::{Verdict, is_stable_like, verdict};
pub use kinks::Kink;
pub use mode::{Completeness, Mode, ModeError, ModeKind, ModeOptions, Modes};
pub(crate) use model::has_forces;
pub use model::{LinearError, LinearModel};
pub use multiblade::NoMultiblade;
pub use output::OutputDerivatives;
pub use reduction::{Assembly, Reduction, ReductionError};
pub use response::{FrequencyResponse, ResponseError};
pub use shapes::NodeShape;
pub use state_space::{StateSpace, StateSpaceError};
pub use steady::{ModeDeviation, SteadyError, steady, steady_on_average};
pub use whirl::Whirl;

/// Eigenvalues of a search and of an inverse iteration that differ by less than this fraction are equal. Also the allowed residual of
/// an inverse iteration, and of a search whose basis has become so large that its residual is round-off.
const EIGENVALUE_TOLERANCE: f64 = 1e-6;
/// Eigenvalues of the search and of the full matrix, and shapes of rigid modes, that differ by less than this fraction are equal.
const EQUAL: f64 = 1e-4;
/// Displacements of differences, as a fraction of the model's length, and rotations [rad]: errors are of the square.
const DISPLACEMENT: f64 = 1e-4;
/// Rate s at which displacements by inertial forces are computed, relative to the rate of rotation: free motions are amplified.
const SLOW_RATE: f64 = 1e-3;
/// Additional modes beyond the requested ones, so that a multiple or clustered eigenvalue at the end is found completely.
const ADDITIONAL_MODES: usize = 4;
