//! Formulas in the base's axes: forces on the tip's point, and entries of the relative rotation, which are the cosines between an axis
//! of the base and one of the tip.
//!
//! ```text
//! δx = R η_u,      wrench of the force f in the base's axes: (Rᵀ f, 0)
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Triple};

use super::relative_increment::{Axes, RelativeIncrement};

/// Wrench on the tip of a force on its point, given in the base's axes.
#[inline(always)]
pub(crate) fn force_wrench<R: Real>(increment: &RelativeIncrement<R>, force: Triple<R>) -> Screw<R> {
    let zero = force.x.like(0.0);
    Screw::new(increment.rotation().transpose_times(force), Triple::new(zero, zero, zero))
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
