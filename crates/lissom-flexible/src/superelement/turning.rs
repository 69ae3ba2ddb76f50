//! Dependence of the angular momentum of a part about its floating frame on its deformation.
//!
//! Legend: y displacements in the floating frame (see `second_order`), ω its angular velocity. The momentum is the sum of two
//! terms: that of points that are displaced along straight lines, with sections that do not rotate, and that of the rotation of
//! sections. The first has p = ω and d = ẏ; the second is evaluated with the mean rotation p = ω + P ẏ and the rates without it,
//! d = Q ẏ = ẏ - R P ẏ. R are the three rigid rotations and P the projection onto them in the metric of the mass.
//!
//! ```text
//! T = ½ p·J p + p·c d        J_ij = J₀ + α_ij·y + ½ y·A_ij y       c_i = c₀ + B_iᵀ y
//! l = J p + c d              l̇ = J ṗ + J̇ p + ċ d + c ḋ
//! moment on f                l̇ + ω × l
//! dual to y                  Pᵀ l̇ + Qᵀ (c·p)˙ - ½ Σ p_i p_j (α_ij + A_ij y) - Σ p_i B_i d
//! ```
//!
//! The rotation of sections changes the inertia of a slender part about its own axis, which is small, by as much as its own
//! value. A part that remains at rest while its floating frame rotates has ẏ = -ω × (X + Ψ y) and no energy: the mean rotation is
//! zero in this motion, and so is the sections' contribution.

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::{DMatrix, DVector, Matrix3xX, MatrixXx3};

use super::geometric::{PAIRS, TurningMatrices};

/// Fraction of the largest inertia that is added to all: a straight line of points has none about its own axis.
const NO_INERTIA: f64 = 1e-12;

/// The mean rotation of a deformation.
#[derive(Clone, Debug)]
pub(super) struct MeanRotation {
    /// P.
    projection: Matrix3xX<f64>,
    /// R.
    turns: MatrixXx3<f64>,
}

impl MeanRotation {
    /// The nearest rigid rotation in the metric of `mass`; `rigid` contains three translations and three rotations. None without
    /// mass.
    pub(super) fn of(mass: &DMatrix<f64>, rigid: &[DVector<f64>; 6]) -> Option<Self> {
        let columns = DMatrix::from_columns(rigid);
        let momenta = mass * &columns;
        let mut whole = columns.tr_mul(&momenta);
        let largest = (3..6).map(|k| whole[(k, k)]).fold(0.0, f64::max);
        for k in 3..6 {
            whole[(k, k)] += NO_INERTIA * largest;
        }
        let whole = whole.cholesky()?;
        let projection = whole.solve(&momenta.transpose()).fixed_rows::<3>(3).into_owned();
        Some(Self { projection, turns: columns.fixed_columns::<3>(3).into_owned() })
    }

    fn rotation(&self, rate: &DVector<f64>) -> Vector3 {
        &self.projection * rate
    }

    /// X Q of three rows X.
    fn rows_without(&self, rows: &Matrix3xX<f64>) -> Matrix3xX<f64> {
        rows - (rows * &self.turns) * &self.projection
    }

    /// X Q.
    fn without(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        matrix - (matrix * &self.turns) * &self.projection
    }

    /// Qᵀ X.
    fn transposed_without(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        matrix - self.projection.tr_mul(&self.turns.tr_mul(matrix))
    }
}

/// The coefficients.
#[derive(Clone, Debug)]
pub(super) struct TurningLaw {
    /// J₀, and of each pair α and A.
    at_rest: Matrix3,
    slope: [DVector<f64>; 6],
    inertia: [DMatrix<f64>; 6],
    /// c₀ and B.
    momentum_at_rest: [DVector<f64>; 3],
    momentum: [DMatrix<f64>; 3],
    mean: Option<MeanRotation>,
}

impl TurningLaw {
    /// For points, with the rigid rotations `turns` and their momenta.
    pub(super) fn of_points(
        matrices: &TurningMatrices,
        turns: [&DVector<f64>; 3],
        momenta: [DVector<f64>; 3],
    ) -> Self {
        let at_rest = Matrix3::from_fn(|i, j| turns[i].dot(&momenta[j]));
        Self { at_rest, momentum_at_rest: momenta, ..Self::of_sections(matrices, None) }
    }

