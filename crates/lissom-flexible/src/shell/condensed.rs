//! The constant stiffness of a shell element for its natural strains: quadrature of the section's law, with enhanced membrane
//! strains condensed once [Simo and Rifai 1990].
//!
//! ```text
//! D = Σ w Pᵀ C P - Lᵀ H⁻¹ L,    L = Σ w Mᵀ C P,    H = Σ w Mᵀ C M,    M = (j₀/j) T₀ [r 0 0 0; 0 s 0 0; 0 0 r s]
//! ```
//!
//! The energy is quadratic in the strains, so the enhanced modes follow from them: they are no unknowns and have no history.

use nalgebra::{SMatrix, SVector};

use super::interpolation::{interpolation, to_local};
use super::quadrilateral::{GAUSS_POINTS, STRAINS, bilinear};
use super::reference::Reference;
use super::section::ShellLaw;

/// Stiffness for the natural strains [N m].
pub(super) type Stiffness = SMatrix<f64, STRAINS, STRAINS>;

/// The stiffness of an element.
pub(super) fn stiffness(reference: &Reference, law: &ShellLaw) -> Stiffness {
    let c = law.with_drilling();
    let centre = reference.axes(0.0, 0.0);
    let mut d = Stiffness::zeros();
    let mut enhanced_stiffness = SMatrix::<f64, 4, 4>::zeros();
    let mut l = SMatrix::<f64, 4, STRAINS>::zeros();
    let at_centre = centre.jacobian.try_inverse().map(|inverse| to_local(&inverse)).unwrap_or_default();
    for &(r, s) in &GAUSS_POINTS {
        let axes = reference.axes(r, s);
        let p = interpolation(reference, &axes, r, s);
        let cp = c * p;
        d += axes.area * (p.transpose() * cp);
        let mut modes = SMatrix::<f64, 3, 4>::zeros();
        (modes[(0, 0)], modes[(1, 1)], modes[(2, 2)], modes[(2, 3)]) = (r, s, r, s);
        let enhanced = (centre.area / axes.area) * (at_centre * modes);
        enhanced_stiffness += axes.area * (enhanced.transpose() * c.fixed_view::<3, 3>(0, 0) * enhanced);
        l += axes.area * (enhanced.transpose() * cp.fixed_rows::<3>(0));
    }
    if let Some(cholesky) = enhanced_stiffness.cholesky() {
        d -= l.transpose() * cholesky.solve(&l);
    }
    0.5 * (d + d.transpose())
}

/// Area of the element, and the share of each node: the integrals of its bilinear function.
pub(super) fn areas(reference: &Reference) -> SVector<f64, 4> {
    let mut shares = SVector::<f64, 4>::zeros();
    for &(r, s) in &GAUSS_POINTS {
        let area = reference.axes(r, s).area;
        shares += area * SVector::from(bilinear(r, s)[0]);
    }
    shares
}
