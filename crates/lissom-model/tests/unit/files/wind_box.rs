//! Tests of `files::wind_box`, a module of it.

use super::*;

const DESCRIPTION: &[u8] = b"by hand";

/// Three points along y, two along z, one of the tower, four instants.
fn file(format: i16, value: impl Fn(usize, usize, usize, usize) -> i16) -> Vec<u8> {
    let mut bytes = format.to_le_bytes().to_vec();
    bytes.extend([2_i32, 3, 1, 4].iter().flat_map(|count| count.to_le_bytes()));
    bytes.extend([10.0_f32, 5.0, 0.5, 12.0, 25.0, 20.0].iter().flat_map(|real| real.to_le_bytes()));
    bytes.extend([100.0_f32, -200.0, 50.0, 0.0, 1000.0, 300.0].iter().flat_map(|real| real.to_le_bytes()));
    bytes.extend(i32::try_from(DESCRIPTION.len()).unwrap().to_le_bytes());
    bytes.extend(DESCRIPTION);
    for instant in 0..4 {
        for (z, y) in (0..2).flat_map(|z| (0..3).map(move |y| (z, y))) {
            bytes.extend((0..3).flat_map(|k| value(k, y, z, instant).to_le_bytes()));
        }
        bytes.extend([i16::MAX; 3].iter().flat_map(|own| own.to_le_bytes()));
    }
    bytes
}

fn number(component: usize, y: usize, z: usize, instant: usize) -> i16 {
    i16::try_from(1000 * component + 100 * instant * instant + 10 * y * y + 3 * z).unwrap()
}

#[test]
fn the_points_have_the_stored_values() {
    let wind = WindBox::of_file(file(7, number)).unwrap();
    let (slope, offset) = ([100.0, 50.0, 1000.0], [-200.0, 0.0, 300.0]);
    for (component, y, z, instant) in
        [(0, 0, 0, 0), (1, 2, 1, 3), (2, 1, 0, 2), (0, 2, 0, 1), (1, 0, 1, 3), (2, 1, 1, 0)]
    {
        let place = [5.0 * (y as f64 - 1.0), 20.0 + 10.0 * z as f64, 0.5 * instant as f64];
        let expected = (f64::from(number(component, y, z, instant)) - offset[component]) / slope[component];
        let found = wind.evaluate(component, place)[0];
        assert!((found - expected).abs() < 1e-12, "{component} {y} {z} {instant}: {found} {expected}");
    }
}

#[test]
fn values_between_have_exact_derivatives() {
    for format in [7, 8] {
        let wind = WindBox::of_file(file(format, number)).unwrap();
        let last = if format == 8 { 1.8 } else { 1.4 };
        for place in [[-3.0, 22.0, 0.2], [1.0, 29.0, last], [4.9, 20.1, 0.9]] {
            let [_, slopes @ ..] = wind.evaluate(1, place);
            for k in 0..3 {
                let [after, before] = [1e-4, -1e-4].map(|step| {
                    let mut moved = place;
                    moved[k] += step;
                    wind.evaluate(1, moved)[0]
                });
                let found = (after - before) / 2e-4;
                assert!((found - slopes[k]).abs() < 1e-5, "{format} {place:?} {k}: {found} {}", slopes[k]);
                assert!(slopes[k].abs() > 1e-3);
            }
        }
    }
}

#[test]
fn derivatives_are_continuous_at_the_points() {
    for format in [7, 8] {
        let wind = WindBox::of_file(file(format, number)).unwrap();
        for (place, axis) in [([0.0, 24.0, 0.7], 0), ([1.0, 24.0, 0.5], 2), ([1.0, 24.0, 1.0], 2)] {
            let [before, after] = [-1e-9, 1e-9].map(|step| {
                let mut moved = place;
                moved[axis] += step;
                wind.evaluate(0, moved)
            });
            let is_close = before.iter().zip(after).all(|(before, after)| (before - after).abs() < 1e-6);
            assert!(is_close, "{format} {place:?}: {before:?} {after:?}");
            assert!(after[1 + axis].abs() > 1e-3);
        }
    }
}

