use super::*;
use lissom_mechanics::registry::TimeFunction;

/// The variance is the integral of the spectrum, G(n₀) n₀² (1/n₁ - 1/n₂), in the mean over seeds.
#[test]
fn a_random_profile_is_as_rough_as_its_class() {
    let variance = |grade| {
        let of_seed = |seed: u32| {
            let profile = random_profile(grade, f64::from(seed), [0.0, 2000.0]).expect("a profile");
            let heights: Vec<f64> = (0..4000).map(|k| profile.value(0.5 * f64::from(k))).collect();
            heights.iter().map(|height| height * height).sum::<f64>() / heights.len() as f64
        };
        (1..=10).map(of_seed).sum::<f64>() / 10.0
    };
    for grade in [0, 2] {
        let wanted = 16e-6 * 4_f64.powi(grade) * 0.01 * (1.0 / 0.01 - 1.0 / 5.0);
        let found = variance(grade);
        assert!((found / wanted - 1.0).abs() < 0.1, "{grade}: {found} for {wanted}");
    }
    // Seeds are other roads, and a road begins level.
    let [first, second] = [1.0, 2.0].map(|seed| random_profile(1, seed, [3.0, 100.0]).expect("a profile"));
    assert!((first.value(50.0) - second.value(50.0)).abs() > 1e-4);
    assert!(first.value(2.0).abs() < 1e-12 && first.value(200.0).abs() < 1e-12);
}