    /// For the contribution of sections.
    pub(super) fn of_sections(matrices: &TurningMatrices, mean: Option<MeanRotation>) -> Self {
        Self {
            at_rest: Matrix3::zeros(),
            slope: [0, 1, 2, 3, 4, 5].map(|k| matrices.slope.row(k).transpose()),
            inertia: matrices.inertia.clone(),
            momentum_at_rest: [0, 1, 2].map(|_| DVector::zeros(matrices.slope.ncols())),
            momentum: matrices.momentum.clone(),
            mean,
        }
    }
}

/// The motion of the part: y, ẏ, ÿ, ω and ω̇.
#[derive(Clone, Copy)]
pub(super) struct PartMotion<'a> {
    pub(super) displacement: &'a DVector<f64>,
    pub(super) rate: &'a DVector<f64>,
    pub(super) second: &'a DVector<f64>,
    pub(super) spin: Vector3,
    pub(super) spin_rate: Vector3,
}

/// The pair of i and j.
fn pair(i: usize, j: usize) -> usize {
    PAIRS.iter().position(|own| *own == [i.min(j), i.max(j)]).unwrap_or_default()
}

/// Momentum and forces at one instant.
#[derive(Default)]
pub(super) struct Turning {
    /// ω.
    spin: Vector3,
    /// p, ṗ.
    rotation: Vector3,
    rotation_rate: Vector3,
    /// d, ḋ.
    deforming: DVector<f64>,
    deforming_rate: DVector<f64>,
    /// J, J̇.
    inertia: Matrix3,
    inertia_rate: Matrix3,
    /// α + A y.
    slope: [DVector<f64>; 6],
    /// c, ċ, B d.
    momentum: [DVector<f64>; 3],
    momentum_rate: [DVector<f64>; 3],
    conjugate: [DVector<f64>; 3],
}

/// Derivatives with respect to y, ẏ, ÿ and ω of the moment on the floating frame (three rows) and of the force dual to
/// y (all rows).
pub(super) struct TurningSlopes {
    pub(super) moment: [Matrix3xX<f64>; 3],
    pub(super) moment_by_spin: Matrix3,
    /// With respect to y and ẏ.
    pub(super) dual: [DMatrix<f64>; 2],
    pub(super) dual_by_spin: MatrixXx3<f64>,
    /// Part of the mass among y.
    pub(super) among: Option<DMatrix<f64>>,
}

impl std::ops::AddAssign for TurningSlopes {
    fn add_assign(&mut self, other: Self) {
        for (own, more) in self.moment.iter_mut().zip(other.moment) {
            *own += more;
        }
        for (own, more) in self.dual.iter_mut().zip(other.dual) {
            *own += more;
        }
        self.moment_by_spin += other.moment_by_spin;
        self.dual_by_spin += other.dual_by_spin;
        self.among = match (self.among.take(), other.among) {
            (Some(own), Some(more)) => Some(own + more),
            (own, more) => own.or(more),
        };
    }
}

/// Parts of the mass matrix: of ω̇; of ÿ on the floating frame, and for y with itself.
pub(super) struct TurningMass {
    pub(super) inertia: Matrix3,
    pub(super) coupling: Matrix3xX<f64>,
    pub(super) among: Option<DMatrix<f64>>,
}

/// out = A x.
pub(super) fn times(matrix: &DMatrix<f64>, x: &DVector<f64>, out: &mut DVector<f64>) {
    resize(out, matrix.nrows());
    out.gemv(1.0, matrix, x, 0.0);
}

/// out = Aᵀ x.
fn transposed_times(matrix: &DMatrix<f64>, x: &DVector<f64>, out: &mut DVector<f64>) {
    resize(out, matrix.ncols());
    out.gemv_tr(1.0, matrix, x, 0.0);
}

pub(super) fn resize(vector: &mut DVector<f64>, size: usize) {
    if vector.len() != size {
        *vector = DVector::zeros(size);
    }
}

/// Three rows.
pub(super) fn rows(of: &[DVector<f64>; 3]) -> Matrix3xX<f64> {
    Matrix3xX::from_fn(of[0].len(), |row, column| of[row][column])
}

