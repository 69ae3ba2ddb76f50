//! An independent reference: numbers in extended precision carrying two infinitesimals, and the plain power series of
//! the exponential and of its tangent over them. Shares no formula with the crate.

use std::ops::{Add, Div, Mul, Sub};

use lissom_motion::{Matrix6, Vector6};

use crate::wide::Wide;

/// `value + first ε₁ + second ε₂ + mixed ε₁ ε₂` with `ε₁² = ε₂² = 0`: exact first and mixed derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Jet {
    pub(crate) value: Wide,
    pub(crate) first: Wide,
    pub(crate) second: Wide,
    pub(crate) mixed: Wide,
}

impl Jet {
    pub(crate) fn new(value: f64, first: f64, second: f64) -> Self {
        Self {
            value: Wide::new(value),
            first: Wide::new(first),
            second: Wide::new(second),
            mixed: Wide::default(),
        }
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
            mixed: self.mixed + other.mixed,
        }
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: self.value * other.first + self.first * other.value,
            second: self.value * other.second + self.second * other.value,
            mixed: self.value * other.mixed
                + self.first * other.second
                + self.second * other.first
                + self.mixed * other.value,
        }
    }
}

/// Enough for 31 digits with rotations up to 7 rad.
const TERMS: usize = 80;

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + other * Jet::new(-1.0, 0.0, 0.0)
    }
}

impl Div for Jet {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let first = (self.first - value * other.first) / other.value;
        let second = (self.second - value * other.second) / other.value;
        let mixed = self.mixed - value * other.mixed - first * other.second - second * other.first;
        Self { value, first, second, mixed: mixed / other.value }
    }
}

pub(crate) type JetVector = [Jet; 6];
pub(crate) type JetMatrix = [[Jet; 6]; 6];

/// `d` moved along `first` and `second`.
pub(crate) fn jets(d: &Vector6, first: &Vector6, second: &Vector6) -> JetVector {
    std::array::from_fn(|i| Jet::new(d[i], first[i], second[i]))
}

pub(crate) fn constants(d: &Vector6) -> JetVector {
    jets(d, &Vector6::zeros(), &Vector6::zeros())
}

fn minus(a: Jet) -> Jet {
    a * Jet::new(-1.0, 0.0, 0.0)
}

/// `-ad_d`, written out component by component.
pub(crate) fn minus_bracket(d: &JetVector) -> JetMatrix {
    let zero = Jet::default();
    let skew =
        |v: [Jet; 3]| [[zero, minus(v[2]), v[1]], [v[2], zero, minus(v[0])], [minus(v[1]), v[0], zero]];
    let (u, theta) = (skew([d[0], d[1], d[2]]), skew([d[3], d[4], d[5]]));
    let mut matrix = [[zero; 6]; 6];
    for i in 0..3 {
        for j in 0..3 {
            matrix[i][j] = minus(theta[i][j]);
            matrix[i + 3][j + 3] = minus(theta[i][j]);
            matrix[i][j + 3] = minus(u[i][j]);
        }
    }
    matrix
}

pub(crate) fn transpose(m: &JetMatrix) -> JetMatrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

pub(crate) fn product<const N: usize>(m: &[[Jet; N]; N], v: &[Jet; N]) -> [Jet; N] {
    std::array::from_fn(|i| (0..N).fold(Jet::default(), |sum, j| sum + m[i][j] * v[j]))
}

/// `Σ_k mᵏ v/(k + shift)! · shift!`: the exponential of `m` for `shift = 0`, `Σ mᵏ/(k+1)!` for `shift = 1`.
pub(crate) fn power_series<const N: usize>(m: &[[Jet; N]; N], v: &[Jet; N], shift: usize) -> [Jet; N] {
    let mut term = *v;
    let mut sum = *v;
    for k in 1..TERMS {
        term = product(m, &term).map(|entry| entry / Jet::new((k + shift) as f64, 0.0, 0.0));
        sum = std::array::from_fn(|i| sum[i] + term[i]);
    }
    sum
}

/// `T(d) a = Σ (-ad_d)ᵏ a/(k+1)!`.
pub(crate) fn tangent_series(d: &JetVector, a: &JetVector) -> JetVector {
    power_series(&minus_bracket(d), a, 1)
}

/// `T(d)ᵀ w`.
pub(crate) fn tangent_transpose_series(d: &JetVector, w: &JetVector) -> JetVector {
    power_series(&transpose(&minus_bracket(d)), w, 1)
}

/// `T(d)⁻¹ a`, or `T(d)⁻ᵀ a` if `transposed`: the system of the series' matrix, solved with pivoting.
pub(crate) fn inverse_tangent_by_elimination(d: &JetVector, a: &JetVector, transposed: bool) -> JetVector {
    let columns = std::array::from_fn(|i| tangent_series(d, &constants(&unit(i))));
    solve(if transposed { columns } else { transpose(&columns) }, *a)
}

fn solve(mut m: JetMatrix, mut x: JetVector) -> JetVector {
    for k in 0..6 {
        let size = |row: &[Jet; 6]| row[k].value.high.abs();
        let pivot = (k..6).max_by(|&i, &j| size(&m[i]).total_cmp(&size(&m[j]))).unwrap();
        m.swap(k, pivot);
        x.swap(k, pivot);
        for i in (0..6).filter(|&i| i != k) {
            let factor = m[i][k] / m[k][k];
            for j in k..6 {
                m[i][j] = m[i][j] - factor * m[k][j];
            }
            x[i] = x[i] - factor * x[k];
        }
    }
    std::array::from_fn(|i| x[i] / m[i][i])
}

/// The 4 x 4 matrix `[[R, x], [0, 1]]` of `exp(d)`, by columns.
pub(crate) fn exponential_series(d: &JetVector) -> [[Jet; 4]; 4] {
    let zero = Jet::default();
    let m = [
        [zero, minus(d[5]), d[4], d[0]],
        [d[5], zero, minus(d[3]), d[1]],
        [minus(d[4]), d[3], zero, d[2]],
        [zero; 4],
    ];
    std::array::from_fn(|column| {
        let unit = std::array::from_fn(|i| Jet::new(f64::from(u8::from(i == column)), 0.0, 0.0));
        power_series(&m, &unit, 0)
    })
}

pub(crate) fn values(v: &JetVector) -> Vector6 {
    Vector6::from_fn(|i, _| v[i].value.value())
}

pub(crate) fn firsts(v: &JetVector) -> Vector6 {
    Vector6::from_fn(|i, _| v[i].first.value())
}

pub(crate) fn unit(i: usize) -> Vector6 {
    let mut v = Vector6::zeros();
    v[i] = 1.0;
    v
}

/// The matrix whose columns are the derivatives of `f` along the six unit directions.
pub(crate) fn derivative_by_jets(d: &Vector6, f: impl Fn(&JetVector) -> JetVector) -> Matrix6 {
    let zero = Vector6::zeros();
    Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|i| firsts(&f(&jets(d, &unit(i), &zero)))))
}
