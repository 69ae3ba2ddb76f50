//! Tests of `forms::meeting`, a module of it.

use lissom_motion::{Matrix3, Rotation, Vector3};

use super::super::samples::sample;
use super::*;
use crate::geometry::gap::Gap;
use lissom_mechanics::law::hull;

/// Every two forms of the table, with the first and the last of the pairs of their parts.
fn pairs() -> Vec<([FormKind; 2], Arc<dyn Pair>)> {
    let of = |kinds: [FormKind; 2]| {
        let solids = kinds.map(|kind| PlacedSolid { form: sample(kind), frame: Motion::IDENTITY });
        let found = meetings(solids.each_ref(), false).expect("closed").expect("in the table");
        [found.first(), found.last()].map(|own| (kinds, own.expect("they have parts").pair.clone()))
    };
    PAIRS.iter().flat_map(|row| row.0.iter().map(|base| [*base, row.1])).flat_map(of).collect()
}

#[test]
fn every_two_forms_are_in_the_table_once() {
    for &one in FormKind::ALL {
        for &other in FormKind::ALL {
            let is_own = |row: &&Row, [base, tip]: [FormKind; 2]| row.0.contains(&base) && row.1 == tip;
            let count = |kinds| PAIRS.iter().filter(|row| is_own(row, kinds)).count();
            let ways = if one == other { 0 } else { count([other, one]) };
            let words = parts_between([one, other]);
            assert_eq!(count([one, other]) + ways, usize::from(words.is_some()), "{one:?} {other:?}");
            assert_eq!(words, parts_between([other, one]));
        }
    }
}

/// Derivatives of normal and point are those of differences, and the gap changes with the velocity of the point of contact along
/// the normal: its force then does the work of an energy.
#[test]
fn derivatives_are_those_of_differences() {
    let step = 1e-6;
    for (kinds, pair) in pairs() {
        let mut compared = 0;
        for k in 0..160 {
            let share = |factor: f64| (f64::from(k) * factor).fract() * 4.0 - 2.0;
            let x = Vector3::new(share(0.754_877), share(0.569_840), share(0.430_159));
            let turn = Rotation::exponential(&(3.0 * Vector3::new(share(0.31), share(0.77), share(0.13))));
            let rotation = turn.matrix();
            let at = pair.gap(&x, &rotation);
            if at.value < -0.01 {
                // Within a solid its sides have edges.
                continue;
            }
            for column in 0..6 {
                let moved = |sign: f64| -> Gap {
                    let unit = Vector3::ith(column % 3, sign * step);
                    if column < 3 {
                        pair.gap(&(x + rotation * unit), &rotation)
                    } else {
                        let turned: Matrix3 = (turn * Rotation::exponential(&unit)).matrix();
                        pair.gap(&x, &turned)
                    }
                };
                let (before, after) = (moved(-1.0), moved(1.0));
                // At the edges between two regions curvatures jump, and where an end becomes nearest.
                if (before.normal_by - after.normal_by).norm() > 0.1
                    || (before.point_by - after.point_by).norm() > 0.1
                {
                    continue;
                }
                compared += 1;
                let slope = |of: fn(&Gap) -> Vector3| (of(&after) - of(&before)) / (2.0 * step);
                let (normal, point) = (slope(|gap| gap.normal), slope(|gap| gap.point));
                let allowed = 1e-6 * (1.0 + at.point_by.norm_squared());
                assert!((normal - at.normal_by.column(column)).norm() < allowed, "{kinds:?} {k} {column}");
                assert!((point - at.point_by.column(column)).norm() < allowed, "{kinds:?} {k} {column}");
                // The velocity of the point of contact along the normal.
                let arm = rotation.tr_mul(&(at.point - x));
                let unit = Vector3::ith(column % 3, 1.0);
                let local = if column < 3 { unit } else { unit.cross(&arm) };
                let wanted = at.normal.dot(&(rotation * local));
                let change = (after.value - before.value) / (2.0 * step);
                assert!((change - wanted).abs() < 1e-6, "{kinds:?} {k} {column}: {change} {wanted}");
            }
        }
        assert!(compared > 200, "{kinds:?}: {compared}");
    }
}

/// Events that evaluate the gap alone find the roots at which the force begins.
#[test]
fn values_alone_are_those_of_gaps() {
    for (kinds, pair) in pairs() {
        for k in 0..160 {
            let share = |factor: f64| (f64::from(k) * factor).fract() * 4.0 - 2.0;
            let x = Vector3::new(share(0.754_877), share(0.569_840), share(0.430_159));
            let turn = Rotation::exponential(&Vector3::new(share(0.31), share(0.77), share(0.13)));
            let (alone, gap) = (pair.value(&x, &turn.matrix()), pair.gap(&x, &turn.matrix()).value);
            assert_eq!(alone.to_bits(), gap.to_bits(), "{kinds:?}: {alone} {gap}");
        }
    }
}

/// Values along a motion are within the range over its arguments, and sliding and spinning on a plane do not widen it.
#[test]
fn ranges_contain_all_values() {
    let motions = [(Vector3::z(), 1.0), (Vector3::x(), 0.2), (Vector3::new(0.3, -0.8, 0.5), 0.7)];
    for (kinds, pair) in pairs() {
        for (axis, turn) in motions {
            let arguments = |share: f64| -> Vec<f64> {
                let tilt = Rotation::exponential(&Vector3::new(0.4, 0.1, 0.0));
                let rotation = (Rotation::exponential(&(share * turn * axis)) * tilt).matrix();
                let x = Vector3::new(0.3, -0.2, 0.5) + share * Vector3::new(0.1, 0.3, 0.0);
                x.iter().chain(rotation.iter()).take(pair.arguments()).copied().collect()
            };
            let samples: Vec<Vec<f64>> = (0..=100).map(|k| arguments(f64::from(k) / 100.0)).collect();
            let over = |k: usize| hull(&samples.iter().map(|own| own[k]).collect::<Vec<_>>());
            let [low, high] = pair.range(&(0..pair.arguments()).map(over).collect::<Vec<_>>());
            for sample in &samples {
                let value = pair.gap_at(sample);
                let is_within = low - 1e-14 <= value && value <= high + 1e-14;
                assert!(is_within, "{kinds:?}: {value} not in {low} … {high}");
            }
            assert!(!pair.is_on_plane() || axis != Vector3::z() || high - low < 1e-12, "{kinds:?}");
        }
    }
}
