//! Derivatives of a beam's forces with respect to positions and twists, for several elements side by side, in three layers:
//! relative coordinates d, relative variations η_i = δh_i - Ad(exp(-d_i)) δh_r, nodes. Long formulas do not know the number of
//! nodes, so that they are compiled once: arrays have [`MAX_NODES`], of which the first are used.
//!
//! Legend: B_i = N_i' T + N_i ∂(T d')/∂d strains by coordinates, S = C (ε + θ ε̇), w_i = V_i - Ad(exp(-d_i)) V_r, D_ik = ∂g_i/∂ḋ_k.
//!
//! ```text
//! ∂g_i/∂d_k = Σ [B_iᵀ C (B_k + θ Ḃ_k) + geometric] + D_ik ∂ḋ_k/∂d_k,      D_ik = Σ θ B_iᵀ C B_k
//! ∂ḋ_k/∂d_k = ∂(T(d_k)⁻¹ w_k)/∂d_k - T(d_k)⁻¹ ad(Ad(exp(-d_k)) V_r) T(d_k)
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{CurvedTangent, DualMatrix, Pose, Real, Screw, TangentOperator};

use lissom_mechanics::kinematics::MAX_NODES;

use super::forces::{Constants, combine_shapes, combine_slopes};
use super::reference;

/// A 6 x 6 matrix.
type Rows<R> = [Screw<R>; 6];

/// By node of the force, then by node of the variation.
pub(super) type Matrices<R> = [[Rows<R>; MAX_NODES]; MAX_NODES];

/// Constants of an element with its law.
pub(super) trait Laws<R: Real>: Constants<R> {
    /// w C, row after row.
    fn law(&self, k: usize) -> [Screw<R>; 6];
}

/// The motion of the section frames of a damped beam.
pub(super) struct Viscous<'a, R> {
    /// Twists, and those of the configuration whose stresses are used.
    pub(super) twists: [&'a [Screw<R>]; 2],
    /// Receives the derivatives with respect to the twists.
    pub(super) damping: &'a mut Matrices<R>,
}

/// Positions and rates of the nodes relative to the reference node.
struct Relative<R> {
    /// Number of nodes.
    count: usize,
    /// d_i.
    coordinates: [Screw<R>; MAX_NODES],
    /// Ad(exp(-d_i)): from twists and variations of the reference node to the frames of the others.
    adjoints: [DualMatrix<R>; MAX_NODES],
    /// T(d_i)⁻¹.
    inverse: [TangentOperator<R>; MAX_NODES],
    /// Ad(exp(-d_i)) V_r, w_i and ḋ_i of a damped beam.
    seen: [Screw<R>; MAX_NODES],
    apart: [Screw<R>; MAX_NODES],
    rates: [Screw<R>; MAX_NODES],
}

impl<R: Real> Relative<R> {
    #[inline(always)]
    fn new(frames: &[Pose<R>], twists: Option<&[Screw<R>]>) -> Self {
        let count = frames.len();
        let reference = reference(count);
        let next = reference + 1;
        // What is not set below is not read.
        let first = logarithm(frames[next].relative_to(frames[reference]));
        let mut relative = Self {
            count,
            coordinates: [first; MAX_NODES],
            adjoints: [frames[0].adjoint_inverse(); MAX_NODES],
            inverse: [inverse_tangent(first); MAX_NODES],
            seen: [first; MAX_NODES],
            apart: [first; MAX_NODES],
            rates: [first; MAX_NODES],
        };
        for i in 0..count {
            if i != reference {
                let motion = frames[i].relative_to(frames[reference]);
                relative.adjoints[i] = motion.adjoint_inverse();
                if i != next {
                    relative.coordinates[i] = logarithm(motion);
                    relative.inverse[i] = inverse_tangent(relative.coordinates[i]);
                }
                if let Some(twists) = twists {
                    relative.seen[i] = motion.adjoint_inverse_times(twists[reference]);
                    relative.apart[i] = twists[i] - relative.seen[i];
                    relative.rates[i] = relative.inverse[i].times(relative.apart[i]);
                }
            }
        }
        relative
    }
}

