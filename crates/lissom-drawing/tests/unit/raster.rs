//! Tests of `raster`, a module of it.

use super::*;

fn empty(width: f64, height: f64) -> Raster {
    Raster::new(&Drawing::new("empty", [width, height]), 1.0).unwrap()
}

fn pixels(raster: &Raster) -> Vec<u8> {
    let mut pixels = Vec::new();
    raster.write(None, &mut pixels).unwrap();
    pixels
}

/// Sum over the pixels, one for a black one.
fn darkness(raster: &Raster) -> f64 {
    pixels(raster).iter().map(|pixel| 1.0 - f64::from(*pixel) / 255.0).sum::<f64>() / 3.0
}

#[test]
fn polygons_cover_their_area() {
    for points in [
        vec![[3.3, 2.7], [15.9, 4.1], [8.2, 17.6]],
        vec![[2.25, 2.5], [9.75, 2.5], [9.75, 12.75], [2.25, 12.75]],
        vec![[2.0, 2.0], [2.0, 18.0], [18.0, 18.0], [18.0, 17.0], [3.0, 17.0], [3.0, 2.0]],
    ] {
        let mut raster = empty(20.0, 20.0);
        raster.fill(path(&points, true), [0; 3]);
        let next = |index: usize| points[(index + 1) % points.len()];
        let twice: f64 = points.iter().enumerate().map(|(i, a)| a[0] * next(i)[1] - a[1] * next(i)[0]).sum();
        let found = darkness(&raster) / (0.5 * twice.abs());
        assert!((found - 1.0).abs() < 0.01, "{found} {twice}");
    }
}

#[test]
fn lines_cover_length_times_width() {
    // The last ones cross several bands.
    for (to, width) in [
        ([40.0, 10.0], 3.0),
        ([10.0, 40.0], 1.5),
        ([45.0, 38.0], 2.0),
        ([45.0, 38.0], 0.5),
        ([45.0, 190.0], 2.0),
        ([45.0, 190.0], 9.0),
    ] {
        let mut raster = empty(60.0, 200.0);
        raster.stroke(path(&[[10.0, 10.0], to], false).as_ref(), [0; 3], width, None);
        let length = f64::hypot(to[0] - 10.0, to[1] - 10.0);
        let width = f64::from(width);
        let found = darkness(&raster) / (length * width + 0.25 * std::f64::consts::PI * width * width);
        assert!((found - 1.0).abs() < 0.06, "{to:?} {width}: {found}");
    }
}

#[test]
fn lines_along_an_axis_are_whole_pixels() {
    let mut drawing = Drawing::new("corner", [20.0, 20.0]);
    drawing.line(vec![[3.3, 2.0], [3.3, 16.2], [18.0, 16.2]], [0; 3], 1.0);
    let raster = Raster::new(&drawing, 2.0).unwrap();
    let found = pixels(&raster);
    assert!(found.iter().all(|pixel| [0, 255].contains(pixel)));
    assert_eq!(darkness(&raster), 2.0 * 30.0 + 2.0 * 29.0);
}

#[test]
fn dashes_go_on_along_a_curve_of_many_points() {
    let mut drawing = Drawing::new("dashes", [60.0, 6.0]);
    let points = (0..=1000).map(|k| [0.0599 * f64::from(k), 3.0]).collect();
    drawing.dashed_line(points, [0; 3], 2.0);
    let found = pixels(&Raster::new(&drawing, 1.0).unwrap());
    // Dashes begin at 0, 12, 24, 36 and 48, and each is 8 long.
    for dash in 0..5 {
        let row = |column: usize| found[3 * (3 * 60 + 12 * dash + column)];
        assert_eq!([row(2), row(6), row(10)], [0, 0, 255], "{dash}");
    }
}

#[test]
fn what_lies_outside_is_cut_off() {
    let square = |right: f64| path(&[[-50.0, -50.0], [right, -50.0], [right, 60.0], [-50.0, 60.0]], true);
    let mut raster = empty(10.0, 10.0);
    raster.fill(square(60.0), [0; 3]);
    assert!((darkness(&raster) - 100.0).abs() < 1e-9, "{}", darkness(&raster));
    let mut raster = empty(10.0, 10.0);
    raster.fill(square(5.0), [0; 3]);
    assert!((darkness(&raster) - 50.0).abs() < 1e-9, "{}", darkness(&raster));
    let mut line = |points: [[f64; 2]; 2], shade| {
        let points = points.to_vec();
        raster.add(&Shape::Line { points, shade, width: 2.0, is_dashed: false }, 1.0);
    };
    line([[20.0, 20.0], [30.0, 30.0]], [0; 3]);
    line([[-1e9, 5.0], [1e9, 5.0]], [255; 3]);
    assert!((darkness(&raster) - 40.0).abs() < 0.1, "{}", darkness(&raster));
}

#[test]
fn words_are_as_dark_upright_as_level() {
    let words = |is_upright| {
        let mut raster = empty(120.0, 120.0);
        let at = if is_upright { [60.3, 110.0] } else { [10.0, 60.3] };
        let text = "displacement [m]".to_owned();
        let (height, align, shade) = (12, Align::Start, [0; 3]);
        raster.add(&Shape::Words { at, text, height, align, shade, is_upright }, 1.0);
        darkness(&raster)
    };
    let [level, upright] = [words(false), words(true)];
    assert!(level > 100.0 && (upright / level - 1.0).abs() < 0.02, "{level} {upright}");
}