impl Turning {
    /// Evaluates the coefficients at a motion.
    pub(super) fn enter(&mut self, law: &TurningLaw, at: &PartMotion<'_>) {
        (self.spin, self.rotation, self.rotation_rate) = (at.spin, at.spin, at.spin_rate);
        self.deforming.clone_from(at.rate);
        self.deforming_rate.clone_from(at.second);
        if let Some(mean) = &law.mean {
            let [own, own_rate] = [at.rate, at.second].map(|rate| mean.rotation(rate));
            self.rotation += own;
            self.rotation_rate += own_rate;
            self.deforming.gemv(-1.0, &mean.turns, &own, 1.0);
            self.deforming_rate.gemv(-1.0, &mean.turns, &own_rate, 1.0);
        }
        for k in 0..6 {
            times(&law.inertia[k], at.displacement, &mut self.slope[k]);
            let [i, j] = PAIRS[k];
            let linear = law.slope[k].dot(at.displacement);
            let value = law.at_rest[(i, j)] + linear + 0.5 * self.slope[k].dot(at.displacement);
            self.slope[k] += &law.slope[k];
            let rate = self.slope[k].dot(at.rate);
            for (row, column) in [(i, j), (j, i)] {
                (self.inertia[(row, column)], self.inertia_rate[(row, column)]) = (value, rate);
            }
        }
        for k in 0..3 {
            transposed_times(&law.momentum[k], at.displacement, &mut self.momentum[k]);
            self.momentum[k] += &law.momentum_at_rest[k];
            transposed_times(&law.momentum[k], at.rate, &mut self.momentum_rate[k]);
            times(&law.momentum[k], &self.deforming, &mut self.conjugate[k]);
        }
    }

    /// l.
    fn angular_momentum(&self) -> Vector3 {
        self.inertia * self.rotation + Vector3::from_fn(|k, _| self.momentum[k].dot(&self.deforming))
    }

    /// l̇.
    fn angular_momentum_rate(&self) -> Vector3 {
        let of_rates = |k: usize| {
            self.momentum_rate[k].dot(&self.deforming) + self.momentum[k].dot(&self.deforming_rate)
        };
        self.inertia * self.rotation_rate
            + self.inertia_rate * self.rotation
            + Vector3::from_fn(|k, _| of_rates(k))
    }

    /// T.
    pub(super) fn kinetic(&self) -> f64 {
        self.rotation.dot(&(self.angular_momentum() - 0.5 * (self.inertia * self.rotation)))
    }

    /// The moment on the floating frame.
    pub(super) fn moment(&self) -> Vector3 {
        self.angular_momentum_rate() + self.spin.cross(&self.angular_momentum())
    }

    /// Adds the force dual to y.
    pub(super) fn add_dual(&self, law: &TurningLaw, out: &mut DVector<f64>) {
        let (p, dp) = (self.rotation, self.rotation_rate);
        for k in 0..3 {
            out.axpy(dp[k], &self.momentum[k], 1.0);
            out.axpy(p[k], &self.momentum_rate[k], 1.0);
            out.axpy(-p[k], &self.conjugate[k], 1.0);
        }
        for (k, [i, j]) in PAIRS.into_iter().enumerate() {
            let both = if i == j { 0.5 } else { 1.0 };
            out.axpy(-both * p[i] * p[j], &self.slope[k], 1.0);
        }
        if let Some(mean) = &law.mean {
            // Qᵀ = 1 - Pᵀ Rᵀ of the factor of Q.
            let mut along = self.angular_momentum_rate();
            for k in 0..3 {
                let turn = mean.turns.column(k);
                let of =
                    |i: usize| dp[i] * turn.dot(&self.momentum[i]) + p[i] * turn.dot(&self.momentum_rate[i]);
                along[k] -= of(0) + of(1) + of(2);
            }
            out.gemv_tr(1.0, &mean.projection, &along, 1.0);
        }
    }

    /// Σ_j v_j (α_ij + A_ij y) for each i.
    fn along(&self, v: &Vector3) -> Matrix3xX<f64> {
        let of = |i: usize, row: usize| (0..3).map(|j| v[j] * self.slope[pair(i, j)][row]).sum();
        Matrix3xX::from_fn(self.deforming.len(), of)
    }

