//! Kinds of pairs of solids that touch in one point.

mod curve_on_surface;
mod ellipsoid_on_plane;
mod point_on_surface;
mod rim_on_plane;

pub use curve_on_surface::CurveOnSurface;
pub use ellipsoid_on_plane::EllipsoidOnPlane;
pub use point_on_surface::PointOnSurface;
pub use rim_on_plane::RimOnPlane;

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use lissom_motion::{Matrix3, Rotation, Vector3};

    use super::*;
    use crate::contact::curves::{Segment, Spline};
    use crate::contact::gap::{Gap, Pair};
    use crate::contact::surfaces::{Cuboid, HalfSpace, Ring, Rod, Surface};
    use crate::law::hull;

    fn pairs() -> Vec<Box<dyn Pair>> {
        let point = |surface: Arc<dyn Surface>| -> Box<dyn Pair> {
            Box::new(PointOnSurface { rounding: 0.1, surface })
        };
        let segment = |surface: Arc<dyn Surface>| -> Box<dyn Pair> {
            let curve = Arc::new(Segment::new(0.4));
            Box::new(CurveOnSurface { curve, rounding: 0.1, surface })
        };
        let egg: Vec<[f64; 2]> = (0..60)
            .map(|k| {
                let (s, c) = (std::f64::consts::TAU * f64::from(k) / 60.0).sin_cos();
                [0.6 * c, 0.4 * s + 0.1 * c * c]
            })
            .collect();
        let spline = |surface: Arc<dyn Surface>| -> Box<dyn Pair> {
            let curve = Arc::new(Spline::new(&egg).expect("valid"));
            Box::new(CurveOnSurface { curve, rounding: 0.1, surface })
        };
        vec![
            point(Arc::new(HalfSpace)),
            point(Arc::new(Rod { half_length: 0.3, radius: 0.4 })),
            point(Arc::new(Cuboid { half_sides: [0.3, 0.5, 0.8] })),
            point(Arc::new(Ring { radii: [0.3, 0.6], half_length: 0.4 })),
            Box::new(RimOnPlane { radius: 0.5, rounding: 0.02 }),
            Box::new(EllipsoidOnPlane { semi_axes: [0.3, 0.6, 0.2] }),
            segment(Arc::new(HalfSpace)),
            segment(Arc::new(Rod { half_length: 0.3, radius: 0.2 })),
            segment(Arc::new(Cuboid { half_sides: [0.2, 0.3, 0.4] })),
            segment(Arc::new(Ring { radii: [0.0, 0.3], half_length: 0.4 })),
            spline(Arc::new(HalfSpace)),
            spline(Arc::new(Rod { half_length: 0.3, radius: 0.2 })),
        ]
    }

    /// Derivatives of normal and point are those of differences, and the gap changes with the velocity of the point of contact along
    /// the normal: its force then does the work of an energy.
    #[test]
    fn derivatives_are_those_of_differences() {
        let step = 1e-6;
        for (index, pair) in pairs().iter().enumerate() {
            let mut compared = 0;
            for k in 0..160 {
                let share = |factor: f64| (f64::from(k) * factor).fract() * 2.0 - 1.0;
                let x = Vector3::new(share(0.754_877), share(0.569_840), share(0.430_159));
                let turn =
                    Rotation::exponential(&(3.0 * Vector3::new(share(0.31), share(0.77), share(0.13))));
                let rotation = turn.matrix();
                let at = pair.gap(&x, &rotation);
                if at.value < -0.1 {
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
                    assert!((normal - at.normal_by.column(column)).norm() < allowed, "{index} {k} {column}");
                    assert!((point - at.point_by.column(column)).norm() < allowed, "{index} {k} {column}");
                    // The velocity of the point of contact along the normal.
                    let arm = rotation.tr_mul(&(at.point - x));
                    let unit = Vector3::ith(column % 3, 1.0);
                    let local = if column < 3 { unit } else { unit.cross(&arm) };
                    let wanted = at.normal.dot(&(rotation * local));
                    let change = (after.value - before.value) / (2.0 * step);
                    assert!((change - wanted).abs() < 1e-6, "{index} {k} {column}: {change} {wanted}");
                }
            }
            assert!(compared > 200, "{index}: {compared}");
        }
    }

    /// Values along a motion are within the range over its arguments, and sliding and spinning on a plane do not widen it.
    #[test]
    fn ranges_contain_all_values() {
        let motions = [(Vector3::z(), 1.0), (Vector3::x(), 0.2), (Vector3::new(0.3, -0.8, 0.5), 0.7)];
        for pair in pairs() {
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
                    assert!(is_within, "{pair:?}: {value} not in {low} … {high}");
                }
                assert!(!pair.is_on_plane() || axis != Vector3::z() || high - low < 1e-12, "{pair:?}");
            }
        }
    }
}
