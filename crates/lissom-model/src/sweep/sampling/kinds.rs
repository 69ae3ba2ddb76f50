//! The table of samplings.

use super::{SamplingKind, grid, latin_hypercube, list, monte_carlo, sobol};

/// All of them; the first is the default.
pub static SAMPLINGS: [SamplingKind; 5] =
    [grid::KIND, list::KIND, latin_hypercube::KIND, sobol::KIND, monte_carlo::KIND];

/// The words, in the order of [`SAMPLINGS`].
pub(crate) const WORDS: [&str; 5] =
    [grid::KIND.name, list::KIND.name, latin_hypercube::KIND.name, sobol::KIND.name, monte_carlo::KIND.name];
