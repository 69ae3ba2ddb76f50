//! Formulas that joints share: coincident points and matching rotations.
//!
//! Rotations: with the joint's rotation Q(φ) and the relative rotation R,
//!
//! ```text
//! E = QᵀR,   c = axial(E),   δE = E ρ̃,   ρ = η_θ - Eᵀ S δφ,   S = axis vectors of Qᵀ ∂Q/∂φ
//! ∂c/∂ρ = N = ½ (tr E I - Eᵀ),   m = Nᵀ μ = ½ (tr E μ - E μ),   ∂m/∂ρ = ½ E μ̃ - μ axial(E)ᵀ
//! ```

use lissom_motion::{Matrix3, Vector3, Vector6, axial, screw, skew};
use nalgebra::SVector;

use super::{Curvature, Equations, Gradient, MOST_COORDINATES, Own, Relative};

/// Names of three equations that hold two points together.
pub const POINT_EQUATIONS: [&str; 3] = ["position 1", "position 2", "position 3"];

/// Rows `row..row + 3`: the tip's point lies at the base's point, c = Rᵀ x in the tip's axes. There the
/// gradient of a tip that turns about a point of the ground stays constant.
pub fn coincident(relative: &Relative, row: usize, out: &mut Equations) {
    out[row..row + 3].copy_from_slice(relative.rotation.tr_mul(&relative.position).as_slice());
}

/// Change of [`coincident`] since the start of the step: Rᵀx - R₀ᵀx₀ = ΔRᵀ x₀ + Rᵀ Δx.
pub fn coincident_change(relative: &Relative, row: usize, out: &mut Equations) {
    let start = relative.position - relative.position_change;
    let change =
        relative.rotation_change.tr_mul(&start) + relative.rotation.tr_mul(&relative.position_change);
    out[row..row + 3].copy_from_slice(change.as_slice());
}

/// Gradient of [`coincident`]: δ(Rᵀ x) = η_u + (Rᵀ x)~ η_θ.
pub fn coincident_gradient(relative: &Relative, row: usize, out: &mut Gradient) {
    let turning = skew(&relative.rotation.tr_mul(&relative.position));
    for i in 0..3 {
        out.relative[(row + i, i)] = 1.0;
        for j in 0..3 {
            out.relative[(row + i, 3 + j)] = turning[(i, j)];
        }
    }
}

/// (∂c/∂η)ᵀ μ of [`coincident`]: the force μ at the base's point, which lies at -Rᵀ x from the tip's.
pub fn coincident_wrench(relative: &Relative, mu: &Vector3) -> Vector6 {
    screw(mu, &mu.cross(&relative.rotation.tr_mul(&relative.position)))
}

/// Curvature of [`coincident`]: the moment -(Rᵀ x)~ μ = μ̃ Rᵀ x.
pub fn coincident_curvature(relative: &Relative, mu: &Vector3, out: &mut Curvature) {
    let mu = skew(mu);
    let turning = mu * skew(&relative.rotation.tr_mul(&relative.position));
    let mut view = out.fixed_view_mut::<3, 3>(3, 0);
    view += mu;
    let mut view = out.fixed_view_mut::<3, 3>(3, 3);
    view += turning;
}

/// Rows `row..row + 3`: the tip's point lies on the base's third axis at the displacement d, c = Rᵀ x - d e₃. Like
/// [`coincident`] but for a constant gradient by d, so that gradient and curvature by the relative motion are the same.
/// The axes of base and tip agree, by other rows.
pub fn on_third_axis(relative: &Relative, displacement: f64, row: usize, out: &mut Equations) {
    coincident(relative, row, out);
    out[row + 2] -= displacement;
}

/// Change of [`on_third_axis`] since the start of the step, d having changed by `change`.
pub fn on_third_axis_change(relative: &Relative, change: f64, row: usize, out: &mut Equations) {
    coincident_change(relative, row, out);
    out[row + 2] -= change;
}

/// The wrench of a joint that holds a point, with the moments of what holds its axes.
pub fn wrench_with_moments(
    force: &Vector6,
    (moment, own): (Vector3, SVector<f64, MOST_COORDINATES>),
) -> (Vector6, SVector<f64, MOST_COORDINATES>) {
    (force + screw(&Vector3::zeros(), &moment), own)
}

/// A joint's own rotation Q(φ) and its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct JointRotation {
    /// Q(φ).
    pub rotation: Matrix3,
    /// Change of Q since the start of the step, free of cancellation.
    pub change: Matrix3,
    /// Axis vectors of Qᵀ ∂Q/∂φ_k, one per coordinate.
    pub axes: [Vector3; MOST_COORDINATES],
    /// ∂axes[k]/∂φ_j, at `[k][j]`.
    pub axes_by: [[Vector3; MOST_COORDINATES]; MOST_COORDINATES],
    /// Number of coordinates.
    pub count: usize,
}

impl JointRotation {
    /// No rotation of its own.
    pub fn none() -> Self {
        Self {
            rotation: Matrix3::identity(),
            change: Matrix3::zeros(),
            axes: [Vector3::zeros(); 2],
            axes_by: [[Vector3::zeros(); 2]; 2],
            count: 0,
        }
    }

