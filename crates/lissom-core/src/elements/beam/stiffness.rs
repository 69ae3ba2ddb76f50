//! Derivatives of a beam's elastic forces by places, for one element or for several side by side. The formulas are
//! those of `beam::linearize`, without damping.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{CurvedTangent, DualMatrix, Pose, Real, Screw, TangentOperator};

use super::Beam;
use super::forces::{Constants, combine_shapes, combine_slopes};

/// A 6 x 6 matrix.
pub(super) type Rows<R> = [Screw<R>; 6];

/// By node of the force, then by node of the variation.
pub(super) type Stiffness<R, const N: usize> = [[Rows<R>; N]; N];

/// The derivatives by the body variations of the section frames, with the stresses of the frames `stressed`.
#[inline(always)]
pub(super) fn stiffness<R: Real, const N: usize>(
    constants: &impl Constants<R>,
    frames: &[Pose<R>; N],
    stressed: &[Pose<R>; N],
) -> Stiffness<R, N> {
    let reference = Beam::<N>::REFERENCE;
    let mut relative = [Screw::zero(frames[0].position.x); N];
    let mut relative_stressed = relative;
    // Takes variations of the reference node to where the others are.
    let mut adjoints = [frames[0].adjoint_inverse(); N];
    for i in 0..N {
        if i != reference {
            let motion = frames[i].relative_to(frames[reference]);
            relative[i] = motion.logarithm();
            relative_stressed[i] = stressed[i].relative_to(stressed[reference]).logarithm();
            adjoints[i] = motion.adjoint_inverse();
        }
    }
    let (mut blocks, conjugate) = by_coordinates(constants, &relative, &relative_stressed);
    let geometric = by_relative_variations(&mut blocks, &relative, &conjugate);
    spread(&mut blocks, &geometric, &adjoints);
    blocks
}

/// ∂g_i/∂d_k, and the forces g_i conjugate to the relative coordinates.
#[inline(always)]
fn by_coordinates<R: Real, const N: usize>(
    constants: &impl Constants<R>,
    relative: &[Screw<R>; N],
    stressed: &[Screw<R>; N],
) -> (Stiffness<R, N>, [Screw<R>; N]) {
    let reference = Beam::<N>::REFERENCE;
    let zero = Screw::zero(relative[0].rotation.x);
    let mut blocks = [[[zero; 6]; N]; N];
    let mut conjugate = [zero; N];
    for k in 0..N - 1 {
        let d_slope = combine_slopes(constants, k, relative);
        let curved = CurvedTangent::new(combine_shapes(constants, k, relative));
        let strain = combine_shapes(constants, k, stressed)
            .tangent_times(combine_slopes(constants, k, stressed))
            - constants.natural(k);
        let stress = constants.stress(k, strain);
        let along = curved.operator.transpose_times(stress);
        let across = curved.operator.derivative_transpose_times(d_slope, stress);
        let turn = curved.operator.transpose_derivative(stress);
        let bend = curved.hessian(d_slope, stress);
        let (by_slope, by_shape) = (curved.operator.matrix(), curved.operator.derivative(d_slope));
        let law = constants.law(k);
        let mut strains = [by_slope; N];
        let mut stresses = [law; N];
        for i in 0..N {
            if i != reference {
                let (slope, shape) = (constants.slope(k, i), zero.rotation.x.like(constants.shape(k, i)));
                conjugate[i] = conjugate[i].plus_scaled(along, slope).plus_scaled(across, shape);
                strains[i] = by_slope.scaled_by(slope).plus_scaled(by_shape, shape);
                stresses[i] = strains[i].times_from_right(&law);
            }
        }
        for i in 0..N {
            for m in 0..N {
                if i != reference && m != reference {
                    add_rows(&mut blocks[i][m], &strains[i].transpose_times_rows(&stresses[m]));
                    let (own, other) = (constants.shape(k, i), constants.shape(k, m));
                    turn.scaled_by(constants.slope(k, i).scaled(other))
                        .plus_scaled(turn.transposed(), constants.slope(k, m).scaled(own))
                        .plus_scaled(bend, zero.rotation.x.like(own * other))
                        .add_to(&mut blocks[i][m]);
                }
            }
        }
    }
    (blocks, conjugate)
}

/// From ∂g_i/∂d_k to ∂F_i/∂η_k; gives X(F_i).
#[inline(always)]
fn by_relative_variations<R: Real, const N: usize>(
    blocks: &mut Stiffness<R, N>,
    relative: &[Screw<R>; N],
    conjugate: &[Screw<R>; N],
) -> [DualMatrix<R>; N] {
    let reference = Beam::<N>::REFERENCE;
    let mut inverse = [TangentOperator::inverse(relative[reference + 1]); N];
    for i in 0..N {
        if i != reference && i != reference + 1 {
            inverse[i] = TangentOperator::inverse(relative[i]);
        }
    }
    let mut geometric = [DualMatrix::coadjoint(conjugate[0]); N];
    for i in 0..N {
        if i != reference {
            geometric[i] = DualMatrix::coadjoint(inverse[i].transpose_times(conjugate[i]));
            for m in 0..N {
                if m != reference {
                    let mut change = inverse[i].matrix().transpose_times_rows(&blocks[i][m]);
                    if i == m {
                        inverse[i].transpose_derivative(conjugate[i]).add_to(&mut change);
                    }
                    blocks[i][m] = inverse[m].matrix().times_from_right(&change);
                }
            }
        }
    }
    geometric
}

/// From ∂F_i/∂η_k of the relative nodes to all nodes: η_k = δh_k - A_k δh_r, F_r = - Σ A_iᵀ F_i and
/// δ(A_iᵀ) F_i = - A_iᵀ X(F_i) η_i.
#[inline(always)]
fn spread<R: Real, const N: usize>(
    blocks: &mut Stiffness<R, N>,
    geometric: &[DualMatrix<R>; N],
    adjoints: &[DualMatrix<R>; N],
) {
    let reference = Beam::<N>::REFERENCE;
    for m in 0..N {
        for i in 0..N {
            if i != reference && m != reference {
                let mut change = blocks[i][m];
                if i == m {
                    (-geometric[i]).add_to(&mut change);
                }
                subtract_rows(&mut blocks[reference][m], &adjoints[i].transpose_times_rows(&change));
            }
        }
    }
    for i in 0..N {
        for m in 0..N {
            if m != reference {
                let seen = adjoints[m].times_from_right(&blocks[i][m]);
                subtract_rows(&mut blocks[i][reference], &seen);
            }
        }
    }
}

#[inline(always)]
fn add_rows<R: Real>(rows: &mut Rows<R>, other: &Rows<R>) {
    for i in 0..6 {
        rows[i] = rows[i] + other[i];
    }
}

#[inline(always)]
fn subtract_rows<R: Real>(rows: &mut Rows<R>, other: &Rows<R>) {
    for i in 0..6 {
        rows[i] = rows[i] - other[i];
    }
}