#[test]
fn wind_that_is_linear_over_the_points_is_linear_up_to_the_ends() {
    let linear = |_: usize, y: usize, z: usize, instant: usize| {
        i16::try_from(500 + 100 * y + 30 * z + 200 * instant).unwrap()
    };
    let wind = WindBox::of_file(file(7, linear)).unwrap();
    for place in [[-4.8, 20.5, 0.1], [0.3, 25.0, 0.8], [4.8, 29.5, 1.4], [5.0, 30.0, 1.5]] {
        let found = wind.evaluate(1, place);
        let expected = 10.0 + 0.4 * (place[0] + 5.0) + 0.06 * (place[1] - 20.0) + 8.0 * place[2];
        let is_right = [expected, 0.4, 0.06, 8.0].iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_right, "{place:?}: {found:?} {expected}");
    }
}

#[test]
fn a_periodic_file_repeats_and_another_one_ends() {
    let wind = WindBox::of_file(file(8, number)).unwrap();
    for time in [0.1, 0.7, 1.9] {
        let [here, later, earlier] =
            [time, time + 6.0, time - 4.0].map(|time| wind.evaluate(0, [1.0, 24.0, time])[0]);
        assert!((here - later).abs() < 1e-12 && (here - earlier).abs() < 1e-12, "{time}");
    }
    // Half way between the last plane and the first.
    let [between, before, last, first, second] =
        [1.75, 1.0, 1.5, 0.0, 0.5].map(|time| wind.evaluate(0, [0.0, 20.0, time])[0]);
    let expected = (9.0 * (last + first) - (before + second)) / 16.0;
    assert!((between - expected).abs() < 1e-12 && last - first > 1.0, "{between} {last} {first}");
    let wind = WindBox::of_file(file(7, number)).unwrap();
    assert!(wind.evaluate(0, [5.0, 30.0, 1.5])[0].is_finite());
    assert!(wind.evaluate(0, [-5.0, 20.0, 0.0])[0].is_finite());
    for place in [
        [5.1, 25.0, 1.0],
        [-5.1, 25.0, 1.0],
        [0.0, 19.9, 1.0],
        [0.0, 30.1, 1.0],
        [0.0, 25.0, 1.6],
        [0.0, 25.0, -0.1],
        [f64::NAN, 25.0, 1.0],
    ] {
        assert!(wind.evaluate(0, place).iter().all(|value| value.is_nan()), "{place:?}");
    }
    assert_eq!(wind.extent(), "y = -5 to 5 m, z = 20 to 30 m and t = 0 to 1.5 s");
}

#[test]
fn damaged_files_are_rejected() {
    let right = file(7, number);
    let changed = |at: usize, bytes: &[u8]| {
        let mut own = right.clone();
        own[at..at + bytes.len()].copy_from_slice(bytes);
        own
    };
    let (huge, negative) = (i32::MAX.to_le_bytes(), (-1_i32).to_le_bytes());
    for (own, words) in [
        (Vec::new(), "ends within its header"),
        (right[..60].to_vec(), "ends within its header"),
        (right[..right.len() - 1].to_vec(), "bytes, but its header requires 245"),
        ([right.as_slice(), &[0]].concat(), "the file has 246 bytes, but its header requires 245"),
        (changed(0, &4_i16.to_le_bytes()), "begins with 4, not with 7 or 8"),
        (changed(2, &1_i32.to_le_bytes()), "fewer than two points along z"),
        (changed(6, &negative), "fewer than two points along y"),
        (changed(10, &negative), "a negative number of points of the tower"),
        (changed(14, &0_i32.to_le_bytes()), "fewer than two instants"),
        (changed(2, &[huge, huge, huge, huge].concat()), "requires more than a file can have"),
        (changed(14, &huge), "but its header requires"),
        (changed(18, &0.0_f32.to_le_bytes()), "a distance that is not positive"),
        (changed(26, &f32::NAN.to_le_bytes()), "a distance that is not positive"),
        (changed(42, &0.0_f32.to_le_bytes()), "a scale that is zero"),
        (changed(66, &negative), "a negative length of the description"),
        (changed(66, &huge), "but its header requires"),
    ] {
        let problem = WindBox::of_file(own).unwrap_err().to_string();
        assert!(problem.contains(words), "{words}: {problem}");
    }
}
