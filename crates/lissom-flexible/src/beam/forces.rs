//! A beam's elastic and viscous forces, for one element or for several side by side; formulas at `beam`.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{InverseTangent, Pose, Real, Screw, TangentOperator};

use super::{Beam, reference};

/// Constants of an element; Gauss points `k` from 0 to N - 2, nodes `i`.
pub(super) trait Constants<R: Real> {
    /// Shape function of node `i` at point `k`.
    fn shape(&self, k: usize, i: usize) -> f64;
    /// Derivative of the shape function of node `i` at point `k` with respect to arc length.
    fn slope(&self, k: usize, i: usize) -> R;
    /// f₀ of the stress-free state.
    fn natural(&self, k: usize) -> Screw<R>;
    /// Damping by stiffness [s].
    fn damping(&self, k: usize) -> R;
    /// w C ε of the strain ε.
    fn stress(&self, k: usize, strain: Screw<R>) -> Screw<R>;
}

/// A node relative to the reference node.
#[derive(Clone, Copy)]
struct Link<R> {
    motion: Pose<R>,
    d: Screw<R>,
    inverse: InverseTangent<R>,
}

impl<R: Real> Link<R> {
    #[inline(always)]
    fn new(frame: Pose<R>, reference: Pose<R>) -> Self {
        let motion = frame.relative_to(reference);
        let (d, inverse) = motion.logarithm_and_inverse_tangent();
        Self { motion, d, inverse }
    }
}

/// Forces on the section frames of all nodes, from the frames and, with damping, their twists.
#[inline(always)]
pub(super) fn forces<R: Real, const N: usize>(
    constants: &impl Constants<R>,
    frames: &[Pose<R>; N],
    twists: Option<&[Screw<R>; N]>,
) -> [Screw<R>; N] {
    let reference = Beam::<N>::REFERENCE;
    let next = reference + 1;
    let mut links = [Link::new(frames[next], frames[reference]); N];
    for i in 0..N {
        if i != reference && i != next {
            links[i] = Link::new(frames[i], frames[reference]);
        }
    }
    let zero = Screw::zero(frames[0].position.x);
    let mut rates = [zero; N];
    if let Some(twists) = twists {
        for i in 0..N {
            if i != reference {
                let seen = links[i].motion.adjoint_inverse_times(twists[reference]);
                rates[i] = links[i].inverse.times(twists[i] - seen);
            }
        }
    }
    let conjugate = conjugate_forces(constants, &links, twists.is_some().then_some(&rates));
    let mut forces = [zero; N];
    for i in 0..N {
        if i != reference {
            forces[i] = links[i].inverse.transpose_times(conjugate[i]);
            forces[reference] =
                forces[reference] - links[i].motion.adjoint_inverse_transpose_times(forces[i]);
        }
    }
    forces
}

/// Forces conjugate to the relative coordinates d_i.
#[inline(always)]
fn conjugate_forces<R: Real, const N: usize>(
    constants: &impl Constants<R>,
    links: &[Link<R>; N],
    rates: Option<&[Screw<R>; N]>,
) -> [Screw<R>; N] {
    let zero = Screw::zero(links[0].d.rotation.x);
    let mut relative = [zero; N];
    for i in 0..N {
        relative[i] = links[i].d;
    }
    let mut conjugate = [zero; N];
    for k in 0..N - 1 {
        let d_slope = combine_slopes(constants, k, &relative);
        if N == 2 {
            // With only one relative coordinate, d and d' are parallel and T d' = d' for every d.
            let mut strain = d_slope - constants.natural(k);
            if let Some(rates) = rates {
                strain = strain.plus_scaled(combine_slopes(constants, k, rates), constants.damping(k));
            }
            conjugate[1] = constants.stress(k, strain) * constants.slope(k, 1);
            continue;
        }
        // The operator's coefficients are used for strain and forces.
        let operator = TangentOperator::new(combine_shapes(constants, k, &relative));
        let mut strain = operator.times(d_slope) - constants.natural(k);
        if let Some(rates) = rates {
            let rate = operator.times(combine_slopes(constants, k, rates))
                + operator.rate_times(combine_shapes(constants, k, rates), d_slope);
            strain = strain.plus_scaled(rate, constants.damping(k));
        }
        let stress = constants.stress(k, strain);
        let along = operator.transpose_times(stress);
        let across = operator.derivative_transpose_times(d_slope, stress);
        for i in 0..N {
            if i != Beam::<N>::REFERENCE {
                let shape = along.translation.x.like(constants.shape(k, i));
                conjugate[i] =
                    conjugate[i].plus_scaled(along, constants.slope(k, i)).plus_scaled(across, shape);
            }
        }
    }
    conjugate
}

/// Σ N_i' v_i.
#[inline(always)]
pub(super) fn combine_slopes<R: Real>(
    constants: &impl Constants<R>,
    k: usize,
    vectors: &[Screw<R>],
) -> Screw<R> {
    let reference = reference(vectors.len());
    let next = reference + 1;
    let mut sum = vectors[next] * constants.slope(k, next);
    for i in 0..vectors.len() {
        if i != reference && i != next {
            sum = sum.plus_scaled(vectors[i], constants.slope(k, i));
        }
    }
    sum
}

/// Σ N_i v_i.
#[inline(always)]
pub(super) fn combine_shapes<R: Real>(
    constants: &impl Constants<R>,
    k: usize,
    vectors: &[Screw<R>],
) -> Screw<R> {
    let reference = reference(vectors.len());
    let next = reference + 1;
    let mut sum = vectors[next].scaled(constants.shape(k, next));
    for i in 0..vectors.len() {
        if i != reference && i != next {
            let shape = sum.translation.x.like(constants.shape(k, i));
            sum = sum.plus_scaled(vectors[i], shape);
        }
    }
    sum
}
