//! Where a local load acts, and the variables of its functions.

use lissom_mechanics::elements::local_load::LocalLoad;

/// Elements of a load.
#[derive(Clone)]
pub(crate) struct LocalLoadPoints {
    /// Fraction of the length of the beam, and the element there.
    pub(crate) points: Vec<(f64, LocalLoad)>,
    /// The beam along which it is distributed.
    pub(crate) beam: Option<String>,
    /// Names of its variables, and the positions of their functions.
    pub(crate) variables: Vec<(String, usize)>,
}
