//! Geometrically exact beam of 2, 3 or 4 nodes: elastic and viscous forces. Its inertia is that of its
//! nodes (Gauss-Lobatto quadrature at the nodes), see `inertia`.
//!
//! Interpolation relative to one node, hence objective and independent of the path
//! [Crisfield and Jelenić 1999; Sonneville, Brüls and Bauchau 2017]:
//!
//! ```text
//! d_i = log(H_r⁻¹ H_i),   d(ξ) = Σ N_i d_i,   H(ξ) = H_r exp d(ξ),   f = T(d) d'
//! ```
//!
//! r reference node, ' derivative with respect to arc length, f the deformed section's "twist per
//! length", strain ε = f - f₀. With the energy ½ ∫ εᵀ C ε on N - 1 Gauss points and S = w C ε:
//!
//! ```text
//! g_i = Σ [N_i' Tᵀ S + N_i (∂(T d')/∂d)ᵀ S],   F_i = T(d_i)⁻ᵀ g_i,   F_r = - Σ Ad(exp(-d_i))ᵀ F_i
//! ```
//!
//! All is built from relative motions: neither forces nor tangents change when the element moves
//! rigidly.

use lissom_motion::{
    Matrix6, Motion, ScrewTangent, Vector6, coadjoint_matrix, inverse_tangent, inverse_tangent_derivative,
    inverse_tangent_times, inverse_tangent_transpose_derivative, inverse_tangent_transpose_times,
    lie_bracket_matrix, tangent, tangent_derivative, tangent_derivative_transpose_times, tangent_hessian,
    tangent_rate_times, tangent_times, tangent_transpose_derivative, tangent_transpose_times,
};

use super::passage::{Passage, STAGES};
use super::quadrature::gauss_legendre;
use super::shape::lagrange;
use super::{Element, Energy, MOST_UNKNOWNS, Tangents, add_block};
use crate::system::{Kinematics, NodeId};

/// Elastic law of a beam's cross section: forces (axial, shear 2, shear 3) and moments (torsion,
/// bending 2, bending 3) for the six strains.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionLaw {
    /// 6x6 stiffness [N, N m, N m²].
    pub stiffness: Matrix6,
    /// Stiffness-proportional damping: forces are `stiffness (ε + damping ε̇)` [s].
    pub damping: f64,
}

/// What one Gauss point needs.
#[derive(Clone, Debug)]
pub(super) struct Station<const N: usize> {
    /// Shape functions and their derivatives with respect to arc length.
    pub(super) shape: [f64; N],
    pub(super) slope: [f64; N],
    /// Weight times length per ξ [m].
    pub(super) weight: f64,
    pub(super) law: SectionLaw,
    /// f₀ of the stress-free state.
    natural: Vector6,
}

/// A beam element with `N` nodes at the Gauss-Lobatto points.
#[derive(Clone, Debug)]
pub struct Beam<const N: usize> {
    pub(super) nodes: [NodeId; N],
    /// Section frame in the node's frame, where they differ.
    pub(super) offsets: [Option<Motion>; N],
    pub(super) stations: Vec<Station<N>>,
    /// Stress-free relative motions of the nodes, for section forces anywhere in the element.
    natural: [Vector6; N],
}

/// Relative coordinates of the nodes with respect to the reference node.
pub(super) type Relative<const N: usize> = [Vector6; N];

impl<const N: usize> Beam<N> {
    /// The node the others are measured from: one in the middle, so that relative rotations are small.
    pub const REFERENCE: usize = (N - 1) / 2;

