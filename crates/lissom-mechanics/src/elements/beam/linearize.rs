//! Exact derivatives of a beam's forces, in three layers: relative coordinates d, relative
//! variations η_i = δh_i - Ad(exp(-d_i)) δh_r, nodes.

use super::{
    Beam, Kinematics, Matrix6, Motion, Relative, Station, Tangents, Vector6, add_block, coadjoint_matrix,
    combine, inverse_tangent, inverse_tangent_derivative, inverse_tangent_transpose_derivative,
    inverse_tangent_transpose_times, lie_bracket_matrix, tangent, tangent_derivative,
    tangent_derivative_transpose_times, tangent_hessian, tangent_rate_times, tangent_transpose_derivative,
    tangent_transpose_times,
};

type Blocks<const N: usize> = [[Matrix6; N]; N];

pub(in crate::elements) struct Linearization<const N: usize> {
    relative: Relative<N>,
    /// ∂g_i/∂d_k and ∂g_i/∂ḋ_k.
    stiffness: Blocks<N>,
    damping: Blocks<N>,
    conjugate: [Vector6; N],
    damped: bool,
}

/// ∂ε̇/∂d at constant node twists, from derivatives of the strains and of the rates ḋ.
pub(super) fn rate_by_coordinates<const N: usize>(
    station: &Station<N>,
    (d, d_slope): (&Vector6, &Vector6),
    strains: &[Matrix6; N],
    rates: &Relative<N>,
    changes: &[Matrix6; N],
) -> [Matrix6; N] {
    let (shape, slope) = (&station.shape, &station.slope);
    let rate = combine(shape, rates);
    let rate_slope = combine(slope, rates);
    // ∂ε̇/∂d = ∂(T ḋ')/∂d + ∂²(T d')/∂d² ḋ, and ∂ε̇/∂d' = Ṫ.
    let by_d = tangent_derivative(d, &rate_slope) + second_derivative_times(d, d_slope, &rate);
    let by_slope = tangent_rate(d, &rate);
    std::array::from_fn(|k| shape[k] * by_d + slope[k] * by_slope + product(&strains[k], &changes[k]))
}

impl<const N: usize> Linearization<N> {
    pub(super) fn new(beam: &Beam<N>, at: &Kinematics, stressed: &Kinematics) -> Self {
        let relative = beam.relative(at);
        let rates = beam.rates(at, &relative);
        let relative_stressed = beam.relative(stressed);
        let rates_stressed = beam.rates(stressed, &relative_stressed);
        let zeros = [[Matrix6::zeros(); N]; N];
        let mut result = Self {
            relative,
            stiffness: zeros,
            damping: zeros,
            conjugate: [Vector6::zeros(); N],
            damped: rates.is_some(),
        };
        let rate_changes = rates.as_ref().map(|_| rate_changes(beam, at, &relative));
        for station in &beam.stations {
            let stress = station.weight * station.stress(&relative_stressed, rates_stressed.as_ref());
            result.add_station(station, &stress, rates.as_ref(), rate_changes.as_ref());
        }
        result
    }

    fn add_station(
        &mut self,
        station: &Station<N>,
        stress: &Vector6,
        rates: Option<&Relative<N>>,
        rate_changes: Option<&[Matrix6; N]>,
    ) {
        let (shape, slope, weight) = (&station.shape, &station.slope, station.weight);
        let d = combine(shape, &self.relative);
        let d_slope = combine(slope, &self.relative);
        let along = tangent_transpose_times(&d, stress);
        let across = tangent_derivative_transpose_times(&d, &d_slope, stress);
        let (t, turned) = (tangent(&d), tangent_derivative(&d, &d_slope));
        let turn = tangent_transpose_derivative(&d, stress);
        let bend = tangent_hessian(&d, &d_slope, stress);
        let strains: [Matrix6; N] = std::array::from_fn(|i| slope[i] * t + shape[i] * turned);
        let viscous = rates
            .zip(rate_changes)
            .map(|(rates, changes)| rate_by_coordinates(station, (&d, &d_slope), &strains, rates, changes));
        // The reference node has no coordinates of its own.
        for i in (0..N).filter(|&i| i != Beam::<N>::REFERENCE) {
            self.conjugate[i] += slope[i] * along + shape[i] * across;
            let left = product(&(weight * strains[i].transpose()), &station.law.stiffness);
            for k in (0..N).filter(|&k| k != Beam::<N>::REFERENCE) {
                let stiffness = &mut self.stiffness[i][k];
                *stiffness += product(&left, &strains[k])
                    + slope[i] * shape[k] * turn
                    + shape[i] * slope[k] * turn.transpose()
                    + shape[i] * shape[k] * bend;
                if let Some(viscous) = &viscous {
                    *stiffness += product(&(station.law.damping * left), &viscous[k]);
                    self.damping[i][k] += product(&(station.law.damping * left), &strains[k]);
                }
            }
        }
    }

