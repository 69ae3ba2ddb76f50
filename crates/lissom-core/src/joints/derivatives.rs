//! Derivatives of a joint's equations and forces by its local unknowns.
//!
//! ```text
//! (η, φ) = J δ,   B = (∂c/∂(η, φ)) J,   K = Jᵀ C J - [base] Jᵀ X(w) J,   Γ = Bᵀ W B
//! ```
//!
//! δ variations of the local unknowns, C curvature of the equations, X(w) how the base's wrench turns with η, [base]
//! the base's rows only. To the right of each product J and B go through the charts of the nodes, if asked for.

use lissom_motion::{Matrix3, Matrix6, Vector3, Vector6};

use super::{Curvature, Gradient, MOST_COORDINATES, MOST_EQUATIONS};

/// The tip's first local unknown. The base's six begin at 0; two places behind them stay empty, so that each side
/// fills vectors of eight.
pub const TIP: usize = 8;
/// The joint's own coordinates.
pub const OWN: usize = TIP + 6;
/// Places of local unknowns.
pub const LOCAL: usize = OWN + MOST_COORDINATES;
/// Local unknowns and equations, rounded up to a multiple of eight.
const HEIGHT: usize = 24;
/// Relative motion and own coordinates.
const INNER: usize = 6 + MOST_COORDINATES;

/// One number by local unknown.
type Row = [f64; LOCAL];