    /// A beam element, free of stress where the section frames at its nodes are `natural`.
    /// `law(ξ)` gives the section at ξ ∈ [-1, 1]; `offsets` the section frames in the nodes' frames.
    pub fn new(
        nodes: [NodeId; N],
        offsets: [Option<Motion>; N],
        natural: &[Motion; N],
        law: impl Fn(f64) -> SectionLaw,
    ) -> Self {
        let relative = relative_coordinates(natural);
        let stations = gauss_legendre(N - 1)
            .iter()
            .map(|&(xi, weight)| {
                let (shape, slope) = lagrange::<N>(xi);
                let twist = tangent_times(&combine(&shape, &relative), &combine(&slope, &relative));
                let length = twist.fixed_rows::<3>(0).norm();
                Station {
                    shape,
                    slope: slope.map(|value| value / length),
                    weight: weight * length,
                    law: law(xi),
                    natural: twist / length,
                }
            })
            .collect();
        Self { nodes, offsets, stations, natural: relative }
    }

    /// Length of the stress-free reference line [m].
    pub fn length(&self) -> f64 {
        self.stations.iter().map(|station| station.weight).sum()
    }

    /// Length of the stress-free reference line per ξ at ξ [m].
    pub fn length_per_xi(&self, xi: f64) -> f64 {
        let (shape, slope) = lagrange::<N>(xi);
        let twist = tangent_times(&combine(&shape, &self.natural), &combine(&slope, &self.natural));
        twist.fixed_rows::<3>(0).norm()
    }

    fn section_frame(&self, at: &Kinematics, i: usize) -> Motion {
        let frame = at.nodes[self.nodes[i]].frame;
        self.offsets[i].as_ref().map_or(frame, |offset| frame * *offset)
    }

    fn section_twist(&self, at: &Kinematics, i: usize) -> Vector6 {
        let twist = at.nodes[self.nodes[i]].twist;
        self.offsets[i].as_ref().map_or(twist, |offset| offset.adjoint_inverse_times(&twist))
    }

    pub(super) fn relative(&self, at: &Kinematics) -> Relative<N> {
        relative_coordinates(&std::array::from_fn(|i| self.section_frame(at, i)))
    }

    /// V_i - Ad(exp(-d_i)) V_r: the twist of each node relative to the reference node.
    pub(super) fn relative_twists(&self, at: &Kinematics, d: &Relative<N>) -> Relative<N> {
        let reference = self.section_twist(at, Self::REFERENCE);
        std::array::from_fn(|i| {
            if i == Self::REFERENCE {
                Vector6::zeros()
            } else {
                self.section_twist(at, i) - Motion::exponential(&d[i]).adjoint_inverse_times(&reference)
            }
        })
    }

    /// Rates ḋ_i of the relative coordinates, or none where nothing is damped.
    fn rates(&self, at: &Kinematics, d: &Relative<N>) -> Option<Relative<N>> {
        self.stations.iter().any(|station| station.law.damping != 0.0).then(|| {
            let twists = self.relative_twists(at, d);
            std::array::from_fn(|i| inverse_tangent_times(&d[i], &twists[i]))
        })
    }

    /// Place of the section at ξ ∈ [-1, 1].
    pub fn frame_at(&self, at: &Kinematics, xi: f64) -> Motion {
        let d = combine(&lagrange::<N>(xi).0, &self.relative(at));
        self.section_frame(at, Self::REFERENCE) * Motion::exponential(&d)
    }

