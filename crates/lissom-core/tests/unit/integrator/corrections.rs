//! Tests of `integrator::corrections`, a module of it.

use super::*;

#[test]
fn sums_and_maxima_miss_no_number() {
    for count in 0..20 {
        let a: Vec<f64> = (0..count).map(|k| f64::from(k) - 5.0).collect();
        let b: Vec<f64> = (0..count).map(|k| 2.0 + f64::from(k)).collect();
        let expected: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
        assert_eq!(product(&a, &b), expected);
        let most = a.iter().zip(&b).fold(0.0_f64, |most, (a, b)| most.max((a * b).abs()));
        assert_eq!(largest(&a, &b), (most, true));
        for wrong in 0..count as usize {
            for value in [f64::NAN, f64::INFINITY] {
                let mut b = b.clone();
                b[wrong] = value;
                assert!(!largest(&vec![1.0; b.len()], &b).1, "{wrong} of {count}");
            }
        }
    }
}
