//! Derivatives of a joint's equations and forces with respect to its local unknowns.
//!
//! ```text
//! (η, φ) = J δ,   B = (∂c/∂(η, φ)) J,   K = Jᵀ C J - [base] Jᵀ X(w) J,   Γ = Bᵀ W B
//! ```
//!
//! δ variations of the local unknowns, C Hessian of the equations, X(w) the derivative of the base's wrench with
//! respect to η, [base] the base's rows only. To the right of each product J and B are transformed by the charts of
//! the nodes, if requested. Rows are as wide as two blocks of eight, one for each side, and so products are of a
//! number and a vector register.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Block, Lanes, Matrix3, Matrix6, Real, Vector3, Vector6, WIDTH};
use pulp::{Simd, WithSimd};

use super::{ConstraintHessian, Gradient, MAX_COORDINATES, MAX_EQUATIONS};
use crate::kinematics::{NodeId, indexed_by};

indexed_by!(NodeId: IncrementTangent;);

/// The tip's first local unknown. The base's six begin at 0; the two positions after them are empty, so that each
/// side fills vectors of eight.
pub const TIP: usize = 8;
/// The joint's own coordinates.
pub const OWN: usize = TIP + 6;
/// Positions of local unknowns.
pub const LOCAL: usize = OWN + MAX_COORDINATES;
/// Blocks of local unknowns, one for each side; a further one is for the equations.
const SIDES: usize = 2;
/// Relative motion and own coordinates.
const INNER: usize = 6 + MAX_COORDINATES;

/// One value per local unknown.
type Row = [Block; SIDES];

const ZEROS: Row = [[0.0; WIDTH]; SIDES];

/// Derivative of the relative motion with respect to one of the nodes: translation by translation and rotation by
/// rotation are equal, then translation by rotation. Rotation by translation is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// ∂η_u/∂u = ∂η_θ/∂θ.
    pub turning: Matrix3,
    /// ∂η_u/∂θ.
    pub shifting: Matrix3,
}

impl Side {
    /// ± Ad(H⁻¹) of a frame H at `place` of its node, its axes the columns of `axes`: [[Rᵀ, -Rᵀ x̃], [0, Rᵀ]].
    pub fn adjoint_inverse(sign: f64, axes: &Matrix3, place: &Vector3) -> Self {
        let turning = sign * axes.transpose();
        let mut shifting = Matrix3::zeros();
        for i in 0..3 {
            // A row rᵀ times x̃ is (r × x)ᵀ.
            let row = turning.row(i).transpose().cross(place);
            shifting.set_row(i, &(-row.transpose()));
        }
        Self { turning, shifting }
    }

    /// This side with respect to increments of the node instead of body variations.
    fn through(&self, chart: &IncrementTangent) -> Self {
        Self {
            turning: self.turning * chart.turning,
            shifting: self.turning * chart.shifting + self.shifting * chart.turning,
        }
    }

    fn write(&self, rows: &mut [Row; INNER], side: usize) {
        for i in 0..3 {
            for k in 0..3 {
                rows[i][side][k] = self.turning[(i, k)];
                rows[i][side][3 + k] = self.shifting[(i, k)];
                rows[3 + i][side][3 + k] = self.turning[(i, k)];
            }
        }
    }
}

/// The tangent operator T(ψ) = [[T, T'], [0, T]] of a node's increment: δh = T(ψ) δψ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncrementTangent {
    /// T.
    pub turning: Matrix3,
    /// T'.
    pub shifting: Matrix3,
}

impl IncrementTangent {
    /// At the increment `psi`.
    pub fn new(psi: &Vector6) -> Self {
        let matrix: Matrix6 = lissom_motion::tangent(psi);
        Self {
            turning: matrix.fixed_view::<3, 3>(0, 0).into_owned(),
            shifting: matrix.fixed_view::<3, 3>(0, 3).into_owned(),
        }
    }

    /// At the increment `psi` of a frame whose position and rotation change separately, both in the axes of the end:
    /// δx = R (δψ_x - ψ_x × T δψ_θ). Translations are taken to vary by T δψ_x, which differs by half of the rotation in a step.
    pub fn inertial(psi: &Vector6) -> Self {
        let turning = lissom_motion::rotation_tangent(&lissom_motion::rotation_part(psi));
        Self { turning, shifting: -lissom_motion::skew(&lissom_motion::translation_part(psi)) * turning }
    }

    /// Transforms derivatives with respect to a body variation of the node to those with respect to its increment: a
    /// row of six times T(ψ).
    pub fn through(&self, row: &mut [f64]) {
        let mut turned = [0.0; 6];
        for j in 0..3 {
            for i in 0..3 {
                turned[j] += row[i] * self.turning[(i, j)];
                turned[3 + j] += row[i] * self.shifting[(i, j)] + row[3 + i] * self.turning[(i, j)];
            }
        }
        row.copy_from_slice(&turned);
    }

