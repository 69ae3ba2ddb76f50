//! Tests of `output::curves`, a module of it.

use super::*;

/// Rows of two columns of one output, 1 ms apart: a sine of 20 Hz, and the same with the other sign.
fn waves(rows: usize) -> Record {
    let times: Vec<f64> = (0..rows).map(|row| 1e-3 * row as f64).collect();
    let sine: Vec<f64> = times.iter().map(|time| (std::f64::consts::TAU * 20.0 * time).sin()).collect();
    let columns = ["x", "y"].map(|component| Column::new("place", component, "position", "m"));
    Record { columns: columns.into(), times, values: vec![sine.clone(), sine.iter().map(|x| -x).collect()] }
}

#[test]
fn a_spectrum_that_ends_before_its_rows_do_is_reported_once() {
    let of = ["place".to_owned()];
    for (rows, expected) in [(500, 0), (8200, 1)] {
        let record = waves(rows);
        let sources = [Source { name: "", record: &record }];
        let found = plots(&sources, &of, Over::Frequency, "").expect("two spectra");
        assert_eq!(found.left_out.len(), expected, "{rows}: {:?}", found.left_out);
        assert!(found.left_out.iter().all(|words| words.starts_with("the spectrum of `place` ends at ")));
    }
}
