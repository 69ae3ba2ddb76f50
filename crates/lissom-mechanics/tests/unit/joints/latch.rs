//! Tests of `joints::latch`, a module of it.

use super::holds;

#[test]
fn inputs_above_one_half_hold() {
    for (input, wanted) in
        [(0.0, false), (0.5, false), (0.5_f64.next_up(), true), (1.0, true), (f64::NAN, false)]
    {
        assert_eq!(holds(input), wanted, "{input}");
    }
}
