//! Tests of `pictures::picture::snapshot`, a module of it.

use super::*;

#[test]
fn sheets_have_the_columns_that_give_the_largest_panels() {
    let frame = |width, height| Frame { low: [0.0; 2], high: [width, height] };
    let wide = Sheet::of(frame(4.0, 1.0), 6, MAX_EXTENT);
    assert_eq!((wide.columns, wide.rows), (2, 3));
    let high = Sheet::of(frame(1.0, 4.0), 6, MAX_EXTENT);
    assert_eq!((high.columns, high.rows), (6, 1));
    assert_eq!(Sheet::of(frame(1.0, 1.0), 1, MAX_EXTENT).columns, 1);
}

#[test]
fn numbers_are_short() {
    assert_eq!(short(0.123_456), "0.1235");
    assert_eq!(short(200.0), "200");
    assert_eq!(short(1e-17), "0");
}
