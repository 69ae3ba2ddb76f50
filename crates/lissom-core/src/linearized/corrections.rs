//! Omitted modes of a reduction, and shapes that compensate for most of them. Inertia bends the part under motions of the
//! floating frame; and if rotation, accelerations and axial forces change the stiffness, the static shapes differ from those
//! without loads.
//!
//! Legend: y_k retained unknowns (interfaces and modes), q_d omitted modes, of unit mass and with the frequencies Ω_d; F_k
//! flexibility of the retained unknowns with the floating frame fixed; f inertial forces of an acceleration of the frame or of a
//! rotation; G a matrix of second order times the load at which it changes the stiffness by its full amount.
//!
//! ```text
//! Ω_d² q_d = f_d - G_dk y_k      z = Ω_d q_d,  y_k = F_k^½ η      (|z|², |η|² elastic energies, twice)
//! X = [Ω_d⁻¹ G_dk F_k^½,  Ω_d⁻¹ f_d / √(f_k·F_k f_k + f_d·Ω_d⁻² f_d)]  of all loads, as columns
//! X = U Σ Vᵀ,  columns of U with σ² > LEAST:                        q_d = Ω_d⁻¹ U c
//! ```
//!
//! σ² is the fraction of the elastic energy that is missing at such a load. Loads of a kind have one magnitude, that at which the
//! largest of them has this effect. Shapes of f are inertial attachment modes [Craig and Kurdila 2006, ch. 17], those of G static
//! modal derivatives [Idelsohn and Cardona 1985] for the loads of the floating frame; c are rotated so that mass and stiffness
//! are diagonal.

use lissom_motion::Vector3;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::reduction::Reduction;
use crate::flexible::superelement::{Damping, flexibility, rigid_column};

/// Fraction of the elastic energy that may be missing under loads that change the stiffness by its full amount: shapes of first
/// order in the loads neglect as much.
const MIN_ENERGY_FRACTION: f64 = 1e-3;

impl Reduction {
    /// Retains the first `modes` modes and, if `is_corrected`, shapes that compensate for the omitted ones.
    #[must_use]
    pub fn with_modes(mut self, modes: usize, is_corrected: bool) -> Self {
        let interfaces = 6 * self.places.len();
        let all = self.matrices.mass.nrows();
        self.frequencies.truncate(modes);
        let kept = interfaces + self.frequencies.len();
        let shapes =
            if is_corrected && kept < all { self.corrections(kept) } else { DMatrix::zeros(all - kept, 0) };
        self.corrections = shapes.ncols();
        let mut map = DMatrix::zeros(all, kept + shapes.ncols());
        map.view_mut((0, 0), (kept, kept)).fill_with_identity();
        map.view_mut((kept, kept), shapes.shape()).copy_from(&shapes);
        let through = |matrix: &DMatrix<f64>| map.tr_mul(&(matrix * &map));
        self.shapes = &self.shapes * &map;
        let own = &mut self.matrices;
        let all_stiffness = own.stiffness.clone();
        own.mass = through(&own.mass);
        own.stiffness = through(&own.stiffness);
        if let Damping::Matrix(damping) = &mut own.damping {
            *damping = through(damping);
        }
        if !own.preload.is_empty() {
            own.preload = map.tr_mul(&DVector::from_column_slice(&own.preload)).as_slice().to_vec();
        }
        own.geometric = self
            .second_order
            .as_ref()
            .map(|order| order.kept(&map, [&own.mass, &own.stiffness, &all_stiffness], interfaces))
            .map(Box::new);
        self
    }

