//! Matching rotations, a formula that joints share: with the joint's rotation Q(φ) and the relative rotation R,
//!
//! ```text
//! E = QᵀR,   c = axial(E),   δE = E ρ̃,   ρ = η_θ - Eᵀ S δφ,   S = axis vectors of Qᵀ ∂Q/∂φ
//! ∂c/∂ρ = N = ½ (tr E I - Eᵀ),   m = Nᵀ μ = ½ (tr E μ - E μ)
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Matrix3, Real, Triple};

use super::MAX_COORDINATES;
use super::relative_increment::{Angle, Axes, RelativeIncrement};

/// A joint's own rotation Q(φ) and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointRotation<R> {
    /// Q(φ).
    pub rotation: Axes<R>,
    /// Change of Q since the start of the step, without cancellation.
    pub change: Axes<R>,
    /// Axis vectors of Qᵀ ∂Q/∂φ_k, one per coordinate.
    pub axes: [Triple<R>; MAX_COORDINATES],
    /// Number of coordinates.
    pub count: usize,
}

impl<R: Real> JointRotation<R> {
    /// No rotation of its own; `kind` only determines the type of number.
    #[inline(always)]
    pub(crate) fn none(kind: R) -> Self {
        let (zero, one) = (kind.like(0.0), kind.like(1.0));
        let nothing = Triple::new(zero, zero, zero);
        Self {
            rotation: Axes([
                Triple::new(one, zero, zero),
                Triple::new(zero, one, zero),
                Triple::new(zero, zero, one),
            ]),
            change: Axes([nothing; 3]),
            axes: [nothing; 2],
            count: 0,
        }
    }

    /// Rotation about the third axis.
    #[inline(always)]
    pub(crate) fn about_third_axis(angle: &Angle<R>) -> Self {
        let none = Self::none(angle.sine);
        let (rotation, change) = elementary_of(2, angle);
        Self { rotation, change, axes: [none.rotation.0[2], none.axes[1]], count: 1 }
    }

    /// Rotation about the first axis, then about the rotated second axis.
    #[inline(always)]
    pub(crate) fn about_first_and_second_axis([a, b]: &[Angle<R>; 2]) -> Self {
        let none = Self::none(a.sine);
        let [e_1, e_2, _] = none.rotation.0;
        let (first, first_change) = elementary_of(0, a);
        let (second, second_change) = elementary_of(1, b);
        let seen = second.transpose_times(e_1);
        Self {
            rotation: first.product(second),
            // P Q - P₀ Q₀ = ΔP Q + P₀ ΔQ
            change: first_change.product(second).plus(first.minus(first_change).product(second_change)),
            axes: [seen, e_2],
            count: 2,
        }
    }

    /// Change of c = axial(QᵀR), that the relative rotation is Q: QᵀR - Q₀ᵀR₀ = ΔQᵀ R₀ + Qᵀ ΔR.
    #[inline(always)]
    pub(crate) fn matches_change(&self, increment: &RelativeIncrement<R>) -> [R; 3] {
        let change = self
            .change
            .transpose_product(increment.start_rotation)
            .plus(self.rotation.transpose_product(increment.rotation_change));
        let Triple { x, y, z } = change.axial();
        [x, y, z]
    }

    /// (∂c/∂(η, φ))ᵀ μ of the rotation: the moment m, and -Sᵀ E m on the coordinates.
    #[inline(always)]
    pub(crate) fn matches_moments(
        &self,
        increment: &RelativeIncrement<R>,
        mu: Triple<R>,
    ) -> (Triple<R>, [R; MAX_COORDINATES]) {
        let e = self.rotation.transpose_product(increment.rotation());
        let m = (mu * e.trace() - e.times(mu)).scaled(0.5);
        let turned = e.times(m);
        let mut own = [mu.x.like(0.0); MAX_COORDINATES];
        for k in 0..self.count {
            own[k] = -self.axes[k].dot(turned);
        }
        (m, own)
    }
}

/// Rotation by `angle` about coordinate axis `axis`.
pub fn elementary(axis: usize, angle: f64) -> Matrix3 {
    let (s, c) = angle.sin_cos();
    elementary_with(axis, s, c, 1.0).into()
}

/// Rotation about coordinate axis `axis`, and its change since the start of the step.
#[inline(always)]
pub(crate) fn elementary_of<R: Real>(axis: usize, angle: &Angle<R>) -> (Axes<R>, Axes<R>) {
    let (zero, one) = (angle.sine.like(0.0), angle.sine.like(1.0));
    (
        elementary_with(axis, angle.sine, angle.cosine, one),
        elementary_with(axis, angle.sine_change, angle.cosine_change, zero),
    )
}

#[inline(always)]
fn elementary_with<R: Real>(axis: usize, sine: R, cosine: R, one: R) -> Axes<R> {
    let zero = sine.like(0.0);
    match axis {
        0 => Axes([
            Triple::new(one, zero, zero),
            Triple::new(zero, cosine, sine),
            Triple::new(zero, -sine, cosine),
        ]),
        1 => Axes([
            Triple::new(cosine, zero, -sine),
            Triple::new(zero, one, zero),
            Triple::new(sine, zero, cosine),
        ]),
        _ => Axes([
            Triple::new(cosine, sine, zero),
            Triple::new(-sine, cosine, zero),
            Triple::new(zero, zero, one),
        ]),
    }
}
