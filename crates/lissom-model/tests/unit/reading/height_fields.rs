use super::*;

fn height(profile: &RandomProfile, x: f64) -> f64 {
    profile.evaluate(x, 0.0)[0]
}

/// The variance is the integral of the spectrum, G(n₀) n₀² (1/n₁ - 1/n₂), in the mean over seeds.
#[test]
fn a_random_profile_is_as_rough_as_its_class() {
    let variance = |grade| {
        let of_seed = |seed: u32| {
            let profile = random_profile(grade, f64::from(seed), [0.0, 2000.0]).expect("a profile");
            let heights: Vec<f64> = (0..4000).map(|k| height(&profile, 0.5 * f64::from(k))).collect();
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
    assert!((height(&first, 50.0) - height(&second, 50.0)).abs() > 1e-4);
    assert!(height(&first, 2.0) == 0.0 && height(&first, 3.0) == 0.0);
}

#[test]
fn a_random_profile_repeats() {
    for length in [20.0, 500.3] {
        let profile = random_profile(2, 1.0, [3.0, length]).expect("a profile");
        // Beyond the rise it has a period, also over the seam, and its slope is that of its heights.
        let seam = 3.0 + 2.0 * length;
        let mut spread = 0.0_f64;
        for k in -200..200 {
            let x = seam + 0.013 * f64::from(k);
            let [found, slope, _] = profile.evaluate(x, 0.0);
            assert!((found - height(&profile, x + 3.0 * length)).abs() < 1e-9, "{x}");
            let difference = (height(&profile, x + 1e-5) - height(&profile, x - 1e-5)) / 2e-5;
            assert!((slope - difference).abs() < 1e-5, "{x}: {slope}, not {difference}");
            spread = spread.max(found.abs());
        }
        assert!(spread > 1e-3);
        let [inside, slope, _] = profile.evaluate(5.0, 0.0);
        let difference = (height(&profile, 5.0 + 1e-5) - height(&profile, 5.0 - 1e-5)) / 2e-5;
        assert!(inside != 0.0 && (slope - difference).abs() < 1e-6);
    }
}
