//! Tests of `joints::coupling`, a module of it.

use super::*;

/// sin(q₀) q₁ + t q₀.
#[derive(Debug)]
struct Bent;

impl Relation for Bent {
    fn jet(&self, (time, q): RelationPoint<'_>, (of_time, v): RelationPoint<'_>) -> [f64; 3] {
        let (sine, cosine) = q[0].sin_cos();
        [
            sine * q[1] + time * q[0],
            cosine * v[0] * q[1] + sine * v[1] + of_time * q[0] + time * v[0],
            -sine * v[0] * v[0] * q[1] + 2.0 * cosine * v[0] * v[1] + 2.0 * of_time * v[0],
        ]
    }
}

#[test]
fn short_changes_keep_their_digits_and_long_ones_are_exact() {
    let value = |time: f64, q: [f64; 2]| Bent.jet((time, &q), (0.0, &[0.0; 2]))[0];
    let (time, q) = (0.7, [0.4, 1.3]);
    for exponent in 0..10 {
        let width = 10.0_f64.powi(-exponent);
        let change = [0.3 * width, -0.2 * width];
        let found = Bent.change((time, &q), width, &change);
        if exponent < 3 {
            let wanted = value(time + width, [q[0] + change[0], q[1] + change[1]]) - value(time, q);
            assert!((found - wanted).abs() < 1e-14, "{exponent}");
        } else {
            // To second order; the third is below round-off of the first for the shortest.
            let [_, first, second] = Bent.jet((time, &q), (width, &change));
            let wanted = first + 0.5 * second;
            assert!((found - wanted).abs() < width.powi(3) + 4e-16 * wanted.abs(), "{exponent}");
        }
    }
}

/// q₀² - 10¹², 10⁶ sin(q₀ - 10⁶), 10⁶ + sin q₀, and sin t.
#[derive(Debug)]
enum Rounded {
    Argument,
    Slope,
    Offset,
    Late,
}

impl Relation for Rounded {
    fn jet(&self, (time, q): RelationPoint<'_>, (of_time, v): RelationPoint<'_>) -> [f64; 3] {
        let (sine, cosine) = match self {
            Self::Argument => return [q[0] * q[0] - 1e12, 2.0 * q[0] * v[0], 2.0 * v[0] * v[0]],
            Self::Slope => (1e6 * (q[0] - 1e6).sin(), 1e6 * (q[0] - 1e6).cos()),
            Self::Offset => q[0].sin_cos(),
            Self::Late => {
                let (sine, cosine) = time.sin_cos();
                return [sine, cosine * of_time, -sine * of_time * of_time];
            }
        };
        let value = if matches!(self, Self::Offset) { 1e6 + sine } else { sine };
        [value, cosine * v[0], -sine * v[0] * v[0]]
    }
}

/// Large values and arguments have round-off above the change.
#[test]
fn changes_keep_their_digits_whatever_rounds() {
    let width: f64 = 3e-9;
    let late: f64 = 1e6;
    for (relation, time, start, wanted) in [
        (Rounded::Argument, 0.0, 1e6, width * (2e6 + width)),
        (Rounded::Slope, 0.0, 1e6, 1e6 * width),
        (Rounded::Offset, 0.0, 0.3, 0.3_f64.cos() * width),
        (Rounded::Late, late, 0.3, late.cos() * width),
    ] {
        let found = relation.change((time, &[start]), width, &[width]);
        assert!((found / wanted - 1.0).abs() < 1e-8, "{relation:?}: {found:e}, {wanted:e}");
    }
}

#[test]
fn derivatives_of_jets() {
    let coupling = Coupling {
        name: "bent".to_owned(),
        coordinates: vec![CoordinateId::new(1), CoordinateId::new(0)],
        quantities: vec![Quantity::Length; 2],
        quantity: Quantity::Length,
        multiplier: 0,
        relation: Arc::new(Bent),
        scale: 2.0,
    };
    let motion = |value, rate| crate::kinematics::CoordinateMotion { value, rate, acceleration: 0.0 };
    let at = Kinematics {
        time: 0.7,
        elapsed: 0.0,
        nodes: Vec::new(),
        coordinates: vec![motion(1.3, 0.5), motion(0.4, -0.2)],
        held: Vec::new(),
        multipliers: Vec::new(),
        units: Vec::new(),
    };
    let (sine, cosine) = 0.4_f64.sin_cos();
    let close = |found: f64, wanted: f64| assert!((found - 2.0 * wanted).abs() < 1e-14, "{found} {wanted}");
    let numbers = |of: &dyn Fn(&mut [f64])| {
        let mut out = [0.0];
        of(&mut out);
        out[0]
    };
    close(numbers(&|out| coupling.violation(&at, out)), sine * 1.3 + 0.28);
    let gradient = coupling.slopes(&at);
    close(gradient[0], cosine * 1.3 + 0.7);
    close(gradient[1], sine);
    let hessian = coupling.hessian(&at);
    close(hessian[0][0], -sine * 1.3);
    close(hessian[0][1], cosine);
    close(hessian[1][0], cosine);
    close(hessian[1][1], 0.0);
    close(coupling.by_time(&at), 0.4);
    close(numbers(&|out| coupling.acceleration(&at, out)), -sine * 0.04 * 1.3 - 2.0 * cosine * 0.1 - 0.4);
    let second = coupling.second(&at, (1.0, &coupling.rates(&at)));
    close(second[0], -sine * 1.3 * -0.2 + cosine * 0.5 + 1.0);
    close(second[1], cosine * -0.2);
}
