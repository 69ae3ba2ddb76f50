//! Functions given by tables.

use lissom_mechanics::registry::TimeFunction;
use lissom_model::functions::table::{Extrapolation, Interpolation, Table, TableError};

#[test]
fn straight_lines_pass_through_the_rows_and_hold_the_ends() {
    let table =
        Table::new(&[(0.0, 1.0), (1.0, 3.0), (3.0, 0.0)], Interpolation::Linear, Extrapolation::Constant)
            .unwrap();
    for (time, value, first) in [
        (-1.0, 1.0, 0.0),
        (0.0, 1.0, 2.0),
        (0.5, 2.0, 2.0),
        (1.0, 3.0, -1.5),
        (3.0, 0.0, -1.5),
        (4.0, 0.0, 0.0),
    ] {
        assert_eq!((table.value(time), table.first_derivative(time)), (value, first), "{time}");
        assert_eq!(table.second_derivative(time), 0.0);
    }
}

#[test]
fn a_spline_is_exact_for_straight_lines_and_fourth_order_inside() {
    let line = [(0.0, 1.0), (0.5, 2.0), (2.0, 5.0)];
    let spline = Table::new(&line, Interpolation::Spline, Extrapolation::Constant).unwrap();
    assert!((spline.value(1.3) - 3.6).abs() < 1e-14);
    let sine = |n: usize| -> f64 {
        let at = |i: usize| std::f64::consts::PI * i as f64 / n as f64;
        let rows: Vec<_> = (0..=n).map(|i| (at(i), at(i).sin())).collect();
        // The sine's curvature vanishes at 0 and π, as the natural spline's does.
        let table = Table::new(&rows, Interpolation::Spline, Extrapolation::Constant).unwrap();
        (0..1000).map(|i| f64::from(i) * 3e-3).map(|t| (table.value(t) - t.sin()).abs()).fold(0.0, f64::max)
    };
    let ratio = sine(10) / sine(20);
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}

#[test]
fn the_derivatives_of_a_spline_are_its_derivatives() {
    let rows = [(0.0, 0.0), (1.0, 2.0), (1.5, -1.0), (4.0, 0.3), (5.0, 0.0)];
    let h = 1e-5;
    let tables = [Interpolation::Spline, Interpolation::Monotone]
        .map(|own| Table::new(&rows, own, Extrapolation::Linear).unwrap());
    for (table, i) in tables.iter().flat_map(|table| (1..120).map(move |i| (table, i))) {
        let t = 0.0499 * f64::from(i) - 0.5;
        let first = (table.value(t + h) - table.value(t - h)) / (2.0 * h);
        let second = (table.first_derivative(t + h) - table.first_derivative(t - h)) / (2.0 * h);
        assert!((table.first_derivative(t) - first).abs() < 1e-7, "{t}");
        assert!((table.second_derivative(t) - second).abs() < 2e-4, "{t}");
    }
}

#[test]
fn periodic_tables_repeat_without_a_jump() {
    use std::f64::consts::TAU;
    for (interpolation, error) in [(Interpolation::Spline, 2e-4), (Interpolation::Monotone, 1e-2)] {
        let mut rows: Vec<_> = (0..=24).map(|k| TAU * f64::from(k) / 24.0).map(|x| (x, x.sin())).collect();
        rows[24].1 = rows[0].1;
        let table = Table::new(&rows, interpolation, Extrapolation::Periodic).unwrap();
        for k in -200..200 {
            let x = 0.0731 * f64::from(k);
            assert!((table.value(x) - x.sin()).abs() < error, "{x}");
            assert!((table.value(x) - table.value(x + 3.0 * TAU)).abs() < 1e-13, "{x}");
            let [least, most] = table.bounds(x, x + 1.7).expect("bounds of a table");
            let found = (0..=20).map(|k| table.value(x + 0.085 * f64::from(k)));
            assert!(found.into_iter().all(|value| (least..=most).contains(&value)), "{x}");
        }
        let across = |x: f64| [table.first_derivative(x), table.second_derivative(x)];
        let [before, after] = [across(TAU - 1e-9), across(TAU + 1e-9)];
        assert!((before[0] - after[0]).abs() < 1e-6, "{before:?} {after:?}");
        assert!(interpolation == Interpolation::Monotone || (before[1] - after[1]).abs() < 1e-6);
        assert_eq!(table.bounds(0.0, 100.0), table.bounds(0.0, TAU));
    }
    let rows = [(0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (TAU - 7e-9, 0.0)];
    let closed = |count| Table::periodic(&rows[..count], Interpolation::Spline, TAU);
    assert_eq!(closed(4), closed(3));
    assert_eq!(Table::periodic(&rows, Interpolation::Spline, 3.0), Err(TableError::TooLong));
    assert_eq!(Table::periodic(&rows[..3], Interpolation::Spline, 2.5), Err(TableError::NotClosed));
}

#[test]
fn bad_tables_are_refused() {
    let read = |rows: &[(f64, f64)]| Table::new(rows, Interpolation::Spline, Extrapolation::Constant);
    assert_eq!(read(&[(0.0, 1.0)]), Err(TableError::TooShort));
    assert_eq!(read(&[(0.0, 1.0), (1.0, 1.0), (1.0, 2.0)]), Err(TableError::Repeated(1)));
    assert_eq!(read(&[(0.0, 1.0), (1.0, 1.0), (0.5, 2.0)]), Err(TableError::NotAscending(1)));
    assert_eq!(read(&[(0.0, 1.0), (f64::NAN, 1.0)]), Err(TableError::NotFinite(1)));
}

#[test]
fn monotone_tables_do_not_overshoot() {
    let rows = [(0.0, 0.0), (1.0, 0.0), (1.1, 5.0), (3.0, 5.0), (4.0, 7.0)];
    let table = Table::new(&rows, Interpolation::Monotone, Extrapolation::Linear).unwrap();
    let values: Vec<f64> = (0..=400).map(|i| table.value(0.01 * f64::from(i))).collect();
    assert!(values.windows(2).all(|pair| pair[1] >= pair[0] - 1e-14));
    for (argument, value) in rows {
        assert!((table.value(argument) - value).abs() < 1e-14);
    }
    let slope = table.first_derivative(4.0);
    assert!((table.value(5.0) - 7.0 - slope).abs() < 1e-13 && slope > 0.0);
}
