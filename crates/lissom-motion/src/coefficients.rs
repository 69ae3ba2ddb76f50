//! The scalar coefficients of the exponential and its tangent as functions of `q = θ²`, with derivatives with respect
//! to `q`. Scalar functions only. For several arguments side by side the longest series that any of them needs is
//! used for all.
//!
//! Legend: `S_k(q) = Σ_j (-q)ʲ/(2j + k)!`, so `S_0 = cos θ`, `S_1 = sin θ/θ`, `b = S_2 = (1 - cos θ)/θ²`,
//! `c = S_3 = (θ - sin θ)/θ³` (Stumpff's functions), `e = (1 - (θ/2) cot(θ/2))/θ²`.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use crate::real::Real;

/// Below this `q` a short series reaches full accuracy.
const TINY: f64 = 1.0 / 16.0;
/// Below this `q` the series of medium length does.
const SMALL: f64 = 1.0;
const TINY_TERMS: usize = 7;
const SMALL_TERMS: usize = 10;
const MEDIUM_TERMS: usize = 14;
const TERMS: usize = 20;

/// From here on the closed form of the values is more accurate than their series,
const CLOSED_VALUES_FROM: f64 = 9.0;
/// above this that of the first derivatives,
const CLOSED_SLOPES_FROM: f64 = 22.0;
/// and above this (a whole turn) that of all derivatives. Each derivative costs the closed form more digits by
/// cancellation, the series fewer.
const CLOSED_FROM: f64 = 40.0;

/// Series of the derivatives: `SERIES[j][m][k]` is the coefficient of `qʲ` in the `m`-th derivative of `S_(k+2)`.
const SERIES: [[[f64; 2]; 4]; TERMS] = {
    let mut table = [[[0.0; 2]; 4]; TERMS];
    let mut j = 0;
    while j < TERMS {
        let mut m = 0;
        while m < 4 {
            let sign = if (j + m) % 2 == 0 { 1.0 } else { -1.0 };
            let weight = sign * falling_product(j + m, m);
            table[j][m] = [weight / factorial(2 * (j + m) + 2), weight / factorial(2 * (j + m) + 3)];
            m += 1;
        }
        j += 1;
    }
    table
};

/// Series of `cos` and `sin(x)/x` in `x²`.
const CIRCULAR: [[f64; 2]; SMALL_TERMS] = {
    let mut table = [[0.0; 2]; SMALL_TERMS];
    let mut j = 0;
    while j < SMALL_TERMS {
        let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
        table[j] = [sign / factorial(2 * j), sign / factorial(2 * j + 1)];
        j += 1;
    }
    table
};

#[inline]
const fn factorial(n: usize) -> f64 {
    falling_product(n, n)
}

/// `n (n - 1) …` with `count` factors.
#[inline]
const fn falling_product(n: usize, count: usize) -> f64 {
    let mut product = 1.0;
    let mut i = 0;
    while i < count {
        product *= (n - i) as f64;
        i += 1;
    }
    product
}

/// Cosine of the half angle, and sine of the half angle divided by the whole angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfAngle<R> {
    pub(crate) cosine: R,
    pub(crate) sine_by_angle: R,
}

impl<R: Real> HalfAngle<R> {
    /// From the square of the whole angle.
    #[inline(always)]
    pub(crate) fn from_square(q: R) -> Self {
        let [cosine, sine_by_angle] = if q.all_below(TINY) {
            half_angle_series(&CIRCULAR[..TINY_TERMS - 1], q)
        } else if q.all_below(SMALL) {
            half_angle_series(&CIRCULAR, q)
        } else {
            let [values] = R::one_by_one([q], half_angle_of_any);
            values
        };
        Self { cosine, sine_by_angle }
    }
}

#[inline(always)]
fn half_angle_series<R: Real>(table: &[[f64; 2]], q: R) -> [R; 2] {
    let [cosine, sine] = horner(table, q.scaled(0.25));
    [cosine, sine.scaled(0.5)]
}

fn half_angle_of_any([q]: [f64; 1]) -> [[f64; 2]; 1] {
    if q < SMALL {
        return [half_angle_series(&CIRCULAR, q)];
    }
    let angle = q.sqrt();
    let (sine, cosine) = (0.5 * angle).sin_cos();
    [[cosine, sine / angle]]
}

/// `[b, c]` and their derivatives with respect to `q` up to order `ORDERS - 1` (at most 3).
#[inline(always)]
pub(crate) fn exponential_coefficients<R: Real, const ORDERS: usize>(q: R) -> [[R; 2]; ORDERS] {
    if q.all_below(TINY) {
        series(&SERIES[..TINY_TERMS], q)
    } else if q.all_below(SMALL) {
        series(&SERIES[..SMALL_TERMS], q)
    } else if q.all_below(CLOSED_VALUES_FROM) {
        series(&SERIES[..MEDIUM_TERMS], q)
    } else {
        R::one_by_one([q], exponential_coefficients_of_any)
    }
}

