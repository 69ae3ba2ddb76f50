//! How the values of a sweep are combined or drawn. A new sampling is one file here and one line in `kinds`.
//! Draws depend on the seed, the path's number and the member alone.

mod grid;
mod kinds;
mod latin_hypercube;
mod list;
mod monte_carlo;
mod normal;
mod random;
mod sobol;

pub use kinds::SAMPLINGS;
pub(super) use kinds::WORDS;
pub(crate) use normal::normal_quantile;

/// How a sampling fills the table of members by varied paths, member by member.
pub(super) enum Draw {
    /// Indices of values, from the numbers of values of all paths.
    Indices(fn(&[usize]) -> Result<Vec<usize>, String>),
    /// Fractions between 0 and 1, both excluded, for a number of paths, a number of members and a seed.
    Fractions(fn(usize, usize, u64) -> Result<Vec<f64>, String>),
}

/// One way to sample.
pub struct SamplingKind {
    /// Word in the sweep file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    pub(super) draw: Draw,
}
