//! Interface of the shapes of cross sections.

use super::ShearTheory;
use crate::format::keys::Key;
use crate::reading::reader::Reader;
use crate::sections::Outline;

/// Integrals over a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integrals {
    /// Area [m²].
    pub(crate) area: f64,
    /// `∫ x₃² dA` and `∫ x₂² dA` [m⁴]: second moments for bending about axes 2 and 3.
    pub(crate) second: [f64; 2],
    /// St-Venant's torsion constant [m⁴].
    pub(crate) torsion: f64,
}

/// A shape of cross section.
pub(crate) trait CrossSection {
    /// Integrals of the section about the centroid.
    fn integrals(&self) -> Integrals;

    /// Shear coefficients for shear along axes 2 and 3 [–].
    fn shear_coefficients(&self, theory: ShearTheory, poisson: f64) -> [f64; 2];
    /// Shape for drawings.
    fn outline(&self) -> Outline;
}

/// A kind of shape in the model file.
pub(crate) struct SectionKind {
    /// Name in the model file.
    pub(crate) name: &'static str,
    /// One sentence.
    pub(crate) summary: &'static str,
    /// Keys of the kind.
    pub(crate) keys: fn() -> Vec<Key>,
    /// Reads it from its table and reports errors.
    pub(crate) read: fn(&Reader<'_, '_>) -> Option<Box<dyn CrossSection>>,
}
