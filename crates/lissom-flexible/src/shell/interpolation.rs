//! From the 18 natural strains of a shell element to the strains at a point: MITC4+ for membrane and bending [Ko, Lee, Lee and
//! Bathe 2017], linear between the tying points for transverse shear [Dvorkin and Bathe 1984].
//!
//! Legend: A, B strains along r at s = -1 and 1; C, D those along s at r = -1 and 1; E the shear at the centre; c_r, c_s
//! see [`Reference::distortion`].
//!
//! ```text
//! rr = (1/2 - a_A - s/2 + a_A s²) A + (1/2 - a_B + s/2 + a_B s²) B + (s² - 1)(a_C C + a_D D + a_E E)
//! ss = (r² - 1)(a_A A + a_B B) + (1/2 - a_C - r/2 + a_C r²) C + (1/2 - a_D + r/2 + a_D r²) D + (r² - 1) a_E E
//! rs = (-r/4 + a_A r s) A + (r/4 + a_B r s) B + (-s/4 + a_C r s) C + (s/4 + a_D r s) D + (1 + a_E r s) E
//!
//! p = c_r² + c_s² - 1,   a_A, a_B = c_r (c_r ± 1)/2p,   a_C, a_D = c_s (c_s ± 1)/2p,   a_E = 2 c_r c_s/p
//! ```

use nalgebra::{Matrix2, Matrix3, SMatrix};

use super::quadrilateral::{GAUSS_POINTS, STRAINS};
use super::reference::{LocalAxes, Reference};

/// Strains at a point by the natural strains: ε11, ε22, 2 ε12, κ11, κ22, 2 κ12, 2 ε13, 2 ε23, then drilling.
pub(super) type Interpolation = SMatrix<f64, 9, STRAINS>;

/// From covariant components rr, ss, rs of a tensor to 11, 22, 2 times 12, with `inverse` of the Jacobian.
pub(super) fn to_local(inverse: &Matrix2<f64>) -> Matrix3<f64> {
    let [a, b, c, d] = [inverse[(0, 0)], inverse[(0, 1)], inverse[(1, 0)], inverse[(1, 1)]];
    Matrix3::new(
        a * a,
        b * b,
        2.0 * a * b,
        c * c,
        d * d,
        2.0 * c * d,
        2.0 * a * c,
        2.0 * b * d,
        2.0 * (a * d + b * c),
    )
}

/// The interpolation at (r, s). Drilling is that of the nearest Gauss point.
pub(super) fn interpolation(reference: &Reference, axes: &LocalAxes, r: f64, s: f64) -> Interpolation {
    let mut all = Interpolation::zeros();
    let Some(inverse) = axes.jacobian.try_inverse() else { return all };
    let c = reference.distortion();
    let p = c.x * c.x + c.y * c.y - 1.0;
    let a = 0.5 * c.x * (c.x + 1.0) / p;
    let b = 0.5 * c.x * (c.x - 1.0) / p;
    let cc = 0.5 * c.y * (c.y + 1.0) / p;
    let d = 0.5 * c.y * (c.y - 1.0) / p;
    let e = 2.0 * c.x * c.y / p;
    let (rr, ss, rs) = (r * r - 1.0, s * s - 1.0, r * s);
    let covariant = SMatrix::<f64, 3, 5>::from_row_slice(&[
        0.5 - 0.5 * s + a * ss,
        0.5 + 0.5 * s + b * ss,
        cc * ss,
        d * ss,
        e * ss,
        a * rr,
        b * rr,
        0.5 - 0.5 * r + cc * rr,
        0.5 + 0.5 * r + d * rr,
        e * rr,
        -0.25 * r + a * rs,
        0.25 * r + b * rs,
        -0.25 * s + cc * rs,
        0.25 * s + d * rs,
        1.0 + e * rs,
    ]);
    let local = to_local(&inverse) * covariant;
    all.fixed_view_mut::<3, 5>(0, 0).copy_from(&local);
    all.fixed_view_mut::<3, 5>(3, 5).copy_from(&local);
    let mut shear = SMatrix::<f64, 2, 4>::zeros();
    (shear[(0, 0)], shear[(0, 1)]) = (0.5 - 0.5 * s, 0.5 + 0.5 * s);
    (shear[(1, 2)], shear[(1, 3)]) = (0.5 - 0.5 * r, 0.5 + 0.5 * r);
    all.fixed_view_mut::<2, 4>(6, 10).copy_from(&(inverse * shear));
    let nearest = GAUSS_POINTS.iter().position(|&(a, b)| (a > 0.0) == (r > 0.0) && (b > 0.0) == (s > 0.0));
    if let Some(point) = nearest {
        all[(8, 14 + point)] = 1.0;
    }
    all
}
