//! Tests of `number`, a module of it.

use super::*;

#[test]
fn numbers_are_as_people_write_them() {
    for (value, digits, words) in [
        (0.004, 7, "0.004"),
        (0.5, 7, "0.5"),
        (0.1 + 0.2, 7, "0.3"),
        (0.0, 7, "0"),
        (-0.0, 7, "0"),
        (-12.345_678_9, 7, "-12.34568"),
        (1e-4, 7, "0.0001"),
        (9.99e-5, 7, "9.99e-5"),
        (1e6, 7, "1000000"),
        (27_123.4, 3, "27100"),
        (1.234e9, 2, "1.2e9"),
        (f64::NAN, 7, "NaN"),
        (f64::INFINITY, 7, "inf"),
    ] {
        assert_eq!(written(value, digits), words, "{value:e}");
    }
    assert_eq!([0.0123, 0.48, 12.345].map(duration), ["12 ms", "0.48 s", "12.3 s"]);
}

#[test]
fn formats_of_messages_write_numbers_and_leave_the_rest() {
    let (time, count, name) = (0.004, 3_usize, "arm".to_owned());
    let (time, count, name) = (Shown(&time).shown(), (&Shown(&count)).shown(), (&Shown(&name)).shown());
    assert_eq!(format!("{time} {time:.1e} {time:.2} {count} {name}"), "0.004 0.004 0.00 3 arm");
    assert_eq!(2.0 * *time, 0.008);
}