    /// Rotation about the third axis.
    pub fn about_third_axis(own: &Own) -> Self {
        Self {
            rotation: elementary(2, own.value[0]),
            change: elementary_change(2, own.value[0], own.change[0]),
            axes: [Vector3::z(), Vector3::zeros()],
            count: 1,
            ..Self::none()
        }
    }

    /// Rotation about the first axis, then about the turned second axis.
    pub fn about_first_and_second_axis(own: &Own) -> Self {
        let [a, b] = own.value;
        let [da, db] = own.change;
        let (first, second) = (elementary(0, a), elementary(1, b));
        let first_change = elementary_change(0, a, da);
        let second_change = elementary_change(1, b, db);
        let seen = second.tr_mul(&Vector3::x());
        Self {
            rotation: first * second,
            // P Q - P₀ Q₀ = ΔP Q + P₀ ΔQ
            change: first_change * second + (first - first_change) * second_change,
            axes: [seen, Vector3::y()],
            // ∂/∂b (Qᵀ e₁) = - e₂ × (Qᵀ e₁)
            axes_by: [[Vector3::zeros(), -Vector3::y().cross(&seen)], [Vector3::zeros(); 2]],
            count: 2,
        }
    }

    fn error(&self, relative: &Relative) -> Matrix3 {
        self.rotation.tr_mul(&relative.rotation)
    }

    /// Rows `row..row + 3`: the relative rotation is Q.
    pub fn matches(&self, relative: &Relative, row: usize, out: &mut Equations) {
        out[row..row + 3].copy_from_slice(axial(&self.error(relative)).as_slice());
    }

    /// Change of [`Self::matches`]: QᵀR - Q₀ᵀR₀ = ΔQᵀ R₀ + Qᵀ ΔR.
    pub fn matches_change(&self, relative: &Relative, row: usize, out: &mut Equations) {
        let change =
            self.change.tr_mul(&relative.start_rotation()) + self.rotation.tr_mul(&relative.rotation_change);
        out[row..row + 3].copy_from_slice(axial(&change).as_slice());
    }

    /// Gradient of [`Self::matches`].
    pub fn matches_gradient(&self, relative: &Relative, row: usize, out: &mut Gradient) {
        let e = self.error(relative);
        let n = 0.5 * (Matrix3::identity() * e.trace() - e.transpose());
        out.relative.fixed_view_mut::<3, 3>(row, 3).copy_from(&n);
        for k in 0..self.count {
            let column = -n * e.tr_mul(&self.axes[k]);
            out.own.fixed_view_mut::<3, 1>(row, k).copy_from(&column);
        }
    }

    /// (∂c/∂(η, φ))ᵀ μ of [`Self::matches`]: the moment m, and -Sᵀ E m on the coordinates.
    pub fn matches_moments(
        &self,
        relative: &Relative,
        mu: &Vector3,
    ) -> (Vector3, SVector<f64, MOST_COORDINATES>) {
        let e = self.error(relative);
        let m = 0.5 * (e.trace() * mu - e * mu);
        let turned = e * m;
        (m, SVector::from_fn(|k, _| if k < self.count { -self.axes[k].dot(&turned) } else { 0.0 }))
    }

    /// Curvature of [`Self::matches`].
    pub fn matches_curvature(&self, relative: &Relative, mu: &Vector3, out: &mut Curvature) {
        let e = self.error(relative);
        let m = 0.5 * (e.trace() * mu - e * mu);
        let dm = 0.5 * e * skew(mu) - mu * axial(&e).transpose();
        let mut view = out.fixed_view_mut::<3, 3>(3, 3);
        view += dm;
        for k in 0..self.count {
            let axis = e.tr_mul(&self.axes[k]);
            // The moment -Sᵀ E m on φ_k changes with ρ as Sᵀ E (m̃ - ∂m/∂ρ).
            let by_rho = axis.transpose() * (skew(&m) - dm);
            let column = dm * axis;
            for i in 0..3 {
                out[(3 + i, 6 + k)] -= column[i];
                out[(6 + k, 3 + i)] += by_rho[i];
            }
            for j in 0..self.count {
                out[(6 + k, 6 + j)] -= by_rho.dot(&e.tr_mul(&self.axes[j]).transpose());
                out[(6 + k, 6 + j)] -= self.axes_by[k][j].dot(&(e * m));
            }
        }
    }
}

/// Rotation by `angle` about coordinate axis `axis`.
pub fn elementary(axis: usize, angle: f64) -> Matrix3 {
    let (s, c) = angle.sin_cos();
    fill_elementary(axis, s, c, 1.0)
}

/// `elementary(axis, angle) - elementary(axis, angle - change)` without cancellation.
pub fn elementary_change(axis: usize, angle: f64, change: f64) -> Matrix3 {
    let half = (0.5 * change).sin();
    let (s, c) = (angle - 0.5 * change).sin_cos();
    fill_elementary(axis, 2.0 * c * half, -2.0 * s * half, 0.0)
}

fn fill_elementary(axis: usize, sine: f64, cosine: f64, one: f64) -> Matrix3 {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = Matrix3::zeros();
    matrix[(axis, axis)] = one;
    matrix[(j, j)] = cosine;
    matrix[(k, k)] = cosine;
    matrix[(k, j)] = sine;
    matrix[(j, k)] = -sine;
    matrix
}
