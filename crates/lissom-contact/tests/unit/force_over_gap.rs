//! Tests of `force_over_gap`, a module of it.

use super::*;
use crate::geometry::pairs::PointOnSurface;
use crate::geometry::surfaces::{HalfSpace, Rod};
use std::sync::Arc;

/// Values of a box of positions are within the bounds.
#[test]
fn bounds_contain_all_values() {
    let rod = PointOnSurface { rounding: 0.1, surface: Arc::new(Rod { half_length: 0.0, radius: 0.2 }) };
    let plane = PointOnSurface { rounding: 0.1, surface: Arc::new(HalfSpace) };
    for pair in [&rod, &plane] {
        let law = ForceOverGap { gap: pair as &dyn Pair, compliance: PENETRATION };
        let ends = [[-0.3, 0.1], [0.0, 0.05], [-0.02, 0.3]];
        let [low, high] = law.bounds([0.0; 2], &ends).expect("they are known");
        for k in 0..1000 {
            let share = |factor: f64| (f64::from(k) * factor).fract();
            let at: [f64; 3] = std::array::from_fn(|i| {
                ends[i][0] + share([0.754_877, 0.569_840, 0.430_159][i]) * (ends[i][1] - ends[i][0])
            });
            let value = law.value(0.0, &at);
            assert!(low <= value && value <= high, "{at:?}: {value} not in {low} … {high}");
        }
        assert!(law.value(0.0, &[0.0; 3]) > 0.0);
        let none = ForceOverGap { gap: pair as &dyn Pair, compliance: NOTHING };
        assert_eq!(none.value(0.0, &[0.0; 3]), 0.0);
        assert_eq!(none.bounds([0.0; 2], &ends), Some([0.0; 2]));
    }
}