/// How the relative motion varies with one of the nodes: translation by translation and rotation by rotation alike,
/// translation by rotation. Rotation by translation is zero.
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

    /// The same by increments of the node instead of body variations.
    fn through(&self, chart: &IncrementTangent) -> Self {
        Self {
            turning: self.turning * chart.turning,
            shifting: self.turning * chart.shifting + self.shifting * chart.turning,
        }
    }

    fn write(&self, rows: &mut [Row; INNER], first: usize) {
        for i in 0..3 {
            for k in 0..3 {
                rows[i][first + k] = self.turning[(i, k)];
                rows[i][first + 3 + k] = self.shifting[(i, k)];
                rows[3 + i][first + 3 + k] = self.turning[(i, k)];
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

    /// Of no increment.
    pub fn none() -> Self {
        Self { turning: Matrix3::identity(), shifting: Matrix3::zeros() }
    }
}

/// Of a joint, what its derivatives are made of.
#[derive(Clone, Copy, Debug)]
pub struct Inner<'a> {
    /// Number of equations and of own coordinates.
    pub counts: (usize, usize),
    /// ∂c/∂(η, φ).
    pub gradient: &'a Gradient,
    /// C.
    pub curvature: &'a Curvature,
    /// w, on the tip's joint frame.
    pub wrench: &'a Vector6,
    /// Diagonal of W.
    pub weights: &'a [f64; MOST_EQUATIONS],
}

/// Derivatives of one joint after the other.
#[derive(Clone, Debug)]
pub struct Derivatives {
    equations: usize,
    coordinates: usize,
    /// J, and the same through the charts.
    variation: [Row; INNER],
    charted: [Row; INNER],
    /// B, and the same through the charts.
    gradient: [Row; MOST_EQUATIONS],
    charted_gradient: [Row; MOST_EQUATIONS],
    /// C J, and C J - X(w) J, through the charts.
    on_tip: [Row; INNER],
    on_base: [Row; INNER],
    weights: [f64; MOST_EQUATIONS],
    /// The local matrix, column by column; multipliers follow the local unknowns.
    columns: [[f64; HEIGHT]; LOCAL + MOST_EQUATIONS],
}

impl Default for Derivatives {
    fn default() -> Self {
        Self::new()
    }
}

impl Derivatives {
    /// Room.
    pub fn new() -> Self {
        let mut own = [[0.0; LOCAL]; INNER];
        for k in 0..MOST_COORDINATES {
            own[6 + k][OWN + k] = 1.0;
        }
        Self {
            equations: 0,
            coordinates: 0,
            variation: own,
            charted: own,
            gradient: [[0.0; LOCAL]; MOST_EQUATIONS],
            charted_gradient: [[0.0; LOCAL]; MOST_EQUATIONS],
            on_tip: [[0.0; LOCAL]; INNER],
            on_base: [[0.0; LOCAL]; INNER],
            weights: [0.0; MOST_EQUATIONS],
            columns: [[0.0; HEIGHT]; LOCAL + MOST_EQUATIONS],
        }
    }

    /// Of the joint with these sides, base and tip, through these charts.
    pub fn fill(&mut self, sides: &[Side; 2], charts: Option<[&IncrementTangent; 2]>, inner: &Inner<'_>) {
        (self.equations, self.coordinates) = inner.counts;
        self.weights = *inner.weights;
        for (side, first) in [0, TIP].into_iter().enumerate() {
            sides[side].write(&mut self.variation, first);
            let charted = charts.map_or(sides[side], |charts| sides[side].through(charts[side]));
            charted.write(&mut self.charted, first);
        }
        let inner_count = 6 + self.coordinates;
        for e in 0..self.equations {
            let (mut plain, mut charted) = ([0.0; LOCAL], [0.0; LOCAL]);
            for m in 0..inner_count {
                let factor =
                    if m < 6 { inner.gradient.relative[(e, m)] } else { inner.gradient.own[(e, m - 6)] };
                add(&mut plain, factor, &self.variation[m]);
                add(&mut charted, factor, &self.charted[m]);
            }
            (self.gradient[e], self.charted_gradient[e]) = (plain, charted);
        }
        for m in 0..inner_count {
            let mut row = [0.0; LOCAL];
            for n in 0..inner_count {
                let factor = inner.curvature[(m, n)];
                if factor != 0.0 {
                    add(&mut row, factor, &self.charted[n]);
                }
            }
            self.on_tip[m] = row;
        }
        self.turn_base(inner.wrench);
    }

    /// X(w) J = [[0, ñ], [ñ, m̃]] J.
    fn turn_base(&mut self, w: &Vector6) {
        let j = &self.charted;
        for i in 0..3 {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            let (mut force, mut moment) = (self.on_tip[i], self.on_tip[3 + i]);
            // Row i of ñ: -n_b in column a, n_a in column b.
            add(&mut force, w[b], &j[3 + a]);
            add(&mut force, -w[a], &j[3 + b]);
            add(&mut moment, w[b], &j[a]);
            add(&mut moment, -w[a], &j[b]);
            add(&mut moment, w[3 + b], &j[3 + a]);
            add(&mut moment, -w[3 + a], &j[3 + b]);
            (self.on_base[i], self.on_base[3 + i]) = (force, moment);
        }
    }

    /// Makes the local matrix with these factors of K, Γ and B.
    pub fn sum(&mut self, place: f64, augmented: f64, constraint: f64) {
        let (unknowns, equations) = (OWN + self.coordinates, self.equations);
        for j in (0..6).chain(TIP..unknowns) {
            let mut column = [0.0; LOCAL];
            for m in 0..6 {
                let (on_base, on_tip) = (place * self.on_base[m][j], place * self.on_tip[m][j]);
                for k in 0..TIP {
                    column[k] += on_base * self.variation[m][k];
                    column[TIP + k] += on_tip * self.variation[m][TIP + k];
                }
            }
            for k in 0..self.coordinates {
                column[OWN + k] = place * self.on_tip[6 + k][j];
            }
            for e in 0..equations {
                let factor = augmented * self.weights[e] * self.charted_gradient[e][j];
                add(&mut column, factor, &self.gradient[e]);
                self.columns[j][LOCAL + e] = constraint * self.charted_gradient[e][j];
            }
            self.columns[j][..LOCAL].copy_from_slice(&column);
        }
        for e in 0..equations {
            for k in 0..LOCAL {
                self.columns[LOCAL + e][k] = constraint * self.gradient[e][k];
            }
        }
    }

    /// A column of the local matrix.
    pub fn column(&self, column: usize) -> &[f64] {
        &self.columns[column]
    }

    /// A diagonal entry of K.
    pub fn stiffness(&self, unknown: usize) -> f64 {
        if unknown >= OWN {
            return if unknown < OWN + self.coordinates {
                self.on_tip[6 + unknown - OWN][unknown]
            } else {
                0.0
            };
        }
        let rows = if unknown < TIP { &self.on_base } else { &self.on_tip };
        (0..6).map(|m| rows[m][unknown] * self.variation[m][unknown]).sum()
    }

    /// B.
    pub fn gradient(&self) -> &[[f64; LOCAL]; MOST_EQUATIONS] {
        &self.gradient
    }
}

/// Adds `factor` times `row`.
fn add(sum: &mut Row, factor: f64, row: &Row) {
    for k in 0..LOCAL {
        sum[k] += factor * row[k];
    }
}
