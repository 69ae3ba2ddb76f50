//! Change of stiffness by loads in a superelement whose matrices do not contain it: an estimate for a warning.
//!
//! Legend: interface k is at the distance ℓ_k from the floating frame in the direction d_k, N_k = d_k·(K u)_k is the force along
//! it, w_k the displacements under a unit force there with the floating interface fixed, F_q flexibility under modal forces,
//! f_q(ω) centrifugal modal forces.
//!
//! ```text
//! b = u - Σ N_k w_k - F_q f_q(ω)                       bending without elongation
//! H_k = (6/5) v²/ℓ - (1/5) v·t + (2/15) ℓ t²           shortening (twice) of a cubic from the frame to the displacement v and slope t
//! H_j = ∫ρ φ_j² (ℓ/m) κ_j² q_j²,   κ_j⁴ = ω_j² m/(ℓ EI),   EI = ℓ³/(3 λ),   λ largest transverse flexibility
//! part = (Σ |N_k| H_k + Σ |N_k| Σ_j H_j + ω² b·M b) / (b·K b)
//! ```
//!
//! It is the relative change of the stiffness against b by axial forces and rotation [Przemieniecki 1968, ch. 15, for H_k].
//!
//! Moments couple bending out of their plane with torsion, and torques bending in one plane with that in the other. A section
//! that is rotated by ϑ transmits a moment M, which bends by M × ϑ. Rotations increase from the frame on, and moments towards it:
//! a quarter of the product is used. Compared with beams under forces and torques at the end the estimate is 1.2 times the error.
//!
//! ```text
//! m_k moment and f_k force on interface k, M_k larger of m_k and m_k + ℓ d × f_k across d, T_k along d, κ_k rotation of the interface
//! missed = ¼ max(λ_d |M × κ|_d, λ_t |M| |κ_d|, λ_t |T| |κ_t|),    λ_d, λ_t flexibilities of twist and of bending
//! ```
//!
//! The product of the omitted rotation and the element's size is compared with the largest displacement. No matrices
//! contain it.

use lissom_motion::{Matrix3, Vector3};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::part::Part;
use super::vectors::three;

use lissom_mechanics::round_off;

/// Relative change of stiffness that causes a warning.
pub(super) const MAX_SHARE: f64 = 0.005;
/// Bending below this fraction of the size of the element, and of its elongation, is ignored.
const NO_BENDING: [f64; 2] = [1e-7, 1.0];

/// An interface relative to the floating frame.
#[derive(Clone, Debug)]
struct Axial {
    interface: usize,
    /// d, and ℓ [m].
    direction: Vector3,
    length: f64,
    /// w.
    response: DVector<f64>,
    /// Force along d under rotation about an axis perpendicular to it, over the square of its rate [kg m].
    centrifugal: f64,
    /// Rotation about d under a unit moment about it, and the largest about a perpendicular axis under a unit moment
    /// about one [rad/(N m)].
    twist: f64,
    bend: f64,
}

/// Data of the estimate.
#[derive(Clone, Debug, Default)]
pub(super) struct LoadStiffness {
    axial: Vec<Axial>,
    /// (ℓ/m) κ² of each modal coordinate.
    slopes: Vec<f64>,
    /// F_q: a column for each modal coordinate.
    of_modes: DMatrix<f64>,
}

/// Displacements under unit forces with one interface fixed; mechanisms do not move.
pub fn flexibility(stiffness: &DMatrix<f64>, frame: usize) -> DMatrix<f64> {
    let size = stiffness.nrows();
    let is_held = |k: usize| k / 6 == frame;
    let factor = |k: usize| {
        let own = stiffness[(k, k)];
        if own > 0.0 { own.sqrt().recip() } else { 1.0 }
    };
    let scaled = DMatrix::from_fn(size, size, |i, j| {
        if is_held(i) || is_held(j) { 0.0 } else { factor(i) * factor(j) * stiffness[(i, j)] }
    });
    let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(scaled);
    let largest = eigenvalues.amax();
    let inverse =
        eigenvalues.map(|value| if value > round_off::EIGENVALUE * largest { value.recip() } else { 0.0 });
    let found = &eigenvectors * DMatrix::from_diagonal(&inverse) * eigenvectors.transpose();
    DMatrix::from_fn(size, size, |i, j| factor(i) * factor(j) * found[(i, j)])
}

impl LoadStiffness {
    /// For an element.
    pub(super) fn of(element: &Part) -> Self {
        let size = element.size();
        let flexibility = flexibility(&element.stiffness, element.frame);
        let places = DVector::from_fn(size, |row, _| {
            if row < 6 * element.nodes.len() && row % 6 < 3 { element.places[row / 6][row % 6] } else { 0.0 }
        });
        let outward =
            &element.mass * &places + element.carried.tr_mul(&(&element.carried * &places)) / element.total;
        let mut axial: Vec<Axial> = Vec::new();
        // For the interface farthest away: its distance and its largest transverse flexibility.
        let mut slenderness: Option<(f64, f64)> = None;
        for (interface, place) in element.places.iter().enumerate() {
            let length = place.norm();
            if interface == element.frame || length <= 0.0 {
                continue;
            }
            let direction = place / length;
            let own = |j: usize| (0..3).map(|k| flexibility[(j, 6 * interface + k)] * direction[k]).sum();
            let response = DVector::from_fn(size, |j, _| own(j));
            let across = Matrix3::identity() - direction * direction.transpose();
            let block: Matrix3 = flexibility.fixed_view::<3, 3>(6 * interface, 6 * interface).into_owned();
            let softest = (across * block * across).symmetric_eigenvalues().max();
            if slenderness.is_none_or(|(most, _)| length > most) {
                slenderness = Some((length, softest));
            }
            let centrifugal = (0..3).map(|k| direction[k] * outward[6 * interface + k]).sum::<f64>().abs();
            let turns: Matrix3 =
                flexibility.fixed_view::<3, 3>(6 * interface + 3, 6 * interface + 3).into_owned();
            let twist = direction.dot(&(turns * direction));
            let bend = (across * turns * across).symmetric_eigenvalues().max();
            axial.push(Axial { interface, direction, length, response, centrifugal, twist, bend });
        }
        let first = 6 * element.nodes.len();
        let slopes = (first..size).map(|row| {
            let (length, softest) = slenderness?;
            let bending = length.powi(3) / (3.0 * softest);
            let mass = element.whole_mass(row);
            let rate = (element.stiffness[(row, row)] / mass).max(0.0).sqrt();
            let own = length / element.total * mass * rate * (element.total / (length * bending)).sqrt();
            own.is_finite().then_some(own)
        });
        let slopes = slopes.map(Option::unwrap_or_default).collect();
        Self { axial, slopes, of_modes: flexibility.columns(first, size - first).into_owned() }
    }