    pub(in crate::elements) fn assemble(&self, beam: &Beam<N>, out: &mut Tangents) {
        let inverse: [Matrix6; N] = std::array::from_fn(|i| inverse_tangent(&self.relative[i]));
        let mut stiffness = [[Matrix6::zeros(); N]; N];
        let mut damping = [[Matrix6::zeros(); N]; N];
        let mut geometric = [Matrix6::zeros(); N];
        for i in (0..N).filter(|&i| i != Beam::<N>::REFERENCE) {
            let force = inverse_tangent_transpose_times(&self.relative[i], &self.conjugate[i]);
            geometric[i] = coadjoint_matrix(&force);
            for k in (0..N).filter(|&k| k != Beam::<N>::REFERENCE) {
                let mut change = product(&inverse[i].transpose(), &self.stiffness[i][k]);
                if i == k {
                    change += inverse_tangent_transpose_derivative(&self.relative[i], &self.conjugate[i]);
                }
                stiffness[i][k] = product(&change, &inverse[k]);
                if self.damped {
                    let change = product(&inverse[i].transpose(), &self.damping[i][k]);
                    damping[i][k] = product(&change, &inverse[k]);
                }
            }
        }
        let adjoints: [Matrix6; N] =
            std::array::from_fn(|i| Motion::exponential(&self.relative[i]).inverse().adjoint());
        spread(beam, &adjoints, &mut stiffness, &geometric, &mut out.stiffness);
        if self.damped {
            spread(beam, &adjoints, &mut damping, &[Matrix6::zeros(); N], &mut out.damping);
        }
    }
}

/// From ∂F_i/∂η_k of the relative nodes to all nodes: η_k = δh_k - A_k δh_r,
/// F_r = - Σ A_iᵀ F_i and δ(A_iᵀ) F_i = - A_iᵀ X(F_i) η_i.
fn spread<const N: usize>(
    beam: &Beam<N>,
    adjoints: &[Matrix6; N],
    blocks: &mut Blocks<N>,
    geometric: &[Matrix6; N],
    out: &mut [f64],
) {
    let r = Beam::<N>::REFERENCE;
    for k in (0..N).filter(|&k| k != r) {
        let mut sum = Matrix6::zeros();
        for i in (0..N).filter(|&i| i != r) {
            let change = if i == k { blocks[i][k] - geometric[i] } else { blocks[i][k] };
            sum -= product(&adjoints[i].transpose(), &change);
        }
        blocks[r][k] = sum;
    }
    for i in 0..N {
        let mut sum = Matrix6::zeros();
        for k in (0..N).filter(|&k| k != r) {
            sum -= product(&blocks[i][k], &adjoints[k]);
        }
        blocks[i][r] = sum;
    }
    for i in 0..N {
        for k in 0..N {
            let mut block = blocks[i][k];
            if let Some(offset) = &beam.offsets[i] {
                block = product(&offset.inverse().adjoint().transpose(), &block);
            }
            if let Some(offset) = &beam.offsets[k] {
                block = product(&block, &offset.inverse().adjoint());
            }
            add_block(out, 6 * N, (6 * i, 6 * k), &block);
        }
    }
}

/// A product of matrices, compiled once: it has 216 multiplications, and many callers.
#[inline(never)]
fn product(left: &Matrix6, right: &Matrix6) -> Matrix6 {
    left * right
}

/// Ṫ for the rate ḋ.
fn tangent_rate(d: &Vector6, rate: &Vector6) -> Matrix6 {
    Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| tangent_rate_times(d, rate, &unit(k))))
}

/// ∂/∂d of (∂(T a)/∂d) b, row by row from the Hessians of the components of T a.
fn second_derivative_times(d: &Vector6, a: &Vector6, b: &Vector6) -> Matrix6 {
    Matrix6::from_rows(&std::array::from_fn::<_, 6, _>(|k| (tangent_hessian(d, a, &unit(k)) * b).transpose()))
}

fn unit(k: usize) -> Vector6 {
    let mut vector = Vector6::zeros();
    vector[k] = 1.0;
    vector
}

/// ∂ḋ_k/∂d_k at constant node twists: δ(T(d)⁻¹ w) with δw = ad_η Ad(exp(-d)) V_r, η = T δd.
pub(super) fn rate_changes<const N: usize>(
    beam: &Beam<N>,
    at: &Kinematics,
    relative: &Relative<N>,
) -> [Matrix6; N] {
    let twists = beam.relative_twists(at, relative);
    let reference = beam.section_twist(at, Beam::<N>::REFERENCE);
    std::array::from_fn(|k| {
        let seen = Motion::exponential(&relative[k]).adjoint_inverse_times(&reference);
        inverse_tangent_derivative(&relative[k], &twists[k])
            - product(
                &product(&inverse_tangent(&relative[k]), &lie_bracket_matrix(&seen)),
                &tangent(&relative[k]),
            )
    })
}
