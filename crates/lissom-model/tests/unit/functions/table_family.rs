//! Tests of `functions::table_family`, a module of it.

use super::*;
use crate::functions::table::{Extrapolation, Interpolation};

fn table(slope: f64) -> Table {
    Table::new(&[(0.0, 0.0), (2.0, 2.0 * slope)], Interpolation::Linear, Extrapolation::Constant).unwrap()
}

#[test]
fn values_are_linear_between_tables_and_constant_beyond_them() {
    let family = TableFamily::new(vec![(1.0, table(1.0)), (3.0, table(2.0)), (4.0, table(0.0))]).unwrap();
    for (second, wanted) in
        [(0.0, [1.0, 1.0, 0.0]), (2.0, [1.5, 1.5, 0.5]), (3.5, [1.0, 1.0, -2.0]), (5.0, [0.0, 0.0, 0.0])]
    {
        assert_eq!(family.evaluate(1.0, second), wanted, "{second}");
    }
    assert_eq!(family.bounds([0.0, 1.0], [1.0, 2.0]), Some([0.0, 1.5]));
    assert_eq!(family.bounds([1.0, 1.0], [3.0, 3.0]), Some([2.0, 2.0]));
    assert_eq!(family.bounds([1.0, 1.0], [2.0, 3.5]), Some([1.0, 2.0]));
    assert_eq!(family.bounds([0.0, 2.0], [f64::NEG_INFINITY, f64::INFINITY]), Some([0.0, 4.0]));
    assert!(TableFamily::new(vec![(1.0, table(1.0)), (1.0, table(2.0))]).is_none());
    assert!(TableFamily::new(Vec::new()).is_none());
}
