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
//! All terms depend on relative motions only: neither forces nor tangents change when the element moves rigidly.

mod blocks;
mod forces;
pub mod line;
mod linearize;
pub mod section;
pub mod section_error;
mod section_gradient;
mod step_stages;

use lissom_motion::{
    Matrix6, Motion, Pose, Screw, Vector6, inverse_tangent_times, lie_bracket_matrix, tangent_rate_times,
    tangent_times,
};

use blocks::BeamBlocks;
use forces::{Constants, forces};

use lissom_mechanics::elements::quadrature::gauss_legendre;
use lissom_mechanics::elements::shape::lagrange;
use lissom_mechanics::elements::{Capabilities, Deformable, Element, Energy, Tangents, Unknowns};
use lissom_mechanics::evaluation::blocks::{Blocks, linearize_alone};
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages};
use lissom_mechanics::kinematics::{Kinematics, NodeId, Stressed, split};

/// Elastic law of a beam's cross section: forces (axial, shear 2, shear 3) and moments (torsion,
/// bending 2, bending 3) for the six strains.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionLaw {
    /// 6x6 stiffness [N, N m, N m²].
    pub stiffness: Matrix6,
    /// Stiffness-proportional damping: forces are `stiffness (ε + damping ε̇)` [s].
    pub damping: f64,
    /// Strains without forces, as of a change of temperature [-, 1/m].
    pub free: Vector6,
}

impl SectionLaw {
    /// A law without damping and free strains.
    pub fn elastic(stiffness: Matrix6) -> Self {
        Self { stiffness, damping: 0.0, free: Vector6::zeros() }
    }
}

/// Constants of one Gauss point.
#[derive(Clone, Debug)]
pub(super) struct Station<const N: usize> {
    /// Shape functions and their derivatives with respect to arc length.
    pub(super) shape: [f64; N],
    pub(super) slope: [f64; N],
    /// Weight times length per ξ [m].
    pub(super) weight: f64,
    pub(super) law: SectionLaw,
    /// f₀ of the state without forces.
    pub(super) natural: Vector6,
}

/// A beam element with `N` nodes at the Gauss-Lobatto points.
#[derive(Clone, Debug)]
pub struct Beam<const N: usize> {
    pub(super) nodes: [NodeId; N],
    /// Section frame relative to the node's frame, if they differ.
    pub(super) offsets: [Option<Motion>; N],
    pub(super) stations: Vec<Station<N>>,
    /// Stress-free relative motions of the nodes, for section forces anywhere in the element.
    natural: [Vector6; N],
}

/// Relative coordinates of the nodes with respect to the reference node.
pub(super) type Relative<const N: usize> = [Vector6; N];

impl<const N: usize> Beam<N> {
    /// The reference node of relative motions: one in the middle, so that relative rotations are small.
    pub const REFERENCE: usize = reference(N);

    /// A beam element, stress-free if the section frames at its nodes are `natural`. `law(ξ)` is the section's law at
    /// ξ ∈ [-1, 1]; `offsets` are the section frames relative to the nodes' frames.
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
                let law = law(xi);
                Station {
                    shape,
                    slope: slope.map(|value| value / length),
                    weight: weight * length,
                    natural: twist / length + law.free,
                    law,
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
    pub(crate) fn length_per_xi(&self, xi: f64) -> f64 {
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

    pub(super) fn is_damped(&self) -> bool {
        self.stations.iter().any(|station| station.law.damping != 0.0)
    }

    /// Rates ḋ_i of the relative coordinates, or none without damping.
    fn rates(&self, at: &Kinematics, d: &Relative<N>) -> Option<Relative<N>> {
        self.is_damped().then(|| {
            let twists = self.relative_twists(at, d);
            std::array::from_fn(|i| inverse_tangent_times(&d[i], &twists[i]))
        })
    }

    /// Pose of the section at ξ ∈ [-1, 1].
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

    /// Strain at ξ ∈ [-1, 1]: axial, shear 2, shear 3 [-], torsion, curvature 2, curvature 3 [1/m].
    pub(crate) fn strain_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        let (shape, slope) = lagrange::<N>(xi);
        let twist = |d: &Relative<N>| tangent_times(&combine(&shape, d), &combine(&slope, d));
        let natural = twist(&self.natural);
        (twist(&self.relative(at)) - natural) / natural.fixed_rows::<3>(0).norm()
    }

    /// The largest strain of the line at the Gauss points, axial and shear [-].
    pub(crate) fn largest_strain(&self, at: &Kinematics) -> f64 {
        let relative = self.relative(at);
        let of = |station: &Station<N>| {
            let strain =
                station.strain(&combine(&station.shape, &relative), &combine(&station.slope, &relative));
            strain.fixed_rows::<3>(0).norm()
        };
        self.stations.iter().map(of).fold(0.0, f64::max)
    }

    /// Whether a node is behind the one before it: the element is compressed by more than its length.
    pub(crate) fn overlaps(&self, at: &Kinematics) -> bool {
        (1..N).any(|i| {
            let [before, after] = [i - 1, i].map(|k| self.section_frame(at, k));
            before.rotation.apply_inverse(&(after.position - before.position)).x <= 0.0
        })
    }

    /// Internal forces on the two end nodes, section axes [N, N m].
    pub(crate) fn end_forces(&self, at: &Kinematics) -> [Vector6; 2] {
        let frames: [_; N] = std::array::from_fn(|i| Pose::from(&self.section_frame(at, i)));
        let twists = self.is_damped().then(|| std::array::from_fn(|i| (&self.section_twist(at, i)).into()));
        let forces = forces(self, &frames, twists.as_ref());
        [0, N - 1].map(|i| forces[i].into())
    }

    /// Section forces and moments at ξ in the section's frame [N, N m], from those at the Gauss points, where they are most
    /// accurate. The next term of the polynomial through them follows from the equilibrium of the line without the change of
    /// loads along the element. So weight causes bending between the points, and shear also between the nodes of a two-node
    /// element:
    ///
    /// ```text
    /// S' = ad(f)ᵀ S - load,   S = p + Π (ξ - ξ_k) ad(f_ξ)ᵀ c / (N - 1),   c leading coefficient of p
    /// ```
    pub fn section_forces_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        let relative = self.relative(at);
        let rates = self.rates(at, &relative);
        let points = gauss_legendre(N - 1);
        let (mut sum, mut leading) = (Vector6::zeros(), Vector6::zeros());
        for (k, station) in self.stations.iter().enumerate() {
            let others = || (0..points.len()).filter(|&j| j != k);
            let apart: f64 = others().map(|j| points[k].0 - points[j].0).product();
            let from: f64 = others().map(|j| xi - points[j].0).product();
            let stress = station.stress(&relative, rates.as_ref());
            sum += from / apart * stress;
            leading += stress / apart;
        }
        let (shape, slope) = lagrange::<N>(xi);
        let twist = tangent_times(&combine(&shape, &relative), &combine(&slope, &relative));
        let bubble: f64 = points.iter().map(|point| xi - point.0).product();
        sum + bubble / (N - 1) as f64 * lie_bracket_matrix(&twist).tr_mul(&leading)
    }
}