    /// Rotation by moments that linear matrices omit, times the size of the element over its largest displacement.
    pub(super) fn share_of_moments(
        &self,
        element: &Part,
        (displacement, force): (&[f64], &[f64]),
    ) -> Option<f64> {
        let reach = element.reach();
        let size = (0..element.nodes.len())
            .map(|i| three(displacement, 6 * i).norm().max(reach * three(displacement, 6 * i + 3).norm()))
            .fold(0.0, f64::max);
        if size <= NO_BENDING[0] * reach {
            return None;
        }
        let missed = |own: &Axial| {
            let (push, moment) = (three(force, 6 * own.interface), three(force, 6 * own.interface + 3));
            let turn = three(displacement, 6 * own.interface + 3);
            let (torque, twist) = (own.direction.dot(&moment), own.direction.dot(&turn));
            let at_end = moment - torque * own.direction;
            let at_frame = at_end + own.length * own.direction.cross(&push);
            let most = if at_end.norm() > at_frame.norm() { at_end } else { at_frame };
            let bent = turn - twist * own.direction;
            let twisting = own.twist * most.cross(&bent).norm();
            let bending = own.bend * (most.norm() * twist.abs()).max(torque.abs() * bent.norm());
            0.25 * twisting.max(bending)
        };
        self.axial.iter().map(missed).reduce(f64::max).map(|missed| missed * reach / size)
    }

    /// The relative change of stiffness against bending, if there is bending; `displacement` is u, `force` K u.
    pub(super) fn share(
        &self,
        element: &Part,
        (displacement, force, spin): (&[f64], &[f64], &Vector3),
    ) -> Option<f64> {
        let mut bent = DVector::from_column_slice(displacement);
        let mut stretch = 0.0_f64;
        let mut pulls = Vec::with_capacity(self.axial.len());
        for own in &self.axial {
            let pull = own.direction.dot(&three(force, 6 * own.interface));
            bent.axpy(-pull, &own.response, 1.0);
            let own_stretch = three(own.response.as_slice(), 6 * own.interface).norm();
            let largest = pull.abs().max(spin.norm_squared() * own.centrifugal);
            stretch = stretch.max(largest * own_stretch);
            pulls.push(pull.abs());
        }
        bent -= &self.of_modes * element.centrifugal(spin);
        let (reach, nodes) = (element.reach(), element.nodes.len());
        let size = (0..nodes)
            .map(|i| {
                three(bent.as_slice(), 6 * i).norm().max(reach * three(bent.as_slice(), 6 * i + 3).norm())
            })
            .chain(bent.iter().skip(6 * nodes).map(|value| value.abs()))
            .fold(0.0, f64::max);
        if size <= (NO_BENDING[0] * reach).max(NO_BENDING[1] * stretch) {
            return None;
        }
        let mut change = 0.0;
        for (own, pull) in self.axial.iter().zip(&pulls) {
            let (shift, turn) =
                (three(bent.as_slice(), 6 * own.interface), three(bent.as_slice(), 6 * own.interface + 3));
            let across = shift - own.direction * own.direction.dot(&shift);
            let slope = turn.cross(&own.direction);
            let shortening = 1.2 * across.norm_squared() / own.length - 0.2 * across.dot(&slope)
                + 2.0 / 15.0 * own.length * slope.norm_squared();
            change += pull * shortening;
        }
        let all: f64 = pulls.iter().sum();
        let of_modes = bent.iter().skip(6 * nodes).zip(&self.slopes);
        change += all * of_modes.map(|(value, slope)| slope * value * value).sum::<f64>();
        let carried = (&element.carried * &bent).norm_squared() / element.total;
        change += spin.norm_squared() * ((&element.mass * &bent).dot(&bent) + carried);
        let stored = (&element.stiffness * &bent).dot(&bent);
        (stored > 0.0).then_some(change / stored)
    }
}

impl Part {
    /// Centrifugal forces on the modal coordinates, from the positions of the interfaces.
    fn centrifugal(&self, spin: &Vector3) -> DVector<f64> {
        let first = 6 * self.nodes.len();
        let mut outward = DVector::zeros(self.size());
        for (i, place) in self.places.iter().enumerate() {
            outward.fixed_rows_mut::<3>(6 * i).copy_from(&-spin.cross(&spin.cross(place)));
        }
        let carried = self.carried.tr_mul(&(&self.carried * &outward)) / self.total;
        (&self.mass * &outward + carried).rows(first, self.size() - first).into_owned()
    }
}

#[cfg(test)]
#[path = "../../tests/unit/superelement/load_stiffness.rs"]
mod tests;
