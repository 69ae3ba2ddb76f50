//! Tests of `output::csv`, a module of it.

use proptest::prelude::*;

use super::*;

fn columns() -> Vec<Column> {
    vec![Column::new("midspan", "x", "displacement", "m"), Column::new("energy, total", "", "energy", "")]
}

#[test]
fn lines_have_a_heading_and_short_numbers() {
    let mut writer = CsvWriter::new(Vec::new());
    writer.begin(&columns()).unwrap();
    writer.row(0.1, &[1.0, -2.5e-12]).unwrap();
    writer.row(0.2, &[f64::NAN, 1e300]).unwrap();
    writer.finish().unwrap();
    let wanted = "time,midspan.x,\"energy, total\"\n0.1,1,-2.5e-12\n0.2,NaN,1e300\n";
    assert_eq!(String::from_utf8(writer.to).unwrap(), wanted);
}

#[test]
fn only_whole_lines_leave_the_buffer() {
    let mut writer = CsvWriter::new(Vec::new());
    writer.begin(&columns()).unwrap();
    for i in 0..20_000 {
        writer.row(f64::from(i) * 1e-3, &[1.0 / 3.0, 2.0 / 3.0]).unwrap();
        assert_eq!(writer.to.last(), Some(&b'\n'));
    }
    let before = writer.to.len();
    assert!(before > 1 << 16 && !writer.lines.is_empty());
    // After the time of patience the next row leaves at once.
    writer.flushed = Instant::now().checked_sub(2 * PATIENCE).unwrap();
    writer.row(20.0, &[0.0, 0.0]).unwrap();
    assert!(writer.lines.is_empty() && writer.to.len() > before);
}

proptest! {
    #[test]
    fn numbers_are_written_as_by_the_standard_library(value in any::<f64>(), exponent in -12..12_i32) {
        for value in [value, f64::exp2(f64::from(exponent)) * value.fract()] {
            let is_plain = value == 0.0 || !value.is_finite() || (1e-4..1e9).contains(&value.abs());
            let wanted = if is_plain { format!("{value}") } else { format!("{value:e}") };
            let mut text = Vec::new();
            write_number(&mut text, value).unwrap();
            let text = String::from_utf8(text).unwrap();
            if text == wanted {
                continue;
            }
            // Two shortest numbers may be equally near: the exact one then has one digit more, a five.
            let exact = if is_plain { format!("{value:.60}") } else { format!("{value:.60e}") };
            let mantissa = |text: &str| text.split('e').next().unwrap_or_default().trim_end_matches('0').to_owned();
            let exact = mantissa(&exact);
            let is_between = exact.ends_with('5') && exact.len() == mantissa(&wanted).len() + 1;
            prop_assert!(is_between && text.len() == wanted.len(), "{} instead of {}", text, wanted);
            prop_assert_eq!(text.parse::<f64>(), Ok(value));
        }
    }

    #[test]
    fn numbers_come_back_exactly(value in any::<f64>()) {
        let mut text = Vec::new();
        write_number(&mut text, value).unwrap();
        let back: f64 = String::from_utf8(text).unwrap().parse().unwrap();
        prop_assert!(back.to_bits() == value.to_bits() || (back.is_nan() && value.is_nan()));
    }
}

/// Half way between two numbers of equally many digits the last digit is even.
#[test]
fn numbers_between_two_shortest_ones_come_back() {
    let mut text = Vec::new();
    write_number(&mut text, 72.706_695_556_640_62).unwrap();
    assert_eq!(String::from_utf8(text).unwrap(), "72.70669555664062");
}