    /// For a zero increment.
    pub fn none() -> Self {
        Self { turning: Matrix3::identity(), shifting: Matrix3::zeros() }
    }
}

/// The terms of a joint's derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Inner<'a> {
    /// Number of equations and of own coordinates.
    pub counts: (usize, usize),
    /// ∂c/∂(η, φ).
    pub gradient: &'a Gradient,
    /// C.
    pub hessian: &'a ConstraintHessian,
    /// w, on the tip's joint frame.
    pub wrench: &'a Vector6,
    /// Diagonal of W.
    pub weights: &'a [f64; MAX_EQUATIONS],
}

/// Storage for the derivatives of one joint at a time.
#[derive(Clone, Debug)]
pub struct Derivatives {
    equations: usize,
    coordinates: usize,
    /// J, and J transformed by the charts.
    variation: [Row; INNER],
    charted: [Row; INNER],
    /// B, and B transformed by the charts.
    gradient: [Row; MAX_EQUATIONS],
    charted_gradient: [Row; MAX_EQUATIONS],
    /// C J, and C J - X(w) J, transformed by the charts.
    on_tip: [Row; INNER],
    on_base: [Row; INNER],
    weights: [f64; MAX_EQUATIONS],
    /// The local matrix, column by column; multipliers follow the local unknowns.
    columns: [[Block; SIDES + 1]; LOCAL + MAX_EQUATIONS],
    processor: pulp::Arch,
}

impl Default for Derivatives {
    fn default() -> Self {
        Self::new()
    }
}

impl Derivatives {
    /// Allocates the storage.
    pub fn new() -> Self {
        let mut own = [ZEROS; INNER];
        for k in 0..MAX_COORDINATES {
            own[6 + k][1][OWN - TIP + k] = 1.0;
        }
        Self {
            equations: 0,
            coordinates: 0,
            variation: own,
            charted: own,
            gradient: [ZEROS; MAX_EQUATIONS],
            charted_gradient: [ZEROS; MAX_EQUATIONS],
            on_tip: [ZEROS; INNER],
            on_base: [ZEROS; INNER],
            weights: [0.0; MAX_EQUATIONS],
            columns: [[[0.0; WIDTH]; SIDES + 1]; LOCAL + MAX_EQUATIONS],
            processor: pulp::Arch::new(),
        }
    }

    /// Computes the derivatives of the joint with these sides, base and tip, transformed by these charts.
    pub fn fill(&mut self, sides: &[Side; 2], charts: Option<[&IncrementTangent; 2]>, inner: &Inner<'_>) {
        (self.equations, self.coordinates) = inner.counts;
        self.weights = *inner.weights;
        for side in 0..SIDES {
            sides[side].write(&mut self.variation, side);
            let charted = charts.map_or(sides[side], |charts| sides[side].through(charts[side]));
            charted.write(&mut self.charted, side);
        }
        self.processor.dispatch(Fill { inner, out: self });
    }

    /// Computes the local matrix with these factors of K, Γ and B.
    pub fn sum(&mut self, place: f64, augmented: f64, constraint: f64) {
        self.processor.dispatch(Summation { place, augmented, constraint, out: self });
    }

    /// A column of the local matrix.
    pub fn column(&self, column: usize) -> &[f64] {
        self.columns[column].as_flattened()
    }

    /// A diagonal entry of K.
    pub fn stiffness(&self, unknown: usize) -> f64 {
        let (side, place) = (unknown / TIP, unknown % TIP);
        if unknown >= OWN + self.coordinates {
            return 0.0;
        }
        let (rows, count) = if side == 0 { (&self.on_base, 6) } else { (&self.on_tip, INNER) };
        (0..count).map(|m| rows[m][side][place] * self.variation[m][side][place]).sum()
    }
}

struct Fill<'a> {
    inner: &'a Inner<'a>,
    out: &'a mut Derivatives,
}

impl WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for side in 0..SIDES {
            for part in 0..Lanes::<S>::PARTS {
                self.columns(simd, side, part);
            }
        }
    }
}