fn exponential_coefficients_of_any<const ORDERS: usize>([q]: [f64; 1]) -> [[f64; 2]; ORDERS] {
    if q < CLOSED_VALUES_FROM {
        return series(&SERIES[..MEDIUM_TERMS], q);
    }
    let half = HalfAngle::from_square(q);
    if ORDERS == 1 || q > CLOSED_FROM {
        return closed_form(q, half);
    }
    let [values, slopes] = closed_form::<2>(q, half);
    let mut result = series::<f64, ORDERS>(&SERIES, q);
    result[0] = values;
    if q > CLOSED_SLOPES_FROM {
        result[1] = slopes;
    }
    result
}

/// `[b, c]`, if the half angle is already known.
#[inline(always)]
pub(crate) fn exponential_values<R: Real>(q: R, half: HalfAngle<R>) -> [R; 2] {
    let [values] = if q.all_below(CLOSED_VALUES_FROM) {
        exponential_coefficients::<R, 1>(q)
    } else {
        R::one_by_one([q, half.cosine, half.sine_by_angle], exponential_values_of_any)
    };
    values
}

fn exponential_values_of_any([q, cosine, sine_by_angle]: [f64; 3]) -> [[f64; 2]; 1] {
    if q < CLOSED_VALUES_FROM {
        exponential_coefficients_of_any::<1>([q])
    } else {
        closed_form::<1>(q, HalfAngle { cosine, sine_by_angle })
    }
}

#[inline(always)]
fn horner<R: Real>(table: &[[f64; 2]], x: R) -> [R; 2] {
    let last = table[table.len() - 1];
    let mut sum = [x.like(last[0]), x.like(last[1])];
    for j in (0..table.len() - 1).rev() {
        sum[0] = x.like(table[j][0]).plus_product(sum[0], x);
        sum[1] = x.like(table[j][1]).plus_product(sum[1], x);
    }
    sum
}

#[inline(always)]
fn series<R: Real, const ORDERS: usize>(table: &[[[f64; 2]; 4]], q: R) -> [[R; 2]; ORDERS] {
    let mut sum = [[q.like(0.0); 2]; ORDERS];
    let last = table.len() - 1;
    for m in 0..ORDERS {
        sum[m] = [q.like(table[last][m][0]), q.like(table[last][m][1])];
    }
    for j in (0..last).rev() {
        for m in 0..ORDERS {
            sum[m][0] = q.like(table[j][m][0]).plus_product(sum[m][0], q);
            sum[m][1] = q.like(table[j][m][1]).plus_product(sum[m][1], q);
        }
    }
    sum
}

/// Upward recursion `S_(k+2) = (1/k! - S_k)/q`, then `dS_k/dq = (k S_(k+2) - S_(k+1))/2` once per order.
#[inline]
fn closed_form<const ORDERS: usize>(q: f64, half: HalfAngle<f64>) -> [[f64; 2]; ORDERS] {
    const INVERSE_FACTORIAL: [f64; 8] =
        [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0];
    let inverse = 1.0 / q;
    let mut s = [0.0; 10];
    s[2] = 2.0 * half.sine_by_angle * half.sine_by_angle;
    s[3] = (1.0 - 2.0 * half.sine_by_angle * half.cosine) * inverse;
    for k in 4..2 * ORDERS + 2 {
        s[k] = (INVERSE_FACTORIAL[k - 2] - s[k - 2]) * inverse;
    }
    let mut result = [[0.0; 2]; ORDERS];
    result[0] = [s[2], s[3]];
    for m in 1..ORDERS {
        for k in 2..2 * (ORDERS - m) + 2 {
            s[k] = 0.5 * (k as f64 * s[k + 2] - s[k + 1]);
        }
        result[m] = [s[2], s[3]];
    }
    result
}

/// Series of `e`, `|B_2n|/(2n)!` with Bernoulli's numbers, used below [`SMALL`].
const INVERSE: [f64; 15] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30_240.0,
    1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    5.284_190_138_687_493e-10,
    1.338_253_653_068_467_9e-11,
    3.389_680_296_322_582_7e-13,
    8.586_062_056_277_845e-15,
    2.174_868_698_558_062e-16,
    5.509_002_828_360_229_5e-18,
    1.395_446_468_581_252_3e-19,
    3.534_707_039_629_467e-21,
    8.953_517_427_037_546e-23,
    2.267_952_452_337_683e-24,
];
const INVERSE_TERMS: usize = 12;
const TINY_INVERSE_TERMS: usize = 7;
const INVERSE_SERIES: [[f64; 4]; INVERSE_TERMS] = derivatives(&INVERSE);

