//! By how much loads would change the stiffness of a superelement whose matrices do not know of it: an estimate for a warning.
//!
//! Legend: interface k lies at the distance ℓ_k from the floating frame in the direction d_k, N_k = d_k·(K u)_k is the force along
//! it, w_k the displacements under a unit force there with the floating interface held.
//!
//! ```text
//! b = u - Σ N_k w_k                                   what the part bends besides its elongation
//! H_k = (6/5) v²/ℓ - (1/5) v·t + (2/15) ℓ t²           shortening (twice) of a cubic from the frame to the displacement v and slope t
//! H_j = ∫ρ φ_j² (ℓ/m) κ_j² q_j²,   κ_j⁴ = ω_j² m/(ℓ EI),   EI = ℓ³/(3 λ),   λ largest transverse flexibility
//! part = (Σ |N_k| H_k + Σ |N_k| Σ_j H_j + ω² b·M b) / (b·K b)
//! ```
//!
//! It is the share of the stiffness against b that axial forces and rotation give or take [Przemieniecki 1968, ch. 15, for H_k].

use lissom_motion::{Matrix3, Vector3};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::{Superelement, three};

/// Share of the stiffness from which on it is told.
pub(super) const LARGEST_SHARE: f64 = 0.005;
/// Bending below this part of the size of the element, and of its elongation, is nothing to be right about.
const NO_BENDING: [f64; 2] = [1e-7, 1.0];
/// Eigenvalues below this part of the largest are those of mechanisms.
const ROUND_OFF: f64 = 1e-12;

/// An interface seen from the floating frame.
#[derive(Clone, Debug)]
struct Axial {
    interface: usize,
    /// d, and ℓ [m].
    direction: Vector3,
    length: f64,
    /// w.
    response: DVector<f64>,
    /// Force along d in rotation across it, over the square of its rate [kg m].
    centrifugal: f64,
}

/// What the estimate needs.
#[derive(Clone, Debug, Default)]
pub(super) struct LoadStiffness {
    axial: Vec<Axial>,
    /// (ℓ/m) κ² of each modal coordinate.
    slopes: Vec<f64>,
}

/// Displacements under unit forces with one interface held; mechanisms do not move.
pub(crate) fn flexibility(stiffness: &DMatrix<f64>, frame: usize) -> DMatrix<f64> {
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
    let inverse = eigenvalues.map(|value| if value > ROUND_OFF * largest { value.recip() } else { 0.0 });
    let found = &eigenvectors * DMatrix::from_diagonal(&inverse) * eigenvectors.transpose();
    DMatrix::from_fn(size, size, |i, j| factor(i) * factor(j) * found[(i, j)])
}

impl LoadStiffness {
    /// Of an element.
    pub(super) fn of(element: &Superelement) -> Self {
        let size = element.size();
        let flexibility = flexibility(&element.stiffness, element.frame);
        let places = DVector::from_fn(size, |row, _| {
            if row < 6 * element.nodes.len() && row % 6 < 3 { element.places[row / 6][row % 6] } else { 0.0 }
        });
        let outward =
            &element.mass * &places + element.carried.tr_mul(&(&element.carried * &places)) / element.total;
        let mut axial: Vec<Axial> = Vec::new();
        // Of the interface farthest away: its distance and its largest transverse flexibility.
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
            axial.push(Axial { interface, direction, length, response, centrifugal });
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
        Self { axial, slopes: slopes.map(Option::unwrap_or_default).collect() }
    }

    /// The share of the stiffness against what the part bends, where it bends; `displacement` is u, `force` K u.
    pub(super) fn share(
        &self,
        element: &Superelement,
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

impl Superelement {
    /// The mass of a modal coordinate, that of the centre included.
    fn whole_mass(&self, row: usize) -> f64 {
        self.mass[(row, row)] + self.carried.column(row).norm_squared() / self.total
    }
}