/// Derivatives with respect to the body variations of the section frames and to their twists, with the stresses of the frames
/// `stressed`. Adds to `stiffness`, which is zero.
#[inline(always)]
pub(super) fn linearize<R: Real>(
    constants: &impl Laws<R>,
    frames: &[Pose<R>],
    stressed: &[Pose<R>],
    stiffness: &mut Matrices<R>,
    viscous: Option<Viscous<'_, R>>,
) {
    let (count, reference) = (frames.len(), reference(frames.len()));
    let (twists, mut damping) =
        viscous.map_or((None, None), |Viscous { twists, damping }| (Some(twists), Some(damping)));
    let relative = Relative::new(frames, twists.map(|[twists, _]| twists));
    let (coordinates, rates) = match twists {
        Some([_, twists]) => {
            let from = Relative::new(stressed, Some(twists));
            (from.coordinates, Some(from.rates))
        }
        None => (coordinates(stressed), None),
    };
    let conjugate =
        by_coordinates(constants, &relative, &coordinates, rates.as_ref(), stiffness, damping.as_deref_mut());
    if let Some(damping) = &damping {
        for i in 0..count {
            for m in 0..count {
                if i != reference && m != reference {
                    let turned = relative.inverse[m].derivative(relative.apart[m]);
                    add_rows(&mut stiffness[i][m], &times_from_right(turned, &damping[i][m]));
                }
            }
        }
    }
    by_relative_variations(stiffness, &relative, Some(&conjugate));
    if let Some(damping) = damping {
        by_relative_variations(damping, &relative, None);
        for i in 0..count {
            for m in 0..count {
                if i != reference && m != reference {
                    let turning = DualMatrix::lie_bracket(relative.seen[m]);
                    subtract_rows(&mut stiffness[i][m], &times_from_right(turning, &damping[i][m]));
                }
            }
        }
        spread(damping, &relative, None);
    }
    spread(stiffness, &relative, Some(&conjugate));
}

/// d_i.
#[inline(always)]
fn coordinates<R: Real>(frames: &[Pose<R>]) -> [Screw<R>; MAX_NODES] {
    let reference = reference(frames.len());
    let mut coordinates = [Screw::zero(frames[0].position.x); MAX_NODES];
    for i in 0..frames.len() {
        if i != reference {
            coordinates[i] = logarithm(frames[i].relative_to(frames[reference]));
        }
    }
    coordinates
}

