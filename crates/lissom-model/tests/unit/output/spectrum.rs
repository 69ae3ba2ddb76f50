//! Tests of `output::spectrum`, a module of it.

use super::*;

#[test]
fn sines_are_found_whatever_the_steps() {
    let value = |t: f64| 5.0 + 0.7 * (TAU * 12.0 * t).sin() + 0.02 * (TAU * 40.0 * t + 1.0).cos();
    let equal: Vec<f64> = (0..=2000).map(|k| 3.0 + 1e-3 * f64::from(k)).collect();
    // Steps that differ by a factor of three.
    let unequal: Vec<f64> = equal.iter().map(|t| t + 0.159 * (TAU * (t - 3.0) / 2.0).sin()).collect();
    for times in [equal, unequal] {
        let values: Vec<f64> = times.iter().map(|t| value(*t)).collect();
        let spectrum = Spectrum::of(&times, &values).unwrap();
        let at = |frequency: f64| {
            let near = |line: &&(f64, f64)| (line.0 - frequency).abs() < 0.1;
            spectrum.lines.iter().find(near).unwrap().1
        };
        assert!((at(12.0) - 0.7).abs() < 2e-3, "{}", at(12.0));
        assert!((at(40.0) - 0.02).abs() < 1e-3, "{}", at(40.0));
        assert!(at(25.0) < 2e-3 && at(1.0) < 2e-3, "{} {}", at(25.0), at(1.0));
        assert!((spectrum.nyquist - 500.0).abs() < 1e-6);
    }
}

#[test]
fn too_little_gives_nothing() {
    assert!(Spectrum::of(&[0.0, 1.0, 2.0], &[1.0; 3]).is_none());
    assert!(Spectrum::of(&[0.0, 1.0, 2.0, 3.0], &[1.0, f64::NAN, 1.0, 1.0]).is_none());
    assert!(Spectrum::of(&[0.0; 4], &[1.0; 4]).is_none());
    assert!(Spectrum::of(&[0.0, 2.0, 1.0, 3.0], &[1.0; 4]).is_none());
}

/// Integral over the rows, by trapezoids between neighbouring rows.
fn integral(times: &[f64], values: impl Fn(usize) -> f64) -> f64 {
    (1..times.len()).map(|row| 0.5 * (times[row] - times[row - 1]) * (values(row) + values(row - 1))).sum()
}

/// Odd and even numbers of rows, equal and unequal steps, a start that is not zero, a jump at one time.
#[test]
fn amplitudes_are_the_windowed_integrals() {
    for rows in [4, 5, 16, 17] {
        for skew in [0.0, 0.3] {
            let mut times: Vec<f64> =
                (0..rows).map(f64::from).map(|k| 2.5 + 0.2 * k + skew * 0.2 * (1.9 * k).sin()).collect();
            if rows > 6 {
                times[5] = times[4];
            }
            let values: Vec<f64> =
                (0..rows).map(f64::from).map(|k| 3.0 + (1.3 * k).sin() + 0.1 * k * k).collect();
            let spectrum = Spectrum::of(&times, &values).unwrap();
            let last = times.len() - 1;
            let duration = times[last] - times[0];
            let window = |row: usize| 1.0 - (TAU * (times[row] - times[0]) / duration).cos();
            let whole = integral(&times, window);
            let mean = integral(&times, |row| window(row) * values[row]) / whole;
            assert!((spectrum.nyquist - 0.5 * last as f64 / duration).abs() < 1e-12);
            assert_eq!(spectrum.lines.len(), last / 2, "{rows} rows");
            assert!((spectrum.end() - (last / 2) as f64 / duration).abs() < 1e-12);
            for (line, &(frequency, amplitude)) in (1..).map(f64::from).zip(&spectrum.lines) {
                assert!((frequency - line / duration).abs() < 1e-12, "{rows} rows: {frequency}");
                let part = |phase: f64| {
                    integral(&times, |row| {
                        window(row) * (values[row] - mean) * (TAU * frequency * times[row] + phase).cos()
                    })
                };
                let wanted = 2.0 * part(0.0).hypot(part(0.25 * TAU)) / whole;
                assert!((amplitude - wanted).abs() < 1e-12, "{rows} rows, line {line}: {amplitude} {wanted}");
            }
        }
    }
}

#[test]
fn the_number_of_lines_is_limited() {
    let times: Vec<f64> = (0..8100).map(|k| 0.5 * f64::from(k)).collect();
    let values: Vec<f64> = times.iter().map(|time| (3.0 * time).sin()).collect();
    let spectrum = Spectrum::of(&times, &values).unwrap();
    assert_eq!(spectrum.lines.len(), MAX_LINES);
    assert!(spectrum.end() < 0.99 * spectrum.nyquist);
}

#[test]
fn values_beyond_the_times_are_left_out() {
    let times = [0.0, 1.0, 2.0, 3.0, 4.0];
    let of = |count: usize| Spectrum::of(&times[..count], &[1.0, -1.0, 2.0, 0.5, 3.0, 7.0]);
    assert_eq!(of(5), Spectrum::of(&times, &[1.0, -1.0, 2.0, 0.5, 3.0]));
    assert!(of(4).is_some() && of(3).is_none());
}
