//! Tests of `kinematics::switch`, a module of it.

use super::*;

#[test]
fn a_level_is_left_at_both_of_its_ends() {
    for level in [-3.0, -1.0, 0.0, 7.0] {
        let start = Switch::of_level(level + 0.25, 0.0);
        let side = start.side();
        assert_eq!(level_of_side(side), level);
        assert!(start.number * side > 0.0, "{start:?}");
        for (argument, beyond) in
            [(level - 0.01, level - 1.0), (level + 1.01, level + 1.0), (level + 40.0, level + 1.0)]
        {
            let left = Switch::of_level(argument, side);
            assert!(left.number * side < 0.0, "{left:?}");
            assert_eq!(level_of_side(left.beyond(side)), beyond);
        }
    }
    assert_eq!(Switch::from(-2.0).side(), -1.0);
    assert_eq!(Switch::from(-2.0).beyond(1.0), -1.0);
}