impl<const N: usize> Beam<N> {
    /// Adds forces F_i on the section frames of all nodes except the reference node, and the balancing force on it:
    /// F_r = - Σ Ad(exp(-d_i))ᵀ F_i.
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

/// The reference node of relative motions of this number of nodes.
pub(super) const fn reference(nodes: usize) -> usize {
    (nodes - 1) / 2
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

impl<const N: usize> Constants<f64> for Beam<N> {
    fn shape(&self, k: usize, i: usize) -> f64 {
        self.stations[k].shape[i]
    }

    fn slope(&self, k: usize, i: usize) -> f64 {
        self.stations[k].slope[i]
    }

    fn natural(&self, k: usize) -> Screw<f64> {
        (&self.stations[k].natural).into()
    }

    fn damping(&self, k: usize) -> f64 {
        self.stations[k].law.damping
    }

    fn stress(&self, k: usize, strain: Screw<f64>) -> Screw<f64> {
        let station = &self.stations[k];
        (&(station.weight * (station.law.stiffness * Vector6::from(strain)))).into()
    }
}

impl<const N: usize> Element for Beam<N> {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let frames: [_; N] = std::array::from_fn(|i| Pose::from(&self.section_frame(at, i)));
        let twists = self.is_damped().then(|| std::array::from_fn(|i| (&self.section_twist(at, i)).into()));
        let forces = forces(self, &frames, twists.as_ref());
        for (i, force) in forces.into_iter().enumerate() {
            let force = self.offsets[i]
                .as_ref()
                .map_or(force, |offset| Pose::from(offset).adjoint_inverse_transpose_times(force));
            for (sum, value) in out[6 * i..].iter_mut().zip(force.components()) {
                *sum += value;
            }
        }
    }

    fn blocks(items: &[Self]) -> Option<Box<dyn Blocks>> {
        Some(Box::new(BeamBlocks::new(items)))
    }

    fn derivative(neighbours: &[(&Self, f64)]) -> Option<Self> {
        let (first, _) = neighbours.first()?;
        let is_alike = |(one, other): (&Station<N>, &Station<N>)| {
            (one.shape, one.slope, one.weight, one.natural)
                == (other.shape, other.slope, other.weight, other.natural)
                && one.law.damping == other.law.damping
        };
        let is_known = |other: &Self| {
            (first.nodes, first.offsets, first.natural) == (other.nodes, other.offsets, other.natural)
                && first.stations.iter().zip(&other.stations).all(is_alike)
        };
        neighbours.iter().all(|(other, _)| is_known(other)).then(|| {
            let mut derivative = (*first).clone();
            for (k, station) in derivative.stations.iter_mut().enumerate() {
                let of = |(other, weight): &(&Self, f64)| other.stations[k].law.stiffness * *weight;
                station.law.stiffness = neighbours.iter().map(of).sum();
            }
            derivative
        })
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        self.add_stage_forces(step, out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at.into(), out);
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

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { deformation: Some(self), ..Capabilities::default() }
    }
}

impl<const N: usize> Deformable for Beam<N> {
    fn linearize_stressed(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents) {
        linearize_alone(&BeamBlocks::new(std::slice::from_ref(self)), (at, stressed), out);
    }

    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let relative = self.relative(at);
        let twists = self.relative_twists(at, &relative);
        let length = self.length();
        let rate = |i: usize| {
            let (velocity, angular) = split(&twists[i]);
            (velocity.norm() / length + angular.norm(), self.nodes[i])
        };
        (0..N).map(rate).reduce(|most, rate| if rate.0 > most.0 { rate } else { most })
    }

    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        // With unit quaternions of the two frames, their scalar product is the cosine of half the angle between them.
        let quaternion = |i: usize| {
            let rotation = at.nodes[self.nodes[i]].frame.rotation;
            let offset = self.offsets[i].as_ref().map(|offset| offset.rotation);
            offset.map_or(rotation, |offset| rotation * offset).quaternion()
        };
        let reference = quaternion(Self::REFERENCE);
        let pair = |i: usize| {
            let cosine: f64 = reference.iter().zip(quaternion(i)).map(|(a, b)| a * b).sum();
            (cosine.abs(), [self.nodes[Self::REFERENCE], self.nodes[i]])
        };
        let pairs = (0..N).filter(|&i| i != Self::REFERENCE).map(pair);
        pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least })
    }
}
