//! Tests of `instants`, a module of it.

use super::*;

#[test]
fn a_million_additions_stay_within_the_tolerance() {
    for duration in [0.1, 0.01, 1e-3, 1.0 / 3.0] {
        let mut clock = 0.0;
        for k in 1..=1_000_000_u32 {
            clock += duration;
            let exact = f64::from(k) * duration;
            assert!((clock - exact).abs() <= accumulated_tolerance(clock, clock, duration), "{k} {duration}");
        }
        assert!(accumulated_tolerance(clock, clock, duration) <= 1e-3 * duration);
    }
}