    /// Twist of the section at ξ in its own frame [m/s, rad/s].
    pub fn twist_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        let relative = self.relative(at);
        let shape = lagrange::<N>(xi).0;
        let d = combine(&shape, &relative);
        let twists = self.relative_twists(at, &relative);
        let rates: Relative<N> = std::array::from_fn(|i| inverse_tangent_times(&relative[i], &twists[i]));
        Motion::exponential(&d).adjoint_inverse_times(&self.section_twist(at, Self::REFERENCE))
            + tangent_times(&d, &combine(&shape, &rates))
    }

    /// Strain at ξ ∈ [-1, 1]: axial, shear 2, shear 3 [-], twist, curvature 2, curvature 3 [1/m].
    pub fn strain_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        let (shape, slope) = lagrange::<N>(xi);
        let twist = |d: &Relative<N>| tangent_times(&combine(&shape, d), &combine(&slope, d));
        let natural = twist(&self.natural);
        (twist(&self.relative(at)) - natural) / natural.fixed_rows::<3>(0).norm()
    }

    /// Section forces and moments at ξ in the section's frame [N, N m], interpolated between the Gauss
    /// points, where they are most accurate.
    pub fn section_forces_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        let relative = self.relative(at);
        let rates = self.rates(at, &relative);
        let points = gauss_legendre(N - 1);
        let mut sum = Vector6::zeros();
        for (k, station) in self.stations.iter().enumerate() {
            let weight: f64 = (0..points.len())
                .filter(|&j| j != k)
                .map(|j| (xi - points[j].0) / (points[k].0 - points[j].0))
                .product();
            sum += weight * station.stress(&relative, rates.as_ref());
        }
        sum
    }
}

impl<const N: usize> Beam<N> {
    /// Adds forces F_i on the section frames of all nodes but the reference, which takes what balances
    /// them: F_r = - Σ Ad(exp(-d_i))ᵀ F_i.
    pub(super) fn add_relative_forces(&self, motions: &[Motion; N], forces: &Relative<N>, out: &mut [f64]) {
        let mut at_reference = Vector6::zeros();
        let mut add = |i: usize, force: &Vector6| {
            let force = self.offsets[i]
                .as_ref()
                .map_or(*force, |offset| offset.adjoint_inverse_transpose_times(force));
            for k in 0..6 {
                out[6 * i + k] += force[k];
            }
        };
        for i in (0..N).filter(|&i| i != Self::REFERENCE) {
            at_reference -= motions[i].adjoint_inverse_transpose_times(&forces[i]);
            add(i, &forces[i]);
        }
        add(Self::REFERENCE, &at_reference);
    }
}

/// Σ N_i d_i.
pub(super) fn combine<const N: usize>(weights: &[f64; N], vectors: &Relative<N>) -> Vector6 {
    let mut sum = Vector6::zeros();
    for i in 0..N {
        if i != Beam::<N>::REFERENCE {
            sum += weights[i] * vectors[i];
        }
    }
    sum
}

/// Motions of the nodes relative to the reference node.
pub(super) fn relative_motions<const N: usize>(frames: &[Motion; N]) -> [Motion; N] {
    let reference = frames[Beam::<N>::REFERENCE];
    std::array::from_fn(|i| {
        if i == Beam::<N>::REFERENCE { Motion::IDENTITY } else { frames[i].relative_to(&reference) }
    })
}

fn logarithms<const N: usize>(motions: &[Motion; N]) -> Relative<N> {
    std::array::from_fn(|i| if i == Beam::<N>::REFERENCE { Vector6::zeros() } else { motions[i].logarithm() })
}

fn relative_coordinates<const N: usize>(frames: &[Motion; N]) -> Relative<N> {
    logarithms(&relative_motions(frames))
}

impl<const N: usize> Station<N> {
    pub(super) fn strain(&self, d: &Vector6, d_slope: &Vector6) -> Vector6 {
        tangent_times(d, d_slope) - self.natural
    }

    /// ε̇ = T ḋ' + (∂(T d')/∂d) ḋ.
    pub(super) fn strain_rate(&self, d: &Vector6, d_slope: &Vector6, rates: &Relative<N>) -> Vector6 {
        tangent_times(d, &combine(&self.slope, rates))
            + tangent_rate_times(d, &combine(&self.shape, rates), d_slope)
    }

    /// Section forces and moments [N, N m].
    fn stress(&self, relative: &Relative<N>, rates: Option<&Relative<N>>) -> Vector6 {
        let d = combine(&self.shape, relative);
        let d_slope = combine(&self.slope, relative);
        let mut strain = self.strain(&d, &d_slope);
        if let Some(rates) = rates {
            strain += self.law.damping * self.strain_rate(&d, &d_slope, rates);
        }
        self.law.stiffness * strain
    }
}

