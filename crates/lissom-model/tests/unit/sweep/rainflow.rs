//! Tests of `sweep::rainflow`, a module of it.

use super::*;

/// All cycles of a history: range and count, in ascending order, those of one range together.
fn cycles(history: &[f64]) -> Vec<(f64, f64)> {
    let mut all: Vec<(f64, f64)> = Vec::new();
    let mut count_cycle = |range: f64, count: f64| match all.iter_mut().find(|known| known.0 == range) {
        Some(known) => known.1 += count,
        None => all.push((range, count)),
    };
    let mut rainflow = Rainflow::new(1.0);
    for value in history {
        // As `add`, with the cycles passed on.
        match rainflow.reversals[..] {
            [.., last] if last == *value => continue,
            [.., before, last] if (last > before) == (*value > last) => {
                rainflow.reversals.pop();
            }
            _ => rainflow.close(&mut count_cycle),
        }
        rainflow.reversals.push(*value);
    }
    let damage = rainflow.damage(&mut count_cycle);
    let mut added = Rainflow::new(1.0);
    for value in history {
        added.add(*value);
    }
    assert_eq!(added.damage(&mut |_, _| ()), damage);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

#[test]
fn the_example_of_the_standard_is_counted_as_there() {
    // ASTM E1049-85, figure 6: reversals A to I.
    let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
    assert_eq!(cycles(&history), [(3.0, 0.5), (4.0, 1.5), (6.0, 0.5), (8.0, 1.0), (9.0, 0.5)]);
    // Points between reversals, and repeated ones, change nothing.
    let more = [-2.0, -1.0, 0.5, 1.0, 1.0, -3.0, 4.0, 5.0, -1.0, 3.0, 1.0, -4.0, 4.0, 4.0, -2.0];
    assert_eq!(cycles(&more), cycles(&history));
}

#[test]
fn equal_cycles_have_their_own_range() {
    for exponent in [1.0, 3.0, 10.0] {
        let mut rainflow = Rainflow::new(exponent);
        for k in 0..200 {
            rainflow.add(if k % 2 == 0 { 7.0 } else { -5.0 });
        }
        let wanted = 12.0 * (99.5_f64 / 1e3).powf(1.0 / exponent);
        let found = rainflow.equivalent_range(1e3);
        assert!((found - wanted).abs() < 1e-12 * wanted, "{exponent}: {found} {wanted}");
    }
    assert_eq!(Rainflow::new(3.0).equivalent_range(1.0), 0.0);
}