    /// Correction shapes, as columns over the modes from row `kept` on.
    fn corrections(&self, kept: usize) -> DMatrix<f64> {
        let stiffness = &self.matrices.stiffness;
        let left = stiffness.nrows() - kept;
        let own = stiffness.view((0, 0), (kept, kept)).into_owned();
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(flexibility(&own, 0));
        let root = eigenvectors * DMatrix::from_diagonal(&eigenvalues.map(|value| value.max(0.0).sqrt()));
        let rates = DVector::from_fn(left, |k, _| stiffness[(kept + k, kept + k)].sqrt());
        let over_rates = |matrix: &mut DMatrix<f64>| {
            for (mut row, rate) in matrix.row_iter_mut().zip(&rates) {
                row /= *rate;
            }
        };
        // X Xᵀ for all loads, whose eigenvectors and eigenvalues are U and Σ².
        let mut gram = DMatrix::zeros(left, left);
        for alike in self.inertial_forces() {
            let energy = |force: &DVector<f64>| {
                let among = root.tr_mul(&force.rows(0, kept));
                let beyond = force.rows(kept, left).component_div(&rates);
                among.norm_squared() + beyond.norm_squared()
            };
            let largest = alike.iter().map(energy).fold(0.0, f64::max);
            for force in alike.iter().filter(|_| largest > 0.0) {
                let column = force.rows(kept, left).component_div(&rates);
                gram += &column * column.transpose() / largest;
            }
        }
        for alike in self.second_order_matrices() {
            let share = |matrix: &DMatrix<f64>| {
                let among = root.tr_mul(&(matrix.view((0, 0), (kept, kept)) * &root));
                among.singular_values().max()
            };
            let largest = alike.iter().map(share).fold(0.0, f64::max);
            for matrix in alike.iter().filter(|_| largest > 0.0) {
                let below = matrix.view((kept, 0), (left, kept)).into_owned();
                let beside = matrix.view((0, kept), (kept, left)).transpose();
                for rows in [below, beside] {
                    let mut found = rows * &root / largest;
                    over_rates(&mut found);
                    gram += &found * found.transpose();
                }
            }
        }
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(gram);
        let chosen: Vec<usize> = (0..left).filter(|&k| eigenvalues[k] > MIN_ENERGY_FRACTION).collect();
        if chosen.is_empty() {
            return DMatrix::zeros(left, 0);
        }
        let mut found = eigenvectors.select_columns(&chosen);
        over_rates(&mut found);
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(found.tr_mul(&found));
        let unit = eigenvalues.map(|mass| mass.max(f64::MIN_POSITIVE).sqrt().recip());
        found * eigenvectors * DMatrix::from_diagonal(&unit)
    }

    /// Generalised inertial forces due to linear acceleration, angular acceleration and steady rotation of the frame.
    fn inertial_forces(&self) -> [Vec<DVector<f64>>; 3] {
        let size = self.matrices.mass.nrows();
        let origin = self.places.first().copied().unwrap_or_default();
        let places: Vec<Vector3> = self.places.iter().map(|place| place - origin).collect();
        let carried = |k: usize| &self.matrices.mass * DVector::from_vec(rigid_column(&places, size, k));
        let turning = self.second_order.iter().flat_map(|own| {
            own.direct.turning().slope.row_iter().map(|row| row.transpose()).collect::<Vec<_>>()
        });
        [(0..3).map(carried).collect(), (3..6).map(carried).collect(), turning.collect()]
    }

    /// Second-order matrices due to rotation, to acceleration, and to forces on the interfaces along the directions from the
    /// first interface; none if they are unknown.
    fn second_order_matrices(&self) -> [Vec<DMatrix<f64>>; 3] {
        let Some(own) = &self.second_order else { return Default::default() };
        let [turning, pushed] = own.of_loads();
        let flexibility = flexibility(&self.matrices.stiffness, 0);
        let origin = self.places.first().copied().unwrap_or_default();
        let pulled = self.places.iter().enumerate().skip(1).map(|(i, place)| {
            let arm = place - origin;
            let direction = arm / arm.norm().max(f64::MIN_POSITIVE);
            own.stressed(&(flexibility.columns(6 * i, 3) * direction))
        });
        [turning, pushed, pulled.collect()]
    }
}