impl<const N: usize> Element for Beam<N> {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let motions = relative_motions(&std::array::from_fn(|i| self.section_frame(at, i)));
        let relative = logarithms(&motions);
        let rates = self.rates(at, &relative);
        let mut conjugate = [Vector6::zeros(); N];
        for station in &self.stations {
            let d = combine(&station.shape, &relative);
            let d_slope = combine(&station.slope, &relative);
            // Hot: the operator's coefficients serve strain and forces.
            let operator = ScrewTangent::new(&d);
            let mut strain = operator.times(&d_slope) - station.natural;
            if let Some(rates) = &rates {
                strain += station.law.damping * station.strain_rate(&d, &d_slope, rates);
            }
            let stress = station.weight * (station.law.stiffness * strain);
            let along = operator.transpose_times(&stress);
            let across = operator.derivative_transpose_times(&d_slope, &stress);
            for i in 0..N {
                conjugate[i] += station.slope[i] * along + station.shape[i] * across;
            }
        }
        let forces: Relative<N> = std::array::from_fn(|i| {
            if i == Self::REFERENCE {
                Vector6::zeros()
            } else {
                inverse_tangent_transpose_times(&relative[i], &conjugate[i])
            }
        });
        self.add_relative_forces(&motions, &forces, out);
    }

    fn passage_forces(&self, passage: &Passage<'_>, out: &mut [[f64; MOST_UNKNOWNS]; STAGES]) {
        self.add_passage_forces(passage, out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at, out);
    }

    fn linearize_stressed(&self, at: &Kinematics, stressed: &Kinematics, out: &mut Tangents) {
        linearize::Linearization::new(self, at, stressed).assemble(self, out);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let relative = self.relative(at);
        let strain = self
            .stations
            .iter()
            .map(|station| {
                let strain =
                    station.strain(&combine(&station.shape, &relative), &combine(&station.slope, &relative));
                0.5 * station.weight * strain.dot(&(station.law.stiffness * strain))
            })
            .sum();
        Energy { strain, ..Energy::default() }
    }
}

mod linearize {
    //! Exact derivatives of a beam's forces, in three layers: relative coordinates d, relative
    //! variations η_i = δh_i - Ad(exp(-d_i)) δh_r, nodes.

    use super::{
        Beam, Kinematics, Matrix6, Motion, Relative, Station, Tangents, Vector6, add_block, coadjoint_matrix,
        combine, inverse_tangent, inverse_tangent_derivative, inverse_tangent_transpose_derivative,
        inverse_tangent_transpose_times, lie_bracket_matrix, tangent, tangent_derivative,
        tangent_derivative_transpose_times, tangent_hessian, tangent_rate_times,
        tangent_transpose_derivative, tangent_transpose_times,
    };

    type Blocks<const N: usize> = [[Matrix6; N]; N];

