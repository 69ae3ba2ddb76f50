//! Linear buckling: load factors at which the stiffness, assumed to change in proportion to the loads, becomes
//! singular.
//!
//! ```text
//! (K₀ + Λ (K₁ - K₀)) x + Bᵀ μ = 0,    B x = 0
//! ```
//!
//! K₀ stiffness of the equilibrium without loads, K₁ of the one under the loads of the model. In the inner product of K₀ the
//! operator x ↦ -K₀⁻¹ (K₁ - K₀) x on the constraints is symmetric with eigenvalues 1/Λ. The negative pivots of the matrix at a load
//! factor above the last one count those below. If some were missed, because many factors are close to each other, the search is repeated
//! from K₀ + Λ₀ (K₁ - K₀) with a Λ₀ just below the first factor: the eigenvalues are then 1/(Λ - Λ₀), which are far apart.

use super::krylov::{Krylov, Operator, product};
use super::lanczos::{is_converged, ritz, whole_clusters};
use super::mode::Completeness;
use super::model::{LinearError, LinearModel};
use super::shifted::RealShift;
use super::{ADDITIONAL_MODES, krylov};
use crate::diagnostics::diagnostics;
use crate::interrupt;
use crate::round_off;
use crate::system::Linearization;

/// Load factor below which no mode is expected if none is found, over the magnitude of the lowest negative one.
const FAR_AWAY: f64 = 1e3;
/// Load factor from which a search is repeated, over the lowest one.
const RESTART_SHARE: f64 = 0.95;
/// A search with this number of vectors, and eight times the number of modes, is ended: there are no more modes.
const MAX_VECTORS: usize = 300;

/// A buckling mode.
#[derive(Clone, Debug, PartialEq)]
pub struct BucklingMode {
    /// Factor of the loads, greater than zero.
    pub load_factor: f64,
    /// Body-frame displacements and rotations by row, normalised to xᵀK₀x = 2 J.
    pub shape: Vec<f64>,
}

impl BucklingMode {
    /// Counts the load factor from zero instead of from `start`: xᵀKx is in proportion to it.
    fn move_from(&mut self, start: f64) {
        let own = self.load_factor;
        self.load_factor += start;
        let factor = (own / self.load_factor).sqrt();
        self.shape.iter_mut().for_each(|entry| *entry *= factor);
    }
}

/// Buckling modes, by ascending load factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Buckling {
    /// The modes found: fewer than requested if there are no more.
    pub modes: Vec<BucklingMode>,
    /// Whether a lower one may have been missed.
    pub completeness: Completeness,
}

diagnostics! {
    /// Why there are no buckling loads.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure BucklingError {
        /// The model is not stable without loads.
        Unstable {
            /// Number of unstable or free directions.
            directions: usize,
        } => "unstable-without-loads" {
            cause: ("the model is not stable without loads ({directions} unstable or free directions): linear buckling is undefined"),
            remedy: "constrain the free parts, or follow the path by an analysis of kind `path`",
            meaning: "Linear buckling requires a model that is stable without its loads.",
        }
        /// The loads have no potential.
        NotSymmetric {} => "buckling-not-symmetric" {
            cause: ("the stiffness under the loads is not symmetric, for example because of follower loads"),
            remedy: "follow the path by an analysis of kind `path` instead",
            meaning: "The loads have no potential, so that their stiffness is not symmetric. Linear buckling does not apply.",
        }
    }
    wraps {
        /// A factorisation stopped.
        Linear(LinearError), (error) => error.diagnostic(),
    }
}

impl From<LinearError> for BucklingError {
    fn from(error: LinearError) -> Self {
        Self::Linear(error)
    }
}

struct Inverse<'m, 's, 'a> {
    unloaded: &'m LinearModel<'a>,
    /// Stiffness from which the loads change by `change` per load factor.
    stiffness: &'m [f64],
    change: &'m [f64],
    solver: &'s mut RealShift<'a>,
    room: Vec<f64>,
    product: Vec<f64>,
}

impl Inverse<'_, '_, '_> {
    fn multiply(&mut self, values: &[f64], vector: &[f64], result: &mut [f64]) {
        let count = vector.len();
        self.room[..count].copy_from_slice(vector);
        self.room[count..].fill(0.0);
        self.unloaded.pattern().multiply(values, &self.room, &mut self.product);
        result.copy_from_slice(&self.product[..count]);
    }
}

