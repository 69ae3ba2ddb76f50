//! Formulas in the base's axes: components of the relative position, and entries of the relative rotation, which are
//! the cosines between an axis of the base and one of the tip.
//!
//! ```text
//! x:      δx = R η_u,                    wrench of the force f in the base's axes: (Rᵀ f, 0)
//! R_ab:   δR_ab = (e_b × Rᵀ e_a)·η_θ,    Hessian of q R_ab: q ẽ_b (Rᵀ e_a)~
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Triple, Vector3, skew};

use super::relative_increment::{Axes, RelativeIncrement};
use super::{ConstraintHessian, Gradient, Relative};

/// Gradient of the position's component along an axis of the base.
pub(crate) fn component_gradient(relative: &Relative, axis: usize, row: usize, out: &mut Gradient) {
    for j in 0..3 {
        out.relative[(row, j)] = relative.rotation[(axis, j)];
    }
}

/// Wrench on the tip of a force on its point, given in the base's axes.
#[inline(always)]
pub(crate) fn force_wrench<R: Real>(increment: &RelativeIncrement<R>, force: Triple<R>) -> Screw<R> {
    let zero = force.x.like(0.0);
    Screw::new(increment.rotation().transpose_times(force), Triple::new(zero, zero, zero))
}

/// Hessian of [`force_wrench`]: δ(Rᵀ f) = (Rᵀ f)~ η_θ.
pub(crate) fn force_hessian(relative: &Relative, force: &Vector3, out: &mut ConstraintHessian) {
    let turning = skew(&relative.rotation.tr_mul(force));
    let mut view = out.fixed_view_mut::<3, 3>(0, 3);
    view += turning;
}

/// Gradient of `sign` R_ab.
pub(crate) fn cosine_gradient(
    relative: &Relative,
    (a, b): (usize, usize),
    sign: f64,
    row: usize,
    out: &mut Gradient,
) {
    let moment = sign * Vector3::ith(b, 1.0).cross(&relative.rotation.row(a).transpose());
    for j in 0..3 {
        out.relative[(row, 3 + j)] = moment[j];
    }
}

/// Hessian of `factor` R_ab.
pub(crate) fn cosine_hessian(
    relative: &Relative,
    (a, b): (usize, usize),
    factor: f64,
    out: &mut ConstraintHessian,
) {
    let turned = skew(&relative.rotation.row(a).transpose());
    let mut view = out.fixed_view_mut::<3, 3>(3, 3);
    view += factor * skew(&Vector3::ith(b, 1.0)) * turned;
}

/// Row `a` of a matrix.
#[inline(always)]
pub(crate) fn row<R: Real>(axes: &Axes<R>, a: usize) -> Triple<R> {
    let [x, y, z] = axes.0;
    match a {
        0 => Triple::new(x.x, y.x, z.x),
        1 => Triple::new(x.y, y.y, z.y),
        _ => Triple::new(x.z, y.z, z.z),
    }
}
