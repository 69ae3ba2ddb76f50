//! Derivatives of a beam's elastic forces with respect to positions, for one element or for several side by side. The
//! formulas are those of `beam::linearize`, without damping.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{CurvedTangent, DualMatrix, Pose, Real, Screw, TangentOperator};

use super::Beam;
use super::forces::{Constants, combine_shapes, combine_slopes};

/// A 6 x 6 matrix.
pub(super) type Rows<R> = [Screw<R>; 6];

/// By node of the force, then by node of the variation.
pub(super) type Stiffness<R, const N: usize> = [[Rows<R>; N]; N];

/// Derivatives with respect to the body variations of the section frames, with the stresses of the frames `stressed`.
#[inline(always)]
pub(super) fn stiffness<R: Real, const N: usize>(
    constants: &impl Constants<R>,
    frames: &[Pose<R>; N],
    stressed: &[Pose<R>; N],
) -> Stiffness<R, N> {
    let reference = Beam::<N>::REFERENCE;
    let mut relative = [Screw::zero(frames[0].position.x); N];
    let mut relative_stressed = relative;
    // Transforms variations of the reference node to the frames of the others.
    let mut adjoints = [frames[0].adjoint_inverse(); N];
    for i in 0..N {
        if i != reference {
            let motion = frames[i].relative_to(frames[reference]);
            relative[i] = logarithm(motion);
            relative_stressed[i] = logarithm(stressed[i].relative_to(stressed[reference]));
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
        let stressed_shape = combine_shapes(constants, k, stressed);
        let strain = strain(stressed_shape, combine_slopes(constants, k, stressed)) - constants.natural(k);
        let stress = constants.stress(k, strain);
        let AtStation { along, across, turn, bend, by_slope, by_shape } =
            at_station(combine_shapes(constants, k, relative), d_slope, stress);
        let law = constants.law(k);
        let mut strains = [by_slope; N];
        let mut stresses = [law; N];
        for i in 0..N {
            if i != reference {
                let (slope, shape) = (constants.slope(k, i), zero.rotation.x.like(constants.shape(k, i)));
                conjugate[i] = conjugate[i].plus_scaled(along, slope).plus_scaled(across, shape);
                strains[i] = by_slope.scaled_by(slope).plus_scaled(by_shape, shape);
                stresses[i] = times_from_right(strains[i], &law);
            }
        }
        for i in 0..N {
            for m in 0..N {
                if i != reference && m != reference {
                    add_rows(&mut blocks[i][m], &transpose_times_rows(strains[i], &stresses[m]));
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

// The following has long formulas, which are compiled once for beams of any number of nodes.

#[inline(always)]
fn logarithm<R: Real>(motion: Pose<R>) -> Screw<R> {
    motion.position.x.apart(
        #[inline(always)]
        || motion.logarithm(),
    )
}

/// T(d) d'.
#[inline(always)]
fn strain<R: Real>(d: Screw<R>, d_slope: Screw<R>) -> Screw<R> {
    d.rotation.x.apart(
        #[inline(always)]
        || d.tangent_times(d_slope),
    )
}

#[inline(always)]
fn inverse_tangent<R: Real>(d: Screw<R>) -> TangentOperator<R> {
    d.rotation.x.apart(
        #[inline(always)]
        || TangentOperator::inverse(d),
    )
}

/// `W M` of rows W and a twist matrix M.
#[inline(always)]
pub(super) fn times_from_right<R: Real>(matrix: DualMatrix<R>, rows: &Rows<R>) -> Rows<R> {
    rows[0].rotation.x.apart(
        #[inline(always)]
        || matrix.times_from_right(rows),
    )
}

/// `Mᵀ W` of a twist matrix M and rows W.
#[inline(always)]
pub(super) fn transpose_times_rows<R: Real>(matrix: DualMatrix<R>, rows: &Rows<R>) -> Rows<R> {
    rows[0].rotation.x.apart(
        #[inline(always)]
        || matrix.transpose_times_rows(rows),
    )
}

/// Quantities of a station for all nodes, at T(d) and d', with the stress σ.
struct AtStation<R> {
    /// Tᵀ σ.
    along: Screw<R>,
    /// (∂(T d')/∂d)ᵀ σ.
    across: Screw<R>,
    /// ∂(Tᵀ σ)/∂d.
    turn: DualMatrix<R>,
    /// ∂²(σᵀ T d')/∂d∂d.
    bend: DualMatrix<R>,
    /// Derivatives of strains with respect to d' and to d.
    by_slope: DualMatrix<R>,
    by_shape: DualMatrix<R>,
}

#[inline(always)]
fn at_station<R: Real>(d: Screw<R>, d_slope: Screw<R>, stress: Screw<R>) -> AtStation<R> {
    d.rotation.x.apart(
        #[inline(always)]
        || {
            let curved = CurvedTangent::new(d);
            AtStation {
                along: curved.operator.transpose_times(stress),
                across: curved.operator.derivative_transpose_times(d_slope, stress),
                turn: curved.operator.transpose_derivative(stress),
                bend: curved.hessian(d_slope, stress),
                by_slope: curved.operator.matrix(),
                by_shape: curved.operator.derivative(d_slope),
            }
        },
    )
}

/// From ∂g_i/∂d_k to ∂F_i/∂η_k; returns X(F_i).
#[inline(always)]
fn by_relative_variations<R: Real, const N: usize>(
    blocks: &mut Stiffness<R, N>,
    relative: &[Screw<R>; N],
    conjugate: &[Screw<R>; N],
) -> [DualMatrix<R>; N] {
    let reference = Beam::<N>::REFERENCE;
    let mut inverse = [inverse_tangent(relative[reference + 1]); N];
    for i in 0..N {
        if i != reference && i != reference + 1 {
            inverse[i] = inverse_tangent(relative[i]);
        }
    }
    let mut geometric = [DualMatrix::coadjoint(conjugate[0]); N];
    for i in 0..N {
        if i != reference {
            geometric[i] = DualMatrix::coadjoint(inverse[i].transpose_times(conjugate[i]));
            for m in 0..N {
                if m != reference {
                    let mut change = transpose_times_rows(inverse[i].matrix(), &blocks[i][m]);
                    if i == m {
                        inverse[i].transpose_derivative(conjugate[i]).add_to(&mut change);
                    }
                    blocks[i][m] = times_from_right(inverse[m].matrix(), &change);
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
                subtract_rows(&mut blocks[reference][m], &transpose_times_rows(adjoints[i], &change));
            }
        }
    }
    for i in 0..N {
        for m in 0..N {
            if m != reference {
                let seen = times_from_right(adjoints[m], &blocks[i][m]);
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