impl Operator<f64> for Inverse<'_, '_, '_> {
    fn size(&self) -> usize {
        self.unloaded.coordinate_count()
    }

    fn apply(&mut self, vector: &[f64], image: &mut [f64]) {
        let change = self.change;
        self.multiply(change, vector, image);
        let count = image.len();
        for (value, force) in self.room.iter_mut().zip(&*image) {
            *value = -force;
        }
        self.room[count..].fill(0.0);
        self.solver.solve(&mut self.room);
        image.copy_from_slice(&self.room[..count]);
    }

    fn weigh(&mut self, vector: &[f64], weighted: &mut [f64]) {
        let stiffness = self.stiffness;
        self.multiply(stiffness, vector, weighted);
    }
}

impl LinearModel<'_> {
    /// The lowest positive load factors at which a model buckles. `self` is the linear model without loads, `loaded` that
    /// under the loads at factor one, of a system with the same unknowns.
    ///
    /// # Errors
    /// If the model is not stable without loads, or the loads have no potential.
    pub fn buckling(&self, loaded: &LinearModel<'_>, count: usize) -> Result<Buckling, BucklingError> {
        if !(self.is_conservative() && loaded.is_conservative()) {
            return Err(BucklingError::NotSymmetric {});
        }
        let change: Vec<f64> =
            loaded.parts.stiffness.iter().zip(&self.parts.stiffness).map(|(one, zero)| one - zero).collect();
        let found = self.buckling_from(0.0, &change, count)?;
        let Some(first) = found.modes.first().filter(|_| found.completeness != Completeness::Counted) else {
            return Ok(found);
        };
        // The lowest factor may be one of those missed.
        let again = self.buckling_from(RESTART_SHARE * first.load_factor, &change, count);
        Ok(again.ok().filter(|again| again.completeness == Completeness::Counted).unwrap_or(found))
    }

    /// Relative error of the load factor Λ of a mode, to first order, because the stiffness does not change in proportion to the loads. `models`
    /// are two equilibria under the load factors `at`, each without and with the loads. Of second order are the stresses of a deflection, while
    /// the coupling of stretching and bending grows with the deflection itself.
    ///
    /// ```text
    /// K(Λ) = K₀ + Λ A + Λ² C,    (K_q - K₀)/q - (K_p - K₀)/p = (q - p) C,    K(Λ) - K₀ - Λ (K₁ - K₀) = Λ (Λ - 1) C
    /// ```
    pub fn load_factor_error(
        &self,
        models: [[&LinearModel<'_>; 2]; 2],
        at: [f64; 2],
        mode: &BucklingMode,
    ) -> f64 {
        let size = self.system.layout().size();
        let mut shape = mode.shape.clone();
        shape.resize(size, 0.0);
        let mut forces = vec![0.0; size];
        let [first, second] = [0, 1].map(|k| {
            let [without, with] = models[k].map(|model| &model.parts.stiffness);
            let change = |((start, without), with): ((&f64, &f64), &f64)| {
                (without - start + at[k] * (with - without)) / at[k]
            };
            let change: Vec<f64> = self.parts.stiffness.iter().zip(without).zip(with).map(change).collect();
            self.pattern().multiply(&change, &shape, &mut forces);
            product(&forces, &shape)
        });
        // xᵀK₀x is 2 J.
        0.5 * mode.load_factor * (mode.load_factor - 1.0) * (second - first) / (at[1] - at[0])
    }

    /// The stiffness at a load factor, with the other coefficients of the model without loads.
    fn at_load_factor(&self, change: &[f64], factor: f64) -> Linearization {
        let mut parts = self.parts.clone();
        parts.stiffness.iter_mut().zip(change).for_each(|(own, change)| *own += factor * change);
        parts
    }

    /// The lowest load factors above `start`, at which the model is stable.
    fn buckling_from(&self, start: f64, change: &[f64], count: usize) -> Result<Buckling, BucklingError> {
        let parts = self.at_load_factor(change, start);
        let mut solver = RealShift::new(self.system, &self.representative);
        let below = solver.factor(&parts, 0.0).map_err(|error| self.stopped(&error))?;
        if below > 0 {
            return Err(BucklingError::Unstable { directions: below });
        }
        let size = self.system.layout().size();
        let mut operator = Inverse {
            unloaded: self,
            stiffness: &parts.stiffness,
            change,
            solver: &mut solver,
            room: vec![0.0; size],
            product: vec![0.0; size],
        };
        let mut krylov = Krylov::new(operator.size());
        let mut is_exhausted = krylov.start(&mut operator, krylov::BLOCK, 1) == 0;
        let mut wanted = count + ADDITIONAL_MODES;
        let mut restarts = 0;
        loop {
            let Search { mut modes, is_whole, largest } =
                search(&mut krylov, &mut operator, wanted, &mut is_exhausted)?;
            for mode in &mut modes {
                mode.move_from(start);
            }
            let rates: Vec<f64> = modes.iter().map(|mode| mode.load_factor.recip()).collect();
            // All modes of a multiple factor are counted together: between two of them the matrix is singular.
            let keep = whole_clusters(&rates, count.min(rates.len()));
            if keep == wanted {
                // The factor may have more modes than were searched for.
                wanted += krylov::BLOCK;
                continue;
            }
            let next = modes.get(keep).map(|mode| mode.load_factor);
            modes.truncate(keep);
            let counted = self.counted(change, &modes, next, largest);
            let is_short = modes.len() < count && !is_whole;
            if counted == Completeness::Counted || is_exhausted || restarts == krylov::MAX_RESTARTS {
                modes.truncate(count);
                let is_unknown = is_short && counted == Completeness::Counted;
                let completeness = if is_unknown { Completeness::Unknown } else { counted };
                return Ok(Buckling { modes, completeness });
            }
            restarts += 1;
            is_exhausted = krylov.start(&mut operator, krylov::BLOCK, 1) == 0;
        }
    }

    /// Compares the number of modes with the number of negative pivots above the last one. If there are none, the pivots are
    /// counted far above the magnitude of the lowest negative load factor, the reciprocal of `largest`.
    fn counted(
        &self,
        change: &[f64],
        modes: &[BucklingMode],
        next: Option<f64>,
        largest: f64,
    ) -> Completeness {
        if modes.is_empty() && largest == 0.0 {
            return Completeness::Counted;
        }
        let last = modes.last().map_or(FAR_AWAY / largest, |mode| mode.load_factor);
        let mut solver = RealShift::new(self.system, &self.representative);
        for part in [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8] {
            let at = next.map_or((1.0 + part) * last, |next| last + part * (next - last));
            if let Ok(below) = solver.factor(&self.at_load_factor(change, at), 0.0)
                && solver.is_accurate()
            {
                return match below.checked_sub(modes.len()) {
                    Some(0) => Completeness::Counted,
                    Some(missing) => Completeness::Missing(missing),
                    None => Completeness::Unknown,
                };
            }
        }
        Completeness::Unknown
    }
}

/// Result of a search.
struct Search {
    modes: Vec<BucklingMode>,
    /// Whether there are no modes except those found, also beyond the requested ones.
    is_whole: bool,
    /// The largest magnitude of an eigenvalue of the operator.
    largest: f64,
}

/// Extends the basis until the `wanted` largest positive eigenvalues have converged, or it is exhausted.
fn search(
    krylov: &mut Krylov<f64>,
    operator: &mut Inverse<'_, '_, '_>,
    wanted: usize,
    is_exhausted: &mut bool,
) -> Result<Search, LinearError> {
    let mut since = 0;
    loop {
        interrupt::check()?;
        if !*is_exhausted && !krylov.step(operator) {
            *is_exhausted = krylov.start(operator, krylov::BLOCK, 1) == 0;
        }
        since += 1;
        if !*is_exhausted && since < krylov::CHECK_INTERVAL.max(krylov.order() / 8) {
            continue;
        }
        since = 0;
        let estimates = ritz(krylov);
        let largest = estimates.first().map_or(0.0, |estimate| estimate.0.abs());
        let mut positive: Vec<_> = estimates
            .into_iter()
            .filter(|estimate| estimate.0 > round_off::ITERATED_EIGENVALUE * largest)
            .collect();
        positive.sort_by(|a, b| b.0.total_cmp(&a.0));
        *is_exhausted |= krylov.order() > MAX_VECTORS.max(8 * wanted);
        let are_enough = positive.len() >= wanted && positive[..wanted].iter().all(is_converged);
        if are_enough || *is_exhausted {
            let before = positive.len();
            // Estimates that have not converged at the end of a search are not modes yet.
            positive.retain(is_converged);
            let is_whole = positive.len() == before;
            positive.truncate(wanted);
            let of =
                |(value, weights, _): &(f64, Vec<f64>, f64)| mode(operator, &krylov.combine(weights), *value);
            return Ok(Search { modes: positive.iter().map(of).collect(), is_whole, largest });
        }
    }
}

fn mode(operator: &mut Inverse<'_, '_, '_>, vector: &[f64], value: f64) -> BucklingMode {
    let mut shape = vec![0.0; vector.len()];
    operator.apply(vector, &mut shape);
    let mut forces = vec![0.0; vector.len()];
    operator.weigh(&shape, &mut forces);
    let factor = (2.0 / product(&forces, &shape)).sqrt();
    for entry in &mut shape {
        *entry *= factor;
    }
    BucklingMode { load_factor: value.recip(), shape }
}