    pub(super) struct Linearization<const N: usize> {
        relative: Relative<N>,
        /// ∂g_i/∂d_k and ∂g_i/∂ḋ_k.
        stiffness: Blocks<N>,
        damping: Blocks<N>,
        conjugate: [Vector6; N],
        damped: bool,
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
            // ∂ḋ_k/∂d_k at constant node twists: δ(T(d)⁻¹ w) with δw = ad_η Ad(exp(-d)) V_r, η = T δd.
            let rate_changes = rates.as_ref().map(|_| {
                let twists = beam.relative_twists(at, &relative);
                let reference = beam.section_twist(at, Beam::<N>::REFERENCE);
                std::array::from_fn(|k| {
                    let seen = Motion::exponential(&relative[k]).adjoint_inverse_times(&reference);
                    inverse_tangent_derivative(&relative[k], &twists[k])
                        - inverse_tangent(&relative[k]) * lie_bracket_matrix(&seen) * tangent(&relative[k])
                })
            });
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
            let viscous = rates.zip(rate_changes).map(|(rates, changes)| {
                let rate = combine(shape, rates);
                let rate_slope = combine(slope, rates);
                // ∂ε̇/∂d = ∂(T ḋ')/∂d + ∂²(T d')/∂d² ḋ, and ∂ε̇/∂d' = Ṫ.
                let by_d = tangent_derivative(&d, &rate_slope) + second_derivative_times(&d, &d_slope, &rate);
                let by_slope = tangent_rate(&d, &rate);
                let changes: [Matrix6; N] =
                    std::array::from_fn(|k| shape[k] * by_d + slope[k] * by_slope + strains[k] * changes[k]);
                changes
            });
            for i in 0..N {
                self.conjugate[i] += slope[i] * along + shape[i] * across;
                let left = weight * strains[i].transpose() * station.law.stiffness;
                for k in 0..N {
                    self.stiffness[i][k] += left * strains[k]
                        + slope[i] * shape[k] * turn
                        + shape[i] * slope[k] * turn.transpose()
                        + shape[i] * shape[k] * bend;
                    if let Some(viscous) = &viscous {
                        self.stiffness[i][k] += station.law.damping * left * viscous[k];
                        self.damping[i][k] += station.law.damping * left * strains[k];
                    }
                }
            }
        }

        pub(super) fn assemble(&self, beam: &Beam<N>, out: &mut Tangents) {
            let inverse: [Matrix6; N] = std::array::from_fn(|i| inverse_tangent(&self.relative[i]));
            let mut stiffness = [[Matrix6::zeros(); N]; N];
            let mut damping = [[Matrix6::zeros(); N]; N];
            let mut geometric = [Matrix6::zeros(); N];
            for i in (0..N).filter(|&i| i != Beam::<N>::REFERENCE) {
                let force = inverse_tangent_transpose_times(&self.relative[i], &self.conjugate[i]);
                geometric[i] = coadjoint_matrix(&force);
                for k in (0..N).filter(|&k| k != Beam::<N>::REFERENCE) {
                    let mut change = inverse[i].transpose() * self.stiffness[i][k];
                    if i == k {
                        change += inverse_tangent_transpose_derivative(&self.relative[i], &self.conjugate[i]);
                    }
                    stiffness[i][k] = change * inverse[k];
                    if self.damped {
                        damping[i][k] = inverse[i].transpose() * self.damping[i][k] * inverse[k];
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
                sum -= adjoints[i].transpose() * change;
            }
            blocks[r][k] = sum;
        }
        for i in 0..N {
            let mut sum = Matrix6::zeros();
            for k in (0..N).filter(|&k| k != r) {
                sum -= blocks[i][k] * adjoints[k];
            }
            blocks[i][r] = sum;
        }
        for i in 0..N {
            for k in 0..N {
                let mut block = blocks[i][k];
                if let Some(offset) = &beam.offsets[i] {
                    block = offset.inverse().adjoint().transpose() * block;
                }
                if let Some(offset) = &beam.offsets[k] {
                    block *= offset.inverse().adjoint();
                }
                add_block(out, 6 * N, (6 * i, 6 * k), &block);
            }
        }
    }

    /// Ṫ for the rate ḋ.
    fn tangent_rate(d: &Vector6, rate: &Vector6) -> Matrix6 {
        Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| tangent_rate_times(d, rate, &unit(k))))
    }

    /// ∂/∂d of (∂(T a)/∂d) b, row by row from the Hessians of the components of T a.
    fn second_derivative_times(d: &Vector6, a: &Vector6, b: &Vector6) -> Matrix6 {
        Matrix6::from_rows(&std::array::from_fn::<_, 6, _>(|k| {
            (tangent_hessian(d, a, &unit(k)) * b).transpose()
        }))
    }

    fn unit(k: usize) -> Vector6 {
        let mut vector = Vector6::zeros();
        vector[k] = 1.0;
        vector
    }
}
