//! Tests of `geometry::curves::spline`, a module of it.

use super::*;

#[test]
fn a_spline_through_points_of_a_circle_is_almost_a_circle() {
    let points: Vec<[f64; 2]> = (0..40)
        .map(|k| {
            let (s, c) = (-std::f64::consts::TAU * f64::from(k) / 40.0).sin_cos();
            [2.0 * c, 2.0 * s]
        })
        .collect();
    let spline = Spline::new(&points).expect("valid");
    assert!(area(spline.points()) > 0.0);
    let step = 1e-5;
    for k in 0..50 {
        let t = spline.length() * 0.0213 * f64::from(k);
        let [p, first, second] = spline.at(t);
        assert!((p.norm() - 2.0).abs() < 1e-5, "{t} {p}");
        let slope = (spline.at(t + step)[0] - spline.at(t - step)[0]) / (2.0 * step);
        let bend = (spline.at(t + step)[1] - spline.at(t - step)[1]) / (2.0 * step);
        assert!((slope - first).norm() < 1e-8 && (bend - second).norm() < 1e-6, "{t} {slope} {bend}");
    }
    assert_eq!(Spline::new(&points[..2]), None);
    assert_eq!(Spline::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]), None);
}
