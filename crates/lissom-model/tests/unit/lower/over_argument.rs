//! Tests of `lower::over_argument`, a module of it.

use super::*;
use crate::functions::table::{Extrapolation, Interpolation, Table};

#[test]
fn rows_are_breakpoints_where_the_argument_is_a_line_of_time() {
    let rows = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 1.0)];
    let over = |interpolation, line| {
        OverArgument::new(Table::new(&rows, interpolation, Extrapolation::Constant).unwrap().into(), line)
    };
    assert_eq!(over(Interpolation::Linear, Some((3.0, -0.5))).breakpoints(), [2.0, 4.0]);
    for (interpolation, line) in [
        (Interpolation::Linear, None),
        (Interpolation::Linear, Some((1.0, 0.0))),
        (Interpolation::Spline, Some((0.0, 1.0))),
    ] {
        assert!(over(interpolation, line).breakpoints().is_empty(), "{interpolation:?}");
    }
    let mut slope = [0.0];
    over(Interpolation::Linear, None).gradient(0.0, &[1.5], &[], &mut slope);
    assert_eq!(slope, [-1.0]);
}