/// Adds ∂g_i/∂d_k at constant ḋ and, with rates, ∂g_i/∂ḋ_k; returns the forces g_i conjugate to the relative coordinates.
#[inline(always)]
fn by_coordinates<R: Real>(
    constants: &impl Laws<R>,
    relative: &Relative<R>,
    stressed: &[Screw<R>; MAX_NODES],
    stressed_rates: Option<&[Screw<R>; MAX_NODES]>,
    stiffness: &mut Matrices<R>,
    mut damping: Option<&mut Matrices<R>>,
) -> [Screw<R>; MAX_NODES] {
    let (count, reference) = (relative.count, reference(relative.count));
    let zero = Screw::zero(relative.coordinates[0].rotation.x);
    let mut conjugate = [zero; MAX_NODES];
    for k in 0..count - 1 {
        let (d, d_slope) = (
            combine_shapes(constants, k, &relative.coordinates[..count]),
            combine_slopes(constants, k, &relative.coordinates[..count]),
        );
        let stressed_shape = combine_shapes(constants, k, &stressed[..count]);
        let stressed_slope = combine_slopes(constants, k, &stressed[..count]);
        let mut strain = strain(stressed_shape, stressed_slope) - constants.natural(k);
        if let Some(rates) = stressed_rates {
            let (rate, slope) = (
                combine_shapes(constants, k, &rates[..count]),
                combine_slopes(constants, k, &rates[..count]),
            );
            let rate = strain_rate((stressed_shape, stressed_slope), (rate, slope));
            strain = strain.plus_scaled(rate, constants.damping(k));
        }
        let stress = constants.stress(k, strain);
        let AtStation { along, across, turn, bend, by_slope, by_shape } = at_station(d, d_slope, stress);
        let law = constants.law(k);
        let mut strains = [by_slope; MAX_NODES];
        let mut stresses = [law; MAX_NODES];
        for i in 0..count {
            if i != reference {
                let (slope, shape) = (constants.slope(k, i), zero.rotation.x.like(constants.shape(k, i)));
                conjugate[i] = conjugate[i].plus_scaled(along, slope).plus_scaled(across, shape);
                strains[i] = by_slope.scaled_by(slope).plus_scaled(by_shape, shape);
                stresses[i] = times_from_right(strains[i], &law);
            }
        }
        if let Some(damping) = &mut damping {
            let rate = combine_shapes(constants, k, &relative.rates[..count]);
            let rate_slope = combine_slopes(constants, k, &relative.rates[..count]);
            let [by_slope, by_shape] = strain_change_rates((d, d_slope), (rate, rate_slope));
            let factor = constants.damping(k);
            for m in 0..count {
                if m != reference {
                    let mut viscous = stresses[m];
                    for row in 0..6 {
                        viscous[row] = viscous[row] * factor;
                    }
                    for i in 0..count {
                        if i != reference {
                            add_rows(&mut damping[i][m], &transpose_times_rows(strains[i], &viscous));
                        }
                    }
                    let slope = constants.slope(k, m) * factor;
                    let shape = factor.scaled(constants.shape(k, m));
                    let change = by_slope.scaled_by(slope).plus_scaled(by_shape, shape);
                    add_rows(&mut stresses[m], &times_from_right(change, &law));
                }
            }
        }
        for i in 0..count {
            for m in 0..count {
                if i != reference && m != reference {
                    add_rows(&mut stiffness[i][m], &transpose_times_rows(strains[i], &stresses[m]));
                    let (own, other) = (constants.shape(k, i), constants.shape(k, m));
                    turn.scaled_by(constants.slope(k, i).scaled(other))
                        .plus_scaled(turn.transposed(), constants.slope(k, m).scaled(own))
                        .plus_scaled(bend, zero.rotation.x.like(own * other))
                        .add_to(&mut stiffness[i][m]);
                }
            }
        }
    }
    conjugate
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

/// ε̇ = T ḋ' + (∂(T d')/∂d) ḋ.
#[inline(always)]
fn strain_rate<R: Real>(
    (d, d_slope): (Screw<R>, Screw<R>),
    (rate, rate_slope): (Screw<R>, Screw<R>),
) -> Screw<R> {
    d.rotation.x.apart(
        #[inline(always)]
        || {
            let operator = TangentOperator::new(d);
            operator.times(rate_slope) + operator.rate_times(rate, d_slope)
        },
    )
}

/// Rates of the derivatives of strains with respect to d' and to d.
#[inline(always)]
fn strain_change_rates<R: Real>(
    (d, d_slope): (Screw<R>, Screw<R>),
    (rate, rate_slope): (Screw<R>, Screw<R>),
) -> [DualMatrix<R>; 2] {
    d.rotation.x.apart(
        #[inline(always)]
        || {
            let curved = CurvedTangent::new(d);
            [curved.rate(rate), curved.derivative_rate((d_slope, rate_slope), rate)]
        },
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
fn times_from_right<R: Real>(matrix: DualMatrix<R>, rows: &Rows<R>) -> Rows<R> {
    rows[0].rotation.x.apart(
        #[inline(always)]
        || matrix.times_from_right(rows),
    )
}

/// `Mᵀ W` of a twist matrix M and rows W.
#[inline(always)]
fn transpose_times_rows<R: Real>(matrix: DualMatrix<R>, rows: &Rows<R>) -> Rows<R> {
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

/// From ∂g_i/∂d_k to ∂F_i/∂η_k.
#[inline(always)]
fn by_relative_variations<R: Real>(
    blocks: &mut Matrices<R>,
    relative: &Relative<R>,
    conjugate: Option<&[Screw<R>; MAX_NODES]>,
) {
    let (count, reference) = (relative.count, reference(relative.count));
    let inverse = &relative.inverse;
    for i in 0..count {
        for m in 0..count {
            if i != reference && m != reference {
                let mut change = transpose_times_rows(inverse[i].matrix(), &blocks[i][m]);
                if let Some(conjugate) = conjugate
                    && i == m
                {
                    inverse[i].transpose_derivative(conjugate[i]).add_to(&mut change);
                }
                blocks[i][m] = times_from_right(inverse[m].matrix(), &change);
            }
        }
    }
}

/// From ∂F_i/∂η_k of the relative nodes to all nodes: η_k = δh_k - A_k δh_r, F_r = - Σ A_iᵀ F_i and
/// δ(A_iᵀ) F_i = - A_iᵀ X(F_i) η_i, where the last term belongs to variations of positions.
#[inline(always)]
fn spread<R: Real>(
    blocks: &mut Matrices<R>,
    relative: &Relative<R>,
    conjugate: Option<&[Screw<R>; MAX_NODES]>,
) {
    let (count, reference) = (relative.count, reference(relative.count));
    for m in 0..count {
        for i in 0..count {
            if i != reference && m != reference {
                let mut change = blocks[i][m];
                if let Some(conjugate) = conjugate
                    && i == m
                {
                    let force = relative.inverse[i].transpose_times(conjugate[i]);
                    (-DualMatrix::coadjoint(force)).add_to(&mut change);
                }
                subtract_rows(
                    &mut blocks[reference][m],
                    &transpose_times_rows(relative.adjoints[i], &change),
                );
            }
        }
    }
    for i in 0..count {
        for m in 0..count {
            if m != reference {
                let seen = times_from_right(relative.adjoints[m], &blocks[i][m]);
                subtract_rows(&mut blocks[i][reference], &seen);
            }
        }
    }
}

/// From variations of the section frames to those of the nodes, relative to which the section frames are `offsets`.
#[inline(always)]
pub(super) fn through_offsets<R: Real>(blocks: &mut Matrices<R>, offsets: &[Pose<R>]) {
    for i in 0..offsets.len() {
        for m in 0..offsets.len() {
            let seen = times_from_right(offsets[m].adjoint_inverse(), &blocks[i][m]);
            blocks[i][m] = transpose_times_rows(offsets[i].adjoint_inverse(), &seen);
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
