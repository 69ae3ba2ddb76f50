//! Tests of `output::curve_record`, a module of it.

use super::*;

fn curves(rows: u32, value: impl Fn(u32) -> f64) -> CurveRecord {
    let mut record = CurveRecord::default();
    record.begin(&[Column::new("a", "", "a", ""), Column::new("b", "", "b", "")]).unwrap();
    for row in 0..rows {
        record.row(f64::from(row), &[value(row), -value(row)]).unwrap();
    }
    record
}

#[test]
fn few_rows_are_all_there() {
    let points = curves(1000, |row| f64::from(row * row)).points(1);
    let wanted: Vec<Point> = (0..1000).map(|row| (f64::from(row), -f64::from(row * row))).collect();
    assert_eq!(points, wanted);
}

#[test]
fn a_million_rows_leave_a_bounded_number_of_points_with_all_extremes_and_both_ends() {
    let value = |row: u32| match row {
        123_457 => 9.0,
        876_543 => -8.0,
        row => (0.01 * f64::from(row)).sin(),
    };
    let record = curves(1_000_000, value);
    for (column, sign) in [(0, 1.0), (1, -1.0)] {
        let points = record.points(column);
        assert!(points.len() <= 4 * STRETCHES + 2 && points.len() > STRETCHES, "{}", points.len());
        assert!(points.contains(&(123_457.0, 9.0 * sign)) && points.contains(&(876_543.0, -8.0 * sign)));
        assert_eq!(points[0], (0.0, 0.0 * sign));
        assert_eq!(points.last(), Some(&(999_999.0, sign * value(999_999))));
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }
    assert!(record.row_of_wrong_length());
}

/// Stretches have 1, 2, 4, … rows, as few as leave less than twice [`STRETCHES`].
#[test]
fn points_are_the_extremes_of_stretches_of_equal_length() {
    let value = |row: u32| f64::from((row * 7919) % 65_537);
    for rows in [8191, 8192, 8193, 16_384, 20_001, 50_000] {
        let mut length = 1;
        while rows >= 2 * STRETCHES as u32 * length {
            length *= 2;
        }
        let all: Vec<Point> = (0..rows).map(|row| (f64::from(row), value(row))).collect();
        let mut wanted = vec![all[0]];
        for stretch in all.chunks(length as usize) {
            let by_value = |a: &&Point, b: &&Point| a.1.total_cmp(&b.1);
            let mut extremes =
                [*stretch.iter().min_by(by_value).unwrap(), *stretch.iter().max_by(by_value).unwrap()];
            extremes.sort_by(|a, b| a.0.total_cmp(&b.0));
            wanted.extend(extremes);
        }
        wanted.push(all[all.len() - 1]);
        wanted.dedup();
        assert_eq!(curves(rows, value).points(0), wanted, "{rows} rows");
    }
}

#[test]
fn gaps_do_not_hide_what_is_beside_them() {
    let record = curves(100_000, |row| if row % 7 == 0 { f64::NAN } else { f64::from(row) });
    let points = record.points(0);
    assert!(points.iter().filter(|point| point.1.is_finite()).count() > STRETCHES);
    assert!(points.contains(&(99_999.0, 99_999.0)));
}

impl CurveRecord {
    fn row_of_wrong_length(mut self) -> bool {
        self.row(1.0, &[1.0]).is_err()
    }
}