impl Fill<'_> {
    /// As many columns of one side as a vector register contains.
    #[inline(always)]
    fn columns<S: Simd>(&mut self, simd: S, side: usize, part: usize) {
        let Self { inner, out } = self;
        let own = if side == 0 { 0 } else { out.coordinates };
        let plain = load(simd, &out.variation, side, part);
        let charted = load(simd, &out.charted, side, part);
        let zero = Lanes::splat(simd, 0.0);
        for e in 0..out.equations {
            let (mut row, mut through) = (zero, zero);
            for m in 0..6 {
                let factor = Lanes::splat(simd, inner.gradient.relative[(e, m)]);
                row = row.plus_product(factor, plain[m]);
                through = through.plus_product(factor, charted[m]);
            }
            for k in 0..own {
                let factor = Lanes::splat(simd, inner.gradient.own[(e, k)]);
                row = row.plus_product(factor, plain[6 + k]);
                through = through.plus_product(factor, charted[6 + k]);
            }
            row.store(&mut out.gradient[e][side], part);
            through.store(&mut out.charted_gradient[e][side], part);
        }
        let mut bent = [zero; INNER];
        for m in 0..6 + out.coordinates {
            for n in 0..6 + own {
                let factor = inner.hessian[(m, n)];
                if factor != 0.0 {
                    bent[m] = bent[m].plus_product(Lanes::splat(simd, factor), charted[n]);
                }
            }
            bent[m].store(&mut out.on_tip[m][side], part);
        }
        // X(w) J = [[0, ñ], [ñ, m̃]] J is subtracted. Row i of ñ: -n_b in column a, n_a in column b.
        let mut w = [zero; 6];
        for m in 0..6 {
            w[m] = Lanes::splat(simd, inner.wrench[m]);
        }
        for i in 0..3 {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            let force = bent[i].plus_product(w[b], charted[3 + a]).minus_product(w[a], charted[3 + b]);
            let moment = bent[3 + i]
                .plus_product(w[b], charted[a])
                .minus_product(w[a], charted[b])
                .plus_product(w[3 + b], charted[3 + a])
                .minus_product(w[3 + a], charted[3 + b]);
            force.store(&mut out.on_base[i][side], part);
            moment.store(&mut out.on_base[3 + i][side], part);
        }
    }
}

struct Summation<'a> {
    place: f64,
    augmented: f64,
    constraint: f64,
    out: &'a mut Derivatives,
}

impl WithSimd for Summation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for side in 0..SIDES {
            for part in 0..Lanes::<S>::PARTS {
                self.rows(simd, side, part);
            }
        }
        let Derivatives { equations, coordinates, charted_gradient, columns, .. } = self.out;
        for j in (0..6).chain(TIP..OWN + *coordinates) {
            for e in 0..*equations {
                columns[j][SIDES][e] = self.constraint * charted_gradient[e][j / WIDTH][j % WIDTH];
            }
        }
    }
}

impl Summation<'_> {
    /// As many rows of one side as a vector register contains, in all columns.
    #[inline(always)]
    fn rows<S: Simd>(&mut self, simd: S, side: usize, part: usize) {
        let (coordinates, equations) = (self.out.coordinates, self.out.equations);
        let has_place = self.place != 0.0;
        let augmented = if self.augmented == 0.0 { 0 } else { equations };
        let Derivatives { variation, gradient, charted_gradient, weights, columns, on_base, on_tip, .. } =
            &mut *self.out;
        let (bent, own) = if side == 0 { (on_base, 0) } else { (on_tip, coordinates) };
        let mut variation = load(simd, variation, side, part);
        for m in 0..INNER {
            variation[m] = variation[m].scaled(self.place);
        }
        let plain = load(simd, gradient, side, part);
        let mut weighted = plain;
        for e in 0..MAX_EQUATIONS {
            weighted[e] = plain[e].scaled(self.augmented * weights[e]);
        }
        for column in 0..OWN + coordinates {
            let (half, place) = (column / WIDTH, column % WIDTH);
            if half == 0 && place >= 6 {
                continue;
            }
            let mut sum = Lanes::splat(simd, 0.0);
            // Records and initial values have no K, and each term of separate derivatives is alone.
            if has_place {
                for m in 0..6 {
                    sum = sum.plus_product(variation[m], Lanes::splat(simd, bent[m][half][place]));
                }
                for k in 0..own {
                    sum = sum.plus_product(variation[6 + k], Lanes::splat(simd, bent[6 + k][half][place]));
                }
            }
            for e in 0..augmented {
                sum = sum.plus_product(weighted[e], Lanes::splat(simd, charted_gradient[e][half][place]));
            }
            sum.store(&mut columns[column][side], part);
        }
        for e in 0..equations {
            plain[e].scaled(self.constraint).store(&mut columns[LOCAL + e][side], part);
        }
    }
}

/// A part of one side of several rows.
#[inline(always)]
fn load<S: Simd, const COUNT: usize>(
    simd: S,
    rows: &[Row; COUNT],
    side: usize,
    part: usize,
) -> [Lanes<S>; COUNT] {
    let mut loaded = [Lanes::splat(simd, 0.0); COUNT];
    for m in 0..COUNT {
        loaded[m] = Lanes::load(simd, &rows[m][side], part);
    }
    loaded
}