/// The first poles `4π²n²` of `e`.
const POLES: [f64; 3] = [39.478_417_604_357_43, 157.913_670_417_429_73, 355.305_758_439_216_9];
/// Beyond this `q` (past the first pole) the closed form of `e` is used.
const POLES_UP_TO: f64 = 60.0;
/// `2 Σ_(n≥4) (4π²n²)^-(k+1)`: the series of `e` without its first three poles.
const REMAINDER: [f64; 20] = [
    1.437_863_891_007_568_4e-2,
    9.595_555_480_779_425e-6,
    1.125_714_338_300_260_9e-8,
    1.538_897_956_518_107_3e-11,
    2.247_318_965_080_410_4e-14,
    3.394_356_459_763_464e-17,
    5.223_754_698_482_221_5e-20,
    8.127_414_828_310_521e-23,
    1.272_843_048_024_265_6e-25,
    2.001_458_998_678_854_4e-28,
    3.155_044_680_287_923e-31,
    4.981_335_263_797_585e-34,
    7.872_558_284_510_73e-37,
    1.244_968_366_250_882_4e-39,
    1.969_580_735_610_114e-42,
    3.116_731_900_957_955_5e-45,
    4.932_821_196_232_198_6e-48,
    7.807_934_479_359_275e-51,
    1.235_963_388_287_838_3e-53,
    1.956_560_904_780_354_5e-56,
];
const REMAINDER_TERMS: usize = 16;

const REMAINDER_SERIES: [[f64; 4]; REMAINDER_TERMS] = derivatives(&REMAINDER);

/// Derivatives of a series: entry `[j][m]` is the coefficient of `qʲ` in the `m`-th derivative.
const fn derivatives<const TERMS: usize>(series: &[f64]) -> [[f64; 4]; TERMS] {
    let mut table = [[0.0; 4]; TERMS];
    let mut j = 0;
    while j < TERMS {
        let mut m = 0;
        while m < 4 {
            table[j][m] = falling_product(j + m, m) * series[j + m];
            m += 1;
        }
        j += 1;
    }
    table
}

/// `e` and its derivatives with respect to `q` up to order `ORDERS - 1` (at most 3).
///
/// From Euler's expansion of the cotangent, `e = 2 Σ_n 1/(4π²n² - q)`: every term is positive below the first pole,
/// so neither `e` nor its derivatives lose a digit at any angle. At the pole itself (a whole turn, where the tangent
/// has no inverse) the distance to it is replaced by its rounding error, so that values remain finite.
#[inline(always)]
pub(crate) fn inverse_coefficients<R: Real, const ORDERS: usize>(q: R) -> [R; ORDERS] {
    if q.all_below(TINY) {
        inverse_series(&INVERSE_SERIES[..TINY_INVERSE_TERMS], q)
    } else if q.all_below(SMALL) {
        inverse_series(&INVERSE_SERIES, q)
    } else if q.all_below(POLES[0]) {
        expansion(q)
    } else {
        let [values] = R::one_by_one([q], inverse_coefficients_of_any);
        values
    }
}

fn inverse_coefficients_of_any<const ORDERS: usize>([q]: [f64; 1]) -> [[f64; ORDERS]; 1] {
    if q > POLES_UP_TO {
        return [inverse_closed_form(q)];
    }
    let at_pole = POLES.contains(&q);
    [expansion(if at_pole { q * (1.0 - f64::EPSILON) } else { q })]
}

#[inline(always)]
fn expansion<R: Real, const ORDERS: usize>(q: R) -> [R; ORDERS] {
    let mut sum = inverse_series(&REMAINDER_SERIES, q);
    for n in 0..POLES.len() {
        let inverse = q.like(1.0) / (q.like(POLES[n]) - q);
        let mut term = inverse.scaled(2.0);
        for m in 0..ORDERS {
            sum[m] = sum[m] + term;
            term = term * inverse.scaled((m + 1) as f64);
        }
    }
    sum
}

#[inline(always)]
fn inverse_series<R: Real, const ORDERS: usize>(table: &[[f64; 4]], q: R) -> [R; ORDERS] {
    let last = table.len() - 1;
    let mut sum = [q.like(0.0); ORDERS];
    for m in 0..ORDERS {
        sum[m] = q.like(table[last][m]);
    }
    for j in (0..last).rev() {
        for m in 0..ORDERS {
            sum[m] = q.like(table[j][m]).plus_product(sum[m], q);
        }
    }
    sum
}

/// With `γ = (θ/2) cot(θ/2)`: `2 q γ' = γ - γ² - q/4`, differentiated twice more, and `e = (1 - γ)/q`.
#[cold]
#[inline]
fn inverse_closed_form<const ORDERS: usize>(q: f64) -> [f64; ORDERS] {
    let half = HalfAngle::from_square(q);
    let mut gamma = [0.0; 4];
    gamma[0] = 0.5 * half.cosine / half.sine_by_angle;
    gamma[1] = (gamma[0] - gamma[0] * gamma[0] - 0.25 * q) / (2.0 * q);
    gamma[2] = (-gamma[1] - 2.0 * gamma[0] * gamma[1] - 0.25) / (2.0 * q);
    gamma[3] = (-3.0 * gamma[2] - 2.0 * gamma[1] * gamma[1] - 2.0 * gamma[0] * gamma[2]) / (2.0 * q);
    let mut result = [0.0; ORDERS];
    result[0] = (1.0 - gamma[0]) / q;
    for m in 1..ORDERS {
        result[m] = (-gamma[m] - m as f64 * result[m - 1]) / q;
    }
    result
}

#[cfg(test)]
#[path = "../tests/unit/coefficients.rs"]
mod tests;
