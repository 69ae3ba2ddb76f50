//! Derivatives of section forces with respect to the nodes of an element.
//!
//! With f(ξ) = T(d) d', p the polynomial through the stresses S_k of the Gauss points and c its leading coefficient, see
//! [`Beam::section_forces_at`]:
//!
//! ```text
//! δS = δp + b (ad(f)ᵀ δc + X(c) δf),      δd_k = T(d_k)⁻¹ (δh_k - A_k δh_r),      A_k = Ad(exp(-d_k))
//! ```

use lissom_motion::{
    Matrix6, Motion, Vector6, coadjoint_matrix, inverse_tangent, inverse_tangent_derivative,
    lie_bracket_matrix, tangent, tangent_derivative, tangent_derivative_rate, tangent_rate, tangent_times,
};

use super::{Beam, Kinematics, Relative, Station, combine, gauss_legendre, lagrange};
use lissom_mechanics::kinematics::local_derivatives::LocalDerivatives;

impl<const N: usize> Beam<N> {
    /// Derivatives of [`section_forces_at`](Self::section_forces_at).
    pub fn section_force_derivatives_at(&self, at: &Kinematics, xi: f64) -> LocalDerivatives<6> {
        let relative = self.relative(at);
        let rates = self.rates(at, &relative);
        let changes = rates.as_ref().map(|_| rate_changes(self, at, &relative));
        let points = gauss_legendre(N - 1);
        let (shape, slope) = lagrange::<N>(xi);
        let (d, d_slope) = (combine(&shape, &relative), combine(&slope, &relative));
        let twist = tangent_times(&d, &d_slope);
        let bubble = points.iter().map(|point| xi - point.0).product::<f64>() / (N - 1) as f64;
        let turning = bubble * lie_bracket_matrix(&twist).transpose();
        let mut leading = Vector6::zeros();
        // With respect to d_k, and to ḋ_k.
        let (mut by_place, mut by_rate) = ([Matrix6::zeros(); N], [Matrix6::zeros(); N]);
        for (k, station) in self.stations.iter().enumerate() {
            let others = || (0..points.len()).filter(|&j| j != k);
            let apart: f64 = others().map(|j| points[k].0 - points[j].0).product();
            let from: f64 = others().map(|j| xi - points[j].0).product();
            leading += station.stress(&relative, rates.as_ref()) / apart;
            let weight =
                (Matrix6::from_diagonal_element(from / apart) + turning / apart) * station.law.stiffness;
            let own = (combine(&station.shape, &relative), combine(&station.slope, &relative));
            let (t, turned) = (tangent(&own.0), tangent_derivative(&own.0, &own.1));
            let strains: [Matrix6; N] =
                std::array::from_fn(|i| station.slope[i] * t + station.shape[i] * turned);
            for i in 0..N {
                by_place[i] += weight * strains[i];
                by_rate[i] += station.law.damping * weight * strains[i];
            }
            if let (Some(rates), Some(changes)) = (&rates, &changes) {
                let viscous = rate_by_coordinates(station, (&own.0, &own.1), &strains, rates, changes);
                for i in 0..N {
                    by_place[i] += station.law.damping * weight * viscous[i];
                }
            }
        }
        let by_twist = bubble * coadjoint_matrix(&leading);
        let (t, turned) = (tangent(&d), tangent_derivative(&d, &d_slope));
        for i in 0..N {
            by_place[i] += by_twist * (slope[i] * t + shape[i] * turned);
        }
        let mut out = LocalDerivatives::zero(self.nodes.to_vec(), Vec::new(), 0);
        for (columns, blocks) in [(&mut out.by_place, by_place), (&mut out.by_rate, by_rate)] {
            for i in (0..N).filter(|&i| i != Self::REFERENCE) {
                let own = blocks[i] * inverse_tangent(&relative[i]);
                let of_reference = -own * Motion::exponential(&relative[i]).inverse().adjoint();
                for (node, block) in [(i, own), (Self::REFERENCE, of_reference)] {
                    let block = match &self.offsets[node] {
                        Some(offset) => block * offset.inverse().adjoint(),
                        None => block,
                    };
                    (0..6).for_each(|k| columns[6 * node + k] += block.column(k));
                }
            }
        }
        out
    }
}

/// ∂ε̇/∂d at constant node twists, from derivatives of the strains and of the rates ḋ.
fn rate_by_coordinates<const N: usize>(
    station: &Station<N>,
    (d, d_slope): (&Vector6, &Vector6),
    strains: &[Matrix6; N],
    rates: &Relative<N>,
    changes: &[Matrix6; N],
) -> [Matrix6; N] {
    let (shape, slope) = (&station.shape, &station.slope);
    let rate = combine(shape, rates);
    let by_shape = tangent_derivative_rate(d, (d_slope, &combine(slope, rates)), &rate);
    let by_slope = tangent_rate(d, &rate);
    std::array::from_fn(|k| shape[k] * by_shape + slope[k] * by_slope + strains[k] * changes[k])
}

/// ∂ḋ_k/∂d_k at constant node twists: δ(T(d)⁻¹ w) with δw = ad_η Ad(exp(-d)) V_r, η = T δd.
fn rate_changes<const N: usize>(beam: &Beam<N>, at: &Kinematics, relative: &Relative<N>) -> [Matrix6; N] {
    let twists = beam.relative_twists(at, relative);
    let reference = beam.section_twist(at, Beam::<N>::REFERENCE);
    std::array::from_fn(|k| {
        let seen = Motion::exponential(&relative[k]).adjoint_inverse_times(&reference);
        inverse_tangent_derivative(&relative[k], &twists[k])
            - inverse_tangent(&relative[k]) * lie_bracket_matrix(&seen) * tangent(&relative[k])
    })
}