    /// Parts of the mass matrix.
    pub(super) fn mass(&self, law: &TurningLaw) -> TurningMass {
        let momentum = rows(&self.momentum);
        let Some(mean) = &law.mean else {
            return TurningMass { inertia: self.inertia, coupling: momentum, among: None };
        };
        let turned = self.inertia * &mean.projection;
        let momentum = mean.rows_without(&momentum);
        let coupling = &momentum + turned;
        // Pᵀ (c Q + J P) + (c Q)ᵀ P.
        let among = mean.projection.tr_mul(&coupling) + momentum.tr_mul(&mean.projection);
        TurningMass { inertia: self.inertia, coupling, among: Some(among) }
    }

    /// Derivatives of moment and force.
    pub(super) fn slopes(&self, law: &TurningLaw, at: &PartMotion<'_>) -> TurningSlopes {
        let (p, dp) = (self.rotation, self.rotation_rate);
        let size = self.deforming.len();
        let turn = skew(&self.spin);
        let momentum = rows(&self.momentum);
        let momentum_rate = rows(&self.momentum_rate);
        // l with respect to y; l̇ with respect to y.
        let by_place = self.along(&p) + rows(&self.conjugate);
        let mut rate_by_place = self.along(&dp);
        let mut own = DVector::zeros(size);
        for i in 0..3 {
            own.gemv(1.0, &law.momentum[i], &self.deforming_rate, 0.0);
            for j in 0..3 {
                own.gemv(p[j], &law.inertia[pair(i, j)], at.rate, 1.0);
            }
            for (sum, value) in rate_by_place.row_mut(i).iter_mut().zip(own.iter()) {
                *sum += value;
            }
        }
        // Σ p_i B_iᵀ, Σ ṗ_i B_iᵀ, ½ Σ p_i p_j A_ij.
        let mut gyroscopic = DMatrix::zeros(size, size);
        let mut euler = DMatrix::zeros(size, size);
        let mut centrifugal = DMatrix::zeros(size, size);
        for (k, matrix) in law.momentum.iter().enumerate() {
            for (factor, sum) in [(p[k], &mut gyroscopic), (dp[k], &mut euler)] {
                if factor != 0.0 {
                    sum.zip_apply(&matrix.transpose(), |sum, value| *sum += factor * value);
                }
            }
        }
        for (k, [i, j]) in PAIRS.into_iter().enumerate() {
            let both = if i == j { 0.5 } else { 1.0 };
            let factor = both * p[i] * p[j];
            if factor != 0.0 {
                centrifugal.zip_apply(&law.inertia[k], |sum, value| *sum += factor * value);
            }
        }
        let moment_by_spin = self.inertia_rate - skew(&self.angular_momentum()) + turn * self.inertia;
        let Some(mean) = &law.mean else {
            return TurningSlopes {
                moment: [
                    &rate_by_place + turn * &by_place,
                    &by_place + &momentum_rate + turn * &momentum,
                    momentum,
                ],
                moment_by_spin,
                dual: [euler - centrifugal, &gyroscopic - gyroscopic.transpose()],
                dual_by_spin: (momentum_rate - by_place).transpose(),
                among: None,
            };
        };
        let projection = &mean.projection;
        let by_second = mean.rows_without(&momentum) + self.inertia * projection;
        let rate_by_rate = &by_place + mean.rows_without(&momentum_rate) + self.inertia_rate * projection;
        // Derivative of ½ Σ p_i p_j (α + A y) + Σ p_i B_i d with respect to ẏ, and of (c·p)˙.
        let back = mean.without(&gyroscopic.transpose()) + by_place.tr_mul(projection);
        let forth = gyroscopic + momentum_rate.tr_mul(projection);
        let dual_by_spin = projection.tr_mul(&self.inertia_rate)
            + mean.rows_without(&momentum_rate).transpose()
            - by_place.transpose();
        TurningSlopes {
            dual: [
                projection.tr_mul(&rate_by_place) + mean.transposed_without(&euler) - centrifugal,
                projection.tr_mul(&rate_by_rate) + mean.transposed_without(&forth) - back,
            ],
            moment: [&rate_by_place + turn * &by_place, rate_by_rate + turn * &by_second, by_second],
            moment_by_spin,
            dual_by_spin,
            among: self.mass(law).among,
        }
    }
}
